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

from adamslite.integrators.accelerations import accelerations, mass_signature, put_state
from adamslite.integrators.audit.balance import audit
from adamslite.integrators.contract import BROKEN_START, DONE, INTERRUPTED, SINGULAR_MASS, Problem
from adamslite.integrators.events.events import happened, start_events
from adamslite.integrators.events.guards import crawls, hold_watch, keep_margins, let_go
from adamslite.integrators.events.search import ends_there, shorter, starts_there
from adamslite.integrators.events.stops import (
    fitted,
    least_step,
    longest_step,
    set_pace,
    step_limit,
)
from adamslite.integrators.explicit.control import BODIES, MASSES, Control
from adamslite.integrators.explicit.dense_output import write_dense
from adamslite.integrators.explicit.error import (
    LEAST_ERROR,
    choose_explicit_step,
    estimate,
    starting_step,
)
from adamslite.integrators.explicit.events import change_where_it_stands, locate_between, pass_by
from adamslite.integrators.explicit.history import INVERSE, K_NEW, NEXT_STATE, OLD
from adamslite.integrators.explicit.recovery import reject, shorten, why_stuck
from adamslite.integrators.explicit.stages import exact_rates, run_stages
from adamslite.integrators.explicit.state import base_here, keep_solution, stand_again
from adamslite.integrators.linalg.plan import Plan
from adamslite.integrators.motion_equations import track
from adamslite.integrators.projection import sensitivity
from adamslite.integrators.records import note_violation, write_record
from adamslite.integrators.step_back import make_undoable
from adamslite.integrators.stepping.control import RUNNING
from adamslite.integrators.stepping.outcome import ALMOST
from adamslite.integrators.stepping.step_size import LONGER
from adamslite.integrators.unconstrained import invert_inertia, is_free, mass_tables
from adamslite.native.translate import Reals, native

# A projection that moves further than this times ERROR does not correct a step but leaves it, as
# where constraints lose rank and another branch is near.
FAR = 1.0
# A step whose stages have no value is cut to this.
CUT = 0.25
# Where steps below this share of HMAX are pulled so far this often, shorter ones will not help.
TINY, MOST_PULLED = 1e-6, 20
EPSILON = 2.220446049250313e-16


@native
def explicit(P: Problem, L: Plan) -> int:
    """Integrate to the end time; returns an outcome."""
    C = Control(P.control)
    outcome = begin_explicit(P, L)
    while outcome == RUNNING:
        outcome = try_step(P, L)
    P.report.t = C.t
    return outcome


@native
def begin_explicit(P: Problem, L: Plan) -> int:
    """Rates at the start, first record, first step."""
    C = Control(P.control)
    t = P.settings.t
    n, ns, first = P.sizes.n, P.sizes.ns, P.sizes.m + P.sizes.nv
    w = 2 * n + ns
    P.undoing[:] = 0
    C[:] = 0
    C.t, C.last_error = t, LEAST_ERROR
    y, k = P.history[OLD * w :], P.history[0:]
    for i in range(n):
        y[i], y[n + i] = P.q[i], P.u[i]
    for i in range(ns):
        y[2 * n + i] = P.z[first + i]
    C.width = w
    start_events(P, True, True)
    inverse = P.history[INVERSE * w :]
    if is_free(P) and mass_tables(P, inverse, inverse[n:]):
        C.kind, C.width = MASSES, n
    elif is_free(P) and invert_inertia(P, inverse):
        C.kind = BODIES
    elif not accelerations(P, L, t, P.q, P.u, P.a, P.z, P.rd):
        return BROKEN_START
    if P.sizes.implicit_mass:
        C.signature = mass_signature(P, L, P.pivot0)
    if not exact_rates(P, L, t, y, k):
        return BROKEN_START
    hold_watch(P)
    P.report.order = 8
    C.h = starting_step(P, L, w)
    if not exact_rates(P, L, t, y, k):
        return BROKEN_START
    base_here(P, w)
    keep_solution(P)
    track(P)
    write_record(P, 0)
    C.row = 1
    return RUNNING


@native
def try_step(P: Problem, L: Plan) -> int:
    """One try of a step: RUNNING to continue, whether accepted or not, else the outcome."""
    C = Control(P.control)
    w = 2 * P.sizes.n + P.sizes.ns
    if C.t >= P.settings.t_end:
        return DONE
    if P.settings.stop:
        return INTERRUPTED
    set_pace(P, C.t)
    C.h = min(C.h, longest_step(P))
    left = step_limit(P, C.row) - C.t
    if not P.settings.interpolate:
        C.h = fitted(P, C.h, left)
    if C.h * LONGER > left:
        C.h = left
    least = P.settings.h_min if C.cautious else least_step(P)
    if C.h < least or crawls(P, C.h):
        return why_stuck(P, L, w)
    P.report.t, P.report.h = C.t, C.h
    if not run_stages(P, L, w, C.h):
        if let_go(P):
            return RUNNING
        return shorten(P, w, CUT)
    error = estimate(P, w, C.h)
    P.report.error = error
    if not error <= 1.0:
        return reject(P, w, error)
    return accept_step(P, L, w, error)


@native
def accept_step(P: Problem, L: Plan, w: int, error: float) -> int:
    """Project, and move on unless the step is to end at a crossing before."""
    C = Control(P.control)
    K = P.history
    h, t = C.h, C.t + C.h
    limit = step_limit(P, C.row)
    if t + ALMOST * h > limit:
        t = limit
    new, width = K[NEXT_STATE * w :], C.width
    if P.sizes.implicit_mass and changed_signature(P, L, t, new):
        return shorten(P, w, CUT)
    P.report.moved = 0.0
    if not exact_rates(P, L, t, new, K[K_NEW * width :]):
        return shorten(P, w, CUT)
    if P.report.moved > FAR * P.settings.error or is_loose(P, L):
        return pull_back(P, L, w)
    if P.sizes.watched + P.sizes.zones > 0:
        locate_between(P, C.t, h, width, OLD * w, K_NEW)
        if not ends_there(P):
            if starts_there(P):
                return change_where_it_stands(P, L, w)
            C.h = shorter(P)
            return RUNNING
    return move_on(P, L, w, t, error)


@native
def move_on(P: Problem, L: Plan, w: int, t: float, error: float) -> int:
    """Write records up to ``t``, take over the new state, choose the next step."""
    C = Control(P.control)
    K, width = P.history, C.width
    new = K[NEXT_STATE * w :]
    P.count.steps += 1
    P.report.spent += error
    make_undoable(P, C.t, C.h, C.tries == 0)
    C.retries, C.tries = 0, 0
    note_violation(P, t)
    audit(P, L, t)
    keep_solution(P)
    if not write_dense(P, L, w, t):
        return SINGULAR_MASS
    C.t = t
    for i in range(w):
        K[OLD * w + i] = new[i]
    for i in range(width):
        K[i] = K[K_NEW * width + i]
    stand_again(P, w)
    track(P)
    base_here(P, w)
    if happened(P, t):
        return pass_by(P, L, w)
    keep_margins(P)
    choose_explicit_step(P, error)
    return RUNNING


@native
def pull_back(P: Problem, L: Plan, w: int) -> int:
    """The step left its branch, or ended where it may be left: a shorter one, another start."""
    C = Control(P.control)
    if C.h < TINY * P.settings.h_max:
        C.pulled += 1
    if C.pulled <= MOST_PULLED:
        return shorten(P, w, 0.5)
    C.retries += 1
    return why_stuck(P, L, w)


@native
def is_loose(P: Problem, L: Plan) -> bool:
    """Whether constraints hold the new state so loosely that round-off decides its velocity.

    With the lever d of :mod:`adamslite.integrators.step_back`, 1 in the best posture so far,
    round-off e is an error e/d^2 of velocities: more than ERROR. Steps that become short walk into
    such places, and leave them on any branch.
    """
    C = Control(P.control)
    if P.sizes.m == 0:
        return False
    now = sensitivity(P, L)
    C.firmest = min(C.firmest, now) if C.firmest > 0.0 else now
    return EPSILON * now * now > P.settings.error * C.firmest * C.firmest


@native
def changed_signature(P: Problem, L: Plan, t: float, y: Reals) -> bool:
    """Whether the acceleration matrix became singular within the step."""
    C = Control(P.control)
    n = P.sizes.n
    put_state(P, t, y, y[n:], P.a, P.z, P.rd)
    return mass_signature(P, L, P.x) != C.signature
