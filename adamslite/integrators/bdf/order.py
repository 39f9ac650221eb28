"""The error test of the backward differences, and the order and size of the next step.

    error of order j  =  |D_{j+1}| / (j + 1),    step ratio  =  (SAFETY error/ERROR)^(-1/(j+1))

Reference: Shampine, Reichelt, SIAM J. Sci. Comput. 18 (1997) 1, section 2.
"""

from __future__ import annotations

from adamslite.integrators.bdf.control import Control
from adamslite.integrators.bdf.history import MAX_ORDER
from adamslite.integrators.bdf.order_cap import CAPPED, highest_order, suspect
from adamslite.integrators.bdf.state import resize, tests_velocities
from adamslite.integrators.contract import Problem
from adamslite.integrators.events.stops import longest_step
from adamslite.integrators.implicit.step_size import step_ratio
from adamslite.integrators.implicit.tolerance import beyond_round_off, most_wrong, weighted
from adamslite.integrators.stepping.outcome import LONGER, cut
from adamslite.native.translate import native

# The next step aims at an estimated error below ERROR by these factors (at a higher order: more
# caution).
SAFETY, SAFETY_UP = 3.0, 4.5
# ... and behind an event, while the order still rises, by so much more: what such a step errs by
# stays until the next event.
CAUTIOUS = 1.5
# Past values on a cubic have no D_4.  What it will be is this many times the first d behind them:
# order 3 makes 11/6 d/h up for h^3 y''''/6, the change of y' that the cubic does not have.
CUBIC_PAST = 11.0
# A step changes only when that pays for a new matrix, and never grows by more than this at once.
LEAST_GROWTH, LEAST_SHRINK, MOST_GROWTH = 1.2, 0.9, 10.0
# Steps that double again and again amplify the noise of higher orders.
GROWING_ORDER = 3.0


@native
def difference(P: Problem, C: Control, row: int) -> float:
    """Largest |D_row|, weighted."""
    D, n, ns = P.history, P.sizes.n, P.sizes.ns
    return weighted(D[row * C.width :], D, n, ns, tests_velocities(P))


@native
def local_error(P: Problem, C: Control) -> float:
    """Estimated error over ERROR; leaves d in psi's place and y in the prediction's."""
    n, ns, w = P.sizes.n, P.sizes.ns, C.width
    first = P.sizes.m + P.sizes.nv
    y, d, e = P.trial[0:], P.trial[w:], P.trial[2 * w + n :]
    for i in range(n):
        d[i], d[n + i] = e[i], P.u[i] - y[n + i]
        y[i], y[n + i] = P.q[i], P.u[i]
    for i in range(2 * n, w):
        d[i] = P.z[first + i - 2 * n] - y[i]
        y[i] = P.z[first + i - 2 * n]
    cap = C.cap
    cap.tries += 1.0
    tested = tests_velocities(P)
    size = weighted(d, y, n, ns, tested)
    P.report.where = most_wrong(size, d, y, n, ns, tested)
    share = CUBIC_PAST if C.order == 3 and C.h_last == 0.0 else 1.0
    norm = share * size / ((C.order + 1.0) * P.settings.error)
    if norm > 1.0:
        norm = beyond_round_off(P, norm, 0.0, P.q, C.cu)
    P.report.error = norm
    return norm


@native
def choose_order(P: Problem, C: Control, norm: float) -> None:
    """Order and size of the next step; a history of unequal steps says nothing about orders."""
    if P.settings.fixed_step > 0.0:
        approach_fixed_step(P, C)
    elif C.order > C.highest:
        drop_order(P, C)
    elif C.equal > C.order:
        take_longest_step(P, C, norm)


@native
def watch_order(P: Problem, C: Control) -> None:
    """After an accepted step: the highest order from now on."""
    cap = C.cap
    cap.travelled += C.h
    C.highest = highest_order(cap, C.highest, most_order(P), P.settings.h_max)
    P.report.order_capped = cap.state == CAPPED


@native
def most_order(P: Problem) -> int:
    """KMAX, as far as there are formulas."""
    return min(MAX_ORDER, P.settings.k_max)


@native
def drop_order(P: Problem, C: Control) -> None:
    """Down to the highest order allowed, with the step that suits it."""
    k = C.highest
    norm = difference(P, C, k + 1) / ((k + 1) * P.settings.error)
    C.order = k
    resize(P, C, min(1.0, step_ratio(SAFETY * norm, k)))


@native
def approach_fixed_step(P: Problem, C: Control) -> None:
    """Raise the order to GROWING_ORDER, the step to FIXED_STEP, then the order to KMAX; each only
    after as many equal steps as the formula looks back.
    """
    growth = min(2.0, P.settings.fixed_step / C.h)
    if C.equal <= C.order:
        return
    grown = growth <= LONGER
    if C.order < most_order(P) and (C.order < GROWING_ORDER or grown):
        C.order += 1
        C.equal = 0
    elif not grown:
        resize(P, C, growth)


@native
def take_longest_step(P: Problem, C: Control, norm: float) -> None:
    """The order and the step ratio that promise the largest next step.

    When HMAX caps the step, the present order is kept unless a higher one is more accurate, because
    "largest step" would always pick the lowest.
    """
    k, tol, room = C.order, P.settings.error, longest_step(P) / C.h
    same = step_ratio(SAFETY * C.caution * norm, k)
    best, factor = k, same
    if k > 1:
        low = difference(P, C, k)
        high = norm * (k + 1) * tol
        if suspect(C.cap, k, low, high, tol, C.equal):
            P.report.vibrating, P.report.vibration = P.report.where, high / (low * C.h)
        f = step_ratio(SAFETY * C.caution * low / (k * tol), k - 1)
        if f > factor and min(f, same) < room:
            best, factor = k - 1, f
    if k < C.highest:
        high = difference(P, C, k + 2) / ((k + 2) * tol)
        f = step_ratio(SAFETY_UP * C.caution * high, k + 1)
        if f > factor or (min(f, factor) >= room and high < norm):
            best, factor = k + 1, f
    if best <= k:
        C.caution = 1.0
    factor = min(factor, min(room, MOST_GROWTH))
    if best != k or factor >= LEAST_GROWTH or factor < LEAST_SHRINK:
        C.order = best
        resize(P, C, cut(P, C, factor))
