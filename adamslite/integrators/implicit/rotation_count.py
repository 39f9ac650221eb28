"""Rotation vectors relative to a new reference attitude."""

from __future__ import annotations

from adamslite.native.translate import Reals, native


@native
def count_anew(D: Reals, p: int, c0: float, c1: float, c2: float) -> None:
    """The Cayley vector at ``p`` counted from the attitude of the vector c: cay(a) cay(-c)."""
    a0, a1, a2 = D[p], D[p + 1], D[p + 2]
    s = 1.0 / (1.0 + 0.25 * (a0 * c0 + a1 * c1 + a2 * c2))
    D[p] = s * (a0 - c0 - 0.5 * (a1 * c2 - a2 * c1))
    D[p + 1] = s * (a1 - c1 - 0.5 * (a2 * c0 - a0 * c2))
    D[p + 2] = s * (a2 - c2 - 0.5 * (a0 * c1 - a1 * c0))
