"""The error test of HHT and NEWMARK: (beta - 1/6) h^2 |b+ - b| of q."""

from __future__ import annotations

from adamslite.integrators.contract import Problem
from adamslite.integrators.hht.control import Control
from adamslite.integrators.linalg.norms import exceeds, largest_share, place_of
from adamslite.integrators.motion_equations import PART
from adamslite.native.translate import maximum, native

# gamma + alpha - 1/2 below this is round-off: HHT is of order 2 for every alpha.
FIRST_ORDER = 1e-9
# A step is rough when accelerations change by this share of the largest, and that is more than this
# share of ERROR: a vibration that is not followed but damped.
HALF, FELT = 0.5, 0.01


@native
def local_error(P: Problem, C: Control) -> float:
    """Estimated local error of positions, rotations and states over ERROR; remembers where.

    Velocities have one of (gamma + alpha - 1/2) h |b+ - b|, which is nothing but in a NEWMARK of
    order 1.  States: a share of the distance from the explicit formula of order 2.
    """
    D, s, n, ns = P.history, P.settings, P.sizes.n, P.sizes.ns
    stretch = C.h / C.h_last if C.h_last > 0.0 else 0.0
    scale = abs(s.beta - 1.0 / 6.0) * C.h * C.h
    fast = first_order_share(P) * C.h
    A, B, d, size, jump = P.ra, D[2 * n :], P.x, 0.0, 0.0
    for i in range(n):
        # b+ - b with b moved to this step's place.
        d[i] = (1.0 + s.alpha) * (P.a[i] - A[i]) - stretch * (B[i] - A[i])
        size, jump = maximum(size, abs(P.a[i])), maximum(jump, abs(d[i]))
    share = largest_share(d, P.q, n)
    top, where = scale * share, 0 if C.fixed > 0.0 else place_of(share, d, P.q, n)
    if fast > 0.0:
        share = largest_share(d, P.u, n)
        if exceeds(fast * share, top):
            top, where = fast * share, place_of(share, d, P.u, n)
    for b in range(P.sizes.nb):
        if P.body[b].width == PART:
            i = P.body[b].first
            bend = bend_of(P.u[i + 3], P.u[i + 4], P.u[i + 5], C.h)
            if exceeds(bend, top):
                top, where = bend, i + 3
    C.rough = jump > HALF * size and top > FELT * s.error
    first = P.sizes.m + P.sizes.nv
    for k in range(ns):
        o = 3 * n + k
        rate, value = D[o + ns], P.z[first + k]
        explicit = D[o] + C.h * (rate + 0.5 * stretch * (rate - D[o + 3 * ns]))
        if exceeds(0.5 * abs(value - explicit), top * max(1.0, abs(value))):
            top, where = 0.5 * abs(value - explicit) / max(1.0, abs(value)), 2 * n + k
    P.report.where, P.report.error = where, top / s.error
    return P.report.error


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
