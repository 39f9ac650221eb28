"""Why the tries of a step failed, and the unknown with the largest error."""

from __future__ import annotations

from adamslite.integrators.contract import (
    Problem,
)
from adamslite.integrators.implicit.control import (
    StepControl,
)
from adamslite.integrators.linalg.norms import exceeds
from adamslite.native.translate import native

# A sign change of the effective mass is approached to this share of HMAX.
SINGULAR_RESOLUTION = 1e-6


@native
def corrector_failed(C: StepControl) -> bool:
    """Whether the last tries failed for the corrector, not for accuracy."""
    return C.retries > 2 or (C.retries > 0 and C.norm == 0.0)


@native
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
