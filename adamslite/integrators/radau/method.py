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

from math import floor

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
    INTERRUPTED,
    NEWTON_FAILED,
    NOT_FINITE,
    SINGULAR_MASS,
    STEP_TOO_SMALL,
    Problem,
)
from adamslite.integrators.events.events import happened, start_events
from adamslite.integrators.events.guards import crawls, hold_watch, keep_margins
from adamslite.integrators.events.search import ends_there, shorter, starts_there
from adamslite.integrators.events.stops import horizon, longest_step, set_pace
from adamslite.integrators.implicit.control import keep_algebraic
from adamslite.integrators.implicit.step_size import first_step
from adamslite.integrators.linalg.plan import Plan
from adamslite.integrators.motion_equations import track
from adamslite.integrators.radau.control import Control
from adamslite.integrators.radau.corrector import QUICK, after_failed_stages, solve_stages
from adamslite.integrators.radau.error import filtered_error
from adamslite.integrators.radau.events import (
    falls_short,
    is_at_crossing,
    locate_in_stages,
    move_past,
    switch_behind,
)
from adamslite.integrators.radau.stages import (
    ORIGIN,
    collocated,
    keep_stages,
    predict_stages,
    stage_motion,
)
from adamslite.integrators.radau.state import (
    count_from_here,
    put_end,
    stand_at_start,
)
from adamslite.integrators.records import note_violation, write_record
from adamslite.integrators.stepping.control import RUNNING
from adamslite.integrators.stepping.outcome import SINGULAR_RESOLUTION, corrector_failed
from adamslite.integrators.stepping.step_size import cut, too_small
from adamslite.native.translate import native

# The next step aims at this share of the step that the error allows; it is changed only when it
# grows by more than KEEP_GROWTH, because every other size needs new factors.
SAFETY, MOST_GROWTH, LEAST_SHRINK, KEEP_GROWTH = 0.9, 5.0, 0.125, 1.2
# Further from the target than this many steps they need not fit.
MANY_STEPS = 100.0


@native
def radau(P: Problem, L: Plan) -> int:
    """Integrate to the end time; returns an outcome."""
    C = Control(P.control)
    outcome = start_radau(P, L)
    while outcome == RUNNING:
        outcome = try_radau(P, L)
    stand_at_start(P)
    P.report.t = C.t
    return outcome


@native
def start_radau(P: Problem, L: Plan) -> int:
    """Accelerations at the start, the first record, attitudes counted from here."""
    C = Control(P.control)
    Y, t = P.history, P.settings.t
    n, ns, first = P.sizes.n, P.sizes.ns, P.sizes.m + P.sizes.nv
    P.undoing[:] = 0
    C[:] = 0
    for i in range(P.history.size):
        Y[i] = 0.0
    C.t, C.rate, C.cautious = t, 1.0, True
    start_events(P, True, True)
    good = accelerations(P, L, t, P.q, P.u, P.a, P.z, P.rd)
    hold_watch(P)
    C.h = first_step(P, 0)
    if good:
        if P.sizes.implicit_mass:
            C.signature = mass_signature(P, L, P.pivot0)
        while C.row < P.times.size and P.times[C.row] <= t:
            write_record(P, C.row)
            C.row += 1
        track(P)
        count_from_here(P)
    origin = Y[ORIGIN * (2 * n + ns) :]
    for i in range(n):
        origin[i], origin[n + i], Y[n + i], P.ra[i] = P.q[i], P.u[i], P.u[i], P.a[i]
    for k in range(ns):
        origin[2 * n + k], Y[2 * n + k] = P.z[first + k], P.z[first + k]
    keep_algebraic(P)
    return RUNNING if good else BROKEN_START


@native
def try_radau(P: Problem, L: Plan) -> int:
    """One try of a step: RUNNING to continue, whether accepted or not, else the outcome."""
    C = Control(P.control)
    if C.t >= P.settings.t_end:
        return DONE
    if P.settings.stop:
        return INTERRUPTED
    fit_step(P)
    if too_small(P, C) or crawls(P, C.h):
        return why_no_step(P, L)
    P.report.t, P.report.h, P.report.order = C.t, C.h, 5
    predict_stages(P, C.h, C.h_last)
    stage_motion(P, C.h)
    if not solve_stages(P, L):
        return after_failed_stages(P)
    norm = filtered_error(P, L, C.cautious)
    P.report.error = norm
    if not norm < 1e12:
        return NOT_FINITE
    if norm > 1.0:
        if is_at_crossing(P, norm):
            return switch_behind(P, L)
        take_shorter(P, norm)
        return RUNNING
    if P.sizes.implicit_mass:
        put_end(P)
        if mass_signature(P, L, P.x) != C.signature:
            C.h *= 0.25
            return RUNNING if C.h > SINGULAR_RESOLUTION * P.settings.h_max else SINGULAR_MASS
    return finish_stages(P, L, norm)


@native
def take_shorter(P: Problem, norm: float) -> None:
    """The error was too large: a shorter step, with new derivatives where they were old, because
    these may be all that is wrong with the estimate.
    """
    C = Control(P.control)
    P.count.rejected += 1
    C.cautious, C.norm = True, norm
    if not C.fresh:
        C.known = False
    C.h *= cut(P, C, step_factor(C, norm))
    if C.h > 1e-9 * P.settings.h_max:
        C.blamed = P.report.where


@native
def finish_stages(P: Problem, L: Plan, norm: float) -> int:
    """The step has passed its tests: accept it, or take it again to end at the first crossing."""
    C = Control(P.control)
    if P.sizes.watched + P.sizes.zones > 0:
        locate_in_stages(P, L)
        if not ends_there(P):
            if starts_there(P):
                return switch_behind(P, L)
            if P.search.cut > 1.0:
                C.passed = max(C.passed, C.h)
            C.h = shorter(P)
            return RUNNING
        if falls_short(P):
            return RUNNING
    return accept_stages(P, L, norm)


@native
def fit_step(P: Problem) -> None:
    """Keep the step within its pace; equal steps to the horizon or, unless they may be
    interpolated, to the next output time.  A step to a crossing keeps its size.
    """
    C = Control(P.control)
    set_pace(P, C.t)
    target, row = horizon(P), C.row
    if not P.settings.interpolate and row < P.times.size:
        target = min(target, P.times[row])
    C.h = min(C.h, longest_step(P))
    left = target - C.t
    if P.search.hunt:
        C.h = min(C.h, left)
        return
    C.to_target = floor(left / C.h + 1.0 - 1e-7)
    if C.to_target < MANY_STEPS:
        C.h = left / max(1.0, C.to_target)


@native
def step_factor(C: Control, norm: float) -> float:
    """Change of the step that the error allows; many iterations ask for caution."""
    safety = min(SAFETY, SAFETY * 15.0 / (C.turns + 14.0))
    return max(LEAST_SHRINK, min(MOST_GROWTH, safety * max(norm, 1e-10) ** -0.25))


@native
def accept_stages(P: Problem, L: Plan, norm: float) -> int:
    """Move on, write records, choose the next step."""
    C = Control(P.control)
    h = C.h
    P.count.steps += 1
    # The formula is of order 5, its estimate of order 3.
    P.report.spent += norm * (norm * P.settings.error) ** 0.5
    t, row = C.t + h, C.row
    if t + 1e-7 * h > horizon(P):
        t = horizon(P)
    if row < P.times.size and abs(P.times[row] - t) < 1e-7 * h:
        t = P.times[row]
    put_end(P)
    keep_algebraic(P)
    for i in range(P.sizes.n):
        P.ra[i] = P.a[i]
    note_violation(P, t)
    audit(P, L, t)
    C.t = t
    good = record_within(P, L, t, h)
    put_end(P)
    track(P)
    count_from_here(P)
    keep_stages(P)
    put_state(P, t, P.q, P.u, P.a, P.z, P.rd)
    choose_step(P, norm)
    if not good:
        return SINGULAR_MASS
    if happened(P, t):
        return move_past(P, L)
    keep_margins(P)
    return RUNNING


@native
def choose_step(P: Problem, norm: float) -> None:
    """The next step, from the errors of the last two (Gustafsson), and what is kept for it."""
    C = Control(P.control)
    h = C.h
    factor = step_factor(C, norm)
    if C.last_size > 0.0:
        trend = h / C.last_size * (max(C.last_norm, 1e-10) / max(norm, 1e-10) ** 2.0) ** 0.25
        factor = min(factor, max(LEAST_SHRINK, SAFETY * trend))
    if C.cautious and C.last_size > 0.0:
        factor = min(factor, 1.0)
    C.last_size, C.last_norm, C.h_last = h, max(0.01, norm), h
    C.retries, C.fresh, C.cautious, C.norm = 0, False, False, 0.0
    C.age += 1
    if C.theta > QUICK:
        C.known = False
    if C.passed > h:
        resume(P)
    elif factor < 1.0 or min(factor * h, longest_step(P)) > KEEP_GROWTH * h:
        C.h *= cut(P, C, factor)
    C.passed, C.lengthened = 0.0, 0


@native
def resume(P: Problem) -> None:
    """A step shortened to a crossing ends, maybe, just before it: the next is the rest of the one
    that has passed its test.  Derivatives of a step this short, and its error, are round-off.
    """
    C = Control(P.control)
    C.h = max(C.passed - C.h, C.h)
    C.h_last, C.last_size = 0.0, 0.0


@native
def record_within(P: Problem, L: Plan, t: float, h: float) -> bool:
    """Write every output time of the accepted step; False when accelerations are not determined."""
    C = Control(P.control)
    n, ns, first = P.sizes.n, P.sizes.ns, P.sizes.m + P.sizes.nv
    row, y, w = C.row, P.trial[0:], 2 * P.sizes.n + P.sizes.ns
    while row < P.times.size and P.times[row] <= t + 1e-9 * h:
        collocated(P, P.history, w, min(1.0, 1.0 + (P.times[row] - t) / h), y)
        for i in range(n):
            y[i] += P.history[ORIGIN * w + i]
        for k in range(ns):
            P.z[first + k] = y[2 * n + k]
        if not accelerations(P, L, P.times[row], y, y[n:], P.a, P.z, P.rd):
            return False
        write_record(P, row)
        row += 1
        C.row = row
    return True


@native
def why_no_step(P: Problem, L: Plan) -> int:
    """Why the step became too small: a vanishing pivot of the acceleration matrix, or something
    else.
    """
    C = Control(P.control)
    stand_at_start(P)
    if mass_vanishes(P, L, C.signature):
        return SINGULAR_MASS
    P.report.where = C.blamed
    if P.search.freed > 0:
        return CHATTERING
    return NEWTON_FAILED if corrector_failed(C) else STEP_TOO_SMALL
