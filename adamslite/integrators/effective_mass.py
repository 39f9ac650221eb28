"""Effective masses: of bodies on which forces act that are linear in their own acceleration.

    F(a) = F(0) + E a,    E = M - df/da    (3 x 3 of a point, 6 x 6 of a part)

Nothing else of the equations depends on accelerations, so that E is what the acceleration matrix
consists of.
"""

from __future__ import annotations

from adamslite.integrators.contract import ADDED_MASS, Problem
from adamslite.integrators.linalg.blocks import invert
from adamslite.integrators.linalg.dense import negative_pivots
from adamslite.integrators.motion_equations import put_mass
from adamslite.native.translate import Reals, call_address, native


@native
def effective_masses(P: Problem, E: Reals) -> None:
    """E of every body at the workspace's state, where its block of the Jacobian is."""
    body, c, g = P.body, P.coef, P.group
    for b in range(P.sizes.nb):
        put_mass(P, b, E, body[b].block)
    c[0], c[1], c[2], c[3], c[4] = 0.0, 0.0, 1.0, 0.0, 0.0
    for k in range(P.sizes.ng):
        if g[k].phases & ADDED_MASS:
            call_address(g[k].jacobian, g[k].count, g[k].ints, g[k].reals, P.W, c, E)


@native
def signature_of_masses(P: Problem, E: Reals, found: Reals, late: float) -> int:
    """Negative pivots of E, which go to ``found``; -1 when it is singular.  Replaces E."""
    count = 0
    for b in range(P.sizes.nb):
        w, at, i = P.body[b].width, P.body[b].block, P.body[b].first
        count += negative_pivots(E, at, w, P.work, found, i, late)
        if not invert(E, at, w, P.pivots_a, 0, P.work):
            return -1
    return count
