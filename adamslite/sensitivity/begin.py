"""A history of sensitivities at the start and behind events, from derivatives of their motion.

As the run's own history there (:mod:`adamslite.integrators.bdf.start`): with rates f_0, f_1, f_2 of
states and sensitivities now, at d and at 2 d on the parabola that is known so far,

    y'' = (4 f_1 - 3 f_0 - f_2)/(2 d),      y''' = (f_0 - 2 f_1 + f_2)/d^2
"""

from __future__ import annotations

from adamslite.integrators.accelerations import accelerations
from adamslite.integrators.contract import Problem
from adamslite.integrators.linalg.plan import Plan
from adamslite.integrators.motion_equations import vector_rates
from adamslite.native.translate import Reals, native, seldom
from adamslite.sensitivity.contract import Forward, Tangents
from adamslite.sensitivity.tangents import clear, rates_of, sensitive_accelerations, take_state

# Rows of derivatives: first, second, third, and rates ahead.
RATE, SECOND, THIRD, NEAR, FAR, ROWS = range(6)
# How far ahead, as a share of the step.
AHEAD = 0.1


@native
@seldom
def begin_history(P: Problem, L: Plan, D: Tangents, S: Forward, h: float, order: int) -> bool:
    """A history of the sensitivities, for a step of size ``h`` from the workspace's state."""
    w, t = S.width, P.W[0]
    d, origin = AHEAD * h, S.state[ROWS * w :]
    take_state(P)
    for i in range(P.sizes.n):
        origin[i], origin[P.sizes.n + i] = P.q[i], P.u[i]
    for k in range(P.sizes.ns):
        origin[2 * P.sizes.n + k] = P.z[P.sizes.m + P.sizes.nv + k]
    clear(S.state, ROWS * w)
    clear(S.start, S.start.size)
    known = rates_ahead(P, L, D, S, t, 0.0, RATE)
    if order > 1:
        known = known and rates_ahead(P, L, D, S, t, d, NEAR)
        curve(S.state, w, d)
        for number in range(D.count):
            curve(S.start[number * ROWS * w :], w, d)
        known = known and rates_ahead(P, L, D, S, t, d, NEAR)
        known = known and rates_ahead(P, L, D, S, t, 2.0 * d, FAR)
    for number in range(D.count):
        H, rows = S.history[number * S.room :], S.start[number * ROWS * w :]
        if order > 1:
            higher(rows, w, d)
        differences_of(H, rows, w, h, S.room)
    S.h, S.order = h, order
    return known


@native
def curve(rows: Reals, w: int, d: float) -> None:
    """The second derivative from rates ahead on a straight line."""
    for i in range(w):
        rows[SECOND * w + i] = (rows[NEAR * w + i] - rows[RATE * w + i]) / d


@native
def higher(rows: Reals, w: int, d: float) -> None:
    """The second and the third derivative."""
    for i in range(w):
        f0, f1, f2 = rows[i], rows[NEAR * w + i], rows[FAR * w + i]
        rows[SECOND * w + i] = (4.0 * f1 - 3.0 * f0 - f2) / (2.0 * d)
        rows[THIRD * w + i] = (f0 - 2.0 * f1 + f2) / (d * d)


@native
def differences_of(H: Reals, rows: Reals, w: int, h: float, size: int) -> None:
    """Derivatives become differences on steps of h, behind the values in place."""
    for i in range(w, size):
        H[i] = 0.0
    for i in range(w):
        rate, second = h * rows[i], h * h * rows[SECOND * w + i]
        third = h * h * h * rows[THIRD * w + i]
        H[w + i] = rate - second / 2.0 + third / 6.0
        H[2 * w + i], H[3 * w + i] = second - third, third


@native
def rates_ahead(
    P: Problem, L: Plan, D: Tangents, S: Forward, t: float, ahead: float, row: int
) -> bool:
    """Rates of the state and of all sensitivities on their parabolas, into a row; False without
    accelerations.
    """
    n, ns, w, X = P.sizes.n, P.sizes.ns, S.width, S.state
    first, origin, x = P.sizes.m + P.sizes.nv, S.state[ROWS * w :], S.state[(ROWS + 1) * w :]
    for i in range(w):
        x[i] = origin[i] + ahead * (X[i] + 0.5 * ahead * X[SECOND * w + i])
    for k in range(ns):
        P.z[first + k] = x[2 * n + k]
    if not accelerations(P, L, t + ahead, x, x[n:], P.a, P.z, P.rd):
        return False
    rates = X[row * w :]
    vector_rates(P, x, x[n:], rates)
    for i in range(n):
        rates[n + i] = P.a[i]
    for k in range(ns):
        rates[2 * n + k] = P.rd[k]
    for number in range(D.count):
        H, Y, y = S.history[number * S.room :], S.start[number * ROWS * w :], S.y[0:]
        for i in range(w):
            y[i] = H[i] + ahead * (Y[i] + 0.5 * ahead * Y[SECOND * w + i])
        sensitive_accelerations(P, L, D, S, number, y, 0.0)
        rates_of(P, S, y, Y[row * w :])
    return True
