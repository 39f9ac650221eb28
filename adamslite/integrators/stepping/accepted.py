"""The accepted state: what every method keeps of it besides its own history."""

from __future__ import annotations

from adamslite.integrators.contract import Problem
from adamslite.integrators.motion_equations import PART
from adamslite.native.translate import native


@native
def keep_solution(P: Problem) -> None:
    """Accelerations, multipliers, variables and states in place are the accepted ones."""
    for i in range(P.sizes.n):
        P.ra[i] = P.a[i]
    for i in range(P.z.size):
        P.rz[i] = P.z[i]


@native
def count_from_here(P: Problem) -> None:
    """The workspace's attitudes become the base of rotation vectors."""
    for b in range(P.sizes.nb):
        if P.body[b].width == PART:
            i, o = P.body[b].first, P.body[b].at
            for k in range(9):
                P.base[9 * b + k] = P.W[o + 15 + k]
            for k in range(3, 6):
                P.q[i + k] = 0.0
