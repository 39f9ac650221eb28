"""ABAM, RKF45: an explicit Runge-Kutta pair of order 8(5,3) with dense output of order 7.

    y = (q, u, s),   y' = f(t, y) = (T^-1 u, a, s'),     k_i = f(t + c_i h, y + h sum a_ij k_j)
    y+ = y + h sum b_i k_i,    error = |e5|^2/sqrt(|e5|^2 + 0.01 |e3|^2)    over ERROR max(1, |y|)

Accelerations come body by body when nothing ties bodies together
(:mod:`adamslite.integrators.unconstrained`), else from the index-1 equations
(:mod:`adamslite.integrators.accelerations`) with a factored matrix that serves all stages of a
step. With constraints every accepted state is projected in the mass metric,

    [M, G^T; G, 0] (dq, .) = (0, g),    [M, G^T; G, 0] (du, .) = (0, G u + g_t),

so that nothing drifts.  Rotations are Cayley vectors counted from the attitude at the step's start.
References: Hairer, Norsett, Wanner, Solving ODE I, 1993, sections II.4 (start, steps), II.5, II.6,
II.10 (error); Hairer, Lubich, Wanner, Geometric Numerical Integration, 2006, sections IV.4, VII.1.
"""

from __future__ import annotations

from adamslite.integrators.accelerations import accelerations, put_state
from adamslite.integrators.audit.balance import audit
from adamslite.integrators.contract import BROKEN_START, FULL, HELD, SINGULAR_MASS, Problem
from adamslite.integrators.events.events import happened, start_events
from adamslite.integrators.events.guards import crawls, hold_watch, keep_margins
from adamslite.integrators.events.stops import (
    fitted,
    least_step,
    longest_step,
    set_pace,
    step_limit,
)
from adamslite.integrators.explicit.choice import begin_with_formula, choose_formula, stays
from adamslite.integrators.explicit.control import (
    BODIES,
    INVERSE,
    K_NEW,
    LANES,
    LINE,
    MASSES,
    NEXT_STATE,
    OLD,
    TIED,
    Control,
)
from adamslite.integrators.explicit.dense_output import is_within, record
from adamslite.integrators.explicit.error import (
    LEAST_ERROR,
    choose_step,
    first_step,
    local_error,
    quick_error,
)
from adamslite.integrators.explicit.events import end_at_crossing, pass_on, passes_crossing
from adamslite.integrators.explicit.lanes import into_lanes, lane_masses_clear, lane_tables
from adamslite.integrators.explicit.recovery import (
    after_failure,
    after_rejection,
    left_branch,
    near_singularity,
    pull_back,
    stuck,
)
from adamslite.integrators.explicit.stages import (
    base_here,
    end_rates,
    exact_rates,
    put_free_state,
    rates_at,
    restore_state,
    stages,
    take_state,
)
from adamslite.integrators.linalg.plan import Plan
from adamslite.integrators.motion_equations import track
from adamslite.integrators.records import note_violation, write_record
from adamslite.integrators.step_back import make_undoable
from adamslite.integrators.stepping.control import NOBODY, RUNNING
from adamslite.integrators.stepping.outcome import (
    LONGER,
    end_of_run,
    end_of_step,
    is_cut_short,
    keep_solution,
    note_signature,
    note_try,
    passed_singularity,
)
from adamslite.integrators.unconstrained import invert_inertia, is_free, mass_tables
from adamslite.native.translate import Reals, copy, native, rare

ORDER, QUICK_ORDER = 8, 4


@native
def explicit(P: Problem, L: Plan) -> int:
    """Integrate to the end time; returns an outcome."""
    C = Control(P.control)
    outcome = RUNNING
    if not P.settings.begun:
        P.settings.begun = True
        outcome = begin(P, L, C)
    while outcome == RUNNING:
        outcome = advance(P, L, C)
    if C.lazy and outcome != FULL and outcome != HELD:
        restore_state(P, C)
    P.report.t, P.block.row = C.t, C.row
    return outcome


@native
@rare
def begin(P: Problem, L: Plan, C: Control) -> int:
    """Rates at the start, first step, first record."""
    C[:] = 0
    P.undoing[:] = 0
    P.report.floor = 0.0
    C.t, C.last_error, C.blamed, C.behind = P.settings.t, LEAST_ERROR, NOBODY, True
    choose_kind(P, C)
    start_state(P, C)
    start_events(P, True, True)
    if C.kind == TIED and not accelerations(P, L, C.t, P.q, P.u, P.a, P.z, P.rd):
        return BROKEN_START
    note_signature(P, L, C, P.pivot0)
    y, k = P.history[OLD * C.size :], P.history[0:]
    if not exact_rates(P, L, C, C.t, y, k):
        return BROKEN_START
    hold_watch(P)
    P.report.order = ORDER
    if C.kind == LANES:
        begin_with_formula(P, C)
    C.h = first_step(P, L, C)
    if not exact_rates(P, L, C, C.t, y, k):
        return BROKEN_START
    base_here(P, C)
    keep_solution(P)
    track(P)
    write_record(P, 0)
    C.row = 1
    return RUNNING


@native
def choose_kind(P: Problem, C: Control) -> None:
    """How accelerations come about in this scene, and what a state consists of."""
    C.kind, C.half = TIED, P.sizes.n
    C.size = 2 * C.half + P.sizes.ns
    C.width = C.size
    inverse = P.history[INVERSE * C.size :]
    if P.lane_runs.size > 0 and P.sizes.watched + P.sizes.zones == 0:
        C.kind, C.lane = LANES, LINE * ((P.sizes.nb + LINE - 1) // LINE)
        C.half = 3 * C.lane
        C.size, C.width = 2 * C.half, C.half
        lane_tables(P, C)
        C.lazy = follows_at_records(P)
    elif is_free(P) and mass_tables(P, inverse, inverse[P.sizes.n :]):
        C.kind, C.width = MASSES, P.sizes.n
    elif is_free(P) and invert_inertia(P, inverse):
        C.kind = BODIES


@native
def follows_at_records(P: Problem) -> bool:
    """Whether nobody looks at the workspace between two records."""
    for k in range(P.sizes.ng):
        if P.group[k].track:
            return False
    return not P.audit.on


@native
def start_state(P: Problem, C: Control) -> None:
    """y = (q, u, s)"""
    n, first = P.sizes.n, P.sizes.m + P.sizes.nv
    y = P.history[OLD * C.size :]
    if C.kind == LANES:
        into_lanes(P, C.lane, P.q, y)
        into_lanes(P, C.lane, P.u, y[C.half :])
        return
    for i in range(n):
        y[i], y[n + i] = P.q[i], P.u[i]
    copy(y[2 * n :], P.z[first:], P.sizes.ns)


@native
def advance(P: Problem, L: Plan, C: Control) -> int:
    """One try of a step: RUNNING to continue, whether accepted or not, else the outcome."""
    if C.open:
        return complete(P, L, C)
    outcome = end_of_run(P, C)
    if outcome != RUNNING:
        return outcome
    limit_step(P, C)
    if C.h < (P.settings.h_min if C.cautious else least_step(P)) or crawls(P, C.h):
        return stuck(P, L, C)
    note_try(P, C, QUICK_ORDER if C.quick else ORDER)
    C.late = False
    if not stages(P, L, C, C.h):
        return after_failure(P, L, C)
    t = end_of_step(P, C, step_limit(P, C.row))
    y, k = P.history[NEXT_STATE * C.size :], P.history[K_NEW * C.width :]
    if C.quick and not rates_at(P, L, C, t, y, k):
        return near_singularity(P, C)
    error = quick_error(P, C, C.h) if C.quick else local_error(P, C, C.h)
    P.report.error = error
    if not error <= 1.0:
        return after_rejection(P, L, C, error)
    P.report.moved = 0.0
    if not finish(P, L, C, t, y, k):
        return near_singularity(P, C)
    if left_branch(P, L, C):
        return pull_back(P, L, C)
    if passes_crossing(P, L, C):
        return end_at_crossing(P, L, C)
    return accept(P, L, C, t, error)


@native
def finish(P: Problem, L: Plan, C: Control, t: float, y: Reals, k: Reals) -> bool:
    """Rates at the end of the step; False where an effective mass vanishes within it."""
    if C.kind == LANES:
        return end_rates(P, L, C, t, y, k) and keeps_masses(P, L, C, t, y, k)
    return keeps_signature(P, L, C, t, y) and exact_rates(P, L, C, t, y, k)


@native
def keeps_masses(P: Problem, L: Plan, C: Control, t: float, y: Reals, k: Reals) -> bool:
    """The same of masses by component, of which those at the end are known."""
    if not P.sizes.implicit_mass or (C.signature == 0 and lane_masses_clear(P, C)):
        return True
    good = keeps_signature(P, L, C, t, y)
    put_free_state(P, C, t, y, k)
    return good


@native
def keeps_signature(P: Problem, L: Plan, C: Control, t: float, y: Reals) -> bool:
    """Whether the matrix of accelerations at the end has the signs of before."""
    n = P.sizes.n
    if P.sizes.implicit_mass:
        take_state(P, C, y, P.trial, P.trial[n:])
        put_state(P, t, P.trial, P.trial[n:], P.a, P.z, P.rd)
    return not passed_singularity(P, L, C)


@native
def limit_step(P: Problem, C: Control) -> None:
    """Keep the step within its pace, the horizon and, when stepped onto, the output times."""
    set_pace(P, C.t)
    C.h = min(C.h, longest_step(P))
    left = step_limit(P, C.row) - C.t
    if not P.settings.interpolate:
        C.h = fitted(C.h, left, 0.0 if C.cautious else least_step(P))
    if C.h * LONGER > left:
        C.h = left


@native
def accept(P: Problem, L: Plan, C: Control, t: float, error: float) -> int:
    """Write records up to ``t``, take over the new state, choose the next step."""
    P.count.steps += 1
    P.report.spent += error
    make_undoable(P, C.t, C.h, C.tries == 0)
    C.retries, C.tries = 0, 0
    note_violation(P, t)
    audit(P, L, t)
    keep_solution(P)
    C.end, C.first_row, C.apart = t, C.row, False
    C.accepted = error
    return complete(P, L, C)


@native
def complete(P: Problem, L: Plan, C: Control) -> int:
    """Write the records of the accepted step, as far as there is room, and go on from its end."""
    short = is_cut_short(P, C)
    if not (short or record(P, L, C, C.end)):
        return SINGULAR_MASS
    C.open = not short and is_within(P, C, C.end)
    if C.open:
        return FULL
    error = C.accepted
    move_on(P, C, C.end, C.row > C.first_row)
    if happened(P, C.t):
        if C.lazy:
            restore_state(P, C)
        return pass_on(P, L, C)
    keep_margins(P)
    C.h_last = C.h
    if stays(C, error):
        C.last_error = max(error, LEAST_ERROR)
    else:
        choose_step(P, C, error)
    if C.kind == LANES:
        choose_formula(P, C, error)
    return RUNNING


@native
def move_on(P: Problem, C: Control, t: float, recorded: bool) -> None:
    """The end of the step is the accepted state, its last stage the first of the next."""
    K = P.history
    C.t, C.behind = t, False
    copy(K[OLD * C.size :], K[NEXT_STATE * C.size :], C.size)
    for i in range(C.width):
        K[i] = K[K_NEW * C.width + i]
    if recorded or not C.lazy:
        restore_state(P, C)
    track(P)
    base_here(P, C)
