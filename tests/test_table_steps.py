"""Tables of the state: no step passes what is narrower than it, and few knots cost steps.

Truths are energies: the work of a force by a table is its integral, exact by Gauss's formula on
every piece.
"""

from __future__ import annotations

from math import sqrt

import numpy as np
import pytest

from adamslite import Outcome, Results, simulate
from adamslite.errors import UsageError
from adamslite.symbolic.interpolant import interpolant, reach

KINDS = {"AKISPL": "akima", "CUBSPL": "natural", "INTERP": "linear"}
DECK = """A mass that meets a force by a table
UNITS/SYSTEM=MKS
PART/1, GROUND
MARKER/1, PART=1
SPLINE/1, X={x}
, Y={y}
POINT_MASS/2, MASS={mass}, CM=2, VX={speed}
MARKER/2, POINT_MASS=2
VFORCE/1, I=2, J_PART=1, FX={force}
SIMULATE/DYNAMIC, END={end}, STEPS={steps}
END
"""


def listed(values: np.ndarray) -> str:
    rows = [values[k : k + 6].tolist() for k in range(0, len(values), 6)]
    return "\n, ".join(", ".join(map(repr, row)) for row in rows)


def work(x: np.ndarray, y: np.ndarray, kind: str, end: float) -> float:
    """Integral of the table from 0 to ``end``."""
    table, (nodes, weights) = interpolant(x, y[:, None], kind), np.polynomial.legendre.leggauss(3)
    bounds = np.unique(np.concatenate([[0.0], x[(x > 0) & (x < end)], [end]]))
    half, middle = 0.5 * np.diff(bounds), 0.5 * (bounds[:-1] + bounds[1:])
    values = table.at((middle[:, None] + half[:, None] * nodes).ravel())[:, 0]
    return float((values.reshape(-1, 3) @ weights) @ half)


def spike(rng: np.random.Generator, kind: str) -> tuple[np.ndarray, np.ndarray, float, float]:
    """Uneven knots of a spike on a flat table of length 1, mass and speed; the spike takes or gives
    10 to 50 % of the energy.
    """
    width, n = 10 ** rng.uniform(-3, -0.7), int(rng.integers(2, 9))
    own = rng.uniform(0.3, 0.6) + width * np.cumsum(rng.uniform(0.1, 1, n)) / n
    gap = width * rng.uniform(0.05, 0.6)
    left = [-0.1, *np.sort(rng.uniform(0, own[0] - 4 * gap, int(rng.integers(2, 8))))]
    right = [*np.sort(rng.uniform(own[-1] + 4 * gap, 1.3, int(rng.integers(2, 8)))), 2.0]
    flat = gap * np.array([1.0, 2.0, 3.3])
    x = np.concatenate([left, own[0] - flat[::-1], own, own[-1] + flat, right])
    y = np.zeros(len(x))
    y[len(left) + 3 : len(left) + 3 + n] = rng.uniform(0.2, 1, n) * rng.choice([-1, 1])
    mass, speed = 10 ** rng.uniform(-1, 2), 10 ** rng.uniform(0, 2)
    scale = rng.uniform(0.1, 0.5) * mass * speed**2 / 2 / abs(work(x, y, kind, 1.3))
    return x * speed, y * scale / speed, mass, speed


def passed(function: str, rng: np.random.Generator, **options) -> tuple[Results, float]:
    """A run over a spike, and how far its last speed is off, as a share."""
    x, y, mass, speed = spike(rng, KINDS[function])
    argument = "1,1" if function == "INTERP" else "0,1"
    deck = DECK.format(
        x=listed(x), y=listed(y), mass=mass, speed=speed, end=1, steps=rng.choice([1, 2, 10, 40]),
        force=f"{function}(DX(2),{argument})",
    )  # fmt: skip
    results = simulate(deck, **options)
    assert results.outcome is Outcome.DONE
    at = float(results["POINT_MASS/2.x"][-1])
    truth = sqrt(speed**2 + 2 * work(x, y, KINDS[function], at) / mass)
    return results, abs(results["POINT_MASS/2.vx"][-1] / truth - 1)


@pytest.mark.numerical
@pytest.mark.parametrize("function", KINDS)
@pytest.mark.parametrize(
    ("method", "error", "off"),
    [("GSTIFF", 1e-3, 2e-2), ("GSTIFF", 1e-6, 1e-4), ("RADAU", 1e-6, 1e-4), ("RADAU", 1e-8, 1e-6),
     ("HHT", 1e-4, 1e-2), ("HHT", 1e-6, 1e-3), ("NEWMARK", 1e-4, 1e-2), ("ABAM", 1e-3, 1e-3),
     ("ABAM", 1e-8, 1e-4)],
)  # fmt: skip
def test_no_spike_of_a_table_is_passed(function, method, error, off) -> None:
    """Spikes of a thousandth to a fifth of the way, which long steps would pass unseen."""
    rng = np.random.default_rng(31)
    for _ in range(10):
        assert passed(function, rng, integrator=method, error=error)[1] < off


@pytest.mark.parametrize("function", KINDS)
def test_equal_steps_reject_tables_of_the_state(function) -> None:
    with pytest.raises(UsageError, match="rises within a zone .*a table"):
        passed(function, np.random.default_rng(31), integrator="VERLET", error=1e-3)


@pytest.mark.numerical
@pytest.mark.parametrize("method", ["GSTIFF", "RADAU", "HHT", "ABAM"])
def test_a_corner_behind_a_knot_without_a_bend_is_met(method) -> None:
    """A wedge of 0.3 m and 1e4 N takes 2 (1000 J) of 5000 J: 89.4427 m/s are left."""
    x, y = np.array([0, 50.5, 50.7, 50.9, 51, 51.1, 100]), np.array([0, 0, 0, 0, -1e4, 0, 0])
    deck = DECK.format(
        x=listed(x), y=listed(y), mass=1, speed=100, end=1, steps=10, force="INTERP(DX(2),1,1)"
    )
    for error in (1e-3, 1e-6):
        speed = simulate(deck, integrator=method, error=error)["POINT_MASS/2.vx"][-1]
        assert abs(speed - sqrt(8000)) < (0.1 if error == 1e-3 else 2e-3)


def hops(x: np.ndarray, y: np.ndarray, tight: float, kind: str = "akima") -> int:
    """The fewest steps from one end of a table to the other."""
    found = reach(interpolant(x, y[:, None], kind), 0, False, tight)
    n, at, count = int(found[0]), x[0] + 1e-9, 0
    knots, aims = found[3 : 3 + n], found[3 + n : 4 + 2 * n]
    while at < x[-1]:
        at, count = aims[np.searchsorted(knots, at, side="right")], count + 1
    return count


def test_smooth_tables_cost_few_steps_whatever_the_number_of_knots() -> None:
    """Ten seconds of a sine: its curvature bounds steps, not its knots.  Flat and straight tables
    are passed at once, and a spike is not, wherever it is.
    """
    for n in (300, 3000, 30000):
        x = np.linspace(0, 10, n)
        assert hops(x, np.sin(x), 1e-4) < 20
        assert hops(x, 3 + 2 * x, 1e-9) == 1
        bump = np.sin(x)
        bump[n // 3] += 0.01
        found = reach(interpolant(x, bump[:, None], "akima"), 0, False, 1e-4)
        aims = found[3 + int(found[0]) : 4 + 2 * int(found[0])]
        before = aims[n // 3 - 20 : n // 3]
        assert (before <= x[n // 3] + 1e-12).all()


def test_a_table_that_is_flat_over_many_knots_costs_no_steps() -> None:
    x = np.linspace(-1, 200, 2000)
    for force in ("AKISPL(DX(2),0,1)", "INTERP(DX(2),1,1)"):
        steps = []
        for knots in (x, x[[0, 700, 1400, -1]]):
            deck = DECK.format(
                x=listed(knots), y=listed(5 + 0 * knots), mass=1, speed=100, end=1, steps=2,
                force=force,
            )  # fmt: skip
            steps.append(simulate(deck).summary["steps"])
        assert steps[0] <= steps[1] + 3


@pytest.mark.numerical
@pytest.mark.parametrize("method", ["GSTIFF", "RADAU", "HHT", "ABAM"])
def test_a_hump_between_two_knots_is_not_hidden_by_its_ends(method) -> None:
    """Akima's cubic over 10 m beside a spike is zero at both of its knots, and large in between."""
    x = np.array([-5, 0, 10, 20, 30, 40, 50, 50.1, 50.2, 50.3, 50.4, 60, 70, 80, 90, 100, 120])
    y = np.zeros(len(x))
    y[7:10] = 1000, 2000, 1000
    deck = DECK.format(
        x=listed(x), y=listed(-y), mass=1, speed=100, end=1, steps=4, force="AKISPL(100-DX(2),0,1)"
    )
    table, ends = interpolant(x, -y[:, None], "akima"), np.linspace(0, 100, 200001)
    force = table.at(100 - 0.5 * (ends[1:] + ends[:-1]))[:, 0]
    truth = sqrt(100**2 + 2 * force.sum() * (ends[1] - ends[0]))
    for error in (1e-3, 1e-4, 1e-5):
        speed = simulate(deck, integrator=method, error=error)["POINT_MASS/2.vx"][-1]
        assert abs(speed / truth - 1) < 0.03
