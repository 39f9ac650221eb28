"""What a table of time can be within a span of time."""

from __future__ import annotations

import numpy as np
import pytest

from adamslite.analyses.clock.enclosures import enclose
from adamslite.analyses.clock.table_ranges import Ranges, extent, value
from adamslite.symbolic.interpolant import Interpolant, interpolant

RANDOM = np.random.default_rng(11)
X = np.cumsum(RANDOM.uniform(0.05, 1.0, 50)) - 12.0
Y = RANDOM.normal(size=(50, 4))
PLACES = np.array([-1.0, 0.0, 0.4, 2.0])
KINDS = ("linear", "akima", "natural")
# Spans of all lengths, inside, beyond one end and beyond both.
LOW = RANDOM.uniform(-16.0, 16.0, 400)
HIGH = LOW + 10.0 ** RANDOM.uniform(-9.0, 1.4, 400)
SHARES = np.linspace(0.0, 1.0, 33)[:, None]
INSIDE = LOW + SHARES * (HIGH - LOW)


def table(kind: str) -> Interpolant:
    return interpolant(X, Y, kind, "parabola", PLACES)


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("order", range(4))
def test_no_value_lies_outside_and_bounds_are_met(kind: str, order: int) -> None:
    """Over 60 pieces and less the bounds are values: a fine sample comes near them."""
    made = table(kind)
    for curve in range(2):
        least, most = Ranges(made, curve, order).within(LOW, HIGH)
        sample = made.at(INSIDE.ravel(), order)[:, curve].reshape(INSIDE.shape)
        room = 1e-9 * (1.0 + np.abs(sample).max())
        assert (sample >= least - room).all() and (sample <= most + room).all()
        short = HIGH - LOW < 1e-3
        wide = (most - least)[short]
        seen = (sample.max(axis=0) - sample.min(axis=0))[short]
        if order < (1 if kind == "linear" else 2):
            assert (wide <= 1.1 * seen + room).all()


def test_every_knot_is_a_jump_of_the_derivatives_that_break_there() -> None:
    jumping = {"linear": {1}, "akima": {2, 3}, "natural": {3}}
    for kind, orders in jumping.items():
        for order in range(4):
            found = Ranges(table(kind), 0, order).jumps_within(X - 1e-6, X + 1e-6)[1:-1]
            assert found.all() if order in orders else not found.any(), (kind, order)


@pytest.mark.parametrize("order", range(3))
def test_value_and_rate_of_a_table_of_time_are_enclosed(order: int) -> None:
    """x = 3 t^2 - 2, also where the span is all of the table; rates by differences."""
    made = table("natural")
    code = [
        ("t",), ("number", 3.0), ("root", 0, 2, 1), ("Mul", 1, 2), ("number", -2.0), ("Add", 3, 4),
        ("Lookup", made, 1, order, 5),
    ]  # fmt: skip
    least, most, slow, fast = enclose(code, LOW, HIGH)
    x, rate = 3.0 * INSIDE**2 - 2.0, 6.0 * INSIDE
    found = made.at(x.ravel(), order)[:, 1].reshape(x.shape)
    rates = made.at(x.ravel(), order + 1)[:, 1].reshape(x.shape) * rate
    for values, low, high in ((found, least, most), (rates, slow, fast)):
        room = 1e-9 * (1.0 + np.abs(values))
        assert (values >= low - room).all() and (values <= high + room).all()


@pytest.mark.parametrize("orders", [(0, 0), (1, 0), (0, 1), (2, 1), (0, 2), (3, 0)])
@pytest.mark.parametrize("curves", [1, 2, 4])
def test_value_and_rate_of_a_table_of_two_arguments_are_enclosed(
    orders: tuple[int, int], curves: int
) -> None:
    """x = t, z = t/8."""
    from adamslite.kernels.code.lookup import lookup

    made = interpolant(X, Y[:, :curves], "akima", "tangent", PLACES[:curves])
    code = [("t",), ("number", 0.125), ("Mul", 0, 1), ("LookupBetween", made, *orders, 0, 2)]
    least, most, slow, fast = enclose(code, LOW, HIGH)
    order, z_order = orders
    for k in range(0, len(SHARES), 4):
        for n, t in enumerate(INSIDE[k]):
            found = lookup(made.data, t, t / 8, order, z_order)
            rate = lookup(made.data, t, t / 8, order + 1, z_order)
            rate += lookup(made.data, t, t / 8, order, z_order + 1) / 8
            room = 1e-9 * (1.0 + abs(found) + abs(rate))
            assert least[n] - room <= found <= most[n] + room
            assert slow[n] - room <= rate <= fast[n] + room


def test_bounds_shrink_to_the_value_of_a_point() -> None:
    made = table("akima")
    at = np.linspace(-13.0, 13.0, 200)
    one = enclose([("t",), ("Lookup", made, 2, 0, 0)], at, at)
    two = enclose([("t",), ("number", 0.1), ("LookupBetween", made, 0, 0, 0, 1)], at, at)
    assert one[0] == pytest.approx(made.at(at)[:, 2]) and (one[0] == one[1]).all()
    assert one[2] == pytest.approx(made.at(at, 1)[:, 2])
    blend = 0.75 * made.at(at)[:, 1] + 0.25 * made.at(at)[:, 2]
    for side in two[:2]:
        assert side == pytest.approx(blend, abs=1e-9)


def test_cubics_are_largest_at_an_end_or_where_they_are_level() -> None:
    """t^3 - 3 t is level at -1 and 1, with the values 2 and -2; a constant is what it is."""
    cubic = np.array([[0.0, -3.0, 0.0, 1.0]])
    for low, high, least, most in ((-1.5, 0.0, 0.0, 2.0), (-3, 3, -18, 18), (0.5, 1.2, -2, -1.375)):
        found = extent(cubic, np.array([low]), np.array([high]))
        assert np.concatenate(found) == pytest.approx([least, most], abs=1e-14)
    level = np.array([[4.0, 0.0, 0.0, 0.0]])
    assert extent(level, np.array([-1.0]), np.array([5.0])) == ([4.0], [4.0])
    assert value(cubic, np.array([2.0])) == [2.0]


def test_of_what_has_no_bound_nothing_is_known() -> None:
    made = table("natural")
    code = [("t",), ("root", 0, -1, 1), ("Lookup", made, 0, 0, 1)]
    least, most, slow, fast = enclose(code, np.array([-1.0]), np.array([1.0]))
    assert (least, most, slow, fast) == (-np.inf, np.inf, -np.inf, np.inf)
