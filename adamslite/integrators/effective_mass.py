"""Effective masses: of bodies on which forces act that are linear in their own acceleration.

    F(a) = F(0) + E a,    E = M - df/da    (3 x 3 of a point, 6 x 6 of a part)

Nothing else of the equations depends on accelerations, so that E is what the acceleration matrix
consists of.
"""

from __future__ import annotations

from adamslite.integrators.contract import ADDED_MASS, Problem
from adamslite.integrators.linalg.blocks import invert
from adamslite.integrators.linalg.dense import negative_pivots
from adamslite.integrators.linalg.plan import TINY
from adamslite.integrators.motion_equations import POINT, put_mass, put_point
from adamslite.native.translate import Reals, call_address, native

# A pivot above this share of what it was, and of the rest of its row, is no round-off.
CLEAR = 1e-6


@native
def effective_masses(P: Problem, E: Reals) -> None:
    """E of every body at the workspace's state, where its block of the Jacobian is."""
    body, c, g = P.body, P.coef, P.group
    for b in range(P.sizes.nb):
        if body[b].width == POINT:
            put_point(P.mass[b], E[body[b].block :])
        else:
            put_mass(P, b, E, body[b].block)
    c[0], c[1], c[2], c[3], c[4] = 0.0, 0.0, 1.0, 0.0, 0.0
    for k in range(P.sizes.ng):
        if g[k].phases & ADDED_MASS:
            call_address(g[k].jacobian, g[k].count, g[k].ints, g[k].reals, P.W, c, E)


@native
def divide_by_masses(P: Problem, E: Reals, F: Reals, a: Reals) -> bool:
    """a = -E^-1 F of point masses; False when one is singular."""
    for m in range(P.sizes.nb):
        o, k = P.body[m].block, P.body[m].first
        e, f, g = E[o], E[o + 4], E[o + 8]
        beside = abs(E[o + 1]) + abs(E[o + 2]) + abs(E[o + 3])
        beside += abs(E[o + 5]) + abs(E[o + 6]) + abs(E[o + 7])
        if beside == 0.0 and abs(e * f * g) > TINY:
            a[k], a[k + 1], a[k + 2] = 0.0 - F[k] / e, 0.0 - F[k + 1] / f, 0.0 - F[k + 2] / g
        elif not by_cramer(E, o, F[k:], a[k:]):
            return False
    return True


@native
def by_cramer(E: Reals, o: int, F: Reals, a: Reals) -> bool:
    """a = -E^-1 F with the 3 x 3 block at ``o``; False when it is singular."""
    b, c, d, f, g, h = E[o + 1], E[o + 2], E[o + 3], E[o + 5], E[o + 6], E[o + 7]
    p, q, r = E[o + 4] * E[o + 8] - f * h, f * g - d * E[o + 8], d * h - E[o + 4] * g
    det = E[o] * p + b * q + c * r
    if not abs(det) > TINY:
        return False
    w = -1.0 / det
    x, y, z = w * F[0], w * F[1], w * F[2]
    a[0] = p * x + (c * h - b * E[o + 8]) * y + (b * f - c * E[o + 4]) * z
    a[1] = q * x + (E[o] * E[o + 8] - c * g) * y + (c * d - E[o] * f) * z
    a[2] = r * x + (b * g - E[o] * h) * y + (E[o] * E[o + 4] - b * d) * z
    return True


@native
def signature_of_masses(P: Problem, E: Reals, found: Reals, late: float) -> int:
    """Negative pivots of E, which go to ``found``; -1 when it is singular.  Replaces E."""
    count = 0
    for b in range(P.sizes.nb):
        w, at, i = P.body[b].width, P.body[b].block, P.body[b].first
        if w == POINT and clear_pivots(E, at, found, i):
            for k in range(3):
                count += 1 if found[i + k] < 0.0 else 0
        else:
            count += negative_pivots(E, at, w, P.work, found, i, late)
            if not invert(E, at, w, P.pivots_a, 0, P.work):
                return -1
    return count


@native
def clear_pivots(E: Reals, o: int, found: Reals, i: int) -> bool:
    """Pivots of a 3 x 3 block eliminated along its diagonal, to ``found``; False when one of them
    might be round-off.
    """
    first, b, c = E[o], E[o + 1], E[o + 2]
    if not abs(first) > CLEAR * max(abs(b), abs(c)):
        return False
    f, g = E[o + 3] / first, E[o + 6] / first
    second, across = E[o + 4] - f * b, E[o + 5] - f * c
    if not abs(second) > CLEAR * max(abs(E[o + 4]), abs(across)):
        return False
    third = E[o + 8] - g * c - (E[o + 7] - g * b) / second * across
    found[i], found[i + 1], found[i + 2] = first, second, third
    return abs(third) > CLEAR * abs(E[o + 8])
