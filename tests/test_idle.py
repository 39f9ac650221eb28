"""Instances that have nothing to add on the branches that are held."""

from __future__ import annotations

import itertools

import pytest

from adamslite.kernels.code.idle import IdleTest
from adamslite.symbolic import algebra, graph
from adamslite.symbolic.formulas import piecewise

x, y, v = map(graph.symbol, "xyv")
A, B, C = x > 0, y >= 0, v < 0
ONE_SIDED = piecewise((x * v, algebra.And(A, B)), otherwise=0, order=0)
OTHER_SIDE = piecewise((y, C), otherwise=0, order=0)
UNHELD = piecewise((x, A), otherwise=0)
TRUE, FALSE, OPEN = 1.0, -1.0, 0.0


class Logic:
    """A builder that computes at once."""

    def compare(self, relation: str, a: float, b: float) -> bool:
        return {"<": a < b, ">": a > b}[relation]


def idle(expressions, a: float, b: float, c: float) -> bool:
    return IdleTest(Logic(), {A: a, B: b, C: c})(map(graph.node, expressions))


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
