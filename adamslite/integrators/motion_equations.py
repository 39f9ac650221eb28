"""The equations of motion as native code: workspace, residual, Jacobian.

    F = M(q) a + w x J w - f(t,q,u,a,lam,V,s) + G^T lam,   g(t,q),   dg/dt,   V - e,   s' - r

The attitude of a part is R = cay(c) R0, the Cayley (Gibbs) vector c counted from attitude R0:

    R = (I + ([c] + [c]^2/2)/(1 + c.c/4)) R0,   w = (c' + c x c'/2)/(1 + c.c/4)

which is rational, exact and regular for rotations below pi from R0.  Newton increments of
rotations are taken in ground axes (dR = [dphi] R), hence dc = (I - [c]/2 + c c^T/4) dphi.
Reference: O. A. Bauchau, Flexible Multibody Dynamics, 2011, section 13.6.
"""

from __future__ import annotations

from adamslite.integrators.contract import REACTIONS, SIGNALS, Problem
from adamslite.kernels.code.workspace import POINT_SIZE
from adamslite.native.translate import Alone, Reals, call_address, native

POINT, PART = 3, 6
# Guards of the clock and of the watch.
CLOCK, WATCH = 0, 1


@native
def attitude(c0: float, c1: float, c2: float, base: Reals, r0: int, W: Reals, o: int) -> None:
    """Write R = cay(c) R0 to the workspace."""
    s = 1.0 / (1.0 + 0.25 * (c0 * c0 + c1 * c1 + c2 * c2))
    h = 0.5 * s
    a00, a01, a02 = 1.0 - h * (c1 * c1 + c2 * c2), h * c0 * c1 - s * c2, h * c0 * c2 + s * c1
    a10, a11, a12 = h * c0 * c1 + s * c2, 1.0 - h * (c0 * c0 + c2 * c2), h * c1 * c2 - s * c0
    a20, a21, a22 = h * c0 * c2 - s * c1, h * c1 * c2 + s * c0, 1.0 - h * (c0 * c0 + c1 * c1)
    for k in range(3):
        x, y, z = base[r0 + k], base[r0 + 3 + k], base[r0 + 6 + k]
        W[o + k] = a00 * x + a01 * y + a02 * z
        W[o + 3 + k] = a10 * x + a11 * y + a12 * z
        W[o + 6 + k] = a20 * x + a21 * y + a22 * z


@native
def only_points(P: Problem) -> bool:
    """Whether no body turns: unknowns and workspace of the bodies are in a row."""
    return P.sizes.n == POINT * P.sizes.nb


@native
def put_vectors(x: Alone, W: Alone, count: int) -> None:
    """A vector of every point mass into its place of the workspace."""
    for b in range(count):
        for k in range(3):
            W[POINT_SIZE * b + k] = x[3 * b + k]


@native
def put_pose(P: Problem, q: Reals) -> None:
    """Positions and attitudes into the workspace."""
    W, body = P.W, P.body
    if only_points(P):
        put_vectors(q, W[P.sizes.n_head :], P.sizes.nb)
        return
    for b in range(P.sizes.nb):
        i, o = body[b].first, body[b].at
        W[o], W[o + 1], W[o + 2] = q[i], q[i + 1], q[i + 2]
        if body[b].width == PART:
            attitude(q[i + 3], q[i + 4], q[i + 5], P.base, 9 * b, W, o + 15)


@native
def put_motion(P: Problem, u: Reals, a: Reals) -> None:
    """Velocities and accelerations into the workspace."""
    W, body = P.W, P.body
    if only_points(P):
        put_vectors(u, W[P.sizes.n_head + 3 :], P.sizes.nb)
        put_vectors(a, W[P.sizes.n_head + 6 :], P.sizes.nb)
        return
    for b in range(P.sizes.nb):
        i, o = body[b].first, body[b].at
        for k in range(3):
            W[o + 3 + k] = u[i + k]
            W[o + 6 + k] = a[i + k]
        if body[b].width == PART:
            for k in range(3):
                W[o + 9 + k] = u[i + 3 + k]
                W[o + 12 + k] = a[i + 3 + k]


@native
def put_scalars(P: Problem, z: Reals, sd: Reals) -> None:
    """Multipliers, variables and DIFF states (with derivatives ``sd``) into the workspace."""
    W = P.W
    first = P.sizes.m + P.sizes.nv
    for k in range(first + P.sizes.ns):
        W[P.scalar[k]] = z[k]
    for k in range(P.sizes.ns):
        W[P.scalar[first + k] + 1] = sd[k]


@native
def run_groups(P: Problem, phases: int, target: Reals) -> None:
    """Every group of the phases adds to ``target``."""
    g = P.group
    for k in range(P.sizes.ng):
        if g[k].phases & phases:
            call_address(g[k].residual, g[k].count, g[k].ints, g[k].reals, P.W, target)


@native
def put_time(P: Problem, t: float) -> None:
    """Time and the time-only variables into the workspace."""
    W = P.W
    W[0] = t
    for k in range(2, P.sizes.n_head):
        W[k] = 0.0
    run_groups(P, SIGNALS, W)


@native
def track(P: Problem) -> None:
    """Let every kernel with a memory remember its angles at the accepted state."""
    g = P.group
    for k in range(P.sizes.ng):
        if g[k].track:
            call_address(g[k].track, g[k].count, g[k].ints, g[k].reals, P.W, P.W)


@native
def guard_values(P: Problem, which: int) -> None:
    """Values of the guards of the clock or of the watch, behind the workspace's size in
    ``P.guard``.
    """
    g = P.group
    for k in range(P.sizes.nw, P.guard.size):
        P.guard[k] = 0.0
    for k in range(P.sizes.ng):
        address = g[k].clock if which == CLOCK else g[k].watch
        if address:
            call_address(address, g[k].count, g[k].ints, g[k].reals, P.W, P.guard)


@native
def rotated_inertia(P: Problem, b: int, o: int, J: Reals) -> None:
    """J = R I R^T, inertia about the mass centre in ground axes."""
    W, tensor = P.W, P.inertia
    for i in range(3):
        for j in range(3):
            total = 0.0
            for k in range(3):
                for m in range(3):
                    total += (
                        W[o + 15 + 3 * i + k] * tensor[9 * b + 3 * k + m] * W[o + 15 + 3 * j + m]
                    )
            J[3 * i + j] = total


@native
def inertia_forces(P: Problem, F: Reals) -> None:
    """F = M (a - gravity) and J al + w x J w."""
    W, body, work = P.W, P.body, P.work
    gx, gy, gz = P.gravity[0], P.gravity[1], P.gravity[2]
    for b in range(P.sizes.nb):
        i, o, m = body[b].first, body[b].at, P.mass[b]
        F[i] = m * (W[o + 6] - gx)
        F[i + 1] = m * (W[o + 7] - gy)
        F[i + 2] = m * (W[o + 8] - gz)
        if body[b].width == PART:
            rotated_inertia(P, b, o, work)
            wx, wy, wz = W[o + 9], W[o + 10], W[o + 11]
            hx = work[0] * wx + work[1] * wy + work[2] * wz
            hy = work[3] * wx + work[4] * wy + work[5] * wz
            hz = work[6] * wx + work[7] * wy + work[8] * wz
            ax, ay, az = W[o + 12], W[o + 13], W[o + 14]
            F[i + 3] = work[0] * ax + work[1] * ay + work[2] * az + wy * hz - wz * hy
            F[i + 4] = work[3] * ax + work[4] * ay + work[5] * az + wz * hx - wx * hz
            F[i + 5] = work[6] * ax + work[7] * ay + work[8] * az + wx * hy - wy * hx


@native
def residual(P: Problem, phases: int, F: Reals) -> None:
    """All equations at the workspace's state.

    What would drive the model out of its plane ends the run:
    see :mod:`adamslite.analyses.dynamics.planar_reduction`.
    """
    for k in range(P.sizes.n, P.sizes.nz):
        F[k] = 0.0
    inertia_forces(P, F)
    run_groups(P, phases, F)
    for k in range(P.held.size):
        if abs(F[P.held[k]]) > P.loose[k]:
            P.report.left_plane = True
            P.settings.stop = True
    for k in range(P.dead.size):
        F[P.dead[k]] = 0.0
    P.count.residuals += 1


@native
def put_skew(S: Reals, o: int, x: float, y: float, z: float) -> None:
    S[o], S[o + 1], S[o + 2] = 0.0, -z, y
    S[o + 3], S[o + 4], S[o + 5] = z, 0.0, -x
    S[o + 6], S[o + 7], S[o + 8] = -y, x, 0.0


@native
def rotation_block(
    P: Problem, b: int, o: int, cq: float, cu: float, ca: float, J: Reals, at: int
) -> None:
    """Add the derivative of J al + w x J w to rows and columns 3..5 of a part's own block.

    d/dphi: [J x]-terms from dJ = [dphi] J - J [dphi];  d/dw: [w] J - [J w];  d/dal: J.
    """
    W, work = P.W, P.work
    rotated_inertia(P, b, o, work)
    wx, wy, wz = W[o + 9], W[o + 10], W[o + 11]
    ax, ay, az = W[o + 12], W[o + 13], W[o + 14]
    for k in range(3):
        work[9 + k] = work[3 * k] * wx + work[3 * k + 1] * wy + work[3 * k + 2] * wz
        work[12 + k] = work[3 * k] * ax + work[3 * k + 1] * ay + work[3 * k + 2] * az
    put_skew(work, 18, wx, wy, wz)
    put_skew(work, 27, ax, ay, az)
    put_skew(work, 36, work[9], work[10], work[11])
    put_skew(work, 45, work[12], work[13], work[14])
    for i in range(3):
        for j in range(3):
            jw, ja, wj, wjw, whs = 0.0, 0.0, 0.0, 0.0, 0.0
            for k in range(3):
                jw += work[3 * i + k] * work[18 + 3 * k + j]
                ja += work[3 * i + k] * work[27 + 3 * k + j]
                wj += work[18 + 3 * i + k] * work[3 * k + j]
                whs += work[18 + 3 * i + k] * work[36 + 3 * k + j]
            for k in range(3):
                inner = 0.0
                for m in range(3):
                    inner += work[3 * k + m] * work[18 + 3 * m + j]
                wjw += work[18 + 3 * i + k] * inner
            by_position = ja - work[45 + 3 * i + j] + wjw - whs
            by_velocity = wj - work[36 + 3 * i + j]
            value = cq * by_position + cu * by_velocity + ca * work[3 * i + j]
            J[at + 6 * (3 + i) + 3 + j] += value


@native
def put_mass(P: Problem, b: int, J: Reals, at: int) -> None:
    """The mass matrix of a body, 3 x 3 or 6 x 6, at ``at``."""
    if P.body[b].width == POINT:
        put_point(P.mass[b], J[at:])
    else:
        for k in range(36):
            J[at + k] = 0.0
        for k in range(3):
            J[at + 7 * k] = P.mass[b]
        rotated_inertia(P, b, P.body[b].at, P.work)
        for i in range(3):
            for j in range(3):
                J[at + 6 * (3 + i) + 3 + j] = P.work[3 * i + j]


@native
def put_point(m: float, J: Reals) -> None:
    """m on the diagonal of 3 x 3 zeros."""
    J[0], J[1], J[2] = m, 0.0, 0.0
    J[3], J[4], J[5] = 0.0, m, 0.0
    J[6], J[7], J[8] = 0.0, 0.0, m


@native
def inertia_blocks(P: Problem, cq: float, cu: float, ca: float, J: Reals) -> None:
    """Derivative of the inertia forces, each in its body's own block."""
    body = P.body
    for b in range(P.sizes.nb):
        kind, at = body[b].width, body[b].block
        for k in range(3):
            J[at + k * (kind + 1)] += ca * P.mass[b]
        if kind == PART:
            rotation_block(P, b, body[b].at, cq, cu, ca, J, at)


@native
def jacobian(P: Problem, phases: int, c: Reals, J: Reals) -> None:
    """J = c0 dF/dq + c1 dF/du + c2 dF/da + c3 dF/d(lam, V) + c4 dF/ds'."""
    for k in range(P.J.size):
        J[k] = 0.0
    inertia_blocks(P, c[0], c[1], c[2], J)
    g = P.group
    for k in range(P.sizes.ng):
        if g[k].phases & phases and g[k].jacobian:
            call_address(g[k].jacobian, g[k].count, g[k].ints, g[k].reals, P.W, c, J)
    P.count.jacobians += 1


@native
def spread(P: Problem, LV: Reals) -> None:
    """Copy the Jacobian blocks to their places in the elimination pattern, fill zero."""
    J, copies = P.J, P.copies
    for k in range(P.LV.size):
        LV[k] = 0.0
    for k in range(0, P.copies.size, 5):
        source, rows, columns = copies[k], copies[k + 1], copies[k + 2]
        at, lead = copies[k + 3], copies[k + 4]
        if lead == columns:
            for i in range(rows * columns):
                LV[at + i] = J[source + i]
        else:
            for i in range(rows):
                for j in range(columns):
                    LV[at + i * lead + j] = J[source + i * columns + j]


@native
def spin(P: Problem, q: Reals, v: Reals, b: int, i: int, x: Reals) -> None:
    """w = (c' + c x c'/2)/(1 + c.c/4) of part b; ``v`` holds c', result in ``x``."""
    c0, c1, c2 = q[i + 3], q[i + 4], q[i + 5]
    d0, d1, d2 = v[i + 3], v[i + 4], v[i + 5]
    s = 1.0 / (1.0 + 0.25 * (c0 * c0 + c1 * c1 + c2 * c2))
    x[i + 3] = s * (d0 + 0.5 * (c1 * d2 - c2 * d1))
    x[i + 4] = s * (d1 + 0.5 * (c2 * d0 - c0 * d2))
    x[i + 5] = s * (d2 + 0.5 * (c0 * d1 - c1 * d0))


@native
def velocities(P: Problem, q: Reals, v: Reals, u: Reals) -> None:
    """u from the derivatives ``v`` of q."""
    body = P.body
    for b in range(P.sizes.nb):
        i = body[b].first
        u[i], u[i + 1], u[i + 2] = v[i], v[i + 1], v[i + 2]
        if body[b].width == PART:
            spin(P, q, v, b, i, u)


@native
def vector_rates(P: Problem, q: Reals, u: Reals, v: Reals) -> None:
    """v = derivatives of q from u: c' = (I - [c]/2 + c c^T/4) w."""
    body = P.body
    for b in range(P.sizes.nb):
        i = body[b].first
        for k in range(3):
            v[i + k] = u[i + k]
        if body[b].width == PART:
            back_rotate(q, u, i, v)


@native
def back_rotate(q: Reals, u: Reals, i: int, v: Reals) -> None:
    """v = (I - [c]/2 + c c^T/4) u on components i+3..i+5; ``u`` and ``v`` may be the same."""
    c0, c1, c2 = q[i + 3], q[i + 4], q[i + 5]
    w0, w1, w2 = u[i + 3], u[i + 4], u[i + 5]
    k = 0.25 * (c0 * w0 + c1 * w1 + c2 * w2)
    v[i + 3] = w0 - 0.5 * (c1 * w2 - c2 * w1) + k * c0
    v[i + 4] = w1 - 0.5 * (c2 * w0 - c0 * w2) + k * c1
    v[i + 5] = w2 - 0.5 * (c0 * w1 - c1 * w0) + k * c2


@native
def project_on_constraints(P: Problem, mu: Reals, target: Reals) -> None:
    """target = weight * G^T mu at the workspace's pose."""
    W = P.W
    m = P.sizes.m
    for k in range(P.sizes.n):
        target[k] = 0.0
    for k in range(m):
        W[P.scalar[k]] = mu[k] if k < P.sizes.holonomic else 0.0
    run_groups(P, REACTIONS, target)
    for b in range(P.sizes.nb):
        i = P.body[b].first
        if P.body[b].width == PART:
            for k in range(3, 6):
                target[i + k] *= P.weight[b]
