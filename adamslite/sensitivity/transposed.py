"""The systems of a step and of accelerations, transposed, at the state in the workspace."""

from __future__ import annotations

from adamslite.integrators.accelerations import acceleration_matrix
from adamslite.integrators.contract import DONE, SINGULAR_MASS, Problem
from adamslite.integrators.linalg.blocks import factor
from adamslite.integrators.linalg.plan import Plan
from adamslite.integrators.linalg.transposed import solve_transposed
from adamslite.integrators.motion_equations import track
from adamslite.native.translate import native
from adamslite.sensitivity.differences import matrix
from adamslite.sensitivity.rates import take_state

ENTRY = "adamslite.sensitivity.transposed.transposed"
# What is to be done.
FACTOR_STEP, SOLVE_STEP, FACTOR_RATES, SOLVE_RATES, TAKE, TRACK = range(6)


@native
def transposed(P: Problem, L: Plan, task: int, cu: float) -> int:
    """Do one of these at the state in the workspace.

    FACTOR_STEP, FACTOR_RATES: the matrix of a step with the coefficient ``cu``, or that of
    accelerations; SOLVE_STEP, SOLVE_RATES: replace F by the solution of the transposed system;
    TAKE: the state into the unknowns; TRACK: let kernels remember their angles.
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
    else:
        track(P)
    return DONE
