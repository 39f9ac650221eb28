"""HHT and NEWMARK: second-order implicit formulas on accelerations, index 3, variable step.

    q+ = q + h u + h^2 ((1/2 - beta) b + beta b+),      u+ = u + h ((1 - gamma) b + gamma b+)
    b+ = (1 + alpha) a+ - alpha a                       F(t+, q+, u+, a+, lam+) = 0,  g(t+, q+) = 0

With a constant mass this is M b+ + (1 + alpha) R+ - alpha R = 0, R all other terms; written with
both accelerations it keeps order 2 when the mass turns with the parts, and lam+ and a+ belong to
the end of the step.  HHT: beta = (1 - alpha)^2/4, gamma = 1/2 - alpha; NEWMARK: alpha = 0.

For parts the rule of q gives the rotation vector of the step, with h^3/12 w' x w because the axis
turns; the unknown is its Cayley vector.  u and a are angular velocity and acceleration in ground
axes.  States of DIFF follow the rule of u.  b belongs to the time t + alpha h and is moved along
when h changes.

Newton works on (q, lam, V, s) with u' = cu = gamma/(beta h), a' = ca = 1/(beta h^2 (1 + alpha)).
Local error of q: (beta - 1/6) h^2 |b+ - b|, against ERROR max(1, |q|).  That of u is of higher
order in HHT and not tested; a NEWMARK with gamma other than 1/2 is of order 1, and its local error
(gamma - 1/2) h |b+ - b| of u is held below ERROR max(1, |u|).

When HINIT, HMAX and HMIN are equal every step has that size and no error is tested; only a step
that the corrector cannot do is divided.

References: Hilber, Hughes, Taylor, Earthq. Eng. Struct. Dyn. 5 (1977) 283; Arnold, Bruels,
Multibody Syst. Dyn. 18 (2007) 185; Negrut, Rampalli, Ottarsson, Sajdak, J. Comput. Nonlinear Dyn.
2 (2007) 73 (index 3, error test); Bruels, Cardona, Arnold, Mech. Mach. Theory 48 (2012) 121
(rotations).
"""

from __future__ import annotations

from adamslite.integrators.accelerations import (
    accelerations,
    mass_signature,
    mass_vanishes,
    put_state,
)
from adamslite.integrators.audit.balance import audit
from adamslite.integrators.contract import (
    BROKEN_START,
    CHATTERING,
    DONE,
    INDEX3,
    INTERRUPTED,
    NEWTON_FAILED,
    NOT_FINITE,
    SINGULAR_MASS,
    STEP_TOO_SMALL,
    Problem,
)
from adamslite.integrators.events.events import happened, start_events
from adamslite.integrators.events.guards import crawls, hold_watch, keep_margins, let_go
from adamslite.integrators.events.search import ends_there, shorter, starts_there
from adamslite.integrators.events.stops import horizon, longest_step, step_limit
from adamslite.integrators.failure_notes import note_trouble
from adamslite.integrators.hht.control import Control
from adamslite.integrators.hht.events import change_at_start, locate_in_step, step_on
from adamslite.integrators.hht.newmark_formula import (
    back_to_accepted,
    between,
    choose_coefficients,
    first_order_share,
    keep_second_order,
    move_all,
    position_error,
    predict_step,
    second_order_matrix,
    start_from_here,
)
from adamslite.integrators.implicit.control import keep_algebraic
from adamslite.integrators.implicit.failures import wildest
from adamslite.integrators.implicit.step_size import first_step, retry_factor
from adamslite.integrators.implicit.tolerance import asked
from adamslite.integrators.linalg.blocks import solve
from adamslite.integrators.linalg.plan import Plan
from adamslite.integrators.motion_equations import put_time, residual, track, vector_rates
from adamslite.integrators.newton import renews
from adamslite.integrators.records import note_violation, write_record
from adamslite.integrators.stepping.control import RUNNING
from adamslite.integrators.stepping.outcome import SINGULAR_RESOLUTION, corrector_failed
from adamslite.integrators.stepping.output import record_start
from adamslite.integrators.stepping.step_size import cut, too_small
from adamslite.native.translate import native

# Newton stops when the estimated remaining error is this share of ERROR; after a single iteration,
# whose rate is not known, only when the increment is this share of that.
CORRECTOR_SHARE, QUIET = 0.001, 0.01
# A matrix kept from an earlier step is discarded when increments shrink by less than this, and
# renewed for the next step when this one took more iterations.
SLOW, MOST_ITERATIONS = 0.3, 4
# ... or after this many steps, or when the step has changed by this share.
KEEP_STEPS, KEEP_RATIO = 50.0, 1e-3
# Increments of full Newton that grow this much do not converge.
DIVERGING = 2.0
# The next step aims at an estimated error below ERROR by this factor.
SAFETY = 2.0
LEAST_GROWTH, MOST_GROWTH = 1.25, 2.0
# Share of a fixed step below which it is not divided any more.
LEAST_SHARE = 1e-9


@native
def hht(P: Problem, L: Plan) -> int:
    """Integrate to the end time; returns an outcome."""
    C = Control(P.control)
    outcome = start_hht(P, L)
    while outcome == RUNNING:
        outcome = attempt(P, L)
    back_to_accepted(P)
    P.report.t = C.t
    return outcome


@native
def start_hht(P: Problem, L: Plan) -> int:
    """Accelerations at the start, the first record, attitudes counted from here."""
    C = Control(P.control)
    D, s, n, ns = P.history, P.settings, P.sizes.n, P.sizes.ns
    C[:] = 0
    C.t = s.t
    if s.h_init > 0.0 and s.h_init == s.h_max and s.h_init == s.h_min:
        C.fixed = s.h_init
    start_events(P, C.fixed == 0.0, first_order_share(P) > 0.0)
    good = accelerations(P, L, s.t, P.q, P.u, P.a, P.z, P.rd)
    hold_watch(P)
    C.h = first_step(P, 0)
    P.report.rough_steps = 0
    for i in range(n):
        P.ra[i], D[2 * n + i], D[3 * n + i] = P.a[i], P.a[i], P.a[i]
    for i in range(ns):
        for row in range(1, 4):
            D[4 * n + row * ns + i] = P.rd[i]
    keep_algebraic(P)
    if good:
        if P.sizes.implicit_mass:
            C.signature = mass_signature(P, L, P.pivot0)
        record_start(P, C)
        track(P)
    start_from_here(P)
    return RUNNING if good else BROKEN_START


@native
def attempt(P: Problem, L: Plan) -> int:
    """One try of a step: RUNNING to continue, whether accepted or not, else the outcome."""
    C = Control(P.control)
    if C.t >= P.settings.t_end:
        return DONE
    if P.settings.stop:
        return INTERRUPTED
    choose_coefficients(P)
    if C.h < LEAST_SHARE * C.fixed or (C.fixed == 0.0 and too_small(P, C)) or crawls(P, C.h):
        return why_too_small(P, L)
    P.report.t, P.report.h, P.report.order = C.t, C.h, 2
    if not correct_step(P, L):
        return after_no_convergence(P)
    norm = position_error(P)
    P.report.error = norm
    if not norm < 1e12:
        return NOT_FINITE
    if norm > 1.0 and C.fixed == 0.0:
        P.count.rejected += 1
        C.equal, C.norm = 0, norm
        C.h *= cut(P, C, max(0.2, (SAFETY * norm) ** (-1.0 / 3.0)))
        return RUNNING
    if P.sizes.implicit_mass:
        if mass_signature(P, L, P.x) != C.signature:
            C.h *= 0.25
            return RUNNING if C.h > SINGULAR_RESOLUTION * P.settings.h_max else SINGULAR_MASS
    return finish_attempt(P, L, norm)


@native
def finish_attempt(P: Problem, L: Plan, norm: float) -> int:
    """The step has passed its tests: accept it, or take it again to end at the first crossing."""
    C = Control(P.control)
    if P.sizes.watched + P.sizes.zones > 0 and C.fixed == 0.0:
        locate_in_step(P, L)
        if not ends_there(P):
            if starts_there(P):
                return change_at_start(P, L)
            C.h, C.equal = shorter(P), 0
            return RUNNING
    return accept_attempt(P, L, norm)


@native
def correct_step(P: Problem, L: Plan) -> bool:
    """Newton from the prediction; True when converged.

    A kept matrix that converges slowly is no longer believed: back to the prediction, or on from
    here when the matrix was made in this step, with a new matrix at every iteration.
    """
    C = Control(P.control)
    tolerance, last = CORRECTOR_SHARE * asked(P, C.fixed), 0.0
    if first_order_share(P) > 0.0:
        tolerance *= min(1.0, C.h)  # Velocities are tested: they are off by that of positions / h.
    full, tries = False, 0
    C.fresh = False
    put_time(P, C.t + C.h)
    predict_step(P)
    while tries < P.settings.max_it:
        if full or not matrix_fits(C) or renews(P, tries, C.age < KEEP_STEPS):
            C.factored, C.fresh, C.age = C.h, True, 0
            if not second_order_matrix(P, L):
                C.factored = 0.0
                return False
        residual(P, INDEX3, P.F)
        solve(L, P.LV, P.pivots, P.F, P.x, P.work)
        size = move_all(P, P.F)
        P.count.newton += 1
        tries += 1
        P.report.iteration = tries
        rate = min(size / last, 0.999) if tries > 1 else 0.5
        left = size * rate / (1.0 - rate) if tries > 1 else size / QUIET
        if left <= tolerance:
            if tries > MOST_ITERATIONS:
                C.factored = 0.0
            return True
        if not size < 1e12 or (tries > 1 and size > SLOW * last):
            if full and not size < DIVERGING * last:
                return False
            if not full and (not C.fresh or not size < last):
                predict_step(P)
                tries = 0
            full = True
        last = size
    return False


@native
def matrix_fits(C: Control) -> bool:
    """Whether there is a factored matrix for this step."""
    return C.factored != 0.0 and abs(C.h / C.factored - 1.0) <= KEEP_RATIO


@native
def after_no_convergence(P: Problem) -> int:
    """A shorter step with a new matrix; near a singular posture also longer ones."""
    C = Control(P.control)
    P.count.failures += 1
    C.factored, C.equal = 0.0, 0
    if C.fixed > 0.0:
        P.report.divided += 1
    if let_go(P):
        return RUNNING
    C.retries += 1
    C.blamed = wildest(P)
    note_trouble(P, INDEX3, P.report.iteration)
    C.h *= cut(P, C, retry_factor(C)) if C.fixed == 0.0 else retry_factor(C)
    return RUNNING


@native
def accept_attempt(P: Problem, L: Plan, norm: float) -> int:
    """Move on, write records, choose the next step."""
    C = Control(P.control)
    h = C.h
    P.count.steps += 1
    P.report.spent += norm
    t = C.t + h
    limit = step_limit(P, C.row) if C.fixed == 0.0 else horizon(P)
    if t + 1e-7 * h > limit:
        t = limit
    keep_second_order(P)
    P.report.rough_steps += 1 if C.rough else 0
    note_violation(P, t)
    audit(P, L, t)
    C.t, C.h_last, C.retries, C.norm = t, h, 0, 0.0
    C.age += 1
    good = record_between(P, L, t, h)
    track(P)
    start_from_here(P)
    if not good:
        return SINGULAR_MASS
    if happened(P, t):
        outcome = step_on(P, L)
        C.h = C.fixed if C.fixed > 0.0 else C.h
        return outcome
    keep_margins(P)
    if C.fixed > 0.0:
        C.h = min(2.0 * h, C.fixed)
    else:
        factor = max(SAFETY * norm, 1e-10) ** (-1.0 / 3.0)
        C.equal += 1
        room = min(MOST_GROWTH, longest_step(P) / h)
        if (C.equal > 1 and min(factor, room) > LEAST_GROWTH) or factor < 0.9:
            C.h *= cut(P, C, min(factor, room))
            C.equal = 0
    return RUNNING


@native
def record_between(P: Problem, L: Plan, t: float, h: float) -> bool:
    """Write every output time of the accepted step; False when accelerations are not determined.

    Positions and states are interpolated by cubics, velocities are the derivatives of those;
    accelerations, multipliers and variables are solved for.
    """
    C = Control(P.control)
    n, ns, first = P.sizes.n, P.sizes.ns, P.sizes.m + P.sizes.nv
    row, good = C.row, True
    if row >= P.times.size or P.times[row] > t + 1e-9 * h:
        return True
    end, y = P.trial[0:], P.trial[2 * n + ns :]
    for k in range(ns):
        end[2 * n + k] = P.z[first + k]
    vector_rates(P, P.q, P.u, end[n:])
    while good and row < P.times.size and P.times[row] <= t + 1e-9 * h:
        between(P, h, min(1.0, 1.0 + (P.times[row] - t) / h), end, y)
        good = accelerations(P, L, P.times[row], y, y[n:], P.a, P.z, P.rd)
        if good:
            write_record(P, row)
            row += 1
    C.row = row
    for k in range(ns):
        P.rd[k] = P.history[4 * n + ns + k]
        P.z[first + k] = end[2 * n + k]
    for k in range(first):
        P.z[k] = P.rz[k]
    put_state(P, t, P.q, P.u, P.ra, P.z, P.rd)
    return good


@native
def why_too_small(P: Problem, L: Plan) -> int:
    """Why the step became too small: a vanishing pivot of the acceleration matrix, or something
    else.
    """
    C = Control(P.control)
    back_to_accepted(P)
    if mass_vanishes(P, L, C.signature):
        return SINGULAR_MASS
    if C.retries > 0:
        P.report.where = C.blamed
    if P.search.freed > 0:
        return CHATTERING
    return NEWTON_FAILED if corrector_failed(C) else STEP_TOO_SMALL
