"""Records within a step of the explicit formula: three more stages, a polynomial of order 7.

Reference: Hairer, Norsett, Wanner, Solving ODE I, 1993, section II.6.
"""

from __future__ import annotations

from adamslite.integrators.base import Plan, Problem
from adamslite.integrators.dop853 import LATE, POWERS, ROW, TIMES
from adamslite.integrators.explicit_stages import add_combined, combine, exact_rates, rates_at
from adamslite.integrators.explicit_state import (
    BETWEEN,
    CLOCK,
    FOLLOWING,
    K_NEW,
    NEXT_STATE,
    OLD,
    WIDTH,
    H,
)
from adamslite.integrators.records import write_record
from adamslite.translate import Reals, native


@native
def write_dense(P: Problem, L: Plan, w: int, t: float) -> bool:
    """Write every asked time up to ``t``, the end of the step."""
    C, K = P.control, P.history
    following, ready, h = int(C[FOLLOWING]), False, C[H]
    while following < P.times.size and P.times[following] <= t + 1e-9 * h:
        y = K[NEXT_STATE * w :]
        if P.times[following] < t - 1e-9 * h:
            if not ready and not late_stages(P, L, w, h):
                return False
            ready = True
            y = K[BETWEEN * w :]
            interpolated(P, w, h, (P.times[following] - C[CLOCK]) / h, y)
        if ready and not exact_rates(P, L, P.times[following], y, P.trial):
            return False
        write_record(P, following)
        following += 1
    C[FOLLOWING] = float(following)
    return True


@native
def late_stages(P: Problem, L: Plan, w: int, h: float) -> bool:
    """Three more stages for the interpolation."""
    K, y = P.history, P.history[BETWEEN * w :]
    for i in range(K_NEW + 1, K_NEW + 4):
        combine(P, LATE + i - K_NEW - 1, w, h, K[OLD * w :], y)
        at = P.control[CLOCK] + h * P.tableau[ROW * TIMES + i]
        if not rates_at(P, L, at, y, K[i * int(P.control[WIDTH]) :]):
            return False
    return True


@native
def interpolated(P: Problem, w: int, h: float, x: float, y: Reals) -> None:
    """The state at t + x h: order 7."""
    K, z = P.history, 1.0 - x
    old, new = K[OLD * w :], K[NEXT_STATE * w :]
    a, b, c = x, x * z, x * x * z
    for i in range(w):
        y[i] = old[i] + (a - b + 2.0 * c) * (new[i] - old[i])
    width = int(P.control[WIDTH])
    for i in range(width):
        y[w - width + i] += h * ((b - c) * K[i] - c * K[K_NEW * width + i])
    for i in range(w - width):
        y[i] += h * ((b - c) * old[width + i] - c * new[width + i])
    weight = h * x * x * z * z
    for j in range(4):
        add_combined(P, POWERS + j, w, weight, y)
        weight *= x if j % 2 == 0 else z
