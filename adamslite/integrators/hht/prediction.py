"""The predictor of HHT and NEWMARK, and how the formula turns parts.

Equations and references: :mod:`adamslite.integrators.hht.method`.
"""

from __future__ import annotations

from adamslite.integrators.contract import Problem
from adamslite.integrators.hht.control import Control
from adamslite.integrators.motion_equations import (
    PART,
    put_motion,
    put_pose,
    put_scalars,
    put_time,
)
from adamslite.native.translate import copy, native


@native
def choose_coefficients(P: Problem, C: Control) -> None:
    """How u and a follow from q, and s' from s, in a step of this size."""
    s, h = P.settings, C.h
    beta, gamma, one = s.beta, s.gamma, 1.0 + s.alpha
    C.cu, C.ca, C.cs = gamma / (beta * h), 1.0 / (beta * h * h * one), 1.0 / (gamma * h * one)


@native
def predict(P: Problem, C: Control) -> None:
    """Unknowns at the end of the step with a+ = a and s'+ = s'; writes the workspace."""
    D, s, n, ns = P.history, P.settings, P.sizes.n, P.sizes.ns
    h, beta, gamma, first = C.h, s.beta, s.gamma, P.sizes.m + P.sizes.nv
    put_time(P, C.t + h)
    stretch = h / C.h_last if C.h_last > 0.0 else 0.0
    q, u, a, U, B, A = P.q, P.u, P.a, D[n:], D[2 * n :], P.ra
    for i in range(n):
        b = A[i] + (B[i] - A[i]) * stretch
        q[i] = D[i] + h * (U[i] + h * ((0.5 - beta) * b + beta * A[i]))
        u[i] = U[i] + h * ((1.0 - gamma) * b + gamma * A[i])
        a[i] = A[i]
    for body in range(P.sizes.nb):
        if P.body[body].width == PART:
            turn_from_start(P, C, P.body[body].first)
    copy(P.z, P.rz, first)
    for k in range(ns):
        o = 3 * n + k
        rate = D[o + ns]
        b = rate + (D[o + 2 * ns] - rate) * stretch
        P.z[first + k] = D[o] + h * ((1.0 - gamma) * b + gamma * rate)
        P.rd[k] = rate
    put_pose(P, q)
    put_motion(P, u, a)
    put_scalars(P, P.z, P.rd)


@native
def turn_from_start(P: Problem, C: Control, i: int) -> None:
    """Cayley vector c = theta tan(x)/x, x = |theta|/2, of the part whose positions start at ``i``.

    theta = h w + h^2 ((1/2 - beta) b + beta b+) + h^3/12 w' x w is the rotation vector of the step,
    w' x w because w turns: Magnus' series.  tan(x)/x by its continued fraction, exact to round-off.
    """
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
