"""The corrector of HHT and NEWMARK: Newton on q, lam, V and s, from the prediction.

Iterations stop when rate/(1 - rate) times the last increment is a small share of ERROR.
"""

from __future__ import annotations

from adamslite.integrators.contract import INDEX3, Problem
from adamslite.integrators.hht.control import Control
from adamslite.integrators.hht.error import first_order_share
from adamslite.integrators.hht.prediction import predict, turn_from_start
from adamslite.integrators.implicit.tolerance import error_limit
from adamslite.integrators.linalg.blocks import factor, solve
from adamslite.integrators.linalg.norms import exceeds
from adamslite.integrators.linalg.plan import Plan
from adamslite.integrators.motion_equations import (
    PART,
    attitude,
    back_rotate,
    jacobian,
    put_scalars,
    residual,
    spread,
)
from adamslite.integrators.newton import ROUND_OFF, multiplier_change, renews
from adamslite.integrators.stepping.outcome import OVERFLOW
from adamslite.native.translate import Reals, native

# Newton stops when the estimated remaining error is this share of ERROR; after a single iteration,
# whose rate is not known, only when the increment is this share of that.
CORRECTOR_SHARE, QUIET = 0.001, 0.01
# The rate of convergence is not believed to be worse than this: SLOW comes first.
WORST_RATE = 0.999
# A matrix kept from an earlier step is discarded when increments shrink by less than this, and
# renewed for the next step when this one took more iterations.
SLOW, MOST_ITERATIONS = 0.3, 4
# ... or after this many steps, or when the step has changed by this share.
KEEP_STEPS, KEEP_RATIO = 50.0, 1e-3
# Increments of full Newton that grow this much do not converge.
DIVERGING = 2.0
# Rotations within a step below this change the matrix less than a kept one is allowed to be off.
SMALL_TURN = 0.02


@native
def correct(P: Problem, L: Plan, C: Control) -> bool:
    """Newton from the prediction; True when converged.

    A kept matrix that converges slowly is no longer believed: back to the prediction, or on from
    here when the matrix was made in this step, with a new matrix at every iteration.
    """
    tolerance, last = CORRECTOR_SHARE * error_limit(P, C.fixed), 0.0
    if first_order_share(P) > 0.0:
        tolerance *= min(1.0, C.h)  # Velocities are tested: they are off by that of positions / h.
    full, tries = False, 0
    C.fresh = False
    while tries < P.settings.max_it:
        if full or not matrix_fits(C) or renews(P, tries, C.age < KEEP_STEPS):
            C.factored, C.fresh, C.age = C.h, True, 0
            if not newton_matrix(P, L, C):
                C.factored = 0.0
                return False
        residual(P, INDEX3, P.F)
        solve(L, P.LV, P.pivots, P.F, P.x, P.work)
        size = move_all(P, C, P.F)
        P.count.newton += 1
        tries += 1
        P.report.iteration = tries
        if remaining(size, last, tries) <= tolerance:
            if tries > MOST_ITERATIONS:
                C.factored = 0.0
            return True
        if not size < OVERFLOW or (tries > 1 and size > SLOW * last):
            if full and not size < DIVERGING * last:
                return False
            if not full and (not C.fresh or not size < last):
                predict(P, C)
                tries = 0
            full = True
        last = size
    return False


@native
def remaining(size: float, last: float, tries: int) -> float:
    """Error left after an increment of ``size`` when the one before was ``last``."""
    if tries == 1:
        return size / QUIET
    rate = min(size / last, WORST_RATE)
    return size * rate / (1.0 - rate)


@native
def matrix_fits(C: Control) -> bool:
    """Whether there is a factored matrix for this step."""
    return C.factored != 0.0 and abs(C.h / C.factored - 1.0) <= KEEP_RATIO


@native
def newton_matrix(P: Problem, L: Plan, C: Control) -> bool:
    """Assemble and factor dF/d(q, lam, V, s) = F_q + (cu F_u + ca F_a) T at the workspace's
    state; T = I - [c]/2 + c c^T/4 for rotations.
    """
    c = P.coef
    c[0], c[1], c[2], c[3], c[4] = 1.0, C.cu, C.ca, 1.0, C.cs
    jacobian(P, INDEX3, c, P.J)
    if P.turning.size > 0 and largest_turn(P) > SMALL_TURN:
        c[0], c[3], c[4] = 0.0, 0.0, 0.0
        jacobian(P, INDEX3, c, P.D)
        for k in range(0, P.turning.size, 3):
            turn_columns(P, P.turning[k], P.turning[k + 1], P.turning[k + 2])
    spread(P, P.LV)
    for k in range(P.unit.size):
        P.LV[P.unit[k]] = 1.0
    P.count.factorizations += 1
    return factor(L, P.LV, P.pivots, P.work)


@native
def largest_turn(P: Problem) -> float:
    """Largest component of the rotation vectors within this step."""
    top = 0.0
    for b in range(P.sizes.nb):
        if P.body[b].width == PART:
            for k in range(3, 6):
                top = max(top, abs(P.q[P.body[b].first + k]))
    return top


@native
def turn_columns(P: Problem, at: int, rows: int, b: int) -> None:
    """J[:, 3:6] += D[:, 3:6] (T - I) on one block."""
    J, D, i = P.J, P.D, P.body[b].first
    x, y, z = P.q[i + 3], P.q[i + 4], P.q[i + 5]
    for r in range(rows):
        o = at + 6 * r + 3
        d, e, f = D[o], D[o + 1], D[o + 2]
        along = 0.25 * (d * x + e * y + f * z)
        J[o] += along * x - 0.5 * (e * z - f * y)
        J[o + 1] += along * y - 0.5 * (f * x - d * z)
        J[o + 2] += along * z - 0.5 * (d * y - e * x)


@native
def move_all(P: Problem, C: Control, dz: Reals) -> float:
    """Subtract a Newton increment from all unknowns, there and in the workspace.

    Returns the largest increment of positions, rotations, variables and states, each against
    max(1, |value|); at the round-off of positions it counts as none.
    """
    W, q, u, a = P.W, P.q, P.u, P.a
    cu, ca, noise, largest = C.cu, C.ca, ROUND_OFF * C.reach, 0.0
    for b in range(P.sizes.nb):
        kind, i, o = P.body[b].width, P.body[b].first, P.body[b].at
        for k in range(3):
            d = dz[i + k]
            x, v, w = q[i + k] - d, u[i + k] - cu * d, a[i + k] - ca * d
            q[i + k], u[i + k], a[i + k] = x, v, w
            W[o + k], W[o + 3 + k], W[o + 6 + k] = x, v, w
            # Compared before divided: few elements ever set a new maximum.
            if exceeds(abs(d), largest * max(1.0, abs(x))):
                largest = abs(d) / max(1.0, abs(x))
        if kind == PART:
            back_rotate(q, dz, i, dz)
            for k in range(3, 6):
                d = dz[i + k]
                u[i + k] -= cu * d
                a[i + k] -= ca * d
                W[o + 6 + k], W[o + 9 + k] = u[i + k], a[i + k]
                if exceeds(abs(d), largest):
                    largest = abs(d)
            turn_from_start(P, C, i)
            attitude(q[i + 3], q[i + 4], q[i + 5], P.base, 9 * b, W, o + 15)
    if largest <= noise:
        largest = 0.0
    return max(largest, move_scalars(P, C, dz))


@native
def move_scalars(P: Problem, C: Control, dz: Reals) -> float:
    """The share of multipliers, variables and states in :func:`move_all`, the same round-off."""
    n, m, ns, first, largest = P.sizes.n, P.sizes.m, P.sizes.ns, P.sizes.m + P.sizes.nv, 0.0
    for k in range(first + ns):
        P.z[k] -= dz[n + k]
        if k >= m and not abs(dz[n + k]) <= max(largest, ROUND_OFF) * max(1.0, abs(P.z[k])):
            largest = abs(dz[n + k]) / max(1.0, abs(P.z[k]))
    for k in range(ns):
        P.rd[k] -= C.cs * dz[n + first + k]
    put_scalars(P, P.z, P.rd)
    if P.settings.all_converge:
        largest = max(largest, multiplier_change(P, dz, P.z, C.ca))
    return largest
