"""Every deck function in the registry: its derivative is the derivative of its value.

Nothing here names a function to include it: arguments follow from the signature, and the places to
look at closely from its ``edges``.
"""

from __future__ import annotations

import itertools
import random

import mpmath as mp
import numpy as np
import pytest
from graph_values import DOUBLES, value
from sample_scope import DIGITS, GROUND, TABLES, SampleScope
from tiers import every

import adamslite.functions  # noqa: F401  fills the registry
from adamslite.functions.arrays import NUMBERED
from adamslite.functions.forces import NET
from adamslite.functions.vectors import VECTORS
from adamslite.kernels.code.graph_to_llvm import CONDITIONS, NAMES
from adamslite.language.function import FUNCTIONS, Function
from adamslite.language.routines import USER
from adamslite.native.llvm_builder import LIBRARY
from adamslite.symbolic.derivatives import Derivatives, along
from adamslite.symbolic.graph import ZERO, node, symbol
from adamslite.symbolic.structure import ordered

# What native code can be made of; anything else would only be noticed when a deck uses it.
PRINTABLE = {*LIBRARY, *NAMES, *CONDITIONS, "number", "symbol", "neg", "choice", *TABLES}
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
        self.numbers = [symbol(f"u{n}") for n, a in enumerate(form) if a is None]
        rest = iter(self.numbers)
        args = [next(rest) if a is None else a for a in form]
        slope = Derivatives()
        self.expr = node(FUNCTIONS[name].body(self.scope, *args))
        edges = FUNCTIONS[name].edges
        self.edges = [node(e) for e in edges(*args)] if edges else []
        given = sorted(slope.symbols(self.expr) - set(self.numbers), key=str)
        self.symbols = self.numbers + given
        self.derivatives = [slope.gradient(self.expr).get(s, ZERO) for s in self.symbols]
        self.given = [self.scope.values[s] for s in given]

    def value_of(self, *at: mp.mpf) -> mp.mpf:
        """The value at many digits."""
        return value(self.expr, dict(zip(self.symbols, at, strict=True)), mp, TABLES)

    def slopes_of(self, *at: mp.mpf) -> list[mp.mpf]:
        """The derivatives."""
        numbers = dict(zip(self.symbols, at, strict=True))
        return [value(each, numbers, mp, TABLES) for each in self.derivatives]

    def edges_of(self, *at: mp.mpf) -> list[mp.mpf]:
        """What changes sign at the places to look at closely."""
        numbers = dict(zip(self.numbers, at, strict=True))
        return [value(each, numbers, mp) for each in self.edges]

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
def test_the_derivative_in_a_direction_is_that_of_all_symbols(name, form):
    """Forward and reverse: sum of slopes times rates, at random rates."""
    gradient, rng = Gradient(name, form), random.Random(name)
    rates = {each: symbol(f"rate_{each}") for each in gradient.symbols}
    with mp.workdps(DIGITS):
        numbers = {each: mp.mpf(rng.uniform(-1, 1)) for each in rates.values()}
        numbers |= dict(zip(gradient.symbols, [
            *(mp.mpf(rng.uniform(-0.95, 0.95)) for _ in gradient.numbers), *gradient.given,
        ], strict=True))  # fmt: skip
        found = value(along(gradient.expr, rates), numbers, mp, TABLES)
        parts = [
            value(slope, numbers, mp, TABLES) * numbers[rates[each]]
            for each, slope in zip(gradient.symbols, gradient.derivatives, strict=True)
        ]
        assert abs(found - mp.fsum(parts)) <= mp.mpf("1e-30") * (1 + abs(found))


@pytest.mark.parametrize(("name", "form"), every(6, CASES))
def test_only_printable_operations(name, form):
    gradient = Gradient(name, form)
    assert {top.kind for top in ordered([gradient.expr, *gradient.derivatives])} <= PRINTABLE


def eager(expr, symbols, values):
    """The value in doubles, as a kernel has it."""
    with np.errstate(all="ignore"):
        return float(value(expr, dict(zip(symbols, values, strict=True)), DOUBLES))


def gradient_at(expr, symbols, values) -> list[float]:
    slopes = Derivatives().gradient(expr)
    return [eager(slopes.get(s, ZERO), symbols, values) for s in symbols]


@pytest.mark.parametrize("name", ["VM", "ACCM", "WM", "WDTM"])
def test_measures_at_rest_are_flat(name):
    scope = SampleScope()
    form = (0, GROUND, GROUND)[: len(FUNCTIONS[name].parameters)]
    expr = FUNCTIONS[name].body(scope, *form)
    symbols = sorted(Derivatives().symbols(expr), key=str)
    rest = [0.0] * len(symbols)
    assert eager(expr, symbols, rest) == 0
    assert gradient_at(expr, symbols, rest) == [0.0] * len(symbols)


@pytest.mark.parametrize("name", ["PSI", "THETA", "PHI", "YAW", "PITCH", "ROLL"])
def test_angles_of_aligned_frames_have_finite_derivatives(name):
    scope = SampleScope()
    expr = FUNCTIONS[name].body(scope, 0, GROUND)
    symbols = sorted(Derivatives().symbols(expr), key=str)
    # x_0_<axis>_<component> of the unit matrix
    aligned = [float(str(s)[4] == str(s)[6]) for s in symbols]
    assert eager(expr, symbols, aligned) == 0
    assert np.isfinite(gradient_at(expr, symbols, aligned)).all()


@pytest.mark.parametrize("exponent", [1.0, 1.5, 2.0, 2.2])
@pytest.mark.parametrize("depth", [0.0, 0.5])
def test_contact_at_the_moment_of_touching(exponent, depth):
    x, v = symbol("x"), symbol("v")
    for x1, k in ((4.0, 10.0), (symbol("x1"), symbol("k"))):
        expr = FUNCTIONS["IMPACT"].body(SampleScope(), x, v, x1, k, exponent, 2.0, depth)
        symbols, values = [x, v], [4.0, -1.0]
        if x1 != 4.0:
            symbols, values = [x, v, x1, k], [4.0, -1.0, 4.0, 10.0]
        assert eager(expr, symbols, values) == 0
        assert np.isfinite(gradient_at(expr, symbols, values)).all()


def test_root_of_a_square_is_differentiable():
    x = symbol("x")
    expr = FUNCTIONS["SQRT"].body(SampleScope(), x**2)
    assert [gradient_at(expr, [x], [v]) for v in (-2.0, 0.0, 3.0)] == [[-1], [1], [1]]
