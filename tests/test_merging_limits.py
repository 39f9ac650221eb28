"""Parts on FIXED that a run keeps apart, and those that fly as one body."""

from __future__ import annotations

import numpy as np
import pytest
from test_merging import PENDULUM, deck, difference, is_merged

import adamslite

HINGE = "JOINT/1, REVOLUTE, I=3, J=1"
VALUES = {"mass": 3, "more": "", "speeds": "", "extra": "", "kind": "DYNAMICS"}


def test_a_free_body_flies_and_spins_as_its_parts_do() -> None:
    """Its mass centre, at x = (2*1 + 3*2.5)/5 = 1.9, starts with the speed there, and falls."""
    given = VALUES | {"speeds": ", VX=1, VY=-0.5, WZ=3", "more": ", VX=1, VY=4, WZ=3"}
    found = adamslite.read(PENDULUM.replace(HINGE, "").format(**given))
    assert is_merged(found)
    assert difference(found, error=1e-10, integrator="RADAU") < 1e-9
    run = adamslite.simulate(found, error=1e-10)
    t = run.time
    y = (2 * run["PART/2.y"] + 3 * run["PART/3.y"]) / 5
    np.testing.assert_allclose(y, (-0.5 + 3 * 0.9) * t - 9.81 * t**2 / 2, atol=1e-9)


@pytest.mark.parametrize(
    ("old", "new"),
    [
        (HINGE, f"{HINGE}, IC=0.1,0"),
        (HINGE, f"{HINGE}\nMOTION/1, JOINT=1, ROTATION, FUNCTION=0.1*TIME, ICDISP=0.1"),
        (HINGE, f"{HINGE}\nMOTION/1, JOINT=1, ROTATION, ACCELERATION, FUNCTION=1"),
        ("QG=2,0,0", "QG=2,0,0, EXACT=X"),
        ("QG=2,0,0", "QG=2,0,0, REULER=1E-7,0,0"),
    ],
)
def test_parts_stay_apart_where_the_start_moves_each_by_itself(old: str, new: str) -> None:
    """Start conditions of other joints, a part that is kept where it is, parts drawn askew."""
    found = adamslite.read(PENDULUM.replace(old, new).format(**VALUES))
    assert not is_merged(found)


def test_parts_stay_apart_where_a_routine_may_ask_for_them() -> None:
    text = PENDULUM.format(**VALUES | {"extra": "SFORCE/1, I=6, J=1, FUNCTION=USER(1)"})
    assert not is_merged(adamslite.read(text, user={"SFOSUB": lambda parameters, time: 1.0}))
    assert is_merged(deck("SFORCE/1, I=6, J=1, FUNCTION=1"))


def test_parts_stay_apart_where_reactions_on_both_cannot_be_measured() -> None:
    """Two forces on ground whose reactions go to the two parts, wherever they are."""
    force = "MARKER/9, PART=1, QP=1,1,0\nVFORCE/3, I=9, J_PART=2, FX=5\\ FY=1\\ FZ=0"
    assert is_merged(deck(force))
    assert not is_merged(deck(f"{force}\nVFORCE/4, I=9, J_PART=3, FX=5\\ FY=1\\ FZ=0"))
