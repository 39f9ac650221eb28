"""Derivatives of the equations, in a direction of the state and by a number of the deck.

    dF = F_q (dx, theta) + F_u du + F_a da + F_z dz + F_s' ds' + F_p

Kernels give those of loads, constraints and equations
(:mod:`adamslite.kernels.code.tangent_writer`); inertia forces are M (a - g) and J al + w x J w with

    dJ = [theta] J - J [theta] + R dI R^T

Accelerations follow from F_(a, z, s') (da, dz, ds') = -(F_y dy + F_p) with the matrix that solves
for the accelerations themselves; theta' = dw + w x theta.
"""

from __future__ import annotations

from adamslite.integrators.accelerations import solve_accelerations
from adamslite.integrators.contract import ACCELERATION, OUTPUTS, SIGNALS, STATE_ORIGIN, Problem
from adamslite.integrators.linalg.norms import largest_of
from adamslite.integrators.linalg.plan import Plan
from adamslite.integrators.motion_equations import PART, only_points, put_vectors, rotated_inertia
from adamslite.kernels.code.workspace import HEAD
from adamslite.native.translate import Reals, call_address, copy, native
from adamslite.sensitivity.contract import Forward, Tangents

# In place of phases: guards of the clock, guards of the state.
CLOCK_GUARDS, STATE_GUARDS = -1, -2


@native
def clear(x: Reals, count: int) -> None:
    """The first ``count`` numbers become zero."""
    for i in range(count):
        x[i] = 0.0


@native
def put_direction(
    P: Problem, D: Tangents, y: Reals, a: Reals, z: Reals, rates: Reals, time: float
) -> None:
    """A direction of the state into the derivative of the workspace: ``y`` (places and turns,
    velocities, states), accelerations, multipliers and variables, rates of states, the time.
    """
    n, ns, first, W, d = P.sizes.n, P.sizes.ns, P.sizes.m + P.sizes.nv, P.W, D.dW
    clear(d, P.sizes.n_head)
    d[0] = time
    if only_points(P):
        put_vectors(y, d[P.sizes.n_head :], P.sizes.nb)
        put_vectors(y[n:], d[P.sizes.n_head + 3 :], P.sizes.nb)
        put_vectors(a, d[P.sizes.n_head + 6 :], P.sizes.nb)
    for b in range(0 if only_points(P) else P.sizes.nb):
        i, o = P.body[b].first, P.body[b].at
        for k in range(3):
            d[o + k], d[o + 3 + k], d[o + 6 + k] = y[i + k], y[n + i + k], a[i + k]
        if P.body[b].width == PART:
            x0, x1, x2 = y[i + 3], y[i + 4], y[i + 5]
            for k in range(3):
                d[o + 9 + k], d[o + 12 + k] = y[n + i + 3 + k], a[i + 3 + k]
                r0, r1, r2 = W[o + 15 + k], W[o + 18 + k], W[o + 21 + k]
                d[o + 15 + k] = x1 * r2 - x2 * r1
                d[o + 18 + k] = x2 * r0 - x0 * r2
                d[o + 21 + k] = x0 * r1 - x1 * r0
    for k in range(first):
        d[P.scalar[k]] = z[k]
    for k in range(ns):
        o = P.scalar[first + k]
        d[o], d[o + 1], d[o + STATE_ORIGIN] = y[2 * n + k], rates[k], 0.0


@native
def put_signals(P: Problem, D: Tangents, number: int) -> None:
    """Derivatives of the VARIABLEs of TIME by a number (-1: none) and the time."""
    if P.sizes.n_head == HEAD or (D.dW[0] == 0.0 and (number < 0 or D.signals[number] == 0)):
        return
    for k in range(P.sizes.ng):
        if P.group[k].phases & SIGNALS:
            reals = of_signals(P, D, number, k)
            call_address(
                D.group[k].residual, P.group[k].count, P.group[k].ints, P.group[k].reals, P.W,
                reals, D.dW, D.dW,
            )  # fmt: skip


@native
def of_signals(P: Problem, D: Tangents, number: int, k: int) -> int:
    """The address of the derivatives of all reals of a group of signals."""
    if number >= 0:
        for p in range(D.piece_at[number], D.piece_at[number + 1]):
            if D.piece[p].group == k:
                return D.piece[p].reals
    return D.nothing


@native
def tangent(P: Problem, D: Tangents, number: int, phases: int, F: Reals) -> None:
    """F = the derivative of the equations of ``phases`` in the direction in ``dW`` and by a number
    (-1: none) at the workspace's state.
    """
    clear(F, P.sizes.nz)
    put_signals(P, D, number)
    inertia_tangent(P, D, number, F)
    directed(P, D, phases, F)
    by_number(P, D, number, phases, F)
    note_plane(P, D, number, F)
    for k in range(P.dead.size):
        F[P.dead[k]] = 0.0


@native
def note_plane(P: Problem, D: Tangents, number: int, F: Reals) -> None:
    """Keep the largest of what acts in the plane of the run, and of what drives out of it."""
    if P.held.size == 0 or number < 0:
        return
    for k in range(P.held.size):
        D.out[number] = max(D.out[number], abs(F[P.held[k]]))
    D.top[number] = max(D.top[number], largest_of(F, P.sizes.nz))


@native
def tangent_of(P: Problem, D: Tangents, k: int, phases: int) -> int:
    """The address of the tangent of a group of kernels, 0 where it has none of the phases."""
    if phases == CLOCK_GUARDS:
        return D.group[k].clock
    if phases == STATE_GUARDS:
        return D.group[k].watch
    return D.group[k].residual if P.group[k].phases & phases else 0


@native
def directed(P: Problem, D: Tangents, phases: int, F: Reals) -> None:
    """Add what kernels of the phases change by in the direction in ``dW``."""
    g = P.group
    for k in range(P.sizes.ng):
        address = tangent_of(P, D, k, phases)
        if address != 0:
            call_address(address, g[k].count, g[k].ints, g[k].reals, P.W, D.nothing, D.dW, F)


@native
def by_number(P: Problem, D: Tangents, number: int, phases: int, F: Reals) -> None:
    """Add what kernels of the phases change by with a number (-1: none), the state being what it
    is.
    """
    g = P.group
    for p in range(D.piece_at[max(number, 0)], D.piece_at[number + 1]):
        k, first = D.piece[p].group, D.piece[p].first
        address = tangent_of(P, D, k, phases)
        if address != 0:
            call_address(
                address, D.piece[p].count, g[k].ints + 8 * first * D.group[k].of_ints,
                g[k].reals + 8 * first * D.group[k].of_reals, P.W, D.piece[p].reals, D.none, F,
            )  # fmt: skip


@native
def inertia_tangent(P: Problem, D: Tangents, number: int, F: Reals) -> None:
    """The derivative of the inertia forces."""
    W, d, g, nb = P.W, D.dW, P.gravity, P.sizes.nb
    for b in range(nb):
        i, o, m = P.body[b].first, P.body[b].at, P.mass[b]
        for k in range(3):
            F[i + k] = m * d[o + 6 + k]
        if number >= 0:
            dm = D.mass[number * nb + b]
            for k in range(3):
                F[i + k] += dm * (W[o + 6 + k] - g[k]) - m * D.gravity[3 * number + k]
        if P.body[b].width == PART:
            turning_tangent(P, D, number, b, F)


@native
def turning_tangent(P: Problem, D: Tangents, number: int, b: int, F: Reals) -> None:
    """The same of J al + w x J w of a part; theta is read from dR R^T."""
    W, d, i, o, work = P.W, D.dW, P.body[b].first, P.body[b].at, P.work
    rotated_inertia(P, b, o, work)
    turned_inertia(W[o + 15 :], d[o + 15 :], work)
    if number >= 0:
        inertia_by_number(P, D, number, b)
    for k in range(3):
        jw, djw, ja = 0.0, 0.0, 0.0
        for c in range(3):
            jw += work[3 * k + c] * W[o + 9 + c]
            djw += work[18 + 3 * k + c] * W[o + 9 + c] + work[3 * k + c] * d[o + 9 + c]
            ja += work[18 + 3 * k + c] * W[o + 12 + c] + work[3 * k + c] * d[o + 12 + c]
        work[27 + k], work[30 + k], F[i + 3 + k] = jw, djw, ja
    for k in range(3):
        p, q = (k + 1) % 3, (k + 2) % 3
        F[i + 3 + k] += d[o + 9 + p] * work[27 + q] - d[o + 9 + q] * work[27 + p]
        F[i + 3 + k] += W[o + 9 + p] * work[30 + q] - W[o + 9 + q] * work[30 + p]


@native
def turned_inertia(R: Reals, dR: Reals, work: Reals) -> None:
    """dJ = [theta] J - J [theta] behind J and [theta] = dR R^T."""
    for r in range(3):
        for c in range(3):
            total = 0.0
            for k in range(3):
                total += dR[3 * r + k] * R[3 * c + k]
            work[9 + 3 * r + c] = total
    for r in range(3):
        for c in range(3):
            total = 0.0
            for k in range(3):
                total += work[9 + 3 * r + k] * work[3 * k + c]
                total -= work[3 * r + k] * work[9 + 3 * k + c]
            work[18 + 3 * r + c] = total


@native
def inertia_by_number(P: Problem, D: Tangents, number: int, b: int) -> None:
    """Add R dI R^T to dJ."""
    W, o, tensor = P.W, P.body[b].at, D.inertia[9 * (number * P.sizes.nb + b) :]
    if largest_of(tensor, 9) == 0.0:
        return
    for r in range(3):
        for c in range(3):
            total = 0.0
            for k in range(3):
                for m in range(3):
                    total += W[o + 15 + 3 * r + k] * tensor[3 * k + m] * W[o + 15 + 3 * c + m]
            P.work[18 + 3 * r + c] += total


@native
def take_state(P: Problem) -> None:
    """The workspace's state into q, u, a, z and s'; attitudes count from there."""
    W, first = P.W, P.sizes.m + P.sizes.nv
    for b in range(P.sizes.nb):
        i, o = P.body[b].first, P.body[b].at
        for k in range(3):
            P.q[i + k], P.u[i + k], P.a[i + k] = W[o + k], W[o + 3 + k], W[o + 6 + k]
        if P.body[b].width == PART:
            for k in range(3):
                P.q[i + 3 + k] = 0.0
                P.u[i + 3 + k], P.a[i + 3 + k] = W[o + 9 + k], W[o + 12 + k]
            for k in range(9):
                P.base[9 * b + k] = W[o + 15 + k]
    for k in range(first + P.sizes.ns):
        P.z[k] = W[P.scalar[k]]
    for k in range(P.sizes.ns):
        P.rd[k] = W[P.scalar[first + k] + 1]


@native
def spun(P: Problem, y: Reals, u: Reals, sign: float, target: Reals) -> None:
    """target = u + sign w x theta of parts, u of places: rates of places and turns from velocities
    and (``sign`` -1) back.
    """
    for b in range(P.sizes.nb):
        i, o = P.body[b].first, P.body[b].at
        for k in range(3):
            target[i + k] = u[i + k]
        if P.body[b].width == PART:
            for k in range(3):
                p, q = (k + 1) % 3, (k + 2) % 3
                cross = P.W[o + 9 + p] * y[i + 3 + q] - P.W[o + 9 + q] * y[i + 3 + p]
                target[i + 3 + k] = u[i + 3 + k] + sign * cross


@native
def forget_rates(P: Problem, S: Forward) -> None:
    """No accelerations, multipliers, variables or rates of states."""
    clear(S.a, P.sizes.n)
    clear(S.z, P.sizes.m + P.sizes.nv)
    clear(S.sd, P.sizes.ns)


@native
def sensitive_accelerations(
    P: Problem, L: Plan, D: Tangents, S: Forward, number: int, y: Reals, time: float
) -> None:
    """Derivatives of accelerations, multipliers, variables and s' into ``S``, and the whole of the
    direction into ``dW``, by a number, or (-1) in the direction ``y`` and ``time`` alone; the
    matrix of accelerations is factored.
    """
    n, ns, first = P.sizes.n, P.sizes.ns, P.sizes.m + P.sizes.nv
    forget_rates(P, S)
    put_direction(P, D, y, S.a, S.z, S.sd, time)
    tangent(P, D, number, ACCELERATION, P.F)
    for k in range(n + first + ns, P.sizes.nz):
        P.F[k] = 0.0
    solve_accelerations(P, L)
    for i in range(n):
        S.a[i] = 0.0 - P.F[i]
    for k in range(first):
        S.z[k] = 0.0 - P.F[n + k]
    for k in range(ns):
        S.sd[k] = 0.0 - P.F[n + first + k]
    put_direction(P, D, y, S.a, S.z, S.sd, time)
    put_signals(P, D, number)


@native
def rates_of(P: Problem, S: Forward, y: Reals, rates: Reals) -> None:
    """Rates of sensitivities from the derivatives of accelerations in ``S``."""
    n = P.sizes.n
    spun(P, y, y[n:], 1.0, rates)
    for i in range(n):
        rates[n + i] = S.a[i]
    for k in range(P.sizes.ns):
        rates[2 * n + k] = S.sd[k]


@native
def write_outputs(P: Problem, L: Plan, D: Tangents, S: Forward, number: int, y: Reals) -> None:
    """The derivative of the next row of the record by a number, from the sensitivities ``y`` of
    the workspace's state; the matrix of accelerations is factored.
    """
    nw, n_out = P.sizes.nw, P.sizes.n_out
    sensitive_accelerations(P, L, D, S, number, y, 0.0)
    out = S.record[(number * P.times.size + S.row) * (nw + n_out) :]
    copy(out, D.dW, nw)
    written = out[nw:]
    for k in range(n_out):
        written[k] = 0.0
    directed(P, D, OUTPUTS, written)
    by_number(P, D, number, OUTPUTS, written)
