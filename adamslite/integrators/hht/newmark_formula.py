"""The second-order formula of HHT and NEWMARK: prediction, Newton matrix, error, interpolation.

Equations and references: :mod:`adamslite.integrators.hht.method`.  Of the accepted state it
remembers in ``P.history`` q, u, b and, for DIFF, s, s', b of s', s' one step earlier; a in
``P.ra``.
"""

from __future__ import annotations

from adamslite.integrators.accelerations import put_state
from adamslite.integrators.contract import INDEX3, Problem
from adamslite.integrators.events.stops import fitted, horizon, longest_step, set_pace, step_limit
from adamslite.integrators.hht.control import Control
from adamslite.integrators.implicit.control import keep_algebraic
from adamslite.integrators.linalg.blocks import factor
from adamslite.integrators.linalg.norms import exceeds
from adamslite.integrators.linalg.plan import Plan
from adamslite.integrators.motion_equations import (
    PART,
    attitude,
    back_rotate,
    jacobian,
    put_motion,
    put_pose,
    put_scalars,
    spread,
    velocities,
)
from adamslite.integrators.newton import ROUND_OFF, multiplier_change
from adamslite.integrators.stepping.accepted import count_from_here
from adamslite.native.translate import Reals, native

# Rotations within a step below this change the matrix less than a kept one is allowed to be off.
SMALL_TURN = 0.02
# gamma + alpha - 1/2 below this is round-off: HHT is of order 2 for every alpha.
FIRST_ORDER = 1e-9
# A step is rough when accelerations change by this share of the largest, and that is more than this
# share of ERROR: a vibration that is not followed but damped.
HALF, FELT = 0.5, 0.01


@native
def choose_coefficients(P: Problem) -> None:
    """The step within its pace and the end time, and how u, a and s' follow from q and s."""
    C = Control(P.control)
    s = P.settings
    set_pace(P, C.t)
    left = horizon(P) - C.t
    C.h = min(C.h, longest_step(P))
    if not s.interpolate and C.fixed == 0.0:
        C.h = fitted(P, C.h, step_limit(P, C.row) - C.t)
    elif C.h * 1.0000001 > left:
        C.h = left
    elif C.fixed == 0.0 and 2.0 * C.h > left:
        C.h = 0.5 * left
    h, beta, gamma, one = C.h, s.beta, s.gamma, 1.0 + s.alpha
    C.cu, C.ca, C.cs = gamma / (beta * h), 1.0 / (beta * h * h * one), 1.0 / (gamma * h * one)


@native
def predict_step(P: Problem) -> None:
    """Unknowns at the end of the step with a+ = a and s'+ = s'; writes the workspace."""
    C = Control(P.control)
    D, s, n, ns = P.history, P.settings, P.sizes.n, P.sizes.ns
    h, beta, gamma, first = C.h, s.beta, s.gamma, P.sizes.m + P.sizes.nv
    stretch = h / C.h_last if C.h_last > 0.0 else 0.0
    q, u, a, U, B, A = P.q, P.u, P.a, D[n:], D[2 * n :], P.ra
    reach = 1.0
    for i in range(n):
        b = A[i] + (B[i] - A[i]) * stretch
        q[i] = D[i] + h * (U[i] + h * ((0.5 - beta) * b + beta * A[i]))
        u[i] = U[i] + h * ((1.0 - gamma) * b + gamma * A[i])
        a[i] = A[i]
        reach = max(reach, abs(q[i]))
    C.reach = reach
    for body in range(P.sizes.nb):
        if P.body[body].width == PART:
            turn_from_start(P, P.body[body].first)
    for k in range(first):
        P.z[k] = P.rz[k]
    for k in range(ns):
        o = 4 * n + k
        rate = D[o + ns]
        b = rate + (D[o + 2 * ns] - rate) * stretch
        P.z[first + k] = D[o] + h * ((1.0 - gamma) * b + gamma * rate)
        P.rd[k] = rate
    put_pose(P, q)
    put_motion(P, u, a)
    put_scalars(P, P.z, P.rd)


@native
def turn_from_start(P: Problem, i: int) -> None:
    """Cayley vector c = theta tan(x)/x, x = |theta|/2, of the part whose positions start at ``i``.

    theta = h w + h^2 ((1/2 - beta) b + beta b+) + h^3/12 w' x w is the rotation vector of the step,
    w' x w because w turns: Magnus' series.  tan(x)/x by its continued fraction, exact to round-off.
    """
    C = Control(P.control)
    D, s, n, q, a, A = P.history, P.settings, P.sizes.n, P.q, P.a, P.ra
    h, beta, alpha = C.h, s.beta, s.alpha
    U, B = D[n:], D[2 * n :]
    stretch = h / C.h_last if C.h_last > 0.0 else 0.0
    for k in range(i + 3, i + 6):
        b = A[k] + (B[k] - A[k]) * stretch
        after = (1.0 + alpha) * a[k] - alpha * A[k]
        q[k] = h * (U[k] + h * ((0.5 - beta) * b + beta * after))
    twelfth = h * h * h / 12.0
    q[i + 3] += twelfth * (A[i + 4] * U[i + 5] - A[i + 5] * U[i + 4])
    q[i + 4] += twelfth * (A[i + 5] * U[i + 3] - A[i + 3] * U[i + 5])
    q[i + 5] += twelfth * (A[i + 3] * U[i + 4] - A[i + 4] * U[i + 3])
    y = 0.25 * (q[i + 3] * q[i + 3] + q[i + 4] * q[i + 4] + q[i + 5] * q[i + 5])
    longer = 1.0 / (1.0 - y / (3.0 - y / (5.0 - y / (7.0 - y / (9.0 - y / 11.0)))))
    for k in range(i + 3, i + 6):
        q[k] *= longer


@native
def second_order_matrix(P: Problem, L: Plan) -> bool:
    """Assemble and factor dF/d(q, lam, V, s) = F_q + (cu F_u + ca F_a) T at the workspace's
    state; T = I - [c]/2 + c c^T/4 for rotations.
    """
    C = Control(P.control)
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
def move_all(P: Problem, dz: Reals) -> float:
    """Subtract a Newton increment from all unknowns, there and in the workspace.

    Returns the largest increment of positions, rotations, variables and states, each against
    max(1, |value|); at the round-off of positions it counts as none.
    """
    C = Control(P.control)
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
            turn_from_start(P, i)
            attitude(q[i + 3], q[i + 4], q[i + 5], P.base, 9 * b, W, o + 15)
    if largest <= noise:
        largest = 0.0
    return max(largest, move_scalars(P, dz))


@native
def move_scalars(P: Problem, dz: Reals) -> float:
    """The share of multipliers, variables and states in :func:`move_all`, the same round-off."""
    C = Control(P.control)
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


@native
def position_error(P: Problem) -> float:
    """Estimated local error of positions, rotations and states over ERROR; remembers where.

    Velocities have one of (gamma + alpha - 1/2) h |b+ - b|, which is nothing but in a NEWMARK of
    order 1.  States: a share of the distance from the explicit formula of order 2.
    """
    C = Control(P.control)
    D, s, n, ns = P.history, P.settings, P.sizes.n, P.sizes.ns
    stretch = C.h / C.h_last if C.h_last > 0.0 else 0.0
    scale = abs(s.beta - 1.0 / 6.0) * C.h * C.h
    fast = first_order_share(P) * C.h
    A, B, top, where = P.ra, D[2 * n :], 0.0, 0
    size, jump = 0.0, 0.0
    for i in range(n):
        # b+ - b with b moved to this step's place.
        change = (1.0 + s.alpha) * (P.a[i] - A[i]) - stretch * (B[i] - A[i])
        size, jump = max(size, abs(P.a[i])), max(jump, abs(change))
        if exceeds(scale * abs(change), top * max(1.0, abs(P.q[i]))):
            top, where = scale * abs(change) / max(1.0, abs(P.q[i])), i
        if exceeds(fast * abs(change), top * max(1.0, abs(P.u[i]))):
            top, where = fast * abs(change) / max(1.0, abs(P.u[i])), i
    for b in range(P.sizes.nb):
        if P.body[b].width == PART:
            i = P.body[b].first
            bend = bend_of(P.u[i + 3], P.u[i + 4], P.u[i + 5], C.h)
            if exceeds(bend, top):
                top, where = bend, i + 3
    C.rough = jump > HALF * size and top > FELT * s.error
    first = P.sizes.m + P.sizes.nv
    for k in range(ns):
        o = 4 * n + k
        rate, value = D[o + ns], P.z[first + k]
        explicit = D[o] + C.h * (rate + 0.5 * stretch * (rate - D[o + 3 * ns]))
        if exceeds(0.5 * abs(value - explicit), top * max(1.0, abs(value))):
            top, where = 0.5 * abs(value - explicit) / max(1.0, abs(value)), 2 * n + k
    P.report.where = where
    return top / s.error


@native
def first_order_share(P: Problem) -> float:
    """|gamma + alpha - 1/2|: zero for formulas of order 2."""
    share = abs(P.settings.gamma + P.settings.alpha - 0.5)
    return share if share > FIRST_ORDER else 0.0


@native
def bend_of(x: float, y: float, z: float, h: float) -> float:
    """Error [rad] of a cubic through the Cayley vector c of an even turn w h: h^4/384 of c's fourth
    derivative.
    """
    turn = h * h * (x * x + y * y + z * z)
    return turn * turn * turn**0.5 / 384.0


@native
def keep_second_order(P: Problem) -> None:
    """b, accelerations, multipliers and derivatives of the states at the accepted state."""
    D, n, ns, alpha = P.history, P.sizes.n, P.sizes.ns, P.settings.alpha
    A, B = P.ra, D[2 * n :]
    for i in range(n):
        B[i] = (1.0 + alpha) * P.a[i] - alpha * A[i]
        A[i] = P.a[i]
    for k in range(ns):
        o = 4 * n + k
        D[o + 3 * ns] = D[o + ns]
        D[o + 2 * ns] = (1.0 + alpha) * P.rd[k] - alpha * D[o + ns]
        D[o + ns] = P.rd[k]
    keep_algebraic(P)


@native
def start_from_here(P: Problem) -> None:
    """The workspace's state starts the next step; its attitudes become the base."""
    D, n, first = P.history, P.sizes.n, P.sizes.m + P.sizes.nv
    count_from_here(P)
    for i in range(n):
        D[i], D[n + i] = P.q[i], P.u[i]
    for k in range(P.sizes.ns):
        D[4 * n + k] = P.z[first + k]


@native
def back_to_accepted(P: Problem) -> None:
    """The last accepted state into the unknowns and the workspace."""
    C = Control(P.control)
    D, n, ns, first = P.history, P.sizes.n, P.sizes.ns, P.sizes.m + P.sizes.nv
    for i in range(n):
        P.q[i], P.u[i], P.a[i] = D[i], D[n + i], P.ra[i]
    for k in range(first):
        P.z[k] = P.rz[k]
    for k in range(ns):
        P.z[first + k], P.rd[k] = D[4 * n + k], D[4 * n + ns + k]
    put_state(P, C.t, P.q, P.u, P.a, P.z, P.rd)


@native
def between(P: Problem, h: float, x: float, end: Reals, y: Reals) -> None:
    """Cubics at the share x of the step: q and u into ``y``, states into z; ``end`` holds q', s."""
    D, n, ns, first = P.history, P.sizes.n, P.sizes.ns, P.sizes.m + P.sizes.nv
    w = x * x * (3.0 - 2.0 * x)
    w0, w1 = h * x * (1.0 - x) * (1.0 - x), h * x * x * (x - 1.0)
    bodies_between(P, h, x, end, y)
    for k in range(ns):
        o = 4 * n + k
        step, v0, v1 = end[2 * n + k] - D[o], D[o + 3 * ns], D[o + ns]
        P.z[first + k] = D[o] + w * step + w0 * v0 + w1 * v1


@native
def bodies_between(P: Problem, h: float, x: float, end: Reals, y: Reals) -> None:
    """q and u at the share x of the step; q is at its end, ``end`` holds q' of that."""
    D, n = P.history, P.sizes.n
    w = x * x * (3.0 - 2.0 * x)
    w0, w1 = h * x * (1.0 - x) * (1.0 - x), h * x * x * (x - 1.0)
    d, d0, d1 = 6.0 * x * (1.0 - x) / h, (1.0 - x) * (1.0 - 3.0 * x), x * (3.0 * x - 2.0)
    for i in range(n):
        step, v0, v1 = P.q[i] - D[i], D[n + i], end[n + i]
        y[i] = D[i] + w * step + w0 * v0 + w1 * v1
        y[n + i] = d * step + d0 * v0 + d1 * v1
    velocities(P, y, y[n:], y[n:])
