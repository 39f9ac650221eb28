"""Rates of sensitivities: the equations of accelerations, differentiated.

    F_(a, z, s') (da, dz, ds') = -(F_y dy + F_p)

with the matrix that solves for the accelerations themselves; theta' = dw + w x theta.
"""

from __future__ import annotations

from adamslite.integrators.accelerations import solve_accelerations
from adamslite.integrators.contract import ACCELERATION, Problem
from adamslite.integrators.linalg.plan import Plan
from adamslite.integrators.motion_equations import PART
from adamslite.native.translate import Reals, native
from adamslite.sensitivity.contract import Forward, Tangents
from adamslite.sensitivity.tangents import clear, put_direction, put_signals, tangent


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
