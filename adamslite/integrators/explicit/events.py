"""The explicit formula at events: dense output of the tried step, and the restart.

Within the tried step a cubic goes through both ends with their rates; it only has to say which
branch changes first and about where, because the step is taken again to end there.  Where a guard
dips towards zero without a change at the end, the polynomial of order 7 decides: steps are long,
and the cubic errs by more than a peak may be above the value of a sensor.
"""

from __future__ import annotations

from adamslite.integrators.accelerations import mass_signature, put_state
from adamslite.integrators.contract import NEWTON_FAILED, Problem
from adamslite.integrators.event_rows import DIP
from adamslite.integrators.events.events import change_here, pass_event
from adamslite.integrators.events.search import (
    ends_there,
    is_quiet,
    judge,
    open_search,
    shorter,
    starts_there,
)
from adamslite.integrators.explicit.control import BETWEEN, K_NEW, NEXT_STATE, OLD, Control
from adamslite.integrators.explicit.dense_output import interpolated, late_stages
from adamslite.integrators.explicit.error import LEAST_ERROR, first_step
from adamslite.integrators.explicit.stages import exact_rates, restore_state
from adamslite.integrators.linalg.plan import Plan
from adamslite.integrators.stepping.control import RUNNING
from adamslite.integrators.stepping.outcome import keep_solution
from adamslite.native.translate import copy, native, seldom


@native
def passes_crossing(P: Problem, L: Plan, C: Control) -> bool:
    """Whether a branch changes within the step that has passed its test, whose end is in the
    workspace: the first change is located.
    """
    if is_quiet(P, C.t, C.h):
        return False
    w, h, exact = C.size, C.h, False
    between, end = P.history[BETWEEN * w :], P.history[NEXT_STATE * w :]
    open_search(P, C.t, h)
    while P.search.open:
        if P.search.stage == DIP and not exact:
            exact, C.late = True, late_stages(P, L, C, h)
        if C.late:
            interpolated(P, C, h, P.search.share, between)
            exact_rates(P, L, C, C.t + P.search.share * h, between, P.trial)
        else:
            put_cubic(P, C)
        judge(P)
    if exact:
        exact_rates(P, L, C, C.t + h, end, P.trial)
    put_state(P, C.t + h, P.q, P.u, P.a, P.z, P.rd)
    return not ends_there(P)


@native
@seldom
def end_at_crossing(P: Problem, L: Plan, C: Control) -> int:
    """The step is taken again, to end where the first branch changes, or changes it at once."""
    if starts_there(P):
        return switch_at_start(P, L, C)
    C.h = shorter(P)
    return RUNNING


@native
def put_cubic(P: Problem, C: Control) -> None:
    """The tried step at the share of the search into the workspace, by the cubic through both ends
    and their rates, with the slope of that of velocities for accelerations, and straight lines for
    multipliers and variables.
    """
    n, ns, first, width = P.sizes.n, P.sizes.ns, P.sizes.m + P.sizes.nv, C.width
    w, h, x = 2 * n + ns, C.h, P.search.share
    y0, y1 = P.history[OLD * C.size :], P.history[NEXT_STATE * C.size :]
    k0, k1 = P.history, P.history[K_NEW * width :]
    y, a, z = P.trial, P.x, P.F
    along = x * x * (3.0 - 2.0 * x)
    w0, w1 = h * x * (1.0 - x) * (1.0 - x), h * x * x * (x - 1.0)
    for i in range(w):
        y[i] = y0[i] + along * (y1[i] - y0[i])
    for i in range(width):
        y[w - width + i] += w0 * k0[i] + w1 * k1[i]
    for i in range(w - width):
        y[i] += w0 * y0[width + i] + w1 * y1[width + i]
    for i in range(n):
        bend = 6.0 * (y1[n + i] - y0[n + i]) / h - 3.0 * (P.ra[i] + P.a[i])
        a[i] = P.ra[i] + x * (P.a[i] - P.ra[i] + (1.0 - x) * bend)
    for k in range(first):
        z[k] = P.rz[k] + x * (P.z[k] - P.rz[k])
    copy(z[first:], y[2 * n :], ns)
    put_state(P, C.t + x * h, y, y[n:], a, z, P.rd)


@native
def switch_at_start(P: Problem, L: Plan, C: Control) -> int:
    """A branch changes just after the start of the step: change it there and restart, or end a
    step just behind where it changes.
    """
    restore_state(P, C)
    if not change_here(P, L, C.t):
        C.h = shorter(P)
        return restart_rates(P, L, C, False)
    return restart_rates(P, L, C, True)


@native
@seldom
def pass_on(P: Problem, L: Plan, C: Control) -> int:
    """Behind an event: rates of the new branches, another step when something jumped."""
    if not pass_event(P, L, C.t):
        return NEWTON_FAILED
    return restart_rates(P, L, C, P.search.jump > 0.0)


@native
def restart_rates(P: Problem, L: Plan, C: Control, restart: bool) -> int:
    """The first stage again; with ``restart`` the step is chosen as at the start of a run."""
    w = C.size
    y, k = P.history[OLD * w :], P.history[0:]
    P.undoing.undoable, C.behind = False, True
    if not exact_rates(P, L, C, C.t, y, k):
        return NEWTON_FAILED
    if restart:
        P.count.restarts += 1
        keep_solution(P)
        if P.sizes.implicit_mass:
            # What it leaves in P.LA is no factored matrix: the next rates make one of their own.
            C.signature, C.stale = mass_signature(P, L, P.x), True
        C.h, C.last_error = first_step(P, L, C), LEAST_ERROR
        if not exact_rates(P, L, C, C.t, y, k):
            return NEWTON_FAILED
    keep_solution(P)
    return RUNNING
