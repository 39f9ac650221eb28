"""Control numbers of an implicit method between steps, and its last accepted multipliers."""

from __future__ import annotations

from adamslite.integrators.contract import (
    Problem,
)
from adamslite.native.translate import native

RUNNING = -1


# Places in P.control.
(
    NOW, H, K, K_TOP, EQUAL, NEXT, H_LAST, FACTORED, RATE, FRESH, AGE, RETRIES, SIGNATURE, BLAMED,
) = range(14)  # fmt: skip


NORM, NOISY = 30, 31


@native
def keep_algebraic(P: Problem) -> None:
    """Remember multipliers and variables of the accepted state."""
    for i in range(P.z.size):
        P.rz[i] = P.z[i]
