"""A history behind an event: of higher order than 1, from derivatives of the motion that begins.

y' = f(t, y) is evaluated on the new branches a little ahead, at d and 2 d on the parabola that is
known so far; with f_0, f_1, f_2

    y'' = (4 f_1 - 3 f_0 - f_2)/(2 d),      y''' = (f_0 - 2 f_1 + f_2)/d^2

Differences of the cubic with these derivatives, on steps of h, are the history:

    D_1 = h y' - h^2 y''/2 + h^3 y'''/6,    D_2 = h^2 y'' - h^3 y''',    D_3 = h^3 y'''

Its order is the one that promises the longest step.  What a step then errs by, D_(k+1)/(k + 1), is
known for k = 1 and 2.  y'''' is taken to be as much larger than y''' as that is than y'', or than
y'' as y''' is than y', whichever is more: of a vibration that is at its middle y''' may be nothing.

Reference: Gear, ACM Trans. Math. Softw. 6 (1980) 3, "Runge-Kutta starters for multistep methods"
(why: a start of order 1 costs some twenty steps).
"""

from __future__ import annotations

from adamslite.integrators.accelerations import accelerations
from adamslite.integrators.bdf.control import Control
from adamslite.integrators.bdf.order import difference
from adamslite.integrators.bdf.state import start_values
from adamslite.integrators.contract import Problem
from adamslite.integrators.events.stops import longest_step
from adamslite.integrators.implicit.step_size import LOOK_AHEAD, first_step, jerk
from adamslite.integrators.linalg.plan import Plan
from adamslite.integrators.motion_equations import vector_rates
from adamslite.native.translate import native

# Rows of the history while derivatives are found.
RATE, SECOND, THIRD, NEAR, FAR = 1, 2, 3, 4, 5
# The step of order 1 in multiples of (ERROR/|a'|)^(1/2).
CAREFUL = 0.8
# How far ahead derivatives are taken, as a share of the step of order 1.
AHEAD = 0.2
# A first step is at most this many times as long as what accelerations alone suggest.
BOLD = 10.0
# A first step aims at ERROR over this.
GENTLE = 10.0


@native
def start_history(P: Problem, L: Plan, C: Control) -> None:
    """Order, step and history at the accepted state (q, u, ra, rz, rd)."""
    guess = first_step(P)
    change = jerk(P, L, C.t, LOOK_AHEAD * guess)
    C.order, C.h = 1, guess
    if change > 0.0:
        C.h = min(guess, CAREFUL * (P.settings.error / change) ** 0.5)
    start_values(P, C)
    free = P.settings.fixed_step == 0.0 and P.settings.h_init == 0.0
    if free and C.highest > 1 and derivatives(P, L, C, AHEAD * C.h):
        choose_start(P, C, BOLD * guess)
        write_differences(P, C)
    C.equal = 0


@native
def derivatives(P: Problem, L: Plan, C: Control, d: float) -> bool:
    """y', y'' and y''' into their rows; False, and a history of order 1, without accelerations."""
    w, D, first = C.width, P.history, P.sizes.m + P.sizes.nv
    for i in range(w):
        D[RATE * w + i] /= C.h
    known = rates_ahead(P, L, C, d, NEAR)
    for i in range(w):
        D[SECOND * w + i] = (D[NEAR * w + i] - D[RATE * w + i]) / d
    known = known and rates_ahead(P, L, C, d, NEAR) and rates_ahead(P, L, C, 2.0 * d, FAR)
    for i in range(w):
        f0, f1, f2 = D[RATE * w + i], D[NEAR * w + i], D[FAR * w + i]
        D[SECOND * w + i] = (4.0 * f1 - 3.0 * f0 - f2) / (2.0 * d)
        D[THIRD * w + i] = (f0 - 2.0 * f1 + f2) / (d * d)
    for i in range(P.sizes.n):
        P.a[i] = P.ra[i]
    for k in range(first + P.sizes.ns):
        P.z[k] = P.rz[k]
    for k in range(P.sizes.ns):
        P.rd[k] = D[RATE * w + 2 * P.sizes.n + k]
    if not known:
        start_values(P, C)
    return known


@native
def rates_ahead(P: Problem, L: Plan, C: Control, ahead: float, row: int) -> bool:
    """y' on the parabola of the derivatives found so far, into a row; False without any."""
    n, ns, w, D, y = P.sizes.n, P.sizes.ns, C.width, P.history, P.trial[0:]
    first = P.sizes.m + P.sizes.nv
    for i in range(w):
        y[i] = D[i] + ahead * (D[RATE * w + i] + 0.5 * ahead * D[SECOND * w + i])
    for k in range(ns):
        P.z[first + k] = y[2 * n + k]
    if not accelerations(P, L, C.t + ahead, y, y[n:], P.a, P.z, P.rd):
        return False
    rates = D[row * w :]
    vector_rates(P, y, y[n:], rates)
    for i in range(n):
        rates[n + i] = P.a[i]
    for k in range(ns):
        rates[2 * n + k] = P.rd[k]
    return True


@native
def choose_start(P: Problem, C: Control, longest: float) -> None:
    """The order from 1 to 3 with the longest step, from the derivatives in their rows."""
    top, error = min(longest, longest_step(P)), P.settings.error
    second, third = difference(P, C, SECOND), difference(P, C, THIRD)
    first = difference(P, C, RATE)
    fourth = third * third / second if second > 0.0 else 0.0
    if first > 0.0:
        fourth = max(fourth, second * third / first)
    h = top
    if third > 0.0:
        h = min(top, (3.0 * error / (GENTLE * third)) ** (1.0 / 3.0))
    if h > C.h:
        C.order, C.h = 2, h
    h = top
    if fourth > 0.0:
        h = min(top, (4.0 * error / (GENTLE * fourth)) ** 0.25)
    if C.highest > 2 and h > C.h:
        C.order, C.h = 3, h


@native
def write_differences(P: Problem, C: Control) -> None:
    """The derivatives in their rows become differences on steps of h."""
    w, h, D = C.width, C.h, P.history
    for i in range(w):
        rate, second = h * D[RATE * w + i], h * h * D[SECOND * w + i]
        third = h * h * h * D[THIRD * w + i]
        D[RATE * w + i] = rate - second / 2.0 + third / 6.0
        D[SECOND * w + i], D[THIRD * w + i] = second - third, third
        D[NEAR * w + i], D[FAR * w + i] = 0.0, 0.0
