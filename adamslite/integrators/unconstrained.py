"""Accelerations of bodies without constraints: M^-1 f, body by body.

    x'' = f/m + g,        w' = R I^-1 (R^T tau - w_b x I w_b),    w_b = R^T w

for models without constraints, loops of variables and DIFF states; nothing is factored.  tau is
about the mass centre, in ground axes; I in part axes.  Forces that depend on accelerations must be
added mass; the equations of bodies then have their effective masses
(:mod:`adamslite.integrators.effective_mass`).
"""

from __future__ import annotations

from adamslite.integrators.contract import BROKEN_START, DONE, LOADS, Problem
from adamslite.integrators.effective_mass import divide_by_masses, effective_masses
from adamslite.integrators.linalg.blocks import determinant3, invert, invert3, replace, replace3
from adamslite.integrators.linalg.plan import TINY
from adamslite.integrators.motion_equations import (
    PART,
    attitude,
    inertia_forces,
    jacobian,
    only_points,
    put_mass,
    put_motion,
    put_pose,
    put_time,
    run_groups,
)
from adamslite.native.translate import Alone, Ints, Reals, copy, native, rare

# A part's inertia below this share of its largest entry is singular.
SINGULAR = 1e-12
POWERS = 30
# The vector without symmetry with which a search begins: its largest component, and how large
# those are against the components of a vector that is known.
LARGEST, ADDED = 50.3, 0.1
# Squares of accelerations below this are those of a model on which no force depends.
NOTHING = 1e-200


@native
def is_free(P: Problem) -> bool:
    """Whether accelerations follow body by body."""
    if P.sizes.implicit_mass and not P.sizes.added_mass:
        return False
    if P.sizes.m + P.sizes.nv + P.sizes.ns > 0:
        return False
    for b in range(P.sizes.nb):
        if not P.mass[b] > 0.0:
            return False
    return True


@native
def invert_inertia(P: Problem, inverse: Reals) -> bool:
    """I^-1 of every part into ``inverse`` (9 nb,); False when one is singular."""
    for b in range(P.sizes.nb):
        if P.body[b].width == PART:
            top = 0.0
            for k in range(9):
                inverse[9 * b + k] = P.inertia[9 * b + k]
                top = max(top, abs(inverse[9 * b + k]))
            det = invert3(inverse, 9 * b)
            if not abs(det) > SINGULAR * top * top * top:
                return False
    return True


@native
def invert_bodies(P: Problem, A: Reals) -> bool:
    """Inverses of the blocks of all bodies in dF/da, one behind the other; False when one is
    singular.
    """
    at = 0
    if P.sizes.added_mass:
        effective_masses(P, P.J)
    for b in range(P.sizes.nb):
        width = P.body[b].width
        if P.sizes.added_mass:
            copy(A[at:], P.J[P.body[b].block :], width * width)
        else:
            put_mass(P, b, A, at)
        if width == PART:
            if not invert(A, at, width, P.pivots_a, 0, P.work):
                return False
        elif abs(determinant3(A, at)) > TINY:
            invert3(A, at)
        else:
            return False
        at += width * width
    return True


@native
def times_inverse(P: Problem, A: Reals, x: Reals) -> None:
    """x = M^-1 x with the blocks of :func:`invert_bodies`."""
    at = 0
    for b in range(P.sizes.nb):
        width = P.body[b].width
        if width == PART:
            replace(A[at:], width, x[P.body[b].first :], P.work)
        else:
            replace3(A[at:], x[P.body[b].first :])
        at += width * width


@native
def put_free(P: Problem, t: float, q: Reals, u: Reals) -> None:
    """Time, positions and velocities into the workspace; minus the weights into F."""
    W, F, body = P.W, P.F, P.body
    gx, gy, gz = P.gravity[0], P.gravity[1], P.gravity[2]
    put_time(P, t)
    for b in range(P.sizes.nb):
        i, o, m = body[b].first, body[b].at, P.mass[b]
        x, y, z = q[i], q[i + 1], q[i + 2]
        vx, vy, vz = u[i], u[i + 1], u[i + 2]
        W[o], W[o + 1], W[o + 2] = x, y, z
        W[o + 3], W[o + 4], W[o + 5] = vx, vy, vz
        F[i], F[i + 1], F[i + 2] = -m * gx, -m * gy, -m * gz
        if body[b].width == PART:
            attitude(q[i + 3], q[i + 4], q[i + 5], P.base, 9 * b, W, o + 15)
            for k in range(3):
                W[o + 9 + k] = u[i + 3 + k]
                F[i + 3 + k] = 0.0


@native
def free_accelerations(P: Problem, t: float, q: Reals, u: Reals, inverse: Reals, a: Reals) -> bool:
    """a (n,) at positions q, velocities u; False when an effective mass vanishes."""
    if P.sizes.added_mass:
        return accelerations_of_effective(P, t, q, u, a)
    put_free(P, t, q, u)
    run_groups(P, LOADS, P.F)
    P.count.residuals += 1
    divide_by_mass(P, P.F, inverse, 1.0, a)
    return True


@native
def accelerations_of_effective(P: Problem, t: float, q: Reals, u: Reals, a: Reals) -> bool:
    """a = -E^-1 F(0) at positions q, velocities u; False when an effective mass vanishes."""
    for i in range(P.sizes.n):
        a[i] = 0.0
    put_time(P, t)
    put_pose(P, q)
    put_motion(P, u, a)
    inertia_forces(P, P.F)
    run_groups(P, LOADS, P.F)
    P.count.residuals += 1
    if not invert_bodies(P, P.LA):
        return False
    times_inverse(P, P.LA, P.F)
    for i in range(P.sizes.n):
        a[i] = 0.0 - P.F[i]
    return True


@native
def mass_tables(P: Problem, inverse: Reals, weight: Reals) -> bool:
    """-1/m and -m g of every unknown; False when a body turns."""
    for b in range(P.sizes.nb):
        if P.body[b].width == PART:
            return False
        for k in range(3):
            inverse[3 * b + k] = -1.0 / P.mass[b]
            weight[3 * b + k] = -P.mass[b] * P.gravity[k]
    return True


@native
def mass_accelerations(
    P: Problem, t: float, q: Reals, u: Reals, inverse: Reals, weight: Reals, a: Reals
) -> bool:
    """a (n,) of point masses, with the tables made before; unknowns and workspace are in a row.

    False when an effective mass vanishes.
    """
    n, W, F = P.sizes.n, P.W[P.body[0].at :], P.F
    put_time(P, t)
    for b in range(P.sizes.nb):
        i, o = 3 * b, 9 * b
        x, y, z = q[i], q[i + 1], q[i + 2]
        vx, vy, vz = u[i], u[i + 1], u[i + 2]
        W[o], W[o + 1], W[o + 2], W[o + 3], W[o + 4], W[o + 5] = x, y, z, vx, vy, vz
        W[o + 6], W[o + 7], W[o + 8] = 0.0, 0.0, 0.0
    for i in range(n):
        F[i] = weight[i]
    run_groups(P, LOADS, F)
    P.count.residuals += 1
    if P.sizes.added_mass:
        effective_masses(P, P.J)
        return divide_by_masses(P, P.J, F, a)
    for i in range(n):
        a[i] = inverse[i] * F[i]
    return True


@native
def divide_by_mass(P: Problem, F: Reals, inverse: Reals, turning: float, a: Reals) -> None:
    """a = -M^-1 F, for parts with ``turning`` times the gyroscopic torque of the workspace."""
    body = P.body
    for b in range(P.sizes.nb):
        i, w = body[b].first, -1.0 / P.mass[b]
        a[i], a[i + 1], a[i + 2] = w * F[i], w * F[i + 1], w * F[i + 2]
        if body[b].width == PART:
            turn(P, b, F[i + 3 :], inverse[9 * b :], turning, a[i + 3 :])


@native
def turn(P: Problem, b: int, F: Reals, inverse: Reals, turning: float, a: Reals) -> None:
    """Angular acceleration of part b under the torque -F."""
    R, tensor, s = P.W[P.body[b].at + 15 :], P.inertia[9 * b :], P.work
    w = P.W[P.body[b].at + 9 :]
    for k in range(3):
        s[k] = R[k] * w[0] + R[3 + k] * w[1] + R[6 + k] * w[2]
    for k in range(3):
        s[3 + k] = tensor[3 * k] * s[0] + tensor[3 * k + 1] * s[1] + tensor[3 * k + 2] * s[2]
    s[6] = turning * (s[2] * s[4] - s[1] * s[5])
    s[7] = turning * (s[0] * s[5] - s[2] * s[3])
    s[8] = turning * (s[1] * s[3] - s[0] * s[4])
    for k in range(3):
        s[6 + k] -= R[k] * F[0] + R[3 + k] * F[1] + R[6 + k] * F[2]
    for k in range(3):
        s[k] = inverse[3 * k] * s[6] + inverse[3 * k + 1] * s[7] + inverse[3 * k + 2] * s[8]
    for k in range(3):
        a[k] = R[3 * k] * s[0] + R[3 * k + 1] * s[1] + R[3 * k + 2] * s[2]


@native
@rare
def spectrum(P: Problem) -> int:
    """Spectral radii of M^-1 K and M^-1 C of the forces at the workspace's state, into the
    report; constraints only lower them.
    """
    if not invert_inertia(P, P.history):
        return BROKEN_START
    if P.sizes.added_mass and not invert_bodies(P, P.D):
        return BROKEN_START
    x = P.trial[0:]
    clear(x, P.sizes.n)
    P.report.stiffness = radius(P, 1.0, 0.0, x, POWERS)
    clear(x, P.sizes.n)
    P.report.damping = radius(P, 0.0, 1.0, x, POWERS)
    return DONE


@native
def clear(x: Reals, n: int) -> None:
    """Nothing is known of a vector."""
    for i in range(n):
        x[i] = 0.0


@native
def radius(P: Problem, cq: float, cu: float, x: Reals, turns: int) -> float:
    """Spectral radius of M^-1 (cq dF/dq + cu dF/du) by power iteration (Golub, Van Loan, 7.3.1).

    ``x`` (n,) is replaced by the vector found; the next search may start there, with fewer
    ``turns``.  Some of a vector without symmetry, the same in every run, is added: what was not
    among the fastest may have become so.
    """
    n, c, known = P.sizes.n, P.coef, 0.0
    y, inverse = P.trial[n:], P.history[0:]
    c[0], c[1], c[2], c[3], c[4] = cq, cu, 0.0, 0.0, 0.0
    jacobian(P, LOADS, c, P.J)
    size, found = 0.0, 0.0
    for i in range(n):
        known += x[i] * x[i]
    share = ADDED / LARGEST * (known / float(n)) ** 0.5 if known > 0.0 else 1.0
    for i in range(n):
        x[i] += share * (float((i * 7919 + 3) % 101) - LARGEST)
        size += x[i] * x[i]
    for _iteration in range(turns):
        w = size**-0.5
        for i in range(n):
            x[i] *= w
            y[i] = 0.0
        multiply(P, x, y)
        if P.sizes.added_mass:
            times_inverse(P, P.D, y)
            copy(x, y, n)
        else:
            divide_by_mass(P, y, inverse, 0.0, x)
        size = 0.0
        for i in range(n):
            size += x[i] * x[i]
        if not size > NOTHING:
            return 0.0
        found = size**0.5
    return found


@native
def multiply_points(product: Ints, size: int, J: Alone, x: Alone, y: Alone) -> None:
    """The same where no body turns."""
    for k in range(0, size, 5):
        A, X, Y = J[product[k] :], x[product[k + 4] :], y[product[k + 3] :]
        a, b, c = X[0], X[1], X[2]
        Y[0] += A[0] * a + A[1] * b + A[2] * c
        Y[1] += A[3] * a + A[4] * b + A[5] * c
        Y[2] += A[6] * a + A[7] * b + A[8] * c


@native
def multiply(P: Problem, x: Reals, y: Reals) -> None:
    """y += J x over the blocks of bodies."""
    if only_points(P):
        multiply_points(P.product, P.product.size, P.J, x, y)
        return
    for k in range(0, P.product.size, 5):
        at, columns = P.product[k], P.product[k + 2]
        first, c = P.product[k + 3], P.product[k + 4]
        for r in range(P.product[k + 1]):
            total = 0.0
            for j in range(columns):
                total += P.J[at + r * columns + j] * x[c + j]
            y[first + r] += total
