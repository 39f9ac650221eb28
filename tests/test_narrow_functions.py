"""Narrow functions, poles and roots of the state that a step must not pass unseen.

Closed forms: a force F(x) changes the energy by its integral, whatever the step; a repulsive pole
that the energy does not reach gives the speed back.
"""

from __future__ import annotations

from math import pi, sqrt

import numpy as np
import pytest
from pytest import approx
from scenes import GROUND, done, options, run, system

from adamslite.errors import UsageError
from adamslite.symbolic.guards import NARROW, POLE, ROOT

FORMULAS = ("GSTIFF", "GSTIFF I3", "HHT", "RADAU", "ABAM", "RKF45")
ERRORS = (1e-3, 1e-6)
DECK = GROUND + (
    "MARKER/9, PART=1, QP={c},0,0\n"
    "POINT_MASS/2, MASS=1, CM=2, VX={v}\nMARKER/2, POINT_MASS=2\n"
    "VARIABLE/1, FUNCTION=(DX(2)-{c})/{w}\n"
    "VFORCE/1, I=2, J_PART=1, FX={a}*({force})\nEND\n"
)
# A function of s = (x - c)/w, and its integral over s.
S = "((DX(2)-{c})/{w})"
HUMPS = {
    f"EXP(-{S}**2)": sqrt(pi),
    "EXP(-(DX(2)-{c})**2/{w}**2)": sqrt(pi),
    "EXP(-VARVAL(1)**2)": sqrt(pi),
    f"EXP(-{S}**4)": 1.8128049541109541,
    f"1/(1+{S}**2)": pi,
    f"(1+{S}**2)**(-1.5)": 2.0,
    f"(TANH({S}+2)-TANH({S}-2))/2": 4.0,
    f"{S}**2*EXP(-{S}**2)": sqrt(pi) / 2,
}
RISES = (f"(1+TANH({S}))/2", f"0.5+ATAN({S})/PI", f"(1+{S}/SQRT(1+{S}**2))/2")


def final_speed(formula: str, error: float, force: str, end: float, **numbers: float) -> float:
    """The velocity of 1 kg at ``end`` in five output steps."""
    deck = DECK.format(force=force.format(**numbers), **numbers)
    return done(deck, end, 5, **options(formula, error))["POINT_MASS/2.vx"][-1]


@pytest.mark.numerical
@pytest.mark.parametrize("formula", FORMULAS)
@pytest.mark.parametrize("force", HUMPS)
def test_a_hump_that_is_much_narrower_than_a_step(force, formula):
    """A hump of 0.1 mm to 10 cm on 100 m takes 36 % of the energy, or adds it."""
    for w, sign in ((1e-4, -1), (1e-2, 1), (0.1, -1)):
        for error in ERRORS:
            a = sign * 0.36 * 0.5 * 100.0**2 / (HUMPS[force] * w)
            found = final_speed(formula, error, force, 1.0, c=50.0, v=100.0, w=w, a=a)
            # The rest of the tails at the end, 50 m further: of 1/(1 + s^2) w/50 of it.
            off = 3e-2 if formula == "HHT" else 1e-2 if error > 1e-6 else 1e-3
            assert found == approx(100.0 * sqrt(1 + sign * 0.36), rel=off), (w, error)


@pytest.mark.numerical
@pytest.mark.parametrize("formula", FORMULAS)
@pytest.mark.parametrize("force", RISES)
def test_a_force_that_sets_in_within_a_micrometre(force, formula):
    """Behind x = 5 a force of 10 N acts: at t it is v = 10 - 10 (t - 0.5)."""
    found = final_speed(formula, 1e-5, force, 1.2, c=5.0, v=10.0, w=1e-6, a=-10.0)
    assert found == approx(3.0, abs=5e-3)


REPULSIVE = (
    ("(.05/({c}-DX(2)))**12/-.05", 100.0),
    ("1/(DX(2)-{c})**2*SIGN(1,DX(2)-{c})", 1e-3),
    ("1/(DX(2)-{c})", 8.0),
    ("DX(2,9)/DM(2,9)**14", 1e-7),
    ("-(({c}-DX(2))**(-2.5))", 1e-2),
    ("LOG({c}-DX(2))*2", 40.0),
)


@pytest.mark.numerical
@pytest.mark.parametrize("formula", [*FORMULAS, "VERLET", "AUTO"])
@pytest.mark.parametrize(("force", "a"), REPULSIVE)
def test_a_pole_is_not_stepped_through(force, a, formula):
    """A repulsive pole 1 m ahead gives 10 m/s back, at whatever ERROR."""
    for error in (1e-3,) if formula == "VERLET" and "SIGN" in force else (1e-3, 1e-4, 1e-6):
        deck = DECK.format(force=force.format(c=1.0), a=a, c=1.0, v=10.0, w=1.0)
        results = done(deck, 0.4, 8, **options(formula, error))
        x, v = results["POINT_MASS/2.x"], results["POINT_MASS/2.vx"]
        assert x.max() < 1.0
        if a in (1e-7, 100.0, 1e-2) and formula != "HHT":  # others reach as far as the mass comes
            assert v[-1] == approx(-10.0, rel=2e-2)


@pytest.mark.numerical
@pytest.mark.parametrize("formula", ("GSTIFF", "RADAU", "HHT", "ABAM"))
def test_a_removable_pole_takes_no_steps(formula):
    """sin(x)/x and x/|x| of vectors are no poles: steps are as many as with their series."""
    counts = []
    for force in ("SIN(DX(2))/DX(2)", "1-DX(2)**2/6+DX(2)**4/120"):
        deck = DECK.format(force=force, a=-1e-3, c=-1.0, v=0.5, w=1.0).replace(
            "VX=", "QG=-1,0,0, VX="
        )
        counts.append(done(deck, 4.0, 4, **options(formula, 1e-4)).summary["steps"])
    assert counts[0] <= counts[1] + 2


EXPRESSIONS = (
    ("DX(2,9)/DM(2,9)", []),
    ("(DM(2,9)-1)*DX(2,9)/DM(2,9)+VR(2,9)", []),
    ("SIN(DX(2))/DX(2)", []),
    ("DX(2,9)/DM(2,9)**3", [POLE]),
    ("1/DX(2)", [POLE]),
    ("1/(2+TIME)+EXP(-TIME**2)", []),
    ("LOG(DX(2))", [POLE]),
    ("SQRT(DX(2))", [ROOT]),
    ("SQRT(DX(2)**2+1)", []),
    ("TANH(VX(2)/0.01)", [NARROW]),
    ("TAN(DX(2))", [POLE]),
)


@pytest.mark.parametrize(("force", "kinds"), EXPRESSIONS)
def test_what_is_a_pole(force, kinds):
    deck = DECK.format(force=force, a=1.0, c=1.0, v=0.5, w=1.0)
    assert [kind for _, kind in system(deck).guarded["zone"]] == kinds


def test_a_pole_behind_a_condition_is_none_elsewhere():
    """1/x that a choice keeps from being evaluated for x < 1 does not shorten the steps there."""
    force = "IF(DX(2)-1: 1, 1, 1/DX(2))"
    deck = DECK.format(force=force, a=1e-3, c=1.0, v=-5.0, w=1.0).replace("VX=", "QG=3,0,0, VX=")
    plain = deck.replace(force, "IF(DX(2)-1: 1, 1, 2-DX(2))")
    runs = [done(each, 1.0, 5, **options("RADAU", 1e-4)) for each in (deck, plain)]
    steps = [each.summary["steps"] for each in runs]
    assert steps[0] <= steps[1] + 5


def test_equal_steps_reject_narrow_functions():
    deck = DECK.format(force="EXP(-((DX(2)-5)/1E-3)**2)", a=1.0, c=1.0, v=0.5, w=1.0)
    with pytest.raises(UsageError, match="rises within a zone"):
        run(deck, 1.0, 10, integrator="VERLET", error=1e-3)


@pytest.mark.numerical
def test_a_hump_passed_at_random():
    """Positions, widths and speeds at random, at the ERROR of the default."""
    numbers = np.random.default_rng(31)
    for _ in range(20):
        v, w = 10.0 ** numbers.uniform(0, 2), 10.0 ** numbers.uniform(-5, -2)
        c, share = numbers.uniform(1, 50), numbers.uniform(-0.9, 3)
        a = share * 0.5 * v * v / (sqrt(pi) * w)
        for formula in ("GSTIFF", "RADAU", "ABAM"):
            end = c / v * 1.5
            force = "EXP(-((DX(2)-{c})/{w})**2)"
            found = final_speed(formula, 1e-3, force, end, c=c, v=v, w=w, a=a)
            assert found == approx(v * sqrt(1 + share), rel=1e-2), (formula, v, w, c, share)
