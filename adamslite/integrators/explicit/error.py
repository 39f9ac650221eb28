"""The error test of the explicit formula, the first step and the next.

    error = |e5|^2/sqrt(|e5|^2 + 0.01 |e3|^2)    over ERROR SCALE max(1, |y|)

Reference: Hairer, Norsett, Wanner, Solving ODE I, 1993, sections II.4 (start) and II.10 (error).
"""

from __future__ import annotations

from adamslite.integrators.contract import Problem
from adamslite.integrators.events.stops import longest_step
from adamslite.integrators.explicit.control import (
    BETWEEN,
    K_NEW,
    LANES,
    NEXT_STATE,
    OLD,
    SCALES,
    Control,
)
from adamslite.integrators.explicit.dop853 import ERROR3, ERROR5
from adamslite.integrators.explicit.lanes import unknown_of
from adamslite.integrators.explicit.nystrom import Q_SCALE, U_SCALE
from adamslite.integrators.explicit.stages import combine, rates_at
from adamslite.integrators.linalg.norms import exceeds
from adamslite.integrators.linalg.plan import HUGE, Plan
from adamslite.integrators.stepping.outcome import LONGER
from adamslite.native.translate import Reals, maximum, native

# The next step aims at this share of what the error test allows; exponents of the present and the
# last error (section IV.2 of the second volume: steadier at the limit of stability).
SAFETY = 0.9
NOW_POWER, LAST_POWER = -0.125 + 0.03, 0.04
QUICK_POWER, QUICK_LAST_POWER = -0.25 + 0.06, 0.08
SHRINK, GROW = 0.2, 6.0
# An error estimate below this counts as this for the next step.
LEAST_ERROR = 1e-4
# Where the error is largest is noted where it is too large, and after so many steps for those who
# watch the run.
NOTED = 128
# Numbers whose squares are still numbers, and still above zero.
LARGE, NOTHING = 1e150, 1e-100
# Share of the state that the trial step of the start may change, and its length where nothing moves
# (states and rates below AT_REST) or the rates do not change (below STRAIGHT).
TRIAL, SHORT, AT_REST, STRAIGHT = 0.01, 1e-6, 1e-5, 1e-15


@native
def distance(P: Problem, a: Reals, y: Reals, scales: Reals, w: int) -> float:
    """Largest |a_i| against ERROR scale_i max(1, |y_i|); not-a-number where one is none."""
    top = 0.0
    for i in range(w):
        top = maximum(top, share(a, y, scales, i))
    return top / P.settings.error


@native
def share(a: Reals, y: Reals, scales: Reals, i: int) -> float:
    """|a_i| against scale_i max(1, |y_i|)."""
    return abs(a[i]) / (scales[i] * max(1.0, abs(y[i])))


@native
def note_worst(P: Problem, C: Control) -> None:
    """Remember where the error estimate is largest, or no number."""
    top, where, w = 0.0, 0, C.size
    y, scales = P.history[NEXT_STATE * w :], P.history[SCALES * w :]
    for i in range(w):
        size = share(P.trial, y, scales, i)
        if exceeds(size, top):
            top, where = size, i
    P.report.where = unknown_of(P, C.lane, where) if C.kind == LANES else where


@native
def first_step(P: Problem, L: Plan, C: Control) -> float:
    """A step whose errors are small, from the rates here and one small step further (section
    II.4).
    """
    w = C.size
    t = C.t
    room = min(longest_step(P), P.settings.t_end - t)
    if P.settings.h_init > 0.0:
        return min(room, P.settings.h_init)
    y, new, width = P.history[OLD * w :], P.history[NEXT_STATE * w :], C.width
    h = euler(P, C, 1.0)
    scales = P.history[SCALES * w :]
    d0, d1 = distance(P, y, y, scales, w), change(P, C) / h
    h = min(room, TRIAL * d0 / d1 if d0 > AT_REST and d1 > AT_REST else SHORT)
    euler(P, C, h)
    k = P.history[width:]
    if not rates_at(P, L, C, t + h, new, k):
        return TRIAL * h
    d2, n = d1, C.half
    for i in range(w - n):
        k[i] = k[width - w + n + i] - P.history[width - w + n + i]
    d2 = max(d2, distance(P, k, y[n:], scales[n:], w - n) / h)
    later = (TRIAL / d2) ** (0.25 if C.quick else 0.125) if d2 > STRAIGHT else max(SHORT, 1e-3 * h)
    return min(room, max(P.settings.h_min, min(100.0 * h, later)))


@native
def euler(P: Problem, C: Control, h: float) -> float:
    """The new state by Euler's formula; returns h."""
    w = C.size
    C.h = h
    combine(P, C, 0, w, h / P.tableau[3], P.history[OLD * w :], P.history[NEXT_STATE * w :])
    return h


@native
def change(P: Problem, C: Control) -> float:
    """Distance of the new state from the old."""
    w = C.size
    y, new, e = P.history[OLD * w :], P.history[NEXT_STATE * w :], P.trial[0:]
    for i in range(w):
        e[i] = new[i] - y[i]
    return distance(P, e, y, P.history[SCALES * w :], w)


@native
def local_error(P: Problem, C: Control, h: float) -> float:
    """Error of a step over ERROR: the fifth order's, tamed by the third's but behind an event."""
    w = C.size
    y, zero, e = P.history[NEXT_STATE * w :], P.history[BETWEEN * w :], P.trial[0:]
    scales = P.history[SCALES * w :]
    top = 0.0
    for i in range(w):
        zero[i] = 0.0
        top = maximum(top, abs(y[i]))
    if not top < LARGE:  # no error is large against it
        return HUGE
    combine(P, C, ERROR3, w, h, zero, e)
    third = distance(P, e, y, scales, w)
    combine(P, C, ERROR5, w, h, zero, e)
    fifth = distance(P, e, y, scales, w)
    if not fifth <= 1.0 or P.count.steps % NOTED == 0:
        note_worst(P, C)
    C.third = third
    if not third < LARGE or not fifth < LARGE:
        return HUGE
    if fifth < NOTHING:  # whose square may be nothing
        return 0.0
    tamed = fifth * fifth / (fifth * fifth + 0.01 * third * third) ** 0.5
    return fifth if C.behind else tamed  # a force of t^p makes both of one order


@native
def quick_error(P: Problem, C: Control, h: float) -> float:
    """Error of a step of the formula of four stages against ERROR, from the rates at its end."""
    w, n = C.size, C.width
    K, y, scales = P.history, P.history[NEXT_STATE * w :], P.history[SCALES * w :]
    a, b, c, d, e = K[0:], K[n:], K[2 * n :], K[3 * n :], K[K_NEW * n :]
    top, of_u, of_q = 0.0, h / U_SCALE, h * h / Q_SCALE
    for i in range(n):
        u = of_u * abs(4.0 * e[i] - a[i] + 3.0 * (b[i] - c[i] - d[i]))
        q = of_q * abs(2.0 * b[i] - a[i] - c[i])
        P.trial[i], P.trial[n + i] = q, u
        of, against = scales[i] * max(1.0, abs(y[i])), scales[n + i] * max(1.0, abs(y[n + i]))
        # The larger of q/of and u/against by one division.
        top = maximum(top, maximum(q * against, u * of) / (of * against))
    error = top / P.settings.error
    if not error <= 1.0 or P.count.steps % NOTED == 0:
        note_worst(P, C)
    return error if error < LARGE else HUGE


@native
def smaller(C: Control, error: float) -> float:
    """The share of the step that its error allows."""
    return SAFETY * error ** (QUICK_POWER if C.quick else NOW_POWER)


@native
def choose_step(P: Problem, C: Control, error: float) -> None:
    """The next step from the errors of this and the last one."""
    factor = GROW
    if error > 0.0:
        last_power = QUICK_LAST_POWER if C.quick else LAST_POWER
        factor = min(GROW, smaller(C, error) * C.last_error**last_power)
    if C.cautious:
        factor = min(1.0, factor)
    C.cautious, C.last_error = False, max(error, LEAST_ERROR)
    cut_step(P, C, max(SHRINK, factor))


@native
def cut_step(P: Problem, C: Control, factor: float) -> None:
    """``factor`` times the step, but not below HMIN, unless a step of HMIN has failed."""
    h, least = C.h, P.settings.h_min
    if h * factor >= least:
        C.h = h * factor
    elif h > least * LONGER:
        C.h = least
    elif C.cautious:
        C.h = h * factor
