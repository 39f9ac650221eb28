"""The unknown that keeps a corrector from converging."""

from __future__ import annotations

from adamslite.integrators.contract import Problem
from adamslite.integrators.linalg.norms import exceeds
from adamslite.native.translate import native, rare


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
