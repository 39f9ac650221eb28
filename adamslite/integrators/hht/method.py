"""HHT and NEWMARK: second-order implicit formulas on accelerations, index 3, variable step.

    q+ = q + h u + h^2 ((1/2 - beta) b + beta b+),      u+ = u + h ((1 - gamma) b + gamma b+)
    b+ = (1 + alpha) a+ - alpha a                       F(t+, q+, u+, a+, lam+) = 0,  g(t+, q+) = 0

With a constant mass this is M b+ + (1 + alpha) R+ - alpha R = 0, R all other terms; written with
both accelerations it keeps order 2 when the mass turns with the parts, and lam+ and a+ belong to
the end of the step.  HHT: beta = (1 - alpha)^2/4, gamma = 1/2 - alpha; NEWMARK: alpha = 0.

For parts the rule of q gives the rotation vector of the step, with h^3/12 w' x w because the axis
turns; the unknown is its Cayley vector.  u and a are angular velocity and acceleration in ground
axes.  States of DIFF follow the rule of u.  b belongs to the time t + alpha h and is moved along
when h changes.

Newton works on (q, lam, V, s) with u' = cu = gamma/(beta h), a' = ca = 1/(beta h^2 (1 + alpha)).
Local error of q: (beta - 1/6) h^2 |b+ - b|, against ERROR max(1, |q|).  That of u is of higher
order in HHT and not tested; a NEWMARK with gamma other than 1/2 is of order 1, and its local error
(gamma - 1/2) h |b+ - b| of u is held below ERROR max(1, |u|).

When HINIT, HMAX and HMIN are equal every step has that size and no error is tested; only a step
that the corrector cannot do is divided.

References: Hilber, Hughes, Taylor, Earthq. Eng. Struct. Dyn. 5 (1977) 283; Arnold, Bruels,
Multibody Syst. Dyn. 18 (2007) 185; Negrut, Rampalli, Ottarsson, Sajdak, J. Comput. Nonlinear Dyn.
2 (2007) 73 (index 3, error test); Bruels, Cardona, Arnold, Mech. Mach. Theory 48 (2012) 121
(rotations).
"""

from __future__ import annotations

from adamslite.integrators.accelerations import accelerations
from adamslite.integrators.audit.balance import audit
from adamslite.integrators.contract import (
    BROKEN_START,
    FULL,
    INDEX3,
    NOT_FINITE,
    SINGULAR_MASS,
    Problem,
)
from adamslite.integrators.events.events import happened, start_events
from adamslite.integrators.events.guards import crawls, hold_watch, keep_margins, let_go
from adamslite.integrators.events.stops import fitted, horizon, longest_step, set_pace, step_limit
from adamslite.integrators.failure_notes import note_trouble, wildest
from adamslite.integrators.hht.control import Control
from adamslite.integrators.hht.corrector import KEEP_STEPS, correct
from adamslite.integrators.hht.dense_output import record
from adamslite.integrators.hht.error import first_order_share, local_error
from adamslite.integrators.hht.events import end_at_crossing, pass_on, passes_crossing
from adamslite.integrators.hht.prediction import choose_coefficients, predict
from adamslite.integrators.hht.state import (
    keep_rates,
    restore_state,
    start_from_here,
    start_values,
)
from adamslite.integrators.implicit.step_size import first_step, retry_factor, shrunk, step_ratio
from adamslite.integrators.implicit.tolerance import is_allowed
from adamslite.integrators.linalg.plan import Plan
from adamslite.integrators.motion_equations import track
from adamslite.integrators.records import note_violation
from adamslite.integrators.stepping.control import NOBODY, RUNNING
from adamslite.integrators.stepping.outcome import (
    LONGER,
    OVERFLOW,
    cut,
    end_of_run,
    end_of_step,
    goes_on,
    is_cut_short,
    near_singularity,
    note_signature,
    note_try,
    passed_singularity,
    round_off,
    too_small,
    why_stuck,
)
from adamslite.integrators.stepping.output import is_due, record_start
from adamslite.native.translate import native, rare, seldom

ORDER = 2
# The next step aims at an estimated error below ERROR by this factor.
SAFETY = 2.0
# A step changes only when that pays for a new matrix, and never grows by more than this at once.
LEAST_GROWTH, LEAST_SHRINK, MOST_GROWTH = 1.25, 0.9, 2.0


@native
def hht(P: Problem, L: Plan) -> int:
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
    C[:] = 0
    C.t, C.blamed, C.fixed = P.settings.t, NOBODY, fixed_step(P)
    C.life, C.served = KEEP_STEPS, KEEP_STEPS + 1
    P.report.rough_steps = 0
    start_events(P, C.fixed == 0.0, first_order_share(P) > 0.0)
    started = accelerations(P, L, C.t, P.q, P.u, P.a, P.z, P.rd)
    hold_watch(P)
    C.h = first_step(P)
    start_values(P)
    if started:
        note_signature(P, L, C, P.pivot0)
        record_start(P, C)
        track(P)
    start_from_here(P)
    return RUNNING if started else BROKEN_START


@native
def advance(P: Problem, L: Plan, C: Control) -> int:
    """One try of a step: RUNNING to continue, whether accepted or not, else the outcome."""
    if C.open:
        return complete(P, L, C)
    outcome = end_of_run(P, C)
    if outcome != RUNNING:
        return outcome
    limit_step(P, C)
    if is_stuck(P, C):
        restore_state(P, C)
        return why_stuck(P, L, C)
    note_try(P, C, ORDER)
    choose_coefficients(P, C)
    predict(P, C)
    if not correct(P, L, C):
        return after_failure(P, C)
    norm = local_error(P, C)
    if not is_allowed(norm, C.fixed):
        return after_rejection(P, C, norm)
    if passed_singularity(P, L, C):
        return near_singularity(P, C)
    if passes_crossing(P, L, C):
        return end_at_crossing(P, L, C)
    return accept(P, L, C, norm)


@native
def accept(P: Problem, L: Plan, C: Control, norm: float) -> int:
    """Move on, write records, choose the next step."""
    P.count.steps += 1
    P.report.spent += norm
    P.report.rough_steps += 1 if C.rough else 0
    C.t = end_of_step(P, C, step_limit(P, C.row) if C.fixed == 0.0 else horizon(P))
    C.h_last, C.retries, C.blamed, C.norm = C.h, 0, NOBODY, 0.0
    C.age += 1
    keep_rates(P)
    note_violation(P, C.t)
    audit(P, L, C.t)
    C.accepted = norm
    return complete(P, L, C)


@native
def complete(P: Problem, L: Plan, C: Control) -> int:
    """Write the records of the accepted step, as far as there is room, and go on from its end."""
    short = is_cut_short(P, C)
    recorded = short or record(P, L, C)
    C.open = recorded and not short and is_due(P, C)
    if C.open:
        return FULL
    track(P)
    start_from_here(P)
    if not recorded:
        return SINGULAR_MASS
    if happened(P, C.t):
        return pass_on(P, L, C)
    keep_margins(P)
    choose_step(P, C, C.accepted)
    return RUNNING


# Share of a fixed step below which it is not divided any more.
LEAST_SHARE = 1e-9


@native
def is_stuck(P: Problem, C: Control) -> bool:
    """Whether steps have become too small to go on."""
    if C.fixed > 0.0:
        return C.h < LEAST_SHARE * C.fixed or crawls(P, C.h)
    return too_small(P, C) or crawls(P, C.h)


@native
@seldom
def after_failure(P: Problem, C: Control) -> int:
    """A shorter step with a new matrix; near a singular posture also longer ones."""
    P.count.failures += 1
    C.factored, C.equal = 0.0, 0
    if C.fixed > 0.0:
        P.report.divided += 1
    if let_go(P):
        return RUNNING
    C.retries += 1
    C.blamed = wildest(P)
    note_trouble(P, INDEX3, P.report.iteration)
    C.h *= cut(P, C, retry_factor(C)) if C.fixed == 0.0 else retry_factor(C)
    return RUNNING


@native
@seldom
def after_rejection(P: Problem, C: Control, norm: float) -> int:
    """The error was too large: a smaller step."""
    if not norm < OVERFLOW:
        return NOT_FINITE
    P.count.rejected += 1
    C.equal, C.norm = 0, norm
    C.h *= cut(P, C, shrunk(SAFETY * norm, ORDER))
    return RUNNING


@native
def fixed_step(P: Problem) -> float:
    """The step when HINIT, HMAX and HMIN say that all are equal, else 0."""
    s = P.settings
    return s.h_init if s.h_init > 0.0 and s.h_init == s.h_max and s.h_init == s.h_min else 0.0


@native
def limit_step(P: Problem, C: Control) -> None:
    """Keep the step within its pace, the horizon and, when stepped onto, the output times."""
    set_pace(P, C.t)
    left = horizon(P) - C.t
    C.h = min(C.h, longest_step(P))
    if not P.settings.interpolate and C.fixed == 0.0:
        C.h = fitted(C.h, step_limit(P, C.row) - C.t, round_off(P, C))
    elif C.h * LONGER + round_off(P, C) > left:
        C.h = left
    elif C.fixed == 0.0 and 2.0 * C.h > left:
        C.h = 0.5 * left


@native
def choose_step(P: Problem, C: Control, norm: float) -> None:
    """The next step; one that was divided grows back."""
    h = C.h
    if C.fixed > 0.0:
        C.h = min(2.0 * h, C.fixed)
        return
    C.equal += 1
    factor = step_ratio(SAFETY * norm, ORDER)
    room = min(MOST_GROWTH, longest_step(P) / h)
    if (C.equal > 1 and min(factor, room) > LEAST_GROWTH) or factor < LEAST_SHRINK:
        C.h *= cut(P, C, min(factor, room))
        C.equal = 0
