"""The BDF at events: a step past a crossing is taken again, shorter; after a jump the history
restarts.
"""

from __future__ import annotations

from adamslite.integrators.accelerations import put_state
from adamslite.integrators.bdf.control import Control
from adamslite.integrators.bdf.dense_output import put_between
from adamslite.integrators.bdf.order import CAUTIOUS
from adamslite.integrators.bdf.order_cap import forget_window
from adamslite.integrators.bdf.start import start_history
from adamslite.integrators.bdf.state import forget_multipliers, resize, restore_state
from adamslite.integrators.contract import NEWTON_FAILED, Problem
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
from adamslite.integrators.implicit.formulation import equations_kept
from adamslite.integrators.implicit.step_size import jumped
from adamslite.integrators.linalg.plan import Plan
from adamslite.integrators.stepping.control import RUNNING
from adamslite.integrators.stepping.outcome import keep_solution, note_signature
from adamslite.native.translate import native, seldom


@native
def passes_crossing(P: Problem, L: Plan, C: Control) -> bool:
    """Whether a branch changes within the step that has passed its test: the first change is
    located.
    """
    if is_quiet(P, C.t, C.h):
        return False
    open_search(P, C.t, C.h)
    take_harmless(P, L, equations_kept(P), C.cu)
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
    resize(P, C, shorter(P) / C.h)
    return RUNNING


@native
def switch_at_start(P: Problem, L: Plan, C: Control) -> int:
    """A branch changes just after the start of the step: change it there and restart, or end a
    step just behind where it changes.
    """
    P.undoing.undoable = False
    restore_state(P, C)
    if change_here(P, L, C.t):
        restart(P, L, C)
    else:
        restore_state(P, C)
        resize(P, C, shorter(P) / C.h)
    return RUNNING


@native
@seldom
def pass_on(P: Problem, L: Plan, C: Control) -> int:
    """After an event: the history continues when nothing jumped, else a new one begins."""
    # A step that is taken back must not lead across an event.
    P.undoing.undoable = False
    restore_state(P, C)
    if not pass_event(P, L, C.t):
        return NEWTON_FAILED
    if jumped(P, C):
        restart(P, L, C)
        return RUNNING
    C.factored = 0.0
    keep_solution(P)
    restore_state(P, C)
    return RUNNING


@native
def restart(P: Problem, L: Plan, C: Control) -> None:
    """A history of the state and the accelerations in place."""
    P.count.restarts += 1
    keep_solution(P)
    forget_multipliers(P)
    C.h_last, C.factored, C.caution = 0.0, 0.0, CAUTIOUS
    forget_window(C.cap)
    start_history(P, L, C)
    put_state(P, C.t, P.q, P.u, P.ra, P.z, P.rd)
    note_signature(P, L, C, P.x)
