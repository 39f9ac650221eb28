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
from adamslite.integrators.linalg.plan import Plan
from adamslite.integrators.motion_equations import (
    PART,
    POINT,
    back_rotate,
    jacobian,
    only_points,
    put_motion,
    put_pose,
    put_scalars,
    residual,
    spread,
)
from adamslite.integrators.newton import (
    ROUND_OFF,
    SHRINKING,
    multiplier_change,
    renews,
    serves,
    unresisted_change,
    weigh_residuals,
)
from adamslite.integrators.stepping.outcome import OVERFLOW
from adamslite.native.translate import Alone, Reals, maximum, native

# Newton stops when the estimated remaining error is this share of ERROR; after a single iteration,
# whose rate is not known, only when the increment is this share of that.
CORRECTOR_SHARE, QUIET = 0.001, 0.01
# The rate of convergence is not believed to be worse than this: SLOW comes first.
WORST_RATE = 0.999
# A matrix kept from an earlier step is discarded when increments shrink by less than this, and
# renewed for the next step when this one took more iterations.
SLOW, MOST_ITERATIONS = 0.3, 4
# ... or after this many steps, or when the step has changed by this share.
KEEP_STEPS, KEEP_RATIO = 50, 1e-3
# Increments of full Newton that grow this much do not converge.
DIVERGING = 2.0
# Rotations within a step below this change the matrix less than a kept one is allowed to be off.
SMALL_TURN = 0.02


@native
def correct(P: Problem, L: Plan, C: Control) -> bool:
    """Newton from the prediction; True when converged.

    A kept matrix that converges slowly is no longer believed: back to the prediction, or on from
    here when the matrix was made in this step, with a new matrix at every iteration.  Where that
    happens again and again, the next ones are renewed before that age.
    """
    error, last = error_limit(P, C.fixed), 0.0
    # Where velocities are tested, they are off by that of positions / h.
    tolerance = CORRECTOR_SHARE * error * (min(1.0, C.h) if first_order_share(P) > 0.0 else 1.0)
    full, tries, felt, small = False, 0, 0.0, False
    C.fresh, C.made = False, -1
    C.reach = weigh_residuals(P, 1.0 / C.ca, 0.0)
    while tries < P.settings.max_it:
        if full or not matrix_fits(C) or renews(P, tries, C.age < C.life):
            C.factored, C.fresh, C.age, C.made = C.h, True, 0, tries
            if not newton_matrix(P, L, C):
                C.factored = 0.0
                return False
        residual(P, INDEX3, P.F)
        before, felt = felt, unresisted_change(P, 1.0 / C.cs)
        if small and serves(felt, before, error, CORRECTOR_SHARE):
            note_service(C, tries)
            return True
        solve(L, P.LV, P.pivots, P.F, P.x, P.work)
        size = move_all(P, C, P.F)
        P.count.newton += 1
        tries += 1
        P.report.iteration = tries
        exact = C.made + 1 == tries
        small = remaining(size, last, tries, exact) <= tolerance
        if small:
            if exact or serves(felt, before, error, CORRECTOR_SHARE):
                note_service(C, tries)
                return True
            full = tries > 1 and felt > SHRINKING * before
        elif not size < OVERFLOW or (tries > 1 and size > SLOW * last):
            if full and not size < DIVERGING * last:
                return False
            if not full and (not C.fresh or not size < last):
                note_failure(C)
                predict(P, C)
                tries = 0
            full = True
        last = size
    return False


@native
def note_service(C: Control, tries: int) -> None:
    """The matrix has served a step."""
    if tries > MOST_ITERATIONS:
        C.factored = 0.0
    C.served += 1
    if C.served > KEEP_STEPS and C.life < KEEP_STEPS:
        C.life, C.served = min(2 * C.life, KEEP_STEPS), 0


@native
def note_failure(C: Control) -> None:
    """The matrix has not served: too old, if it was not made in this step, and if that is usual."""
    if not C.fresh:
        C.life = C.life if C.served > KEEP_STEPS else max(1, C.age)
        C.served = 0


@native
def remaining(size: float, last: float, tries: int, exact: bool) -> float:
    """Error left after an increment of ``size`` when the one before was ``last``.

    A matrix of this very iterate (``exact``) leaves less than its increment, which may be noise.
    """
    if tries == 1:
        return size / QUIET
    rate = min(size / last, 0.5 if exact else WORST_RATE)
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
        for k in range(0, P.turning.size, 4):
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
    q, u, a, largest = P.q, P.u, P.a, 0.0
    if only_points(P):
        largest = move_places(q, u, a, dz, P.sizes.n, C.cu, C.ca)
    else:
        for b in range(P.sizes.nb):
            i = P.body[b].first
            size = move_places(q[i:], u[i:], a[i:], dz[i:], POINT, C.cu, C.ca)
            if P.body[b].width == PART:
                size = maximum(size, turn_part(P, C, i, dz))
            largest = maximum(largest, size)
    put_pose(P, q)
    put_motion(P, u, a)
    if largest <= ROUND_OFF * C.reach:
        largest = 0.0
    return maximum(largest, move_scalars(P, C, dz))


@native
def move_places(q: Alone, u: Alone, a: Alone, dz: Alone, count: int, cu: float, ca: float) -> float:
    """Subtract increments of positions; returns the largest against max(1, |q|)."""
    largest = 0.0
    for i in range(count):
        d = dz[i]
        x = q[i] - d
        q[i] = x
        u[i] -= cu * d
        a[i] -= ca * d
        largest = maximum(largest, abs(d) / max(1.0, abs(x)))
    return largest


@native
def turn_part(P: Problem, C: Control, i: int, dz: Reals) -> float:
    """Subtract the rotation of the part whose positions start at ``i``; returns its size."""
    largest = 0.0
    back_rotate(P.q, dz, i, dz)
    for k in range(i + 3, i + 6):
        P.u[k] -= C.cu * dz[k]
        P.a[k] -= C.ca * dz[k]
        largest = maximum(largest, abs(dz[k]))
    turn_from_start(P, C, i)
    return largest


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
