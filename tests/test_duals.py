"""Numbers with derivatives: every function of numbers, tables, and measures of a posture."""

from __future__ import annotations

import math
from threading import Event, Thread
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from constraint_decks import BODIES
from test_functions import TABLE

import adamslite as al
from adamslite.assembly.closing import moved
from adamslite.assembly.rows import gradient, values
from adamslite.assembly.scope import WIDTH, Posture
from adamslite.language.function import FUNCTIONS
from adamslite.model.model import Model
from adamslite.symbolic import formulas, graph
from adamslite.symbolic.duals import Dual
from adamslite.symbolic.formulas import fn, with_numbers
from adamslite.symbolic.interpolant import interpolant

STEP = 1e-6
SCOPE: Any = SimpleNamespace(touch=lambda relation: relation)


def computed(name: str, args: list[float]) -> Dual:
    slopes = np.eye(len(args))
    duals = [Dual(float(a), slope) for a, slope in zip(args, slopes, strict=True)]
    with with_numbers():
        found = FUNCTIONS[name].body(SCOPE, *duals)
    return found if isinstance(found, Dual) else Dual(found)


@pytest.mark.parametrize("name", TABLE)
def test_values_are_those_of_the_definitions(name: str) -> None:
    for args, expected in TABLE[name]:
        assert computed(name, list(args)).value == pytest.approx(expected, abs=1e-13), args


@pytest.mark.parametrize("name", TABLE)
def test_slopes_are_those_of_central_differences(name: str) -> None:
    """Beside edges, h = 1e-6: h^2 times third derivatives of up to 1e4 (SWEEP) is 1e-8, round-off
    of values up to 1e3 over h some 1e-7.
    """
    for args, _ in TABLE[name]:
        beside = [0.993 * a + 0.0071 * (n + 1) for n, a in enumerate(args)]
        found = computed(name, beside)
        for k in range(len(beside)):
            ahead, back = (
                computed(name, [a + sign * STEP * (n == k) for n, a in enumerate(beside)]).value
                for sign in (1, -1)
            )
            slope = found.slope[k] if np.ndim(found.slope) else 0.0
            assert slope == pytest.approx((ahead - back) / (2 * STEP), rel=1e-6, abs=1e-6), args


def test_what_has_no_value_is_not_a_number() -> None:
    with with_numbers():
        for found in (fn.sqrt(Dual(-1.0)), fn.log(Dual(0.0)), 1 / Dual(0.0), fn.asin(Dual(2.0)),
                      fn.exp(Dual(1e4)), Dual(0.0) ** -1):  # fmt: skip
            assert math.isnan(found.value)


def test_a_length_of_nothing_has_the_slope_zero() -> None:
    zero = Dual(0.0, np.ones(2))
    with with_numbers():
        assert formulas.norm((zero, zero, zero)) == 0


def test_expressions_are_back_afterwards() -> None:
    with pytest.raises(KeyError), with_numbers():
        raise KeyError
    x = graph.symbol("x")
    assert fn.sin(x).kind == "sin"
    assert formulas.piecewise((1, x > 0), otherwise=2).kind == "choice"


def test_tables() -> None:
    knots, z = np.linspace(0.0, 3.0, 7), np.array([0.0, 1.0, 3.0])
    curves = np.sin(knots)[:, None] * (1.0 + z) + z**2
    table = interpolant(knots, curves, "akima", places=z)
    for x in (-0.4, 0.7, 1.5, 3.6):
        at, plain = Dual(x, np.array([1.0, 0.0])), np.array([x])
        with with_numbers():
            found = formulas.lookup(table, at, 1)
        assert found.value == table.at(plain)[0, 1]
        assert found.slope[0] == table.at(plain, 1)[0, 1]
        for place, low in ((-1.0, 0), (0.25, 0), (2.5, 1), (4.0, 1)):
            with with_numbers():
                between = formulas.lookup_between(table, at, Dual(place, np.array([0.0, 1.0])))
            share = (place - z[low]) / (z[low + 1] - z[low])
            pair, rise = (table.at(plain, n)[0, low : low + 2] for n in (0, 1))
            assert between.value == pytest.approx(pair[0] + share * (pair[1] - pair[0]))
            slopes = [rise[0] + share * (rise[1] - rise[0]), np.diff(pair)[0] / np.diff(z)[low]]
            np.testing.assert_allclose(between.slope, slopes)


MEASURES = [
    "DM(21,31)", "DX(40,21,31)", "DY(21,1)", "DZ(31,2,22)", "AX(21,31)", "AY(21,1)", "AZ(31,22)",
    "PSI(21,31)", "THETA(21,31)", "PHI(21,1)", "YAW(21,31)", "PITCH(31,21)", "ROLL(21,31)",
    "INCANG(40,21,31)", "ORIENT(14,2,21,31)", "ORIENT(27,3,21,31)", "ORIENT(29,5,21,31)",
    "SQRT(DX(21)**2+DY(21,31)**2)/DM(40,31)", "STEP(DX(21,31),-2,0,2,1)*SIN(DY(40)+AZ(21,31))",
    "AKISPL(DX(21,31),0,1)", "VARVAL(1)*DX(21)", "IF(DX(21,31)-9: DY(21,31), 0, DZ(21))",
    "INTERP(DX(21,31),1,1)+CUBSPL(DX(21,31),0,1,1)", "MAX(DX(21,31),DY(21,31),DZ(21,31))",
]  # fmt: skip


@pytest.mark.parametrize("function", MEASURES)
def test_slopes_of_measures_are_those_of_central_differences(function: str) -> None:
    """Lengths and angles of size 1, h = 1e-6: 1e-10 of round-off, 1e-12 times third derivatives."""
    deck = al.read(
        BODIES + "SPLINE/1, X=-3,-1,0.5,1,4, Y=1,3,2,5,4\nVARIABLE/1, FUNCTION=DM(21,40)+TIME\n"
        f"GCON/1, FUNCTION={function}\nEND\n"
    )
    model = Model(deck)
    at, (gcon,) = Posture.start(model), model.constraints
    (row,) = gradient(model, at, [gcon])
    for column in range(WIDTH * len(model.bodies)):
        if model.bodies[column // WIDTH].width < WIDTH and column % WIDTH >= 3:
            continue
        step = STEP * (np.arange(len(row)) == column)
        ahead, back = (values(model, moved(at, sign * step), gcon)[0] for sign in (-1, 1))
        assert row[column] == pytest.approx((ahead - back) / (2 * STEP), abs=1e-8)


def test_threads_write_their_formulas_for_different_things() -> None:
    """While one computes numbers another one makes kernels, as a server of editors does."""
    inside, done = Event(), Event()

    def other() -> None:
        with with_numbers():
            inside.set()
            done.wait(10.0)

    thread = Thread(target=other)
    thread.start()
    inside.wait(10.0)
    made = formulas.power(graph.symbol("x"), 2.0)
    done.set()
    thread.join()
    assert isinstance(made, graph.Node)
