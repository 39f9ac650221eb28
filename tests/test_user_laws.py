"""Routines of users that give curves, relations and laws of statements."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
import user_functions

import adamslite as al
from adamslite.language.diagnostics import DeckError

BEAD = """a bead on a curve that a routine gives
UNITS/SYSTEM=MKS
ACCGRAV/JGRAV=-9.81
PART/1, GROUND
MARKER/1, PART=1
POINT_MASS/2, MASS=2, QG={start}
MARKER/2, POINT_MASS=2
CURVE/1, {form}, MINPAR=0, MAXPAR=1, FUNCTION=USER(2)
PTCV/1, I=2, CURVE=1, RM=1
INTEGRATOR/GSTIFF, ERROR=1E-8
SIMULATE/DYNAMIC, END=1, STEPS=10
END
"""


def test_a_straight_curve_by_its_ends() -> None:
    """A line at 45 degrees: the bead slides down with g/sqrt(2), x = -y = -g t^2/4."""
    deck = BEAD.format(start="0,0,0", form="OPEN")
    found = al.simulate(al.read(deck, user={"CURSUB": (5.0, 5.0, 0.0, -9.0, -9.0, 0.0)}))
    assert found["POINT_MASS/2.y"] == pytest.approx(-9.81 * found.time**2 / 4, abs=1e-6)
    assert found["POINT_MASS/2.x"] == pytest.approx(-9.81 * found.time**2 / 4, abs=1e-6)


def test_a_curve_in_python() -> None:
    """A circle of radius 2: v^2/2 + g y is 0 as at the start, to a share of 5e-6, and r is 2."""
    deck = BEAD.format(start="2,0,0", form="CLOSED")
    found = al.simulate(al.read(deck, user={"CURVE/1": user_functions.circle}))
    x, y = found["POINT_MASS/2.x"], found["POINT_MASS/2.y"]
    vx, vy = found["POINT_MASS/2.vx"], found["POINT_MASS/2.vy"]
    assert np.hypot(x, y) == pytest.approx(2.0, abs=1e-7)
    assert (vx**2 + vy**2) / 2 + 9.81 * y == pytest.approx(0.0, abs=1e-4)
    assert y.min() < -1.0


@pytest.mark.parametrize(
    ("value", "said"),
    [
        ((0.0, 0.0, 0.0), "takes 6 values and gets 3"),
        (lambda given, alpha: (alpha, 0.0), "ValueError: a curve returns x, y and z"),
        (lambda given, alpha: (1 / alpha, 0.0, 0.0), "ZeroDivisionError"),
    ],
)
def test_a_curve_that_cannot_be_is_reported(value: Any, said: str) -> None:
    with pytest.raises(DeckError, match=said):
        al.read(BEAD.format(start="2,0,0", form="OPEN"), user={"CURSUB": value})


def test_the_function_curve_is_at_the_parameter_of_the_routine() -> None:
    """alpha^3, sin(alpha) and their derivatives, from MINPAR = 0.5 to MAXPAR = 2.5."""
    names = [(comp, order) for comp in (1, 2) for order in (0, 1, 2)]
    lines = [
        f"VARIABLE/c{comp}{order}, FUNCTION=CURVE(TIME+0.5, {order}, {comp}, 1)"
        for comp, order in names
    ]
    deck = (
        "a curve\nPART/1, GROUND\nCURVE/1, OPEN, MINPAR=0.5, MAXPAR=2.5, FUNCTION=USER()\n"
        + "\n".join(lines)
        + "\nSIMULATE/DYNAMIC, END=2, STEPS=7\nEND\n"
    )
    found = al.simulate(al.read(deck, user={"CURVE/1": user_functions.quickening}))
    a = found.time + 0.5
    expected = {1: (a**3, 3 * a**2, 6 * a), 2: (np.sin(a), np.cos(a), -np.sin(a))}
    for comp, order in names:
        allowed = 1e-6 * 10.0 ** (2 * order)
        assert found[f"VARIABLE/c{comp}{order}"] == pytest.approx(
            expected[comp][order], abs=allowed
        )


def test_a_curve_in_space_does_not_roll() -> None:
    deck = (
        "a cam\nPART/1, GROUND\nMARKER/1, PART=1\n"
        "PART/2, MASS=1, CM=2, IP=1,1,1\nMARKER/2, PART=2\n"
        "CURVE/1, OPEN, FUNCTION=USER()\nCURVE/2, OPEN, FUNCTION=USER()\n"
        "CVCV/1, ICURVE=1, JCURVE=2, IRM=2, JRM=1\nEND\n"
    )
    flat, high = (0.0, 0.0, 0.0, 1.0, 0.0, 0.0), (0.0, 0.0, 0.0, 1.0, 0.0, 0.2)
    with pytest.raises(DeckError, match="cannot roll CURVE/2, which is not plane"):
        al.read(deck, user={"CURVE/1": flat, "CURVE/2": high})


COUPLED = """a slider that follows a turning part
PART/1, GROUND
MARKER/31, PART=1
MARKER/32, PART=1, QP=0,1,0
PART/2, MASS=2, CM=21, IP=1,1,1
MARKER/21, PART=2
PART/3, MASS=1, CM=22, IP=1,1,3, QG=0,1,0
MARKER/22, PART=3
JOINT/1, TRANSLATIONAL, I=21, J=31
JOINT/2, REVOLUTE, I=22, J=32
MOTION/1, JOINT=2, VELOCITY, FUNCTION=2+TIME
COUPLER/1, JOINTS=1,2, FUNCTION=USER(0.25)
INTEGRATOR/GSTIFF, ERROR=1E-8
SIMULATE/DYNAMIC, END=2, STEPS=8
END
"""


def test_a_coupler_follows_the_relation_of_a_routine() -> None:
    """Travel 0.25 angle^2 with angle 2 t + t^2/2; the coupler carries m z" of the slider."""
    function = {"COUSUB": user_functions.screw}
    text = COUPLED.replace("INTEGRATOR", "VARIABLE/1, FUNCTION=COUPLER(1,0,4,0)\nINTEGRATOR")
    found = al.simulate(al.read(text, user=function))
    t = found.time
    angle, rate = 2 * t + t**2 / 2, 2 + t
    assert found["PART/2.z"] == pytest.approx(0.25 * angle**2, abs=1e-5)
    assert found["PART/2.vz"] == pytest.approx(0.5 * angle * rate, abs=1e-6)
    assert found["VARIABLE/1"] == pytest.approx(2 * 0.5 * (rate**2 + angle), rel=1e-4)


def test_a_field_has_the_law_of_a_routine_or_of_expressions() -> None:
    """A cubic spring: 1/2 m v^2 + 1/2 k x^2 + 1/4 h x^4 stays, for the routine and the deck."""
    body = (
        "a cubic spring\nPART/1, GROUND\nMARKER/1, PART=1\n"
        "PART/2, MASS=2, CM=2, IP=1,1,1, QG=0.5,0,0, VX=1, WZ=0.4\nMARKER/2, PART=2\n"
        "{field}\nSIMULATE/DYNAMIC, END=3, STEPS=30\nINTEGRATOR/GSTIFF, ERROR=1E-8\nEND\n"
    )
    routine = "FIELD/1, I=2, J=1, FORMULATION=NONLINEAR, FUNCTION=USER(3, 5)"
    written = "FIELD/1, I=2, J=1, FX=-3*DX(2,1,1)-5*DX(2,1,1)**3\\ TZ=-3*AZ(2,1)"
    bound = {"FIELD/1": user_functions.hardening}
    by_routine = al.simulate(al.read(body.format(field=routine), user=bound))
    by_deck = al.simulate(al.read(body.format(field=written)))
    for found in (by_routine, by_deck):
        x, v = found["PART/2.x"], found["PART/2.vx"]
        assert v**2 + 1.5 * x**2 + 1.25 * x**4 == pytest.approx(1.453125, abs=1e-5)
        root = np.sqrt(3.0)
        assert found["PART/2.psi"] == pytest.approx(
            0.4 / root * np.sin(root * found.time), abs=1e-6
        )
    assert by_routine["FIELD/1.fx"] == pytest.approx(by_deck["FIELD/1.fx"], abs=1e-4)


def test_a_ucon_holds_what_a_routine_says() -> None:
    """A pendulum of length 1 from the level: v^2 = -2 g y, and the string pulls with 3 m g sin."""
    deck = (
        "a pendulum\nACCGRAV/JGRAV=-9.81\nPART/1, GROUND\nMARKER/1, PART=1\n"
        "POINT_MASS/2, MASS=2, QG=1,0,0\nMARKER/2, POINT_MASS=2\nUCON/1, FUNCTION=USER(1)\n"
        "INTEGRATOR/GSTIFF, ERROR=1E-8\nSIMULATE/DYNAMIC, END=1, STEPS=10\nEND\n"
    )
    found = al.simulate(al.read(deck, user={"UCOSUB": user_functions.ring}))
    y, speed = (
        found["POINT_MASS/2.y"],
        found["POINT_MASS/2.vx"] ** 2 + found["POINT_MASS/2.vy"] ** 2,
    )
    assert speed == pytest.approx(-2 * 9.81 * y, abs=1e-5)
    assert found["GCON/UCON_1.f"] == pytest.approx(3 * 2 * 9.81 * y, abs=1e-4)
