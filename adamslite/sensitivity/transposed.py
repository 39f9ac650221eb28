"""The systems of a step and of accelerations, transposed, at the state in the workspace."""

from __future__ import annotations

from adamslite.integrators.accelerations import acceleration_matrix
from adamslite.integrators.audit_record import TAPE_HEAD, TAPE_STEP, TAPE_TIME
from adamslite.integrators.contract import DONE, SINGULAR_MASS, Problem
from adamslite.integrators.linalg.blocks import factor
from adamslite.integrators.linalg.complex_transposed import solve_transposed_complex
from adamslite.integrators.linalg.plan import Plan
from adamslite.integrators.linalg.transposed import solve_transposed
from adamslite.integrators.motion_equations import WATCH, guard_values, jacobian, track
from adamslite.integrators.radau.coefficients import TO_MODES, TO_STAGES
from adamslite.integrators.radau.control import Z_ROWS, Control
from adamslite.integrators.radau.stages import (
    put_stage,
    radau_jacobian,
    radau_matrices,
    stage_z,
)
from adamslite.native.translate import Reals, copy, native
from adamslite.sensitivity.corrector import matrix
from adamslite.sensitivity.stages import restore_history
from adamslite.sensitivity.tangents import take_state

ENTRY = "adamslite.sensitivity.transposed.transposed"
# What is to be done.
FACTOR_STEP, SOLVE_STEP, FACTOR_RATES, SOLVE_RATES, TAKE, TRACK, BLOCKS, LAY = range(8)
FACTOR_STAGES, SOLVE_STAGES, GUARDS, PUT_STAGE = 8, 9, 10, 11


@native
def transposed(P: Problem, L: Plan, task: int, cu: float) -> int:
    """Do one of these at the state in the workspace.

    FACTOR_STEP, FACTOR_RATES: the matrix of a step with the coefficient ``cu``, or that of
    accelerations; SOLVE_STEP, SOLVE_RATES: replace F by the solution of the transposed system;
    TAKE: the state into the unknowns; TRACK: let kernels remember their angles; BLOCKS: the
    Jacobian of phases ``cu`` with the coefficients in place; LAY: the history of the step with the
    row ``cu`` of the tape; FACTOR_STAGES: both matrices at its middle stage, for a step of size
    ``cu``; SOLVE_STAGES: the transposed increments of its stages in the place of their residuals;
    GUARDS: values of watched guards; PUT_STAGE and the next two: a stage of it, of a step of size
    ``cu``.
    """
    if task == FACTOR_STEP or task == FACTOR_RATES or task == FACTOR_STAGES:
        return DONE if factored(P, L, task, cu) else SINGULAR_MASS
    if task == SOLVE_STEP:
        solve_transposed(L, P.LV, P.pivots, P.F, P.x, P.work)
    elif task == SOLVE_RATES:
        solve_transposed(L, P.LA, P.pivots_a, P.F, P.x, P.work)
    elif task == SOLVE_STAGES:
        transposed_increments(P, L)
    elif task == GUARDS:
        guard_values(P, WATCH)
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
def factored(P: Problem, L: Plan, task: int, cu: float) -> bool:
    """Factor what is asked for; False when it is singular."""
    if task == FACTOR_STEP:
        return matrix(P, L, cu)
    if task == FACTOR_RATES:
        acceleration_matrix(P)
        return factor(L, P.LA, P.pivots_a, P.work)
    radau_jacobian(P, 2, cu)
    return radau_matrices(P, L, cu)


@native
def lay(P: Problem, here: Reals) -> None:
    """The history of a step by stages from its row of the tape."""
    C = Control(P.control)
    C.t = here[TAPE_TIME] - here[TAPE_STEP]
    behind = TAPE_HEAD + P.W.size
    copy(P.base, here[behind:], 9 * P.sizes.nb)
    restore_history(P, here[behind + 9 * P.sizes.nb :], here[TAPE_STEP])


@native
def transposed_increments(P: Problem, L: Plan) -> None:
    """The transpose of :func:`adamslite.integrators.radau.stages.stage_increments`: a real matrix
    (A, -B; B, A) of the complex one A + i B becomes (A^T, B^T; -B^T, A^T), that of A^T - i B^T.
    """
    nz, X = P.sizes.nz, P.tableau
    R = P.history[stage_z(P, Z_ROWS) :]
    pair, spare = R[3 * nz :], R[5 * nz :]
    for k in range(nz):
        a, b, c = R[k], R[nz + k], R[2 * nz + k]
        o, e, s = TO_STAGES, TO_STAGES + 3, TO_STAGES + 6
        P.F[k] = X[o] * a + X[e] * b + X[s] * c
        pair[2 * k] = X[o + 1] * a + X[e + 1] * b + X[s + 1] * c
        pair[2 * k + 1] = 0.0 - (X[o + 2] * a + X[e + 2] * b + X[s + 2] * c)
    solve_transposed(L, P.LV, P.pivots, P.F, P.x, P.work)
    solve_transposed_complex(L, P.LC, P.pivots_c, pair, spare, P.work)
    for k in range(nz):
        a, b, c = P.F[k], pair[2 * k], 0.0 - pair[2 * k + 1]
        for stage in range(3):
            o = TO_MODES + stage
            R[stage * nz + k] = X[o] * a + X[o + 3] * b + X[o + 6] * c
