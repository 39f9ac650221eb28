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

from adamslite.integrators.accelerations import accelerations, mass_signature
from adamslite.integrators.audit.balance import audit
from adamslite.integrators.bdf.control import Control
from adamslite.integrators.bdf.corrector import correct, start_try
from adamslite.integrators.bdf.differences import extend_history, gamma, rebase
from adamslite.integrators.bdf.events import locate, pass_on, switch_at_start
from adamslite.integrators.bdf.order import adapt_order, local_error, most_order
from adamslite.integrators.bdf.order_cap import CAPPED, highest_order, start_watch
from adamslite.integrators.bdf.recovery import (
    after_failure,
    after_rejection,
    land_elsewhere,
    near_singularity,
    stuck,
)
from adamslite.integrators.bdf.state import (
    resize,
    restore_state,
    start_values,
    tests_velocities,
)
from adamslite.integrators.contract import (
    BROKEN_START,
    DONE,
    INDEX3,
    INTERRUPTED,
    SINGULAR_MASS,
    STABILISED,
    Problem,
)
from adamslite.integrators.events.events import happened, start_events
from adamslite.integrators.events.guards import crawls, hold_watch, keep_margins
from adamslite.integrators.events.search import ends_there, shorter, starts_there
from adamslite.integrators.events.stops import fitted, horizon, longest_step, set_pace, step_limit
from adamslite.integrators.implicit.control import keep_algebraic
from adamslite.integrators.implicit.step_size import first_step
from adamslite.integrators.linalg.plan import Plan
from adamslite.integrators.motion_equations import track
from adamslite.integrators.records import note_violation, record_at
from adamslite.integrators.step_back import make_undoable
from adamslite.integrators.stepping.control import RUNNING
from adamslite.integrators.stepping.step_size import too_small
from adamslite.native.translate import native

# Steps that differ by less than this share are equal.
EQUAL_STEPS = 1e-9


@native
def bdf(P: Problem, L: Plan) -> int:
    """Integrate to the end time; returns an outcome."""
    C = Control(P.control)
    outcome = begin(P, L)
    while outcome == RUNNING:
        outcome = advance(P, L)
    restore_state(P, P.history, 2 * P.sizes.n + P.sizes.ns, C.t)
    P.report.t = C.t
    return outcome


@native
def begin(P: Problem, L: Plan) -> int:
    """Accelerations at the start, history of order 1, first record."""
    C = Control(P.control)
    t = P.settings.t
    w = 2 * P.sizes.n + P.sizes.ns
    C[:] = 0
    C.t, C.rate, C.order, C.highest = t, 1.0, 1, most_order(P)
    P.undoing[:] = 0
    start_watch(C.cap)
    P.report.order_capped = False
    start_events(P, True, tests_velocities(P))
    started = accelerations(P, L, t, P.q, P.u, P.a, P.z, P.rd)
    hold_watch(P)
    h = first_step(P, w)
    C.h = h
    start_values(P, P.history, w, h)
    if not started:
        return BROKEN_START
    if P.sizes.implicit_mass:
        C.signature = mass_signature(P, L, P.pivot0)
    keep_algebraic(P)
    for i in range(P.z.size):
        P.pz[i] = P.rz[i]
    for i in range(P.sizes.n):
        P.ra[i] = P.a[i]
    track(P)
    C.row = record_at(P, L, P.history, w, 0, t, h, 0)
    restore_state(P, P.history, w, t)
    return RUNNING


@native
def advance(P: Problem, L: Plan) -> int:
    """One try of a step: RUNNING to continue, whether accepted or not, else the outcome."""
    C = Control(P.control)
    n, ns = P.sizes.n, P.sizes.ns
    w = 2 * n + ns
    if C.t >= P.settings.t_end:
        return DONE
    if P.settings.stop:
        return INTERRUPTED
    limit_step(P, w)
    if too_small(P, C) or crawls(P, C.h):
        return RUNNING if land_elsewhere(P, w) else stuck(P, L, w)
    P.report.t, P.report.h, P.report.order = C.t, C.h, C.order
    stabilised = P.sizes.si2 and P.sizes.holonomic > 0
    cu = gamma(C.order) / C.h
    start_try(P, w)
    if not correct(P, L, STABILISED if stabilised else INDEX3, cu, stabilised):
        return after_failure(P, w)
    norm = local_error(P, w)
    P.report.error = norm
    if not norm <= 1.0 and not (P.settings.fixed_step > 0.0 and norm < 1e12):
        return after_rejection(P, w, norm)
    if P.sizes.implicit_mass:
        if mass_signature(P, L, P.x) != C.signature:
            return near_singularity(P, w)
    return finish(P, L, w, cu, norm)


@native
def finish(P: Problem, L: Plan, w: int, cu: float, norm: float) -> int:
    """The step has passed its tests: accept it, or take it again to end at the first crossing."""
    C = Control(P.control)
    if P.sizes.watched + P.sizes.zones > 0:
        locate(P, L, cu)
        if not ends_there(P):
            if starts_there(P):
                return switch_at_start(P, L, w)
            resize(P, w, shorter(P) / C.h)
            return RUNNING
    return accept(P, L, w, norm)


@native
def limit_step(P: Problem, w: int) -> None:
    """Keep the step within its pace, the horizon and, when stepped onto, the output times."""
    C = Control(P.control)
    set_pace(P, C.t)
    longest = longest_step(P)
    if C.h > longest * 1.0000001:
        resize(P, w, longest / C.h)
    left = horizon(P) - C.t
    if not P.settings.interpolate and P.settings.fixed_step == 0.0:
        fit = fitted(P, C.h, step_limit(P, C.row) - C.t) / C.h
        # Equal steps keep their history.
        if abs(fit - 1.0) > EQUAL_STEPS:
            resize(P, w, fit)
    elif C.h * 1.0000001 > left:
        resize(P, w, left / C.h)
    elif 2.0 * C.h > left and horizon(P) < P.settings.t_end:
        resize(P, w, 0.5 * left / C.h)


@native
def accept(P: Problem, L: Plan, w: int, norm: float) -> int:
    """Move the history on, write records, choose the next order and step."""
    C = Control(P.control)
    D = P.history
    k = C.order
    P.count.steps += 1
    P.report.spent += norm
    make_undoable(P, C.t, C.h, C.retries == 0 and C.norm == 0.0)
    C.retries, C.fresh, C.norm, C.noisy = 0, False, 0.0, 0
    C.age += 1
    extend_history(D, P.trial[w:], w, k)
    t, h = C.t + C.h, C.h
    limit = horizon(P) if P.settings.fixed_step > 0.0 else step_limit(P, C.row)
    if t + 1e-7 * h > limit:
        t = limit
    C.t, C.h_last = t, h
    for i in range(P.z.size):
        P.pz[i] = P.rz[i]
    keep_algebraic(P)
    for i in range(P.sizes.n):
        P.ra[i] = P.a[i]
    note_violation(P, t)
    audit(P, L, t)
    following = record_at(P, L, D, w, k, t, h, C.row)
    if following < 0:
        return SINGULAR_MASS
    if following > C.row:
        restore_state(P, D, w, t)
    C.row = following
    track(P)
    rebase(P, D, w, k)
    C.equal += 1
    cap = C.cap
    cap.travelled += h
    C.highest = highest_order(cap, C.highest, most_order(P), P.settings.h_max)
    P.report.order_capped = cap.state == CAPPED
    if happened(P, t):
        return pass_on(P, L, w)
    keep_margins(P)
    adapt_order(P, w, norm)
    return RUNNING
