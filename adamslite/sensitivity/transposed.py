"""The systems of a step and of accelerations, transposed, at the state in the workspace."""

from __future__ import annotations

from adamslite.integrators.accelerations import acceleration_matrix
from adamslite.integrators.audit_record import TAPE_HEAD, TAPE_STEP, TAPE_TIME
from adamslite.integrators.contract import DONE, SINGULAR_MASS, Problem
from adamslite.integrators.linalg.blocks import factor
from adamslite.integrators.linalg.plan import Plan
from adamslite.integrators.linalg.transposed import solve_transposed
from adamslite.integrators.motion_equations import jacobian, track
from adamslite.integrators.radau.control import Control
from adamslite.integrators.radau.stages import put_stage
from adamslite.native.translate import Reals, copy, native
from adamslite.sensitivity.corrector import matrix
from adamslite.sensitivity.rates import take_state

ENTRY = "adamslite.sensitivity.transposed.transposed"
# What is to be done.
FACTOR_STEP, SOLVE_STEP, FACTOR_RATES, SOLVE_RATES, TAKE, TRACK, BLOCKS, LAY, PUT_STAGE = range(9)


@native
def transposed(P: Problem, L: Plan, task: int, cu: float) -> int:
    """Do one of these at the state in the workspace.

    FACTOR_STEP, FACTOR_RATES: the matrix of a step with the coefficient ``cu``, or that of
    accelerations; SOLVE_STEP, SOLVE_RATES: replace F by the solution of the transposed system;
    TAKE: the state into the unknowns; TRACK: let kernels remember their angles; BLOCKS: the
    Jacobian of phases ``cu`` with the coefficients in place; LAY: the history of the step with the
    row ``cu`` of the tape; PUT_STAGE and the next two: a stage of it, of a step of size ``cu``.
    """
    if task == FACTOR_STEP:
        return DONE if matrix(P, L, cu) else SINGULAR_MASS
    if task == FACTOR_RATES:
        acceleration_matrix(P)
        return DONE if factor(L, P.LA, P.pivots_a, P.work) else SINGULAR_MASS
    if task == SOLVE_STEP:
        solve_transposed(L, P.LV, P.pivots, P.F, P.x, P.work)
    elif task == SOLVE_RATES:
        solve_transposed(L, P.LA, P.pivots_a, P.F, P.x, P.work)
    elif task == TAKE:
        take_state(P)
    elif task == TRACK:
        track(P)
    elif task == BLOCKS:
        jacobian(P, int(cu), P.coef, P.J)
    elif task == LAY:
        lay(P, P.tape.data[int(cu) * P.tape.width :])
    else:
        put_stage(P, task - PUT_STAGE + 1, cu)
    return DONE


@native
def lay(P: Problem, here: Reals) -> None:
    """The history of a step by stages from its row of the tape."""
    C = Control(P.control)
    C.t = here[TAPE_TIME] - here[TAPE_STEP]
    behind = TAPE_HEAD + P.W.size
    copy(P.base, here[behind:], 9 * P.sizes.nb)
    copy(P.history, here[behind + 9 * P.sizes.nb :], P.tape.kept)
