"""GSTIFF: backward differentiation formulas of order 1 to 5 with variable step (BDF).

With backward differences D_i of the past values on the present step h, for y = (q, u, s)

    predictor  y_p = sum_{i=0..k} D_i,        psi = sum_{i=1..k} gamma_i D_i / gamma_k
    corrector  y' = (psi + d) gamma_k / h,    y = y_p + d,    gamma_k = 1 + 1/2 + ... + 1/k
    error      d / (k + 1)

Index 3 (I3): unknowns (q, lam), u = T q', errors of q tested.  Stabilised index 2 (SI2): also
G u + g_t = 0 with multipliers mu, errors of q and u tested.  Both in the maximum norm with weights
ERROR max(1, |y|).
CONSTANT_BDF has no error test: steps of FIXED_STEP and the order KMAX, both reached in a start-up;
what the corrector cannot do ends the run.

References: Gear, IEEE Trans. Circuit Theory 18 (1971) 89; Shampine, Reichelt, SIAM J. Sci. Comput.
18 (1997) 1 (quasi-constant step, differences); Brenan, Campbell, Petzold, Numerical Solution of
IVP in DAE, 1996, section 5.2 (tests of the corrector).
"""

from __future__ import annotations

from adamslite.integrators.accelerations import accelerations
from adamslite.integrators.audit.balance import audit
from adamslite.integrators.bdf.control import Control
from adamslite.integrators.bdf.corrector import correct
from adamslite.integrators.bdf.dense_output import record
from adamslite.integrators.bdf.differences import extend_history, extrapolate, gamma, rebase
from adamslite.integrators.bdf.events import end_at_crossing, pass_on, passes_crossing
from adamslite.integrators.bdf.order import choose_order, local_error, most_order, watch_order
from adamslite.integrators.bdf.order_cap import start_watch
from adamslite.integrators.bdf.recovery import (
    after_failure,
    after_rejection,
    near_singularity,
    stuck,
)
from adamslite.integrators.bdf.state import (
    forget_multipliers,
    resize,
    restore_state,
    start_values,
    tests_velocities,
)
from adamslite.integrators.contract import BROKEN_START, FULL, SINGULAR_MASS, Problem
from adamslite.integrators.events.dips import expected_share
from adamslite.integrators.events.events import happened, start_events
from adamslite.integrators.events.guards import crawls, hold_watch, keep_margins
from adamslite.integrators.events.stops import fitted, horizon, longest_step, set_pace, step_limit
from adamslite.integrators.implicit.step_size import first_step
from adamslite.integrators.implicit.tolerance import is_allowed
from adamslite.integrators.linalg.plan import Plan
from adamslite.integrators.motion_equations import put_time, track
from adamslite.integrators.records import note_violation
from adamslite.integrators.step_back import make_undoable
from adamslite.integrators.stepping.control import NOBODY, RUNNING
from adamslite.integrators.stepping.outcome import (
    LONGER,
    end_of_run,
    end_of_step,
    goes_on,
    has_failed,
    is_cut_short,
    keep_solution,
    note_signature,
    note_try,
    passed_singularity,
    round_off,
    too_small,
)
from adamslite.integrators.stepping.output import is_due
from adamslite.native.translate import native, rare

# Steps that differ by less than this share are equal.
EQUAL_STEPS = 1e-9
# Multipliers and variables are predicted by a straight line, no further than this many steps.
FAR = 2.0


@native
def bdf(P: Problem, L: Plan) -> int:
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
    """Accelerations at the start, history of order 1, first record."""
    C[:] = 0
    P.undoing[:] = 0
    C.t, C.rate, C.order, C.blamed = P.settings.t, 1.0, 1, NOBODY
    C.caution = 1.0
    C.width, C.highest = 2 * P.sizes.n + P.sizes.ns, most_order(P)
    start_watch(C.cap)
    P.report.order_capped, P.report.floor = False, 0.0
    start_events(P, True, tests_velocities(P))
    started = accelerations(P, L, C.t, P.q, P.u, P.a, P.z, P.rd)
    hold_watch(P)
    C.h = first_step(P)
    start_values(P, C)
    keep_solution(P)
    forget_multipliers(P)
    if not started:
        return BROKEN_START
    note_signature(P, L, C, P.pivot0)
    track(P)
    return RUNNING if record(P, L, C) else SINGULAR_MASS


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
        return stuck(P, L, C)
    note_try(P, C, C.order)
    predict(P, C)
    if not correct(P, L, C):
        return after_failure(P, C)
    norm = local_error(P, C)
    if not is_allowed(norm, P.settings.fixed_step):
        return after_rejection(P, C, norm)
    if passed_singularity(P, L, C):
        return near_singularity(P, C)
    if passes_crossing(P, L, C):
        return end_at_crossing(P, L, C)
    return accept(P, L, C, norm)


@native
def limit_step(P: Problem, C: Control) -> None:
    """Keep the step within its pace, the horizon, when stepped onto the output times, and zones."""
    set_pace(P, C.t)
    longest = longest_step(P)
    if C.h > longest * LONGER:
        resize(P, C, longest / C.h)
    left = horizon(P) - C.t
    if not P.settings.interpolate and P.settings.fixed_step == 0.0:
        fit = fitted(C.h, step_limit(P, C.row) - C.t, round_off(P, C)) / C.h
        # Equal steps keep their history.
        if abs(fit - 1.0) > EQUAL_STEPS:
            resize(P, C, fit)
    elif C.h * LONGER + round_off(P, C) > left:
        resize(P, C, left / C.h)
    elif 2.0 * C.h > left and horizon(P) < P.settings.t_end:
        resize(P, C, 0.5 * left / C.h)
    share = expected_share(P, C.h)
    if share < 1.0:
        resize(P, C, share)


@native
def accept(P: Problem, L: Plan, C: Control, norm: float) -> int:
    """Move the history on, write records, choose the next order and step."""
    P.count.steps += 1
    P.report.spent += norm
    make_undoable(P, C.t, C.h, not has_failed(C))
    move_on(P, C)
    note_violation(P, C.t)
    audit(P, L, C.t)
    C.accepted = norm
    return complete(P, L, C)


@native
def complete(P: Problem, L: Plan, C: Control) -> int:
    """Write the records of the accepted step, as far as there is room, and go on from its end."""
    short = is_cut_short(P, C)
    if not (short or record(P, L, C)):
        return SINGULAR_MASS
    C.open = not short and is_due(P, C)
    if C.open:
        return FULL
    track(P)
    rebase(P, P.history, C.width, C.order)
    watch_order(P, C)
    if happened(P, C.t):
        return pass_on(P, L, C)
    keep_margins(P)
    choose_order(P, C, C.accepted)
    return RUNNING


@native
def move_on(P: Problem, C: Control) -> None:
    """The end of the step is the accepted state."""
    extend_history(P.history, P.trial[C.width :], C.width, C.order)
    C.t = end_of_step(P, C, horizon(P) if P.settings.fixed_step > 0.0 else step_limit(P, C.row))
    C.h_last, C.equal, C.age = C.h, C.equal + 1, C.age + 1
    C.retries, C.fresh, C.norm, C.noisy = 0, False, 0.0, 0
    for i in range(P.z.size):
        P.pz[i] = P.rz[i]
    keep_solution(P)


@native
def predict(P: Problem, C: Control) -> None:
    """Predicted values of all unknowns at the end of the step; of q only the change is kept.

    In ``P.trial``: y_p, psi, q', and the correction e of q, nothing so far.
    """
    n, ns, w = P.sizes.n, P.sizes.ns, C.width
    first = P.sizes.m + P.sizes.nv
    yp, e = P.trial[0:], P.trial[2 * w + n :]
    C.cu = gamma(C.order) / C.h
    extrapolate(P.history, w, C.order, yp, P.trial[w:])
    for i in range(n, w):
        yp[i] += P.history[i]
    for i in range(n):
        P.q[i], e[i] = P.history[i] + yp[i], 0.0
    for i in range(ns):
        P.z[first + i] = yp[2 * n + i]
    ahead = C.h / C.h_last if C.h_last > 0.0 else 0.0
    for i in range(first):
        P.z[i] = P.rz[i] + min(ahead, FAR) * (P.rz[i] - P.pz[i])
    for i in range(P.mu.size):
        P.mu[i] = 0.0
    put_time(P, C.t + C.h)
