"""Records within a step of the explicit formula: three more stages, a polynomial of order 7.

    p(x) at the share x of the step,    defect  p'(x) - h f(p(x))

The step ends right where its error test says so, but the polynomial has a test of its own to pass:
where something stiff holds the steps at the bound of stability, its error is not that of the ends.
The defect, which the rates of the record cost nothing more, shows it; such records are taken by
steps of their own.

References: Hairer, Norsett, Wanner, Solving ODE I, 1993, section II.6; Enright, Numer. Algorithms
18 (1998) 205 (defects of interpolants).
"""

from __future__ import annotations

from adamslite.integrators.contract import Problem
from adamslite.integrators.explicit.control import (
    BETWEEN,
    K_NEW,
    LATE_STAGES,
    NEXT_STATE,
    OLD,
    SLOPE,
    Control,
)
from adamslite.integrators.explicit.dop853 import LATE, POWERS, ROW, TIMES
from adamslite.integrators.explicit.stages import (
    add_combined,
    combine,
    exact_rates,
    rates_at,
    stages,
)
from adamslite.integrators.linalg.plan import Plan
from adamslite.integrators.records import has_room, write_record
from adamslite.integrators.stepping.output import WITHIN
from adamslite.native.translate import Reals, copy, inline, native

# An error e of the polynomial leaves a defect of about e times its order, or e times what the
# stiffest component changes in a step, which is as much at the bound of stability.
DEFECT = 7.0


@native
def record(P: Problem, L: Plan, C: Control, t: float) -> bool:
    """Write the output times up to ``t``, the end of the step, that there is room for."""
    w = C.size
    K, h = P.history, C.h
    while is_within(P, C, t) and has_room(P, C.row):
        at = P.times[C.row]
        if at < t - WITHIN * h:
            x, y = (at - C.t) / h, K[BETWEEN * w :]
            if not (C.late or C.quick) and not late_stages(P, L, C, h):
                return False
            C.late = True
            if not C.apart:
                interpolated(P, C, h, x, y)
                slope(P, C, h, x, K[SLOPE * w :])
                if not exact_rates(P, L, C, at, y, P.trial):
                    return False
                C.apart = defect(P, C, h) > DEFECT * P.settings.error
            if C.apart and not step_to(P, L, C, at, x * h):
                return False
        elif C.late and not exact_rates(P, L, C, at, K[NEXT_STATE * w :], P.trial):
            return False
        write_record(P, C.row)
        C.row += 1
    return True


@native
def is_within(P: Problem, C: Control, t: float) -> bool:
    """Whether the next output time lies in the step that ends at ``t``."""
    return C.row < P.times.size and P.times[C.row] <= t + WITHIN * C.h


@native
def step_to(P: Problem, L: Plan, C: Control, t: float, h: float) -> bool:
    """The state at ``t`` by a step of size ``h`` from the start of this one; the new state stays,
    the stages of this step do not.
    """
    w = C.size
    K, whole = P.history, C.h
    new, y = K[NEXT_STATE * w :], K[BETWEEN * w :]
    copy(y, new, w)
    C.h = h
    good = stages(P, L, C, h)
    C.h = whole
    for i in range(w):
        kept = y[i]
        y[i] = new[i]
        new[i] = kept
    return good and exact_rates(P, L, C, t, y, P.trial)


@native
def late_stages(P: Problem, L: Plan, C: Control, h: float) -> bool:
    """Three more stages for the interpolation."""
    w = C.size
    K, y = P.history, P.history[BETWEEN * w :]
    for i in range(K_NEW + 1, K_NEW + 1 + LATE_STAGES):
        combine(P, C, LATE + i - K_NEW - 1, w, h, K[OLD * w :], y)
        at = C.t + h * P.tableau[ROW * TIMES + i]
        if not rates_at(P, L, C, at, y, K[i * C.width :]):
            return False
    return True


@native
def interpolated(P: Problem, C: Control, h: float, x: float, y: Reals) -> None:
    """The state at t + x h: order 7."""
    if C.quick:
        quick_interpolated(P, C, h, x, y)
        return
    w, z = C.size, 1.0 - x
    copy(y, P.history[OLD * w :], w)
    add_cubic(P, C, h, x, x * z, x * x * z, y)
    weight = h * x * x * z * z
    for j in range(4):
        add_combined(P, C, POWERS + j, 0, w, weight, y)
        weight *= x if j % 2 == 0 else z


@native
def slope(P: Problem, C: Control, h: float, x: float, y: Reals) -> None:
    """h times the rate of the interpolation at t + x h."""
    if C.quick:
        quick_slope(P, C, h, x, y)
        return
    w, z = C.size, 1.0 - x
    b, c = z - x, 2.0 * x * z - x * x
    for i in range(w):
        y[i] = 0.0
    add_cubic(P, C, h, 1.0, b, c, y)
    xz = x * z
    add_combined(P, C, POWERS, 0, w, h * 2.0 * xz * b, y)
    add_combined(P, C, POWERS + 1, 0, w, h * x * xz * (3.0 * z - 2.0 * x), y)
    add_combined(P, C, POWERS + 2, 0, w, h * 3.0 * xz * xz * b, y)
    add_combined(P, C, POWERS + 3, 0, w, h * x * xz * xz * (4.0 * z - 3.0 * x), y)


@native
@inline
def add_cubic(P: Problem, C: Control, h: float, a: float, b: float, c: float, y: Reals) -> None:
    """Add the cubic through both ends of the step, or its slope: a, b and c are x, x (1 - x) and
    x^2 (1 - x), or their slopes.
    """
    w, width, K = C.size, C.width, P.history
    old, new = K[OLD * w :], K[NEXT_STATE * w :]
    for i in range(w):
        y[i] += (a - b + 2.0 * c) * (new[i] - old[i])
    for i in range(width):
        y[w - width + i] += h * ((b - c) * K[i] - c * K[K_NEW * width + i])
    for i in range(w - width):
        y[i] += h * ((b - c) * old[width + i] - c * new[width + i])


@native
@inline
def third(way: float, v0: float, v1: float, a0: float, a1: float) -> float:
    """Coefficient of x^3 in the polynomial p that covers ``way`` from x = 0 to 1, with p' = v0 and
    v1, p''/2 = a0 and a1 there; those of lower powers are v0 and a0.
    """
    return 10.0 * way - 6.0 * v0 - 4.0 * v1 - 3.0 * a0 + a1


@native
@inline
def fourth(way: float, v0: float, v1: float, a0: float, a1: float) -> float:
    """The same of x^4."""
    return 7.0 * v1 + 8.0 * v0 + 3.0 * a0 - 2.0 * a1 - 15.0 * way


@native
@inline
def fifth(way: float, v0: float, v1: float, a0: float, a1: float) -> float:
    """The same of x^5."""
    return 6.0 * way - 3.0 * (v0 + v1) - a0 + a1


@native
def quick_interpolated(P: Problem, C: Control, h: float, x: float, y: Reals) -> None:
    """q and u at t + x h from the polynomial of order 5 through both ends: p and p'/h."""
    n, w = C.width, C.size
    a, b, old, new = (
        P.history,
        P.history[K_NEW * n :],
        P.history[OLD * w :],
        P.history[NEXT_STATE * w :],
    )
    for i in range(n):
        way, v0, v1 = new[i] - old[i], h * old[n + i], h * new[n + i]
        a0, a1 = 0.5 * h * h * a[i], 0.5 * h * h * b[i]
        c3, c4 = third(way, v0, v1, a0, a1), fourth(way, v0, v1, a0, a1)
        c5 = fifth(way, v0, v1, a0, a1)
        y[i] = old[i] + x * (v0 + x * (a0 + x * (c3 + x * (c4 + x * c5))))
        y[n + i] = (v0 + x * (2.0 * a0 + x * (3.0 * c3 + x * (4.0 * c4 + x * 5.0 * c5)))) / h


@native
def quick_slope(P: Problem, C: Control, h: float, x: float, y: Reals) -> None:
    """h times the rate of u of :func:`quick_interpolated`."""
    n, w = C.width, C.size
    a, b, old, new = (
        P.history,
        P.history[K_NEW * n :],
        P.history[OLD * w :],
        P.history[NEXT_STATE * w :],
    )
    for i in range(n):
        way, v0, v1 = new[i] - old[i], h * old[n + i], h * new[n + i]
        a0, a1 = 0.5 * h * h * a[i], 0.5 * h * h * b[i]
        c3, c4 = third(way, v0, v1, a0, a1), fourth(way, v0, v1, a0, a1)
        c5 = fifth(way, v0, v1, a0, a1)
        y[n + i] = (2.0 * a0 + x * (6.0 * c3 + x * (12.0 * c4 + x * 20.0 * c5))) / h


@native
def defect(P: Problem, C: Control, h: float) -> float:
    """max |p' - h f(p)| / max(1, |p|), of what has rates in ``P.trial``."""
    w = C.size
    width, top = C.width, 0.0
    y, rate = P.history[BETWEEN * w :], P.history[SLOPE * w :]
    for i in range(w - width, w):
        off = abs(rate[i] - h * P.trial[i - (w - width)])
        top = max(top, off / max(1.0, abs(y[i])))
    return top
