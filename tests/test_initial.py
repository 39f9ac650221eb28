"""Initial conditions: the nearest consistent positions and velocities, EXACT, refusals."""

from __future__ import annotations

import numpy as np
import pytest
from scenes import GROUND, done, run

from adamslite import Outcome

HINGE = """MARKER/2, PART=2
MARKER/21, PART=2, QP=-1,0,0
JOINT/1, REVOLUTE, I=21, J=1
END
"""


def first(deck: str, name: str) -> float:
    return done(deck, 0.01, 1)[name][0]


def test_an_open_joint_is_closed_by_the_smallest_move():
    """A point 5 m from a sphere of radius 4.9 goes straight to it."""
    deck = (
        GROUND
        + "POINT_MASS/2, MASS=1, CM=2, QG=3,4,0\nMARKER/2, POINT_MASS=2\n"
        + "GCON/1, FUNCTION=DM(2,1)-4.9\nEND\n"
    )
    assert first(deck, "POINT_MASS/2.x") == pytest.approx(3 * 0.98, abs=1e-12)
    assert first(deck, "POINT_MASS/2.y") == pytest.approx(4 * 0.98, abs=1e-12)


def test_exact_coordinates_stay():
    """With EXACT=X the same point moves along y only."""
    deck = (
        GROUND
        + "PART/2, MASS=1, CM=2, IP=1,1,1, QG=3,4,0, EXACT=X\nMARKER/2, PART=2\n"
        + "GCON/1, FUNCTION=DM(2,1)-4.9\nEND\n"
    )
    assert first(deck, "PART/2.x") == pytest.approx(3.0, abs=1e-7)
    assert first(deck, "PART/2.y") == pytest.approx(np.sqrt(4.9**2 - 9), abs=1e-7)


@pytest.mark.parametrize("formulation", ("SI2", "I3"))
def test_a_velocity_along_the_rod_is_taken_away(formulation):
    """Of v = (0.3, 2) only the part across the rod and the spin that fits it stay."""
    deck = GROUND + "PART/2, MASS=1, CM=2, IP=1,1,1, QG=1,0,0, VX=0.3, VY=2, WZ=2\n" + HINGE
    results = done(deck, 0.01, 1, formulation=formulation)
    assert results["PART/2.vx"][0] == pytest.approx(0.0, abs=1e-12)
    assert results["PART/2.vy"][0] == pytest.approx(2.0, abs=1e-12)
    assert results["PART/2.wz"][0] == pytest.approx(2.0, abs=1e-12)


def test_a_speed_of_one_coordinate_is_shared_fairly():
    """VY alone: v = w L with both near their wishes (2, 0); weights 1 and J/m = 1: v = w = 1."""
    deck = GROUND + "PART/2, MASS=1, CM=2, IP=0.1,0.1,0.8, QG=1,0,0, VY=2\n" + HINGE
    results = done(deck, 0.01, 1)
    assert results["PART/2.vy"][0] == pytest.approx(results["PART/2.wz"][0], abs=1e-12)
    assert results["PART/2.vy"][0] == pytest.approx(1.0, abs=1e-9)


@pytest.mark.parametrize(("moments", "square"), [("0.4,0.4,1.2", 2.0), ("0.05,0.05,0.1", 0.2)])
def test_a_turn_weighs_as_the_radius_of_gyration(moments, square):
    """min (v - 2)^2 + k^2 w^2 with v = w L, L = 1 and k^2 = (Ixx + Iyy + Izz)/m."""
    deck = GROUND + f"PART/2, MASS=1, CM=2, IP={moments}, QG=1,0,0, VY=2\n" + HINGE
    assert first(deck, "PART/2.vy") == pytest.approx(2.0 / (1.0 + square), rel=1e-9)


def test_a_nonholonomic_constraint_sets_the_speed():
    deck = (
        GROUND
        + "POINT_MASS/2, MASS=1, CM=2\nMARKER/2, POINT_MASS=2\n"
        + "GCON/1, FUNCTION=VX(2)-3\nEND\n"
    )
    results = done(deck, 1.0, 2)
    np.testing.assert_allclose(results["POINT_MASS/2.vx"], 3.0, atol=1e-9)
    np.testing.assert_allclose(results["POINT_MASS/2.x"], 3 * results.time, atol=1e-6)


def test_the_first_acceleration_and_reaction_are_those_of_the_equations():
    """A rod hinged at its end, released level: alpha = m g L/(m L^2 + J)."""
    deck = GROUND + "ACCGRAV/JGRAV=-10\nPART/2, MASS=2, CM=2, IP=1,1,3, QG=1,0,0\n" + HINGE
    results = done(deck, 0.01, 1)
    assert results["PART/2.az"][0] == 0.0
    assert results["PART/2.ay"][0] == pytest.approx(-4.0, rel=1e-12)
    assert results["JOINT/1.fy"][0] == pytest.approx(2 * (10 - 4), rel=1e-12)


def test_what_cannot_be_closed_is_named():
    """A point on two circles that do not meet."""
    deck = (
        GROUND
        + "MARKER/11, PART=1, QP=5,0,0\nPOINT_MASS/2, MASS=1, CM=2, QG=1,1,0\n"
        + "MARKER/2, POINT_MASS=2\nGCON/1, FUNCTION=DM(2,1)-1\nGCON/2, FUNCTION=DM(2,11)-1\nEND\n"
    )
    results = run(deck, 1.0, 1)
    assert results.outcome is Outcome.INITIAL_CONDITIONS_FAILED
    assert "GCON/" in results.message
    assert "(<text>:" in results.message
    assert len(results.time) == 0
