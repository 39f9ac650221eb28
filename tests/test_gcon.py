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


def test_a_distance_that_grows_at_a_held_rate() -> None:
    """VR = 3 and nothing across: r = 5 + 3 t along the line drawn, however the mass starts."""
    text = HEAD.replace("-9.81", "0") + (
        "POINT_MASS/2, MASS=2, CM=2, QG=3,4,0, VX=1\nMARKER/2, POINT_MASS=2\n"
        "JPRIM/1, INLINE, I=2, J=3\nMARKER/3, PART=1, ZP=3,4,0\n"
        "GCON/1, FUNCTION=VR(2,1)-3\nREQUEST/1, F1=DM(2,1)\nEND\n"
    )
    results = adamslite.simulate(adamslite.read(text), end=1, steps=4, error=1e-8)
    assert results["REQUEST/1.F1"] == pytest.approx(5 + 3 * results.time, abs=1e-6)


@pytest.mark.parametrize("integrator", ["GSTIFF", "RADAU", "HHT", "ABAM"])
def test_a_rule_of_speeds_may_stand_before_the_joints(integrator: str) -> None:
    """A crank of length 1, drawn at rest, is held at w = 2 + t: its hinge bears -m w^2 along it,
    m w' across, and the weight.
    """
    text = HEAD + (
        "GCON/1, FUNCTION=WZ(2)-2-TIME\n"
        "PART/2, MASS=3, CM=2, IP=1,1,1, QG=1,0,0\nMARKER/2, PART=2\n"
        "MARKER/3, PART=2, QP=-1,0,0\nJOINT/1, REVOLUTE, I=3, J=1\n"
        "REQUEST/1, F1=FX(3,1)\\F2=FY(3,1)\nEND\n"
    )
    deck = adamslite.read(text)
    results = adamslite.simulate(deck, end=1, steps=4, error=1e-8, integrator=integrator)
    t = results.time
    turn, w = 2 * t + t**2 / 2, 2 + t
    x, y = np.cos(turn), np.sin(turn)
    assert results["PART/2.x"] == pytest.approx(x, abs=1e-6)
    assert results["PART/2.y"] == pytest.approx(y, abs=1e-6)
    assert results["REQUEST/1.F1"] == pytest.approx(-3 * w**2 * x - 3 * y, abs=1e-3)
    assert results["REQUEST/1.F2"] == pytest.approx(-3 * w**2 * y + 3 * x + 3 * 9.81, abs=1e-3)


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
    from adamslite.reading.read import read_commands

    deck = adamslite.read(PENDULUM)
    run = "DEACTIVATE/GCON, ID=1\nSIMULATE/DYNAMICS, END=0.1, STEPS=2\nSTOP\n"
    results = adamslite.simulate(deck, commands=read_commands(run, deck))
    assert not np.any(results["GCON/1.f"])
    assert results["POINT_MASS/2.ay"] == pytest.approx(-9.81)


HUNG = (
    "title\nPART/1, GROUND\nMARKER/1, PART=1\nMARKER/5, PART=1, QP=0,-{length},0\n"
    "ACCGRAV/JGRAV=-9.81\n"
    "PART/2, MASS={mass}, CM=2, IP=1,1,1, QG=0,-{length},0\nMARKER/2, PART=2\n"
    "GCON/1, FUNCTION={rule}\n"
    "REQUEST/1, F1=FY(2)\\F2=FY(2,1)\\F3=FM(1,2)\\F4=FY(1)\\F5=GCON(1,0,3)\\F6=GCON(1,1,3,2)\\\n"
    ", F7=GCON(1,0,1)\\F8=FY(2,5)\n"
    "REQUEST/2, FORCE, I=2, J=1\nREQUEST/3, FORCE, I=1, J=2\nEND\n"
)


@pytest.mark.parametrize("integrator", ["GSTIFF", "RADAU", "HHT", "ABAM"])
@pytest.mark.parametrize(("mass", "length"), [(2.0, 1.0), (0.5, 3.0)])
@pytest.mark.parametrize(
    "rule", ["DM(2,1)-{l}", "{l}*DM(2,1)**2-{l}**3", "DY(2,1)+{l}", "VY(2,1)", "VR(2,1)"]
)
def test_what_hangs_pulls_at_the_markers_of_the_expression(rule, mass, length, integrator):
    """Weight m g between the two markers: on the mass upwards, on the hook downwards."""
    if integrator == "HHT" and rule.startswith("V"):
        pytest.skip("one integrator of index 3 is enough for the velocity level")
    deck = HUNG.format(rule=rule.format(l=length), mass=mass, length=length)
    results = adamslite.simulate(adamslite.read(deck), end=0.1, steps=2, integrator=integrator)
    w = mass * 9.81
    expected = {"1.F1": w, "1.F2": w, "1.F3": w, "1.F4": -w, "1.F5": w, "1.F6": -w, "1.F7": w}
    expected |= {"1.F8": 0.0, "2.F1": w, "2.F3": w, "2.F5": 0.0, "3.F3": -w}
    for name, value in expected.items():
        assert results[f"REQUEST/{name}"] == pytest.approx(value, abs=1e-8), name


def test_every_leg_of_a_rope_over_three_markers_has_its_own_force() -> None:
    """|2-1| + |2-5| = const on a mass between two hooks: the same tension T in both legs.

    Two legs at 45 degrees carry m g: T = m g/sqrt(2).
    """
    text = HEAD + (
        "MARKER/5, PART=1, QP=2,0,0\nPOINT_MASS/2, MASS=2, CM=2, QG=1,-1,0\n"
        "MARKER/2, POINT_MASS=2\nGCON/1, FUNCTION=DM(2,1)+DM(2,5)-2*SQRT(2)\n"
        "REQUEST/1, F1=FX(2,1)\\F2=FY(2,1)\\F3=FX(2,5)\\F4=FY(2)\\F5=FX(5)\\F6=FX(1,5)\nEND\n"
    )
    results = adamslite.simulate(adamslite.read(text), end=0.1, steps=1)
    half = 9.81  # m g/2 = T/sqrt(2)
    found = [results[f"REQUEST/1.F{n}"][0] for n in range(1, 7)]
    assert found == pytest.approx([-half, half, half, 2 * half, -half, 0.0], abs=1e-8)


@pytest.mark.parametrize("rule", ["AZ(2,1)-0.3*TIME**2", "WZ(2,1)-0.6*TIME"])
def test_a_rule_about_an_angle_is_a_torque(rule: str) -> None:
    """theta = 0.3 t^2 about the principal axis with moment 4: T = 2.4, the opposite on the hook."""
    text = HEAD + (
        "PART/2, MASS=1, CM=2, IP=1,1,4\nMARKER/2, PART=2\nJOINT/1, SPHERICAL, I=2, J=1\n"
        f"GCON/1, FUNCTION={rule}\n"
        "REQUEST/1, F1=GCON(1,0,8)\\F2=GCON(1,1,8)\\F3=TZ(2,1)\\F4=TM(1,2)\nEND\n"
    )
    results = adamslite.simulate(adamslite.read(text), end=0.5, steps=2, error=1e-8)
    for name, value in (("F1", 2.4), ("F2", -2.4), ("F3", 2.4), ("F4", 2.4)):
        assert results[f"REQUEST/1.{name}"] == pytest.approx(value, abs=1e-6)
