"""The error test of the backward differences, and the order and size of the next step.

    error of order j  =  |D_{j+1}| / (j + 1),    step ratio  =  (SAFETY error/ERROR)^(-1/(j+1))

Reference: Shampine, Reichelt, SIAM J. Sci. Comput. 18 (1997) 1, section 2.
"""

from __future__ import annotations

from adamslite.integrators.bdf.control import Control
from adamslite.integrators.bdf.differences import MAX_ORDER
from adamslite.integrators.bdf.order_cap import suspect
from adamslite.integrators.bdf.state import resize, tests_velocities
from adamslite.integrators.contract import Problem
from adamslite.integrators.events.stops import longest_step
from adamslite.integrators.implicit.tolerance import weighted
from adamslite.integrators.stepping.step_size import cut
from adamslite.native.translate import native

# The next step aims at an estimated error below ERROR by these factors (at a higher order: more
# caution).
SAFETY, SAFETY_UP = 3.0, 4.5
# A step grows only when it pays for a new matrix, and never by more than this at once.
LEAST_GROWTH, MOST_GROWTH = 1.2, 10.0
# Steps that double again and again amplify the noise of higher orders.
GROWING_ORDER = 3.0


@native
def difference(P: Problem, row: int, w: int, si2: bool) -> float:
    """Largest |D_row|, weighted; what is reported of the tested error stays."""
    where = P.report.where
    size = weighted(P.history, row, w, P.sizes.n, P.sizes.ns, P.history, si2, P.report)
    P.report.where = where
    return size


@native
def local_error(P: Problem, w: int) -> float:
    """Estimated error over ERROR; leaves d in psi's place and y in the prediction's."""
    C = Control(P.control)
    n, ns = P.sizes.n, P.sizes.ns
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
    size = weighted(d, 0, 0, n, ns, y, tests_velocities(P), P.report)
    return size / ((C.order + 1.0) * P.settings.error)


@native
def adapt_order(P: Problem, w: int, norm: float) -> None:
    """Order and size of the next step."""
    C = Control(P.control)
    if P.settings.fixed_step > 0.0:
        approach_fixed_step(P, w)
    elif C.order > C.highest:
        drop_order(P, w)
    elif C.equal > C.order:
        choose_order(P, w, norm)


@native
def most_order(P: Problem) -> int:
    """KMAX, as far as there are formulas."""
    return min(MAX_ORDER, P.settings.k_max)


@native
def drop_order(P: Problem, w: int) -> None:
    """Down to the highest order allowed, with the step that suits it."""
    C = Control(P.control)
    si2 = tests_velocities(P)
    k = C.highest
    size = difference(P, k + 1, w, si2)
    C.order = C.highest
    norm = size / ((k + 1) * P.settings.error)
    resize(P, w, min(1.0, max(SAFETY * norm, 1e-10) ** (-1.0 / (k + 1))))


@native
def approach_fixed_step(P: Problem, w: int) -> None:
    """Raise the order to GROWING_ORDER, the step to FIXED_STEP, then the order to KMAX; each only
    after as many equal steps as the formula looks back.
    """
    C = Control(P.control)
    growth = min(2.0, P.settings.fixed_step / C.h)
    if C.equal <= C.order:
        return
    grown = growth <= 1.0000001
    if C.order < most_order(P) and (C.order < GROWING_ORDER or grown):
        C.order += 1
        C.equal = 0
    elif not grown:
        resize(P, w, growth)


@native
def choose_order(P: Problem, w: int, norm: float) -> None:
    """The order and the step ratio that promise the largest next step.

    When HMAX caps the step, the present order is kept unless a higher one is more accurate, because
    "largest step" would always pick the lowest.
    """
    C = Control(P.control)
    k, si2, tol, room = C.order, tests_velocities(P), P.settings.error, longest_step(P) / C.h
    same = max(SAFETY * norm, 1e-10) ** (-1.0 / (k + 1))
    best, factor = k, same
    if k > 1:
        low = difference(P, k, w, si2)
        suspect(C.cap, k, low, norm * (k + 1) * tol, tol, C.equal)
        f = max(SAFETY * low / (k * tol), 1e-10) ** (-1.0 / k)
        if f > factor and min(f, same) < room:
            best, factor = k - 1, f
    if k < C.highest:
        high = difference(P, k + 2, w, si2) / ((k + 2) * tol)
        f = max(SAFETY_UP * high, 1e-10) ** (-1.0 / (k + 2))
        if f > factor or (min(f, factor) >= room and high < norm):
            best, factor = k + 1, f
    factor = min(factor, min(room, MOST_GROWTH))
    if best != k or factor >= LEAST_GROWTH or factor < 0.9:
        C.order = best
        resize(P, w, cut(P, C, factor))
