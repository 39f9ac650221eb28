"""The records of a run at the output times, and the largest constraint violation."""

from __future__ import annotations

from adamslite.integrators.contract import (
    JACOBIANS_AT,
    ORDER_AT,
    OUTPUTS,
    POSITION_ROWS,
    RESIDUALS_AT,
    STEP_AT,
    Problem,
)
from adamslite.integrators.motion_equations import run_groups
from adamslite.native.translate import copy, native

# A redundant row is as exact as the deck, whose lengths may have four digits, and as the rows it
# follows from: within some errors of positions.
LOOSE = 1e-4


@native
def has_room(P: Problem, row: int) -> bool:
    """Whether the record has room for a row; none for one before its first, which was taken away
    before a step was taken back.
    """
    return row >= P.block.first and row - P.block.first < P.block.room


@native
def write_record(P: Problem, row: int) -> None:
    """Workspace and outputs into one row of the record, for which there is room."""
    nw, n_out = P.sizes.nw, P.sizes.n_out
    o = (row - P.block.first) * (nw + n_out)
    P.W[STEP_AT], P.W[ORDER_AT] = P.report.h, float(P.report.order)
    P.W[JACOBIANS_AT], P.W[RESIDUALS_AT] = float(P.count.jacobians), float(P.count.residuals)
    copy(P.record[o:], P.W, nw)
    out = P.record[o + nw :]
    for i in range(n_out):
        out[i] = 0.0
    run_groups(P, OUTPUTS, out)
    P.count.records = row + 1


@native
def note_violation(P: Problem, t: float) -> None:
    """Keep the largest |g| seen at an accepted step.

    A row left out as redundant that opens did not follow from the others but in one posture: the
    run ends there, as a mechanism that locks would otherwise run on torn apart.
    """
    if P.sizes.holonomic == 0:
        return
    for i in range(P.sizes.nz):
        P.F[i] = 0.0
    run_groups(P, POSITION_ROWS, P.F)
    for i in range(P.sizes.n, P.sizes.n + P.sizes.m):
        P.report.violation = max(P.report.violation, abs(P.F[i]))
    reach = 1.0
    for i in range(P.sizes.n):
        reach = max(reach, abs(P.q[i]))
    for k in range(P.dead.size):
        i = P.dead[k]
        if i < P.sizes.n + P.sizes.m and abs(P.F[i]) > (LOOSE + 10.0 * P.settings.error) * reach:
            P.report.torn, P.report.t = i, t
            P.settings.stop = True
