"""The equations that a corrector solves: index 3 or the stabilised form."""

from __future__ import annotations

from adamslite.integrators.contract import INDEX3, STABILISED, Problem
from adamslite.native.translate import native


@native
def is_stabilised(P: Problem) -> bool:
    """Whether constraints are kept on positions and velocities."""
    return P.sizes.si2 and P.sizes.holonomic > 0


@native
def equations_kept(P: Problem) -> int:
    """The groups of kernels that make the equations."""
    return STABILISED if is_stabilised(P) else INDEX3
