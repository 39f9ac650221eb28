"""Expressions as graphs: what is folded, what is shared, and derivatives on them."""

from __future__ import annotations

import math
import random
from pathlib import Path

import mpmath as mp
import pytest
from graph_values import value

from adamslite.symbolic import by_sympy, graph, slopes_by_sympy, structure
from adamslite.symbolic.algebra import And, Eq, Not, Or, atan2, chosen, cos, exp, log, sin, sqrt
from adamslite.symbolic.derivatives import Derivatives, along
from adamslite.symbolic.graph import FALSE, NAN, ONE, TRUE, ZERO, node, number, symbol

x, y = symbol("x"), symbol("y")


def test_slopes_are_what_sympy_finds() -> None:
    """The kept module is the one that sympy writes, but for its form."""
    kept = Path(slopes_by_sympy.__file__).read_text(encoding="utf-8")
    assert "".join(kept.split()) == "".join(by_sympy.slopes_text().split())


@pytest.mark.parametrize("name", slopes_by_sympy.SLOPES)
def test_slopes_of_functions(name: str) -> None:
    """Against differences at 60 digits, in (0.1, 0.9)."""
    rng, symbols = random.Random(name), [x, y] if name in ("atan2", "**") else [x]
    top = graph.made(name, *symbols)
    with mp.workdps(60):
        at = {each: mp.mpf(rng.uniform(0.1, 0.9)) for each in symbols}
        for each, slope in zip(symbols, slopes_by_sympy.SLOPES[name](*symbols), strict=True):
            found = mp.diff(lambda u, each=each: value(top, at | {each: u}, mp), at[each])
            assert abs(value(slope, at, mp) - found) < mp.mpf("1e-18")


@pytest.mark.parametrize(
    ("written", "folded"),
    [
        (x + 0, x), (0 * x, ZERO), (1 * x, x), (x - x, ZERO), (x / x, ONE), (x**1, x), (x**0, ONE),
        (0 - (-x), x), (x + (-y), x - y), ((-x) * y, -(x * y)), ((-x) ** 2, x**2),
        ((-x) ** 3, -(x**3)), (x * x, x**2), (x**2 * x**3, x**5), (x**3 / x, x**2),
        (x ** y / x, x**y / x), (2 * (3 * x), 6 * x), (x / 4, 0.25 * x), (sqrt(x) ** 2, x),
        (x + y, y + x), (x * y, y * x), (sin(-x), -sin(x)), (cos(-x), cos(x)),
        (number(0.1) + 0.2, number(0.1 + 0.2)), (sqrt(number(-1)), NAN), (1 / ZERO, NAN),
        (log(ZERO), NAN), (NAN * 0, NAN), (x + NAN, NAN), (exp(number(1e4)), NAN),
        (atan2(number(1), number(0)), number(math.pi / 2)), (sqrt(4 * x), 2 * sqrt(x)),
    ],
)  # fmt: skip
def test_folding(written: graph.Node, folded: graph.Node) -> None:
    """What the operations make of what cannot matter."""
    assert written is folded


@pytest.mark.parametrize(
    ("condition", "decided"),
    [
        (x**2 >= 0, TRUE), (x**2 < 0, FALSE), (x**2 + 1 > 0, TRUE), (x**2 + y**2 + 1 <= 0, FALSE),
        (-(x**2) <= 0, TRUE), (-(x**2) > 0, FALSE), (x <= x, TRUE), (x < x, FALSE),
        (number(1) < 2, TRUE), (Eq(number(1), 2), FALSE), (exp(x) + 1 > 0, TRUE),
        (And(True, x > 0), x > 0), (And(False, x > 0), FALSE), (Or(True, x > 0), TRUE),
        (Or(x > 0, x > 0), x > 0), (Not(x > 0), x <= 0),
        (Not(Not(And(x > 0, y > 0))), And(x > 0, y > 0)),
        (0 < x, x > 0),
    ],
)  # fmt: skip
def test_conditions_that_are_decided(condition: graph.Node, decided: graph.Node) -> None:
    assert condition is decided


def test_conditions_that_are_not_decided() -> None:
    """A square may be zero; nothing is known of a difference; not-a-number decides nothing."""
    for condition in (x**2 > 0, x > y, x**3 >= 0, sqrt(x) > 0):
        assert condition not in (TRUE, FALSE)
        with pytest.raises(TypeError, match="not known yet"):
            bool(condition)
    assert not NAN < 1
    assert not Eq(NAN, NAN)


def test_the_root_of_a_square_is_a_length() -> None:
    """sqrt(x^2 y) = |x| sqrt(y): its slope at x = 0 is no 0/0."""
    slopes = Derivatives().gradient(sqrt(x**2 * y))
    for at, slope in ((-2.0, -2.0), (0.0, 2.0), (3.0, 2.0)):
        assert value(slopes[x], {x: at, y: 4.0}, mp) == slope


def test_a_piece_that_does_not_hold_has_no_slope() -> None:
    """log(x) left of zero and 1/x at zero stay behind their conditions."""
    expr = chosen((log(x) + 1 / x, x > 0), otherwise=y, order=None) * y
    slopes = Derivatives().gradient(expr)
    assert [float(value(slopes[each], {x: 0.0, y: 3.0}, mp)) for each in (x, y)] == [0.0, 6.0]
    assert value(along(expr, {x: ONE, y: ZERO}), {x: 0.0, y: 3.0}, mp) == 0


def test_a_chain_of_a_thousand_parts_grows_by_as_many() -> None:
    """v_(i+1) = v_i sin(v_i) is a tree of 2^i leaves, and a graph of 2 i nodes."""
    expr = x
    for _ in range(1000):
        expr = expr * sin(expr)
    assert len(structure.ordered([expr])) == 2001
    slope, rate = Derivatives().gradient(expr)[x], along(expr, {x: ONE})
    assert len(structure.ordered([slope])) < 10000
    assert len(structure.ordered([rate])) < 10000
    expr = x
    for _ in range(5):
        expr = expr * sin(expr)
    slope, rate = Derivatives().gradient(expr)[x], along(expr, {x: ONE})
    with mp.workdps(40):
        by_step = mp.diff(lambda u: value(expr, {x: u}, mp), mp.mpf("0.7"))
        for found in (slope, rate):
            assert value(found, {x: "0.7"}, mp) == pytest.approx(by_step, rel=1e-15)


def test_what_is_constant_is_not_differentiated_by() -> None:
    found = Derivatives(lambda symbol: symbol is y).gradient(x**2 * y)
    assert [*found] == [x]
    assert found[x] is 2 * x * y


def test_what_is_written_does_not_depend_on_what_was_written_before() -> None:
    """The first of y x and x y stays, until all is forgotten."""
    graph.forget()
    a, b = symbol("a"), symbol("b")
    assert (a * b).args == (b * a).args == (a, b)
    graph.forget()
    assert (b * a).args == (b, a)
    assert node(True) is TRUE
    assert number(0.0) is ZERO
