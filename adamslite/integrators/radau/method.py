"""RADAU: the three-stage Radau IIA formula of order 5 on the stabilised equations, variable step.

    q_i = q_0 + h sum_j a_ij q'_j,   u_i = u_0 + h sum_j a_ij u'_j,   s_i = s_0 + h sum_j a_ij s'_j
    u_i = T(q_i) q'_i + W G^T mu_i,  F(t_i, q_i, u_i, u'_i, lam_i, V_i, s_i, s'_i) = 0
    g(t_i, q_i) = 0,                 G u_i + g_t = 0                      at t_i = t_0 + c_i h

with the last stage as result: stiffly accurate, so that it meets the constraints, and strongly
damped.  Between, q, u and s follow the cubic through start and stages; accelerations, multipliers
and variables are solved for at the output times.

Error: :mod:`adamslite.integrators.radau.error`.  Steps after Gustafsson.

q of a part is the Cayley vector counted from the attitude at the start of the step.
References: Hairer, Wanner, Solving ODE II, 1996, sections IV.8 (iteration, error, steps) and VII.4
(stabilised form); Gustafsson, ACM Trans. Math. Softw. 20 (1994) 496.
"""

from __future__ import annotations

from adamslite.integrators.accelerations import accelerations, put_state
from adamslite.integrators.audit.balance import audit
from adamslite.integrators.contract import BROKEN_START, FULL, NOT_FINITE, SINGULAR_MASS, Problem
from adamslite.integrators.events.events import happened, start_events
from adamslite.integrators.events.guards import crawls, hold_watch, keep_margins, let_go
from adamslite.integrators.events.stops import horizon
from adamslite.integrators.failure_notes import note_trouble, wildest
from adamslite.integrators.implicit.formulation import equations_kept
from adamslite.integrators.implicit.step_size import CUTS, first_step, retry_factor
from adamslite.integrators.linalg.plan import Plan
from adamslite.integrators.motion_equations import track
from adamslite.integrators.radau.control import ORIGIN, Control
from adamslite.integrators.radau.corrector import correct
from adamslite.integrators.radau.error import local_error
from adamslite.integrators.radau.events import (
    end_at_crossing,
    falls_short,
    is_at_crossing,
    pass_on,
    passes_crossing,
    switch_at_start,
    touch_gently,
)
from adamslite.integrators.radau.stages import keep_stages, put_stage
from adamslite.integrators.radau.state import predict, put_end, record, restore_state
from adamslite.integrators.radau.step_size import choose_step, limit_step, step_factor
from adamslite.integrators.records import note_violation
from adamslite.integrators.step_back import before_trouble, make_undoable
from adamslite.integrators.stepping.control import NOBODY, RUNNING
from adamslite.integrators.stepping.outcome import (
    ALMOST,
    OVERFLOW,
    count_from_here,
    cut,
    end_of_run,
    end_of_step,
    goes_on,
    is_cut_short,
    keep_solution,
    near_singularity,
    note_signature,
    note_try,
    passed_singularity,
    too_small,
    why_stuck,
)
from adamslite.integrators.stepping.output import is_due, record_start
from adamslite.native.translate import native, rare, seldom

ORDER = 5


@native
def radau(P: Problem, L: Plan) -> int:
    """Integrate to the end time; returns an outcome."""
    C = Control(P.control)
    outcome = RUNNING
    if not P.settings.begun:
        P.settings.begun = True
        outcome = begin(P, L, C)
    while outcome == RUNNING:
        outcome = advance(P, L, C)
    if not goes_on(outcome):
        restore_state(P, C)
    P.report.t, P.block.row = C.t, C.row
    return outcome


@native
@rare
def begin(P: Problem, L: Plan, C: Control) -> int:
    """Accelerations at the start, the first record, attitudes counted from here."""
    Y, t = P.history, P.settings.t
    n, ns, first = P.sizes.n, P.sizes.ns, P.sizes.m + P.sizes.nv
    P.undoing[:] = 0
    P.report.floor = 0.0
    C[:] = 0
    for i in range(P.history.size):
        Y[i] = 0.0
    C.t, C.rate, C.cautious, C.blamed = t, 1.0, True, NOBODY
    start_events(P, True, True)
    good = accelerations(P, L, t, P.q, P.u, P.a, P.z, P.rd)
    hold_watch(P)
    C.h = first_step(P)
    if good:
        note_signature(P, L, C, P.pivot0)
        record_start(P, C)
        track(P)
        count_from_here(P)
    origin = Y[ORIGIN * (2 * n + ns) :]
    for i in range(n):
        origin[i], origin[n + i], Y[n + i] = P.q[i], P.u[i], P.u[i]
    for k in range(ns):
        origin[2 * n + k], Y[2 * n + k] = P.z[first + k], P.z[first + k]
    keep_solution(P)
    return RUNNING if good else BROKEN_START


@native
def advance(P: Problem, L: Plan, C: Control) -> int:
    """One try of a step: RUNNING to continue, whether accepted or not, else the outcome."""
    if C.open:
        return complete(P, L, C)
    outcome = end_of_run(P, C)
    if outcome != RUNNING:
        return outcome
    limit_step(P, C)
    if too_small(P, C) or crawls(P, C.h):
        if land_elsewhere(P, C):
            return RUNNING
        restore_state(P, C)
        return why_stuck(P, L, C)
    note_try(P, C, ORDER)
    predict(P, C)
    if not correct(P, L, C):
        return after_failure(P, C)
    error = local_error(P, L, C)
    if not error <= 1.0:
        return after_rejection(P, L, C, error)
    if ends_singular(P, L, C):
        return near_singularity(P, C)
    if passes_crossing(P, L, C):
        return end_at_crossing(P, L, C)
    if falls_short(P, C):
        return RUNNING
    return accept(P, L, C, error)


@native
@rare
def ends_singular(P: Problem, L: Plan, C: Control) -> bool:
    """Whether the acceleration matrix became singular within the step."""
    if not P.sizes.implicit_mass:
        return False
    put_end(P, C)
    return passed_singularity(P, L, C)


@native
def accept(P: Problem, L: Plan, C: Control, error: float) -> int:
    """Move on, write records, choose the next step."""
    h, row = C.h, C.row
    P.count.steps += 1
    # The formula is of order 5, its estimate of order 3.
    P.report.spent += error * (error * P.settings.error) ** 0.5
    make_undoable(P, C.t, h, C.retries == 0)
    t = end_of_step(P, C, horizon(P))
    if row < P.times.size and abs(P.times[row] - t) < ALMOST * h:
        t = P.times[row]
    put_end(P, C)
    keep_solution(P)
    note_violation(P, t)
    audit(P, L, t)
    C.t, C.h_last = t, h
    C.accepted = error
    return complete(P, L, C)


@native
def complete(P: Problem, L: Plan, C: Control) -> int:
    """Write the records of the accepted step, as far as there is room, and go on from its end."""
    short = is_cut_short(P, C)
    good = short or record(P, L, C)
    C.open = good and not short and is_due(P, C)
    if C.open:
        return FULL
    put_end(P, C)
    track(P)
    count_from_here(P)
    keep_stages(P)
    put_state(P, C.t, P.q, P.u, P.a, P.z, P.rd)
    choose_step(P, C, C.accepted)
    if not good:
        return SINGULAR_MASS
    if happened(P, C.t):
        return pass_on(P, L, C)
    keep_margins(P)
    if P.search.taken:
        touch_gently(P, L, C)
    return RUNNING


# Below this share of HMAX the error of a step is round-off, and nobody's.
BLAMELESS = 1e-9


@native
@seldom
def after_failure(P: Problem, C: Control) -> int:
    """Newton failed: new derivatives when they were old, else another step."""
    P.count.failures += 1
    old = not C.fresh and C.known
    C.rate, C.cautious = 1.0, True
    if not old and not let_go(P):
        if P.sizes.holonomic > 0 and P.sizes.watched + P.sizes.zones == 0 and not C.separate:
            C.separate = True
            return RUNNING
        C.retries += 1
        P.undoing.trouble += 1.0
        C.blamed = wildest(P)
        put_stage(P, 3, C.h)
        note_trouble(P, equations_kept(P), C.turns)
        if C.retries != CUTS or not land_elsewhere(P, C):
            C.h *= cut(P, C, retry_factor(C))
    C.known, C.factored = False, 0.0
    return RUNNING


@native
@seldom
def land_elsewhere(P: Problem, C: Control) -> bool:
    """Back to before the trouble, with another step; False when that was tried enough."""
    share = before_trouble(P, C.t + C.h)
    if share == 0.0:
        return False
    C.known, C.factored, C.rate, C.cautious, C.separate = False, 0.0, 1.0, True, False
    C.retries, C.fresh, C.norm, C.last_size = 0, False, 0.0, 0.0
    C.h *= share
    restore_state(P, C)
    return True


@native
@seldom
def after_rejection(P: Problem, L: Plan, C: Control, error: float) -> int:
    """The error was too large: a shorter step, with new derivatives where they were old, because
    these may be all that is wrong with the estimate.
    """
    if not error < OVERFLOW:
        return NOT_FINITE
    if is_at_crossing(P, C, error):
        return switch_at_start(P, L, C)
    P.count.rejected += 1
    C.cautious, C.norm = True, error
    if not C.fresh:
        C.known = False
    C.h *= cut(P, C, step_factor(C, error))
    if C.h > BLAMELESS * P.settings.h_max:
        C.blamed = P.report.where
    return RUNNING
