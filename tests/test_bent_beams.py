"""Elements beyond what their law is meant for are named once, with the time; others are not."""

from __future__ import annotations

import pytest

import adamslite
from adamslite.language.diagnostics import DeckError

BEAMS = """Two beams that gravity bends
UNITS/SYSTEM=MKS
ACCGRAV/JGRAV=%s
PART/1, GROUND
MARKER/1, PART=1
PART/2, MASS=10, CM=2, IP=1,1,1, QG=5,0,0
MARKER/2, PART=2
PART/3, MASS=10, CM=3, IP=1,1,1, QG=10,0,0
MARKER/3, PART=3
BEAM/1, I=2, J=1, LENGTH=5, IXX=1E-8, IYY=1E-8, IZZ=1E-8, AREA=1E-3
, EMODULUS=2E11, GMODULUS=8E10, CRATIO=0.01
BEAM/2, I=3, J=2, LENGTH=5, IXX=1E-8, IYY=1E-8, IZZ=1E-8, AREA=1E-3
, EMODULUS=2E11, GMODULUS=8E10, CRATIO=0.01
SIMULATE/DYNAMIC, END=1, STEPS=20
END
"""
BENT = """A pendulum on a constant-velocity joint, turned through its fold or not
UNITS/SYSTEM=MKS
PART/1, GROUND
MARKER/1, PART=1
PART/2, MASS=1, CM=20, IP=.1,.1,.1, WX=%s
MARKER/2, PART=2
MARKER/20, PART=2
JOINT/1, CONVEL, I=2, J=1
SIMULATE/DYNAMIC, END=1, STEPS=50
END
"""


@pytest.mark.numerical
@pytest.mark.parametrize(("gravity", "far"), [(-9.81, True), (-0.05, False)])
def test_beams_that_bend_far_are_named(gravity: float, far: bool) -> None:
    said = adamslite.simulate(BEAMS % gravity).meta.get("out of its law", "")
    assert ("BEAM/1 bent by more than 0.3 of its length" in said) == far


@pytest.mark.numerical
@pytest.mark.parametrize(("turn", "folded"), [(4.0, True), (2.9, False)])
def test_a_folded_constant_velocity_joint_is_named(turn: float, folded: bool) -> None:
    """It turns by 4 or 2.9 rad; within 5 degrees of pi it is folded, first at 3.054/4 s."""
    said = adamslite.simulate(BENT % turn).meta.get("out of its law", "")
    assert ("JOINT/1 bent to within 5 degrees of its fold" in said) == folded
    if folded:
        assert 0.7635 <= float(said.rpartition("=")[2]) < 0.83


@pytest.mark.parametrize(
    ("mass", "code"), [("-2", "negative-mass"), ("0", "no-mass"), ("-1E-9", "negative-mass")]
)
def test_a_negative_mass_is_called_so(mass: str, code: str) -> None:
    deck = f"x\nPART/1, GROUND\nMARKER/1, PART=1\nPOINT_MASS/2, MASS={mass}\nEND\n"
    with pytest.raises(DeckError) as caught:
        adamslite.read(deck)
    assert [each.code for each in caught.value.errors] == [code]


def test_a_mass_of_zero_is_noted_once() -> None:
    """Eight PARTs with MASS=0 give one note; one without MASS, as dummy parts are written, none."""
    parts = "".join(
        f"PART/{k}, MASS=0\nMARKER/{k}, PART={k}\nJOINT/{k}, FIXED, I={k}, J=1\n"
        for k in range(2, 10)
    )
    found = adamslite.read(f"x\nPART/1, GROUND\nMARKER/1, PART=1\n{parts}END\n").warnings
    assert [(each.code, each.severity) for each in found] == [("zero-mass", "note")]
    assert found[0].message.endswith("PART/6, PART/7 and 2 more")
    silent = parts.replace(", MASS=0", "")
    assert not adamslite.read(f"x\nPART/1, GROUND\nMARKER/1, PART=1\n{silent}END\n").warnings
