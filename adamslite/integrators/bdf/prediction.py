"""The predictor of the backward differences: their polynomial, continued."""

from __future__ import annotations

from adamslite.integrators.bdf.control import Control
from adamslite.integrators.bdf.differences import extrapolate, gamma
from adamslite.integrators.contract import Problem
from adamslite.integrators.motion_equations import put_time
from adamslite.native.translate import native

# Multipliers and variables are continued by a straight line, but not further than this many steps.
FAR = 2.0


@native
def predict(P: Problem, C: Control) -> None:
    """Predicted values of all unknowns at the end of the step; of q only the change is kept.

    In ``P.trial``: y_p, psi, q', and the correction e of q, nothing so far.
    """
    n, ns, w = P.sizes.n, P.sizes.ns, C.width
    first = P.sizes.m + P.sizes.nv
    yp, e = P.trial[0:], P.trial[2 * w + n :]
    C.cu = gamma(C.order) / C.h
    extrapolate(P.history, w, C.order, yp, P.trial[w:])
    for i in range(n, w):
        yp[i] += P.history[i]
    for i in range(n):
        P.q[i], e[i] = P.history[i] + yp[i], 0.0
    for i in range(ns):
        P.z[first + i] = yp[2 * n + i]
    ahead = C.h / C.h_last if C.h_last > 0.0 else 0.0
    for i in range(first):
        P.z[i] = P.rz[i] + min(ahead, FAR) * (P.rz[i] - P.pz[i])
    for i in range(P.mu.size):
        P.mu[i] = 0.0
    put_time(P, C.t + C.h)
