"""GCON measured: the strength with which a constraint of the user's pushes."""

from __future__ import annotations

import numpy as np
import pytest

import adamslite

HEAD = """\
a mass and a rule
PART/1, GROUND
MARKER/1, PART=1
ACCGRAV/JGRAV=-9.81
"""
PENDULUM = HEAD + (
    "POINT_MASS/2, MASS=2, CM=2, QG=-1,0,0\nMARKER/2, POINT_MASS=2\n"
    "GCON/1, FUNCTION=DM(2,1)-1\nREQUEST/1, F2=GCON(1)/2\\ F3=0\nEND\n"
)


@pytest.mark.parametrize("formulation", ["SI2", "I3"])
def test_the_tension_of_a_pendulum(formulation: str) -> None:
    """Released level: T = 3 m g times the depth; a rod that pulls has a negative strength."""
    results = adamslite.simulate(
        adamslite.read(PENDULUM), end=1, steps=20, error=1e-8, formulation=formulation
    )
    tension = -3 * 2 * 9.81 * results["POINT_MASS/2.y"]
    assert -results["GCON/1.f"] == pytest.approx(tension, abs=1e-3 * 2 * 9.81)
    assert results["REQUEST/1.F2"] == pytest.approx(results["GCON/1.f"] / 2)


def test_a_speed_that_is_held() -> None:
    """A mass of 3 falls at the constant speed 2: the constraint carries its weight, upwards."""
    text = HEAD + (
        "POINT_MASS/2, MASS=3, CM=2, VY=-2\nMARKER/2, POINT_MASS=2\nGCON/1, FUNCTION=VY(2)+2\nEND\n"
    )
    results = adamslite.simulate(adamslite.read(text), end=1, steps=4)
    assert results["GCON/1.f"] == pytest.approx(3 * 9.81)
    assert results["POINT_MASS/2.vy"] == pytest.approx(-2.0)


def test_a_force_that_depends_on_it() -> None:
    """Friction on a wire: a mass pushed along y = 0 by F slides against mu |L|, L = m g."""
    text = HEAD + (
        "POINT_MASS/2, MASS=3, CM=2\nMARKER/2, POINT_MASS=2\nGCON/1, FUNCTION=DY(2)\n"
        "MARKER/10, FLOATING, PART=1\n"
        "VFORCE/1, I=2, JFLOAT=10, RM=1, FX=20-0.3*GCON(1)\\ FY=-5*TIME\\ FZ=0\nEND\n"
    )
    results = adamslite.simulate(adamslite.read(text), end=1, steps=4, error=1e-8)
    t = results.time
    assert results["GCON/1.f"] == pytest.approx(3 * 9.81 + 5 * t)
    assert results["POINT_MASS/2.ax"] == pytest.approx((20 - 0.3 * (3 * 9.81 + 5 * t)) / 3)


def test_nothing_is_left_of_one_that_is_switched_off() -> None:
    from adamslite.deck import read_commands

    deck = adamslite.read(PENDULUM)
    run = "DEACTIVATE/GCON, ID=1\nSIMULATE/DYNAMICS, END=0.1, STEPS=2\nSTOP\n"
    results = adamslite.simulate(deck, commands=read_commands(run, deck))
    assert not np.any(results["GCON/1.f"])
    assert results["POINT_MASS/2.ay"] == pytest.approx(-9.81)
