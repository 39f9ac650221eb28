"""Instances that have nothing to add on the branches that are held."""

from __future__ import annotations

import itertools
import math
import operator

import numpy as np
import pytest
from graph_values import DOUBLES, value
from scenes import GROUND, run

from adamslite import Outcome
from adamslite.kernels.code.idle import IdleTest, StrictIdleTest
from adamslite.symbolic import algebra, graph
from adamslite.symbolic.formulas import piecewise

x, y, v, p = map(graph.symbol, "xyvp")
A, B, C = x > 0, y >= 0, v < 0
ONE_SIDED = piecewise((x * v, algebra.And(A, B)), otherwise=0, order=0)
OTHER_SIDE = piecewise((y, C), otherwise=0, order=0)
UNHELD = piecewise((x, A), otherwise=0)
TRUE, FALSE, OPEN = 1.0, -1.0, 0.0


class Logic:
    """A builder that computes at once."""

    def compare(self, relation: str, a: float, b: float) -> bool:
        return bool({"<": a < b, ">": a > b, ">=": a >= b}[relation])

    add, sub, mul, div = operator.add, operator.sub, operator.mul, operator.truediv
    neg = operator.neg

    def call(self, name: str, x: float) -> float:
        return {"sqrt": math.sqrt}[name](x)

    def select(self, condition: bool, a: float, b: float) -> float:
        return a if condition else b


def idle(expressions, a: float, b: float, c: float, **numbers: float) -> bool:
    """Whether all vanish: where the branches are held as given, at numbers for x, y, v and p, a
    parameter."""
    state = {each: numbers.get(str(each), 0.5) for each in (x, y, v, p)}

    def value_of(expression):
        with np.errstate(all="ignore"):
            return value(expression, state, DOUBLES)

    held, nodes = {A: a, B: b, C: c}, [*map(graph.node, expressions)]
    found = StrictIdleTest(Logic(), held, value_of, lambda symbol: symbol is p)(nodes)
    assert IdleTest(Logic(), held)(nodes) or not found
    return found


@pytest.mark.parametrize(
    "expressions, expected",
    [
        ([0], lambda a, b, c: True),
        ([x], lambda a, b, c: False),
        ([ONE_SIDED], lambda a, b, c: a < 0 or b < 0),
        ([ONE_SIDED * algebra.sin(y) / v, 3 * ONE_SIDED], lambda a, b, c: a < 0 or b < 0),
        ([ONE_SIDED, x], lambda a, b, c: False),
        ([ONE_SIDED + 1], lambda a, b, c: False),
        ([ONE_SIDED - OTHER_SIDE], lambda a, b, c: (a < 0 or b < 0) and c < 0),
        ([ONE_SIDED * OTHER_SIDE], lambda a, b, c: a < 0 or b < 0 or c < 0),
        ([UNHELD], lambda a, b, c: False),
        ([piecewise((x, graph.made("not", A)), otherwise=0, order=0)], lambda a, b, c: a > 0),
        ([piecewise((x, algebra.Or(A, C)), otherwise=0, order=0)], lambda a, b, c: a < 0 and c < 0),
        ([piecewise((0, A), otherwise=x, order=0)], lambda a, b, c: a > 0),
        ([piecewise((0, A), (x, B), otherwise=y, order=0)], lambda a, b, c: a > 0),
        ([piecewise((0, A), (x, B), otherwise=0, order=0)], lambda a, b, c: a > 0 or b < 0),
        ([piecewise((x, A), (0, B), otherwise=y, order=0)], lambda a, b, c: a < 0 < b),
    ],
)
def test_what_vanishes_on_held_branches(expressions, expected):
    for branches in itertools.product((TRUE, FALSE, OPEN), repeat=3):
        assert idle(expressions, *branches) == expected(*branches), branches


SHUT = piecewise((x, A), otherwise=0, order=0)
DISTANCE = (x * x + y * y + v**2) ** 0.5


@pytest.mark.parametrize(
    "factor, with_a_value, without",
    [
        (1 / y, {"y": -1}, {"y": 0}),
        (1 / (y - v), {"y": 1, "v": 2}, {"y": 2, "v": 2}),
        (y / (2.0 * DISTANCE), {"v": 1e-9}, {"x": 0, "y": 0, "v": 0}),
        (y / DISTANCE, {"v": 1e-9}, {"x": 0, "y": 0, "v": 0}),
        (DISTANCE**-3, {"v": 1e-9}, {"x": 0, "y": 0, "v": 0}),
        (y**-2, {"y": -1}, {"y": 0}),
        (y**0.5, {"y": 0}, {"y": -1}),
        (y**1.5, {"y": 0}, {"y": -1}),
        (y**-0.5, {"y": 1}, {"y": 0}),
        (y**v, {"y": 2, "v": 0.3}, {"y": -2, "v": 0.3}),
        (v**y, {"y": 2, "v": 0}, {"y": -2, "v": 0}),
        (algebra.log(y), {"y": 1e-300}, {"y": 0}),
        (algebra.asin(y), {"y": 1}, {"y": 1.1}),
        (algebra.exp(y), {"y": 1}, {"y": 1e4}),
        (algebra.sin(algebra.log(y)) * 3 + v, {"y": 1}, {"y": -1}),
        (piecewise((1 / y, v > 0), otherwise=2), {"y": 1}, {"y": 0}),
        (1 / p, {"p": 1e-300}, {"p": 0}),
        (1 / (p - algebra.cos(x)), {"p": 1.1}, {"p": 1.0}),
        (1 / (2 - (1 - algebra.sin(y)) / p) ** 0.5, {"p": 1.1}, {"p": 1.0}),
        (1 / (2 - p * algebra.sin(v)), {"p": -1.9}, {"p": -2.0}),
        (1 / (2 - algebra.cos(algebra.log(y))), {"y": 1}, {"y": -1}),
    ],
)
def test_zero_times_what_has_no_value_does_not_vanish(factor, with_a_value, without):
    for product in (SHUT * factor, factor * SHUT, 3 * SHUT * factor - SHUT):
        assert idle([product], FALSE, OPEN, OPEN, **with_a_value)
        assert not idle([product], FALSE, OPEN, OPEN, **without)
        assert not idle([product], TRUE, OPEN, OPEN, **with_a_value)


def test_a_held_branch_bounds_a_denominator():
    """Beyond a radius that is positive nothing is divided by zero, whatever the distance."""
    law = piecewise((x, DISTANCE < p - 1), otherwise=0, order=0) * y / DISTANCE
    for held, radius, expected in ((FALSE, 2, True), (FALSE, 1, False), (OPEN, 2, False)):
        numbers = {x: 0.0, y: 0.0, v: 0.0, p: radius}
        test = StrictIdleTest(
            Logic(), {DISTANCE < p - 1: held},
            lambda each, at=numbers: value(each, at, DOUBLES), lambda symbol: symbol is p,
        )  # fmt: skip
        assert test([law]) == expected


def test_what_always_has_a_value_is_not_computed():
    def never(expression):
        raise AssertionError(expression)

    free = SHUT * (x * v - 3) * algebra.sin(y) * algebra.atan2(y, v) * (x * x + y**2) ** 0.5
    assert StrictIdleTest(Logic(), {A: FALSE}, never, never)([free / 4]) is True
    assert StrictIdleTest(Logic(), {A: FALSE}, never, never)([x / y]) is False


@pytest.mark.parametrize("method", ("GSTIFF", "HHT", "RADAU", "ABAM"))
def test_an_idle_contact_that_is_divided_by_zero_ends_the_run(method):
    """A contact 1.5 away, over what is zero for doubles while 0.25 < t < 0.75, between outputs."""
    idle_force = "IMPACT(DX(2)+2,VX(2),0.5,1E3,1.5,1,0.1)"
    deck = GROUND + (
        "POINT_MASS/2, MASS=2, CM=2\nMARKER/2, POINT_MASS=2\n"
        f"VFORCE/3, I=2, J_PART=1, FX={idle_force}/EXP(1E3*((2*TIME-1)**2-1))\n"
        f"INTEGRATOR/{method}\nEND\n"
    )
    results = run(deck, 1.0, 1)
    assert results.outcome in (Outcome.NOT_FINITE, Outcome.NEWTON_FAILED)
    assert results.summary["t_end"] == pytest.approx(0.25, abs=0.02)
