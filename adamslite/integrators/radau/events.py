"""The Radau formula at events: the search within a tried step, and the restart after it.

Within the tried step, at the share x of it, positions, velocities and states follow the cubic
through the start and the stages,

    y(x) = sum_{i=0..3} l_i(x) y_i,    l_i(x) = prod_{j != i} (x - c_j)/(c_i - c_j),    c_0 = 0,

and what has no value at the start, accelerations, multipliers and variables, the quadratic through
the stages.  The collocation polynomial has order 3 inside of the step; because the step is taken
again to end at the crossing, that is the accuracy of a guess, not of the result.

A formula of one step has no past to forget: after an event only the prediction restarts.
Reference: Hairer, Norsett, Wanner, Solving ODE I, 1993, section II.6 (discontinuities).
"""

from __future__ import annotations

from adamslite.integrators.accelerations import put_state
from adamslite.integrators.contract import NEWTON_FAILED, Problem
from adamslite.integrators.event_rows import END, INSIDE, NONE
from adamslite.integrators.events.events import change_here, pass_event
from adamslite.integrators.events.guards import look
from adamslite.integrators.events.harmless import force_ahead, take_harmless
from adamslite.integrators.events.search import (
    CLOSE,
    ends_there,
    is_quiet,
    judge,
    open_search,
    shorter,
    starts_there,
)
from adamslite.integrators.implicit.formulation import equations_kept
from adamslite.integrators.implicit.step_size import first_step, jumped
from adamslite.integrators.linalg.plan import Plan
from adamslite.integrators.radau.coefficients import REAL
from adamslite.integrators.radau.control import Control
from adamslite.integrators.radau.corrector import round_off
from adamslite.integrators.radau.state import (
    put_between,
    put_end,
    restore_state,
)
from adamslite.integrators.stepping.control import RUNNING
from adamslite.integrators.stepping.outcome import keep_solution, note_signature
from adamslite.native.translate import native, seldom

# A step to a crossing that ends before it by less than this share is taken again, longer, but not
# more often than MOST_LENGTHENED.
BEYOND, MOST_LENGTHENED = 1e-4, 3.0
# Behind branches that changed without an event, the share of their speeds by which a step may
# change velocities, judged by accelerations this share of a step ahead.
GENTLE, AHEAD = 0.05, 0.1


@native
def passes_crossing(P: Problem, L: Plan, C: Control) -> bool:
    """Whether a branch changes within the step that has passed its test: the first change is
    located.
    """
    if is_quiet(P, C.t, C.h):
        return False
    t, h = C.t, C.h
    put_end(P, C)
    open_search(P, t, h)
    take_harmless(P, L, equations_kept(P), P.tableau[REAL] / h)
    while P.search.open:
        put_between(P, t, h, P.search.share)
        judge(P)
    put_end(P, C)
    return not ends_there(P)


@native
@seldom
def end_at_crossing(P: Problem, L: Plan, C: Control) -> int:
    """The step is taken again, to end where the first branch changes, or changes it at once."""
    if starts_there(P):
        return switch_at_start(P, L, C)
    if P.search.cut > 1.0:
        C.passed = max(C.passed, C.h)
    C.h = shorter(P)
    return RUNNING


@native
def falls_short(P: Problem, C: Control) -> bool:
    """Whether a step to a crossing ends just before it: then it is taken again, longer by what it
    lacks.

    A step to the crossing from there would be so short that round-off of positions, over its size,
    spoils velocities.  What is lacking is read from the guards at the end and a little beyond,
    where the polynomial of the step continues.
    """
    S, count, share = P.search, P.sizes.watched, NONE
    if not S.hunt or min(S.found, S.cut) <= 1.0 or C.lengthened >= MOST_LENGTHENED:
        return False
    put_between(P, C.t, C.h, 1.0 + BEYOND)
    look(P, INSIDE)
    put_end(P, C)
    for k in range(count):
        before, after = P.margin[END * count + k], P.margin[INSIDE * count + k]
        if before >= 0.0 and after < 0.0:
            share = min(share, before / (before - after))
    if share > 1.0:
        return False
    C.h += BEYOND * share * C.h + 0.5 * S.tolerance
    C.lengthened += 1
    return True


@native
@seldom
def is_at_crossing(P: Problem, C: Control, error: float) -> bool:
    """Whether the step to a crossing is so short that the last digits of positions make up its
    error, though a longer one from the same start has passed the test: the crossing is here.
    """
    S = P.search
    if C.h > CLOSE * C.passed or S.found > 1.0 or S.found * S.size > C.h:
        return False
    return error * P.settings.error <= round_off(P, C)


@native
def switch_at_start(P: Problem, L: Plan, C: Control) -> int:
    """A branch changes just after the start of the step: change it there and restart, or end a
    step just behind where it changes.
    """
    C.passed, C.lengthened, P.undoing.undoable = 0.0, 0, False
    restore_state(P, C)
    if change_here(P, L, C.t):
        restart(P, L, C)
    else:
        restore_state(P, C)
        C.h, C.known = shorter(P), False
    return RUNNING


@native
@seldom
def pass_on(P: Problem, L: Plan, C: Control) -> int:
    """After an event: the prediction continues when nothing jumped, else it restarts."""
    # A step that is taken back must not lead across an event.
    P.undoing.undoable = False
    if not pass_event(P, L, C.t):
        return NEWTON_FAILED
    C.known = False
    if jumped(P, C):
        restart(P, L, C)
    else:
        keep_solution(P)
    return RUNNING


@native
def restart(P: Problem, L: Plan, C: Control) -> None:
    """The next step is predicted from the accelerations in place, and chosen like the first."""
    P.count.restarts += 1
    keep_solution(P)
    C.h_last, C.last_size, C.known, C.cautious = 0.0, 0.0, False, True
    C.h = first_step(P)
    note_signature(P, L, C, P.x)


@native
def touch_gently(P: Problem, L: Plan, C: Control) -> None:
    """A shorter step where branches changed at the end of the last one and made no difference
    there, but will: a body that just touches a hard wall.  The step before says nothing about it,
    and stiffly damped stages of a long one would take all of its speed without a large error.
    """
    ahead = AHEAD * C.h
    rate = force_ahead(P, L, C.t, ahead) / ahead
    C.known = False
    if rate * C.h * C.h > 2.0 * GENTLE:
        C.h, C.cautious = (2.0 * GENTLE / rate) ** 0.5, True
    put_state(P, C.t, P.q, P.u, P.ra, P.z, P.rd)
