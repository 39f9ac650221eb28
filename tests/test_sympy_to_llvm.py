"""Native code of expressions against their values, rule by rule."""

from __future__ import annotations

import ctypes
import math

import pytest
import sympy as sp

from adamslite.kernels.code.sympy_to_llvm import Lowering
from adamslite.native import compiler
from adamslite.native.llvm_builder import Builder
from adamslite.symbolic import sympy_nodes

x, y, z = sp.symbols("x y z", real=True)
POINTS = ((0.3, 1.7, -0.4), (1.9, 0.2, 2.5), (0.8, 0.8, 0.1))
ORDINARY = [
    x + y - z, x - x * y, -x, 2 * x, x * y * z, x / y, (x - y) / (x + y), 1 / x, -x / (y * z),
    x**2, x**3, x**7, x**-2, sp.sqrt(x), x ** sp.Rational(3, 2), x ** sp.Rational(-1, 2),
    x ** sp.Rational(1, 3), x**y, x**65, x**2.7, sp.sin(x), sp.cos(x * y), sp.tan(x), sp.exp(z),
    sp.log(x), sp.asin(x / 4), sp.acos(x / 4), sp.atan(z), sp.atan2(z, x), sp.sinh(z), sp.cosh(z),
    sp.tanh(z), sympy_nodes.floor(3 * z), sp.pi * x, sp.Rational(1, 3) * x, sp.Integer(4), 0 * x,
    (x + y) ** 2 * (x + y) ** 3 + sp.sin(x + y),
]  # fmt: skip
CHOICES = [
    sympy_nodes.piecewise((x, x > y), otherwise=y),
    sympy_nodes.piecewise((1, sp.Eq(x, y)), otherwise=2),
    sympy_nodes.piecewise((x, sp.And(x > 0, z < 0)), (y, sp.Or(x > 5, z > 2)), otherwise=z),
    sympy_nodes.piecewise((x, sp.Not(sp.Eq(x, y))), otherwise=-1), sympy_nodes.magnitude(z),
    sympy_nodes.norm((x, y, z)), sympy_nodes.piecewise((sp.log(z), z > 0), otherwise=0),
]  # fmt: skip


def run(expressions: list, points=POINTS) -> list[list[float]]:
    """Values of the expressions at the points, by one native function."""
    builder = Builder()
    leaves = {symbol: builder.real_at(n) for n, symbol in enumerate((x, y, z))}
    lower = Lowering(builder, leaves)
    for n, expression in enumerate(expressions):
        builder.store_real(3 + n, lower(sp.S.Zero + expression))
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
    numbers = dict(zip((x, y, z), point, strict=True))
    if type(expression).__name__ == "Piecewise":
        chosen = next(p.expr for p in expression.args if p.cond.subs(numbers) == True)  # noqa: E712
        return value(chosen, point)
    return float((sp.S.Zero + expression).subs(numbers).evalf())


def test_every_rule_gives_the_value_of_the_expression():
    expressions = [*ORDINARY, *CHOICES]
    for point, found in zip(POINTS, run(expressions), strict=True):
        for expression, each in zip(expressions, found, strict=True):
            assert each == pytest.approx(value(expression, point), rel=1e-12, abs=1e-14), expression


def test_not_a_number_stays_what_it_is():
    bad = [sp.sqrt(z), sp.log(z), x * sp.nan]
    assert all(math.isnan(each) for each in run(bad, [(1.0, 1.0, -1.0)])[0])


def test_a_choice_hides_the_piece_it_does_not_take():
    """log of a negative number behind a condition that excludes it."""
    safe = sympy_nodes.piecewise((sp.log(z), z > 0), (sp.sqrt(z), z > 1), otherwise=7)
    assert run([safe], [(0.0, 0.0, -1.0)])[0] == [7.0]


def test_an_undecided_choice_is_not_a_number():
    open_end = sympy_nodes._nodes()[0]((x, x > 0), (y, y > 0))
    assert run([open_end], [(2.0, 1.0, 0.0), (-1.0, 3.0, 0.0)]) == [[2.0], [3.0]]
    assert math.isnan(run([open_end], [(-1.0, -1.0, 0.0)])[0][0])


def test_infinity_is_kept():
    assert run([1 / x, -1 / x, sp.log(x)], [(0.0, 0.0, 0.0)])[0] == [math.inf, -math.inf, -math.inf]


def test_equal_parts_are_computed_once_and_zeros_cost_nothing():
    builder = Builder()
    lower = Lowering(builder, {x: builder.real_at(0), y: builder.real_at(1)})
    lower(sp.sin(x + y) ** 2)
    before = len(builder.lines)
    lower(sp.sin(x + y) ** 2)
    builder.accumulate("F", "%r", 0, 0.0)
    a = builder.real_at(0)
    assert builder.add(a, 0.0) == builder.sub(a, 0.0) == a
    assert builder.mul(a, 1.0) == builder.div(a, 1.0) == a
    for zero in (builder.mul(a, 0.0), builder.sub(a, a), builder.div(0.0, a)):
        assert zero == 0.0
    assert len(builder.lines) == before


def test_unknown_functions_are_refused():
    with pytest.raises(TypeError, match="no native code for gamma"):
        Lowering(Builder(), {x: "%x"})(sp.gamma(x))


@pytest.mark.parametrize("number", (-1.0, 1.0))
@pytest.mark.parametrize("relation", ("<", "<=", ">", ">=", "==", "!="))
def test_comparisons(relation, number):
    truth = {"<": 1.0 < number, "<=": 1.0 <= number, ">": 1.0 > number, ">=": 1.0 >= number}
    truth |= {"==": number == 1.0, "!=": number != 1.0}
    condition = sp.Rel(x, y, relation)
    assert run([sympy_nodes.piecewise((1, condition), otherwise=0)], [(1.0, number, 0.0)])[0] == [
        float(truth[relation])
    ]
