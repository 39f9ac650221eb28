"""Notes on a failed corrector, for the message: the unknown that moved, the open equation."""

from __future__ import annotations

from adamslite.integrators.contract import (
    ACCELERATION,
    Problem,
)
from adamslite.integrators.linalg.norms import exceeds
from adamslite.integrators.motion_equations import residual
from adamslite.native.translate import native, rare


@native
@rare
def note_trouble(P: Problem, phases: int, iteration: int) -> None:
    """Keep the unknown with the largest last increment (in ``P.F``), against max(1, |value|), and
    the equation with the largest residual at the workspace's state; overwrites ``P.F``.
    """
    n, where, top = P.sizes.n, 0, -1.0
    solved = P.a if phases == ACCELERATION else P.q
    for k in range(P.sizes.nz):
        value = 0.0
        if k < n:
            value = solved[k]
        elif k - n < P.z.size - 1:
            value = P.z[k - n]
        weight = max(1.0, abs(value))
        if exceeds(abs(P.F[k]), top * weight):
            where, top = k, abs(P.F[k]) / weight
    P.report.changed, P.report.change, P.report.iteration = where, top, iteration
    residual(P, phases, P.F)
    where, top = 0, -1.0
    for k in range(P.sizes.nz):
        if exceeds(abs(P.F[k]), top):
            where, top = k, abs(P.F[k])
    P.report.open_row, P.report.open_by = where, top


@native
@rare
def wildest(P: Problem) -> int:
    """The unknown with the largest last increment, numbered as in the error test."""
    n, first, where, top = P.sizes.n, P.sizes.m + P.sizes.nv, 0, -1.0
    for i in range(n):
        if exceeds(abs(P.F[i]), top * max(1.0, abs(P.q[i]))):
            top, where = abs(P.F[i]) / max(1.0, abs(P.q[i])), i
    for k in range(first, first + P.sizes.ns):
        if exceeds(abs(P.F[n + k]), top * max(1.0, abs(P.z[k]))):
            top, where = abs(P.F[n + k]) / max(1.0, abs(P.z[k])), 2 * n + k - first
    return where
