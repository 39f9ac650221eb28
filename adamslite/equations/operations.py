"""The native entry of all operations on equations but integration, and what methods share."""

from __future__ import annotations

from adamslite.integrators.accelerations import accelerations, mass_signature, put_state
from adamslite.integrators.audit.balance import add_leap, add_step, audit_from, start_balance
from adamslite.integrators.contract import (
    ACCELERATIONS,
    AUDIT,
    BROKEN_START,
    CLOCK,
    DONE,
    EQUILIBRIUM,
    FACTOR,
    MODE_STATICS,
    RECORD,
    RECORD_AT_REST,
    RESIDUAL,
    RESIDUAL_AT_REST,
    SINGULAR_MASS,
    SOLVE,
    SPECTRUM,
    Problem,
)
from adamslite.integrators.equilibrium import equilibrium
from adamslite.integrators.events.events import change_here, pass_event, start_events
from adamslite.integrators.events.guards import hold_watch, keep_margins, let_go
from adamslite.integrators.events.harmless import take_harmless
from adamslite.integrators.events.search import judge, open_search
from adamslite.integrators.events.stops import sample_clock, set_clock, set_pace
from adamslite.integrators.failure_notes import wildest
from adamslite.integrators.implicit.step_size import first_step, jerk, retry_factor
from adamslite.integrators.implicit.tolerance import weighted
from adamslite.integrators.linalg.blocks import add_to_diagonal, factor, solve
from adamslite.integrators.linalg.plan import Plan
from adamslite.integrators.motion_equations import (
    jacobian,
    project_on_constraints,
    residual,
    spread,
    track,
    vector_rates,
    velocities,
)
from adamslite.integrators.newton import apply_increment, multiplier_change
from adamslite.integrators.records import note_violation, write_record
from adamslite.integrators.step_back import before_trouble, make_undoable
from adamslite.integrators.stepping.outcome import count_from_here
from adamslite.integrators.unconstrained import spectrum
from adamslite.native.translate import native

SHARED = (
    add_leap,
    add_step,
    apply_increment,
    audit_from,
    before_trouble,
    change_here,
    count_from_here,
    first_step,
    hold_watch,
    jerk,
    judge,
    keep_margins,
    let_go,
    make_undoable,
    mass_signature,
    multiplier_change,
    note_violation,
    open_search,
    pass_event,
    project_on_constraints,
    retry_factor,
    set_clock,
    set_pace,
    start_events,
    take_harmless,
    vector_rates,
    velocities,
    weighted,
    wildest,
)
"""What several methods call besides what the operations reach; compiled once, with them."""


@native
def run(P: Problem, L: Plan, operation: int, phases: int) -> int:
    """Do one operation on the state in q, u, a, z and rd at time ``settings[T]``; RECORD writes
    row ``phases``; what is AT_REST has the MODE of statics; CLOCK writes the guards of the clock
    at output times; AUDIT starts a balance; FACTOR eliminates the blocks of J with F added to the
    diagonal, SOLVE replaces F by the solution.
    """
    if operation == FACTOR or operation == SOLVE:
        return eliminated(P, L, operation)
    if operation == CLOCK:
        return sample_clock(P)
    if operation == EQUILIBRIUM:
        return equilibrium(P, L)
    if operation == ACCELERATIONS:
        good = accelerations(P, L, P.settings.t, P.q, P.u, P.a, P.z, P.rd)
        return DONE if good else BROKEN_START
    put_state(P, P.settings.t, P.q, P.u, P.a, P.z, P.rd)
    if operation == SPECTRUM:
        return spectrum(P)
    if operation == RECORD_AT_REST or operation == RESIDUAL_AT_REST:
        P.W[1] = MODE_STATICS
    if operation == RECORD or operation == RECORD_AT_REST:
        write_record(P, phases)
        track(P)
    elif operation == AUDIT:
        start_balance(P)
    elif operation == RESIDUAL or operation == RESIDUAL_AT_REST:
        residual(P, phases, P.F)
    else:
        jacobian(P, phases, P.coef, P.J)
    return DONE


@native
def eliminated(P: Problem, L: Plan, operation: int) -> int:
    """Factor the matrix of the blocks, or solve with it."""
    if operation == SOLVE:
        solve(L, P.LA, P.pivots_a, P.F, P.x, P.work)
        return DONE
    spread(P, P.LA)
    add_to_diagonal(L, P.F, P.LA, P.x)
    return DONE if factor(L, P.LA, P.pivots_a, P.work) else SINGULAR_MASS
