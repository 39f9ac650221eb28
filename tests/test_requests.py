"""REQUEST of VARIABLEs, and MREQUEST, which stands for many of them."""

from __future__ import annotations

import numpy as np
import pytest
from decklets import deck_with, told
from scenes import GROUND, done

from adamslite.language.messages import START

FLYING = (
    GROUND
    + """POINT_MASS/2, MASS=2, VX=3, CM=2
MARKER/2, POINT_MASS=2
POINT_MASS/3, MASS=1, QG=0,0,5
PART/5, MASS=1, CM=5, IP=1,1,1, QG=0,2,0, VY=-1
MARKER/5, PART=5, QP=1,0,0
MARKER/6, PART=1, QP=0,4,0, REULER=90D,0,0
"""
)


def test_a_request_of_variables_has_the_value_of_each() -> None:
    """x = 3 t and x^2 of a point mass that moves at 3."""
    found = done(
        FLYING + "VARIABLE/7, FUNCTION=DX(2,1)\nVARIABLE/8, FUNCTION=VARVAL(7)**2\n"
        "REQUEST/1, VARIABLES=8, 7, CUNITS=a\nEND\n",
        end=1,
    )
    assert found["REQUEST/1.F2"] == pytest.approx(3 * found.time, rel=1e-9, abs=1e-12)
    assert found["REQUEST/1.F1"] == pytest.approx(9 * found.time**2, rel=1e-9, abs=1e-12)


def test_parts_are_measured_at_their_mass_centre() -> None:
    """From MARKER/6 at (0, 4, 0), along axes turned by 90 degrees about z: x is y of ground."""
    found = done(
        FLYING + "MREQUEST/1, DISPLACEMENT, PARTS=ALL, J=6, RM=6\n"
        "MREQUEST/2, VELOCITY, PARTS=5\nEND\n",
        end=1,
    )
    t = found.time
    assert found["REQUEST/MREQUEST_1_POINT_MASS_3.F4"] == pytest.approx(5, rel=1e-12)
    for part, place in (
        ("PART_5", np.column_stack([-2 - t, -1 + 0 * t])),
        ("POINT_MASS_2", np.column_stack([-4 + 0 * t, -3 * t])),
    ):
        for n, expected in enumerate(place.T, 2):
            column = found[f"REQUEST/MREQUEST_1_{part}.F{n}"]
            assert column == pytest.approx(expected, rel=1e-9, abs=1e-9)
    assert found["REQUEST/MREQUEST_2_PART_5.F3"] == pytest.approx(-1, rel=1e-12)


def test_forces_are_those_on_i() -> None:
    """A body at rest under gravity: the joint carries 2 m g, the spring pulls back with 3."""
    found = done(
        GROUND
        + """ACCGRAV/JGRAV=-9.81
PART/2, MASS=2, CM=2, IP=1,1,1
MARKER/2, PART=2
MARKER/3, PART=2, QP=1,0,0
MARKER/4, PART=1, QP=4,0,0
JOINT/9, FIXED, I=2, J=1
SPRINGDAMPER/9, TRANSLATIONAL, I=3, J=4, K=3, LENGTH=2
SFORCE/10, TRANSLATIONAL, ACTIONONLY, I=3, J=1, FUNCTION=7
MREQUEST/1, FORCE, ALL, COMMENT=loads
MREQUEST/2, FORCE, FORCES=9, JOINTS=9
END
""",
        end=0.1,
    )
    for number in (1, 2):
        name = f"REQUEST/MREQUEST_{number}"
        assert found[f"{name}_JOINT_9.F3"] == pytest.approx(2 * 9.81, rel=1e-9)
        assert found[f"{name}_JOINT_9.F2"] == pytest.approx(-3, rel=1e-9)
        assert found[f"{name}_SPRINGDAMPER_9.F2"] == pytest.approx(3, rel=1e-9)
    assert found["REQUEST/MREQUEST_1_SFORCE_10.F4"] == pytest.approx(7, rel=1e-9)
    assert "REQUEST/MREQUEST_2_SFORCE_10.F4" not in found.names


def test_what_is_listed_exists() -> None:
    (mistake,) = told(START + "MREQUEST/1, FORCE, JOINTS=3\n")
    assert (mistake.code, mistake.message) == ("missing-reference", "there is no JOINT/3")
    deck = deck_with("MREQUEST/1, VELOCITY, PARTS=2,3")
    assert [each.label for each in deck.statements[-3:]] == [
        "REQUEST/MREQUEST_1_PART_2",
        "MARKER/MREQUEST_1_POINT_MASS_3",
        "REQUEST/MREQUEST_1_POINT_MASS_3",
    ]
