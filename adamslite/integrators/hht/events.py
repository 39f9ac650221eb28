"""HHT and NEWMARK at events: steps past a crossing are taken again; restart after a jump."""

from __future__ import annotations

from adamslite.integrators.accelerations import put_state
from adamslite.integrators.contract import INDEX3, NEWTON_FAILED, Problem
from adamslite.integrators.events.events import change_here, pass_event
from adamslite.integrators.events.harmless import take_harmless
from adamslite.integrators.events.search import (
    ends_there,
    is_quiet,
    judge,
    open_search,
    shorter,
    starts_there,
)
from adamslite.integrators.hht.control import Control
from adamslite.integrators.hht.dense_output import put_between
from adamslite.integrators.hht.state import restore_state, start_values
from adamslite.integrators.implicit.step_size import LOOK_AHEAD, first_step, jerk, jumped
from adamslite.integrators.linalg.plan import Plan
from adamslite.integrators.motion_equations import vector_rates
from adamslite.integrators.stepping.control import RUNNING
from adamslite.integrators.stepping.outcome import keep_solution, note_signature
from adamslite.native.translate import copy, native, seldom

# The first step behind an event: where its estimated error is this share of ERROR.
CAREFUL = 0.02
# A step that ends at a crossing is not shorter than these shares of the step in which the crossing
# was seen: at least, and at most for the sake of round-off [length over ERROR].
SHORTEST, LONGEST, ROUND_OFF = 1e-6, 0.01, 4e-15


@native
def passes_crossing(P: Problem, L: Plan, C: Control) -> bool:
    """Whether a branch changes within the step that has passed its test: the first change is
    located.  Equal steps end where they end.
    """
    if C.fixed > 0.0 or is_quiet(P, C.t, C.h):
        return False
    open_search(P, C.t, C.h)
    take_harmless(P, L, INDEX3, C.cu)
    vector_rates(P, P.q, P.u, P.trial[P.sizes.n :])
    while P.search.open:
        put_between(P, C, P.search.share)
        judge(P)
    put_state(P, C.t + C.h, P.q, P.u, P.a, P.z, P.rd)
    return not ends_there(P)


@native
@seldom
def end_at_crossing(P: Problem, L: Plan, C: Control) -> int:
    """The step is taken again, to end where the first branch changes, or changes it at once."""
    if starts_there(P):
        return switch_at_start(P, L, C)
    C.h, C.equal = shorter(P), 0
    if P.search.cut > 1.0:
        least = least_to_crossing(P)
        if C.h < least:  # beyond the crossing, where branches have changed in any case
            C.h, P.search.tolerance = least, least
    return RUNNING


@native
def least_to_crossing(P: Problem) -> float:
    """The shortest step to a crossing: velocities, differences of positions over a step, keep
    round-off below ERROR, unless that took too large a share of the step in which it was seen.
    """
    whole = P.search.whole
    return max(SHORTEST * whole, min(ROUND_OFF / P.settings.error, LONGEST * whole))


@native
def switch_at_start(P: Problem, L: Plan, C: Control) -> int:
    """A branch changes just after the start of the step: change it there and restart, or end a
    step just behind where it changes.
    """
    restore_state(P, C)
    if change_here(P, L, C.t):
        restart(P, L, C)
    else:
        restore_state(P, C)
        C.h, C.equal = shorter(P), 0
    return RUNNING


@native
@seldom
def pass_on(P: Problem, L: Plan, C: Control) -> int:
    """After an event: continue when nothing jumped, else restart."""
    if not pass_event(P, L, C.t):
        return NEWTON_FAILED
    if jumped(P, C):
        restart(P, L, C)
    else:
        take_accelerations(P)
        C.factored = 0.0
    if C.fixed > 0.0:
        C.h = C.fixed
    return RUNNING


@native
def take_accelerations(P: Problem) -> None:
    """Accelerations, multipliers and rates of the states in place are the accepted ones."""
    n, ns = P.sizes.n, P.sizes.ns
    copy(P.history[3 * n + ns :], P.rd, ns)
    keep_solution(P)


@native
def restart(P: Problem, L: Plan, C: Control) -> None:
    """Forget earlier accelerations: those in place are the first."""
    P.count.restarts += 1
    C.h_last, C.equal, C.factored = 0.0, 0, 0.0
    start_values(P)
    h = first_step(P)
    change = abs(P.settings.beta - 1.0 / 6.0) * jerk(P, L, C.t, LOOK_AHEAD * h)
    C.h = P.settings.h_max
    if change > 0.0:
        C.h = min(C.h, (CAREFUL * P.settings.error / change) ** (1.0 / 3.0))
    put_state(P, C.t, P.q, P.u, P.ra, P.z, P.rd)
    note_signature(P, L, C, P.x)
