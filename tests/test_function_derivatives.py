"""Every deck function in the registry: its sympy derivative is the derivative of its value.

Nothing here names a function to include it: arguments follow from the signature, and the places to
look at closely from its ``edges``.
"""

from __future__ import annotations

import itertools
import random
from collections.abc import Callable
from functools import cached_property

import mpmath as mp
import numpy as np
import pytest
import sympy as sp
from sample_scope import DIGITS, GROUND, MODULES, SampleScope
from tiers import every

import adamslite.functions  # noqa: F401  fills the registry
from adamslite.functions.arrays import NUMBERED
from adamslite.functions.forces import NET
from adamslite.functions.vectors import VECTORS
from adamslite.language.function import FUNCTIONS, Function
from adamslite.language.routines import USER
from adamslite.symbolic.derivatives import Derivatives

# What the native printer knows; anything else would only be noticed when a deck uses it.
PRINTABLE = {
    *("Add", "Mul", "Pow", "Piecewise", "ExprCondPair", "Symbol", "floor"),
    *("sin", "cos", "tan", "asin", "acos", "atan", "atan2", "sinh", "cosh", "tanh", "exp", "log"),
    *("StrictLessThan", "StrictGreaterThan", "LessThan", "GreaterThan", "Equality", "Unequality"),
    *("And", "Or", "Not", "BooleanTrue", "BooleanFalse", "Exp1", "Pi"),
    *("Lookup", "LookupHeld"),
}
REPEATS = 4
SAMPLES = 8


def forms(function: Function) -> list[tuple]:
    """Arguments but for the numbers (``None``): every frame, and constants over their range."""
    choices: list[tuple] = []
    for index, p in enumerate(function.parameters):
        if p.kind == "constant":
            choices.append(tuple({p.allowed[0], p.allowed[len(p.allowed) // 2], p.allowed[-1]}))
        elif p.kind == "number":
            choices.extend([(None,)] * (REPEATS if p.counts else 1))
        else:
            choices.append((min(index, 2),) if p.kind == "marker" else (7,))
    return [form for form in itertools.product(*choices) if not function.mistakes(form)]


# Net forces, values by number and vectors are written out before anything is evaluated.
WRITTEN_OUT = {*NET, *NUMBERED, *VECTORS, USER}
EVALUATED = {name: f for name, f in sorted(FUNCTIONS.items()) if name not in WRITTEN_OUT}
CASES = [(name, form) for name, f in EVALUATED.items() for form in forms(f)]
CASES += [("ORIENT", (system, n, 0, 1)) for system in (7, 14, 23, 25, 26, 27) for n in (1, 2, 3)]


class Gradient:
    """A call of a deck function with its value and derivatives as functions of all symbols."""

    def __init__(self, name: str, form: tuple) -> None:
        self.scope = SampleScope()
        self.numbers = [sp.Symbol(f"u{n}", real=True) for n, a in enumerate(form) if a is None]
        rest = iter(self.numbers)
        args = [next(rest) if a is None else a for a in form]
        self.expr = sp.S.Zero + FUNCTIONS[name].body(self.scope, *args)
        edges = FUNCTIONS[name].edges
        self.edges = [sp.S.Zero + e for e in edges(*args)] if edges else []
        given = sorted(self.expr.free_symbols - set(self.numbers), key=str)
        self.symbols = self.numbers + given
        self.derivatives = [sp.diff(self.expr, s) for s in self.symbols]
        self.given = [self.scope.values[s] for s in given]

    @cached_property
    def value_of(self) -> Callable:
        """The value at many digits."""
        return sp.lambdify(self.symbols, self.expr, MODULES)

    @cached_property
    def slopes_of(self) -> Callable:
        """The derivatives."""
        return sp.lambdify(self.symbols, self.derivatives, MODULES)

    @cached_property
    def edges_of(self) -> Callable:
        """What changes sign at the places to look at closely."""
        return sp.lambdify(self.numbers, self.edges, "mpmath")

    def check(self, numbers: list) -> bool:
        """Compare at one point; false where the function has no real value."""
        at = [mp.mpf(u) for u in numbers] + self.given
        if not isinstance(self.value_of(*at), int | mp.mpf):
            return False
        step = mp.mpf(10) ** (-DIGITS // 3)
        for n, slope in enumerate(self.slopes_of(*at)):
            up, down = list(at), list(at)
            up[n] += step
            down[n] -= step
            difference = (self.value_of(*up) - self.value_of(*down)) / (2 * step)
            assert abs(slope - difference) <= mp.mpf("1e-12") * (1 + abs(slope)), self.symbols[n]
        return True


@pytest.mark.parametrize(("name", "form"), every(4, CASES), ids=[f"{n}{f}" for n, f in CASES])
def test_derivative_of_the_value(name, form):
    gradient = Gradient(name, form)
    rng = random.Random(name)
    with mp.workdps(DIGITS):
        points = [[rng.uniform(-0.95, 0.95) for _ in gradient.numbers] for _ in range(SAMPLES)]
        good = sum(gradient.check(point) for point in (points if gradient.numbers else [[]]))
        assert good >= (2 if gradient.numbers else 1)
        for index in range(len(gradient.edges)):
            for side in beside_edge(gradient, index, rng):
                assert gradient.check(side)


def beside_edge(gradient: Gradient, index: int, rng: random.Random) -> tuple[list, list]:
    """Two points a hair below and above the place where edge ``index`` changes sign."""
    for _ in range(100):
        start = [mp.mpf(rng.uniform(-0.95, 0.95)) for _ in gradient.numbers]
        end = list(start)
        moved = rng.randrange(len(start))
        end[moved] = mp.mpf(rng.uniform(-0.95, 0.95))
        sign = mp.sign(gradient.edges_of(*start)[index])
        if sign * gradient.edges_of(*end)[index] >= 0:
            continue
        low, high = start[moved], end[moved]
        while abs(high - low) > 1e-9:
            middle = (low + high) / 2
            same = sign * gradient.edges_of(*start[:moved], middle, *start[moved + 1 :])[index] > 0
            low, high = (middle, high) if same else (low, middle)
        return [*start[:moved], low, *start[moved + 1 :]], [
            *start[:moved],
            high,
            *start[moved + 1 :],
        ]
    raise AssertionError(f"no sample crosses {gradient.edges[index]}")


@pytest.mark.parametrize(("name", "form"), every(4, CASES), ids=[f"{n}{f}" for n, f in CASES])
def test_derivatives_are_formed_as_sympy_does(name, form):
    """Kernels get theirs from :class:`Derivatives`, which must be the same tree."""
    gradient, slope = Gradient(name, form), Derivatives()
    assert [slope(gradient.expr, s) for s in gradient.symbols] == gradient.derivatives
    assert slope.symbols(gradient.expr) == gradient.expr.free_symbols


@pytest.mark.parametrize(("name", "form"), every(6, CASES))
def test_only_printable_operations(name, form):
    gradient = Gradient(name, form)
    for expr in (gradient.expr, *gradient.derivatives):
        for node in sp.preorder_traversal(expr):
            assert node.is_Number or type(node).__name__ in PRINTABLE


def eager(expr, symbols, values):
    """The value when all branches are computed and one is selected, as a kernel does."""
    with np.errstate(all="ignore"):
        return float(sp.lambdify(symbols, expr, "numpy")(*[np.float64(v) for v in values]))


def gradient_at(expr, symbols, values) -> list[float]:
    return [eager(sp.S.Zero + sp.diff(expr, s), symbols, values) for s in symbols]


@pytest.mark.parametrize("name", ["VM", "ACCM", "WM", "WDTM"])
def test_measures_at_rest_are_flat(name):
    scope = SampleScope()
    form = (0, GROUND, GROUND)[: len(FUNCTIONS[name].parameters)]
    expr = FUNCTIONS[name].body(scope, *form)
    symbols = sorted(expr.free_symbols, key=str)
    rest = [0.0] * len(symbols)
    assert eager(expr, symbols, rest) == 0
    assert gradient_at(expr, symbols, rest) == [0.0] * len(symbols)


@pytest.mark.parametrize("name", ["PSI", "THETA", "PHI", "YAW", "PITCH", "ROLL"])
def test_angles_of_aligned_frames_have_finite_derivatives(name):
    scope = SampleScope()
    expr = FUNCTIONS[name].body(scope, 0, GROUND)
    symbols = sorted(expr.free_symbols, key=str)
    # x_0_<axis>_<component> of the unit matrix
    aligned = [float(str(s)[4] == str(s)[6]) for s in symbols]
    assert eager(expr, symbols, aligned) == 0
    assert np.isfinite(gradient_at(expr, symbols, aligned)).all()


@pytest.mark.parametrize("exponent", [1.0, 1.5, 2.0, 2.2])
@pytest.mark.parametrize("depth", [0.0, 0.5])
def test_contact_at_the_moment_of_touching(exponent, depth):
    x, v = sp.symbols("x v", real=True)
    for x1, k in ((4.0, 10.0), sp.symbols("x1 k", real=True)):
        expr = FUNCTIONS["IMPACT"].body(None, x, v, x1, k, exponent, 2.0, depth)
        symbols, values = [x, v], [4.0, -1.0]
        if x1 != 4.0:
            symbols, values = [x, v, x1, k], [4.0, -1.0, 4.0, 10.0]
        assert eager(expr, symbols, values) == 0
        assert np.isfinite(gradient_at(expr, symbols, values)).all()


def test_root_of_a_square_is_differentiable():
    x = sp.Symbol("x", real=True)
    expr = FUNCTIONS["SQRT"].body(None, x**2)
    assert [eager(sp.diff(expr, x), [x], [v]) for v in (-2.0, 3.0)] == [-1, 1]
