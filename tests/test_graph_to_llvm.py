"""Native code of expressions against their values, rule by rule."""

from __future__ import annotations

import ctypes
import math

import pytest
from graph_values import DOUBLES
from graph_values import value as value_of

from adamslite.kernels.code.graph_to_llvm import Lowering
from adamslite.native import compiler
from adamslite.native.llvm_builder import Builder
from adamslite.symbolic import algebra as fn
from adamslite.symbolic import formulas, graph

x, y, z = map(graph.symbol, "xyz")
POINTS = ((0.3, 1.7, -0.4), (1.9, 0.2, 2.5), (0.8, 0.8, 0.1))
ORDINARY = [
    x + y - z, x - x * y, -x, 2 * x, x * y * z, x / y, (x - y) / (x + y), 1 / x, -x / (y * z),
    x**2, x**3, x**7, x**-2, fn.sqrt(x), x ** 1.5, x ** -0.5,
    x ** (1 / 3), x**y, x**65, x**2.7, fn.sin(x), fn.cos(x * y), fn.tan(x), fn.exp(z),
    fn.log(x), fn.asin(x / 4), fn.acos(x / 4), fn.atan(z), fn.atan2(z, x), fn.sinh(z), fn.cosh(z),
    fn.tanh(z), formulas.floor(3 * z), fn.pi * x, (1 / 3) * x, graph.number(4), 0 * x,
    (x + y) ** 2 * (x + y) ** 3 + fn.sin(x + y),
]  # fmt: skip
CHOICES = [
    formulas.piecewise((x, x > y), otherwise=y),
    formulas.piecewise((1, fn.Eq(x, y)), otherwise=2),
    formulas.piecewise((x, fn.And(x > 0, z < 0)), (y, fn.Or(x > 5, z > 2)), otherwise=z),
    formulas.piecewise((x, fn.Not(fn.Eq(x, y))), otherwise=-1), formulas.magnitude(z),
    formulas.norm((x, y, z)), formulas.piecewise((fn.log(z), z > 0), otherwise=0),
]  # fmt: skip


def run(expressions: list, points=POINTS) -> list[list[float]]:
    """Values of the expressions at the points, by one native function."""
    builder = Builder()
    leaves = {symbol: builder.real_at(n) for n, symbol in enumerate((x, y, z))}
    lower = Lowering(builder, leaves)
    for n, expression in enumerate(expressions):
        builder.store_real(3 + n, lower(graph.node(expression)))
    name = "lowered" + compiler.digest(*builder.lines)
    head = f"define void @{name}(ptr %rp) {{\nentry:\n"
    text = "\n".join([*sorted(builder.declared), head, *builder.lines, "ret void\n}\n!0 = !{}"])
    address = compiler.addresses([(compiler.object_code(text), [name])])[name]
    found = []
    for point in points:
        reals = (ctypes.c_double * (3 + len(expressions)))(*point)
        ctypes.CFUNCTYPE(None, ctypes.c_void_p)(address)(reals)
        found.append(list(reals)[3:])
    return found


def value(expression, point) -> float:
    """What the expression is worth, by the definition of its pieces."""
    return float(value_of(expression, dict(zip((x, y, z), point, strict=True)), DOUBLES))


def test_every_rule_gives_the_value_of_the_expression():
    expressions = [*ORDINARY, *CHOICES]
    for point, found in zip(POINTS, run(expressions), strict=True):
        for expression, each in zip(expressions, found, strict=True):
            assert each == pytest.approx(value(expression, point), rel=1e-12, abs=1e-14), expression


def test_not_a_number_stays_what_it_is():
    bad = [fn.sqrt(z), fn.log(z), x * fn.nan]
    assert all(math.isnan(each) for each in run(bad, [(1.0, 1.0, -1.0)])[0])


def test_a_choice_hides_the_piece_it_does_not_take():
    """log of a negative number behind a condition that excludes it."""
    safe = formulas.piecewise((fn.log(z), z > 0), (fn.sqrt(z), z > 1), otherwise=7)
    assert run([safe], [(0.0, 0.0, -1.0)])[0] == [7.0]


def test_infinity_is_kept():
    assert run([1 / x, -1 / x, fn.log(x)], [(0.0, 0.0, 0.0)])[0] == [math.inf, -math.inf, -math.inf]


def test_equal_parts_are_computed_once_and_zeros_cost_nothing():
    builder = Builder()
    lower = Lowering(builder, {x: builder.real_at(0), y: builder.real_at(1)})
    lower(fn.sin(x + y) ** 2)
    before = len(builder.lines)
    lower(fn.sin(x + y) ** 2)
    builder.accumulate("F", "%r", 0, 0.0)
    a = builder.real_at(0)
    assert builder.add(a, 0.0) == builder.sub(a, 0.0) == a
    assert builder.mul(a, 1.0) == builder.div(a, 1.0) == a
    for zero in (builder.mul(a, 0.0), builder.sub(a, a), builder.div(0.0, a)):
        assert zero == 0.0
    assert len(builder.lines) == before


def test_unknown_functions_are_refused():
    with pytest.raises(TypeError, match="no native code for gamma"):
        Lowering(Builder(), {x: "%x"})(graph.made("gamma", x))


@pytest.mark.parametrize("number", (-1.0, 1.0))
@pytest.mark.parametrize("relation", ("<", "<=", ">", ">=", "==", "!="))
def test_comparisons(relation, number):
    truth = {"<": 1.0 < number, "<=": 1.0 <= number, ">": 1.0 > number, ">=": 1.0 >= number}
    truth |= {"==": number == 1.0, "!=": number != 1.0}
    condition = graph.relation(relation, x, y)
    assert run([formulas.piecewise((1, condition), otherwise=0)], [(1.0, number, 0.0)])[0] == [
        float(truth[relation])
    ]
