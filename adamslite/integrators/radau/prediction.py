"""The prediction of the Radau formula: first values of its stages."""

from __future__ import annotations

from adamslite.integrators.contract import Problem
from adamslite.integrators.radau.coefficients import NODE
from adamslite.integrators.radau.control import Control
from adamslite.integrators.radau.dense_output import collocated, quadratic
from adamslite.integrators.radau.history import BEFORE
from adamslite.integrators.radau.stages import stage_motion, stage_z
from adamslite.native.translate import native


@native
def predict(P: Problem, C: Control) -> None:
    """First values of the stages: the polynomial of the step before continues, or without one
    accelerations stay; then the motion that follows from them.
    """
    h, before = C.h, C.h_last
    n, ns, first, X = P.sizes.n, P.sizes.ns, P.sizes.m + P.sizes.nv, P.tableau
    w, Y, e = 2 * n + ns, P.history, stage_z(P, 1) - stage_z(P, 0)
    for stage in range(3):
        y, z, c = Y[(1 + stage) * w :], Y[stage_z(P, stage) :], X[NODE + stage] * h
        if before > 0.0:
            collocated(P, Y[BEFORE * w :], Y[BEFORE * w :], w, 1.0 + c / before, y)
            quadratic(P, 1.0 + c / before, Y[stage_z(P, 3) :], e, first, z)
        else:
            for i in range(n):
                y[i] = Y[i] + c * (Y[n + i] + 0.5 * c * P.ra[i])
            for k in range(ns):
                y[2 * n + k] = Y[2 * n + k] + c * P.rd[k]
            for k in range(first):
                z[k] = P.rz[k]
        for k in range(ns):
            z[first + k] = y[2 * n + k]
        for k in range(P.sizes.holonomic):
            z[first + ns + k] = 0.0
    stage_motion(P, h)
