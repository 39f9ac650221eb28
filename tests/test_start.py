"""Conditions at the start: ICDISP and ICVEL of motions, IC, ICTRAN and ICROT of joints."""

from __future__ import annotations

from math import pi

import pytest
from scenes import GROUND, run

from adamslite import Outcome, read, simulate
from adamslite.reading.read import read_commands

INTEGRATORS = ("GSTIFF", "RADAU", "HHT", "ABAM")
SLIDER = "PART/2, MASS=2, CM=2, IP=1,1,1{speeds}\nMARKER/2, PART=2\nJOINT/1, {joint}\n{motion}\n"
SLIDER += "REQUEST/1, F1=DZ(2,1)\\F2=VZ(2,1)\\F3=AZ(2,1)\\F4=WZ(2,1)\nEND\n"
SLIDES, TURNS = "TRANSLATIONAL, I=2, J=1", "REVOLUTE, I=2, J=1"


def moved(joint: str, motion: str = "", speeds: str = "", integrator: str = "GSTIFF"):
    """A part on one joint for 0.5 s."""
    deck = GROUND + SLIDER.format(joint=joint, motion=motion, speeds=speeds)
    return run(deck, 0.5, 1, integrator=integrator, error=1e-8)


@pytest.mark.parametrize("integrator", INTEGRATORS)
@pytest.mark.parametrize(("d", "v", "a"), ((0.5, 2.0, 1.0), (-1.2, -0.7, 3.0)))
@pytest.mark.parametrize("start", ("rate", "both", "displacement alone"))
def test_a_motion_starts_where_icdisp_says_and_as_fast_as_it_says(start, d, v, a, integrator):
    """x = d + v t + a t^2/2: v from FUNCTION, from ICVEL, or what the part has."""
    how = {
        "rate": (f"VELOCITY, ICDISP={d}, FUNCTION={v}+{a}*TIME", ""),
        "both": (f"ACCELERATION, ICDISP={d}, ICVEL={v}, FUNCTION={a}", ""),
        "displacement alone": (f"ACCELERATION, ICDISP={d}, FUNCTION={a}", f", VZ={v}, WZ={v}"),
    }
    motion, speeds = how[start]
    for joint, place, speed in ((SLIDES, "F1", "F2"), (TURNS, "F3", "F4")):
        results = moved(joint, f"MOTION/1, JOINT=1, {motion}", speeds, integrator)
        assert results.outcome is Outcome.DONE
        x, u = results[f"REQUEST/1.{place}"], results[f"REQUEST/1.{speed}"]
        assert (x[0], u[0]) == pytest.approx((d, v), abs=1e-10)
        assert x[1] == pytest.approx(d + v / 2 + a / 8, abs=1e-6)
        assert u[1] == pytest.approx(v + a / 2, abs=1e-6)


@pytest.mark.parametrize("given", (4.0, -1.5))
def test_a_displacement_alone_leaves_the_speed(given):
    """IC=0.7 of a slider that has VZ, IC=30 degrees of a hinge that has WZ; ICTRAN likewise."""
    speeds = f", VZ={given}, WZ={given}"
    for joint, d, v in (
        (f"{SLIDES}, IC=0.7", ("F1", 0.7), ("F2", given)),
        (f"{SLIDES}, IC=0.7, -2", ("F1", 0.7), ("F2", -2.0)),
        (f"{TURNS}, IC=30D", ("F3", pi / 6), ("F4", given)),
        ("CYLINDRICAL, I=2, J=1, ICTRAN=1", ("F1", 1.0), ("F2", given)),
        ("CYLINDRICAL, I=2, J=1, ICTRAN=1, ICROT=0.3,2", ("F3", 0.3), ("F4", 2.0)),
    ):
        results = moved(joint, speeds=speeds)
        assert results[f"REQUEST/1.{d[0]}"][0] == pytest.approx(d[1], abs=1e-10)
        assert results[f"REQUEST/1.{v[0]}"][0] == pytest.approx(v[1], abs=1e-10)


@pytest.mark.parametrize(
    ("joint", "motion", "told"),
    [
        (", IC=0.7", "MOTION/1, JOINT=1, FUNCTION=TIME", ("IC of JOINT/1", "MOTION/1")),
        (", IC=0.7, 2", "MOTION/1, JOINT=1, VELOCITY, FUNCTION=0", ("IC of JOINT/1", "MOTION/1")),
        (
            ", IC=0.7",
            "MOTION/1, JOINT=1, VELOCITY, ICDISP=0.2, FUNCTION=0",
            ("IC of JOINT/1", "ICDISP of MOTION/1"),
        ),
        (
            "",
            "MOTION/1, JOINT=1, VELOCITY, ICDISP=0.2, FUNCTION=0\nGCON/1, FUNCTION=DZ(2)-1",
            ("GCON/1", "ICDISP of MOTION/1"),
        ),
    ],
)
def test_contradicting_conditions_are_both_named(joint, motion, told):
    results = moved(SLIDES + joint, motion)
    assert results.outcome is Outcome.INITIAL_CONDITIONS_FAILED
    for name in told:
        assert f"{name} (<text>:" in results.message
    assert "condition 1" not in results.message


@pytest.mark.parametrize(
    "integrator", ("GSTIFF", "RADAU", "HHT", "NEWMARK", "ABAM", "VERLET", "AUTO")
)
def test_a_deck_in_which_nothing_moves_tabulates_its_expressions(integrator):
    deck = GROUND + "VARIABLE/1, FUNCTION=TIME**2\nREQUEST/1, F1=VARVAL(1)*3\nEND\n"
    results = run(deck, 2.0, 4, integrator=integrator)
    assert results.outcome is Outcome.DONE
    assert results["REQUEST/1.F1"] == pytest.approx(3 * results.time**2, abs=1e-12)


DRIVEN = SLIDER.replace("{joint}", SLIDES).format(speeds="", motion="VARIABLE/1, {law}\n{rule}")


@pytest.mark.parametrize("integrator", ("GSTIFF", "RADAU"))
@pytest.mark.parametrize("left_off", ((), ("variables",)))
@pytest.mark.parametrize(
    ("law", "rule", "speed"),
    [
        ("FUNCTION=3*TIME**2", "MOTION/1, JOINT=1, FUNCTION=VARVAL(1)", 3.0),
        ("FUNCTION=3*TIME**2", "MOTION/1, JOINT=1, FUNCTION=VARVAL(1)+VARVAL(1)", 6.0),
        ("FUNCTION=3*TIME", "MOTION/1, JOINT=1, VELOCITY, FUNCTION=2*VARVAL(1)", 3.0),
        ("FUNCTION=0.5*TIME**2", "GCON/1, FUNCTION=DZ(2,1)-VARVAL(1)", 0.5),
        ("FUNCTION=TIME**3", "MOTION/1, JOINT=1, FUNCTION=VARVAL(d(1)/dt)", 3.0),
    ],
)
def test_an_input_may_drive_a_motion(law, rule, speed, left_off, integrator):
    """A VARIABLE that PINPUT names is solved for; its rates are those of its FUNCTION."""
    deck = GROUND + DRIVEN.format(law=law, rule=rule) + "PINPUT/1, VARIABLES=1\nEND\n"
    deck = deck.replace("END\nPINPUT", "PINPUT")
    results = run(deck, 0.5, 2, integrator=integrator, no_reduction=left_off, error=1e-9)
    assert results.outcome is Outcome.DONE
    assert results["REQUEST/1.F2"][-1] == pytest.approx(speed, abs=1e-6)


def test_a_variable_solved_for_starts_at_its_function():
    """L_0 in a denominator: with IC = 0 there would be no first acceleration."""
    deck = GROUND + (
        "POINT_MASS/2, MASS=2, CM=2, QG=3,0,0\nMARKER/2, POINT_MASS=2\n"
        "VARIABLE/L_0, FUNCTION=2\nVARIABLE/K, FUNCTION=8/VARVAL(L_0)\nPINPUT/1, VARIABLES=L_0,K\n"
        "SFORCE/1, I=2, J=1, FUNCTION=-K/L_0*(DM(2,1)-L_0)\nEND\n"
    )
    assert run(deck, 0.1, 1)["POINT_MASS/2.ax"][0] == pytest.approx(-4 / 2 / 2, rel=1e-12)


@pytest.mark.parametrize(
    "rule", ("DM(2,1)-1", "SQRT(DX(2)-5)", "LOG(DX(2)-1)", "DX(2)/(DY(2)*TIME)", "SQRT(VX(2)-1)")
)
def test_a_constraint_without_a_value_at_the_start_is_named(rule):
    deck = GROUND + (
        "PART/2, MASS=2, CM=2, IP=1,1,1\nMARKER/2, PART=2\n"
        f"JOINT/1, PLANAR, I=2, J=1\nGCON/1, FUNCTION={rule}\nEND\n"
    )
    results = run(deck, 0.1, 1)
    assert results.outcome is Outcome.NOT_FINITE
    assert results.message.startswith("GCON/1 (<text>:7:1), FUNCTION, has no value at the start.")


@pytest.mark.parametrize(
    ("change", "name", "value"),
    [
        ("DIFF/1, IC=3", "DIFF/1", 3.0),
        ("POINT_MASS/2, QG=0,0,-2", "POINT_MASS/2.z", -2.0),
        ("POINT_MASS/2, VX=4", "POINT_MASS/2.vx", 4.0),
        ("DEACTIVATE/JPRIM, ID=1", "POINT_MASS/2.y", 0.5),
    ],
)
def test_commands_before_the_first_analysis_change_the_start(
    change: str, name: str, value: float
) -> None:
    """A mass that JPRIM/1 moves from y = 0.5 onto the x axis of ground, unless it is off."""
    deck = read(
        GROUND + "POINT_MASS/2, MASS=1, CM=2, QG=0,0.5,0\nMARKER/2, POINT_MASS=2\n"
        "JPRIM/1, INPLANE, I=2, J=4\n"
        "MARKER/4, PART=1, REULER=0,90D,0\nDIFF/1, IC=1, FUNCTION=0\nEND\n"
    )
    commands = read_commands(f"{change}\nSIMULATE/DYNAMIC, END=1E-3, STEPS=1\n", deck)
    assert not commands.warnings
    assert simulate(deck, commands=commands)[name][0] == pytest.approx(value)
