"""Loads of point masses whose numbers are stored by component.

    S = x of all bodies, y, z, then vx, vy, vz        F = forces, the same way

in rows of equal length: see :mod:`adamslite.kernels.code.lane_writer`.
"""

from __future__ import annotations

from adamslite.integrators.contract import BY_COMPONENT, LOADS, Problem
from adamslite.native.translate import Reals, call_address, native


@native
def run_lanes(P: Problem, S: Reals, row: int, F: Reals) -> None:
    """All loads, with the other sign, into F."""
    for k in range(P.lane_runs.size):
        run, y, z = P.lane_runs[k], F[row:], F[2 * row :]
        call_address(run.function, run.count, run.ints, run.reals, run.of, P.W, S, row, F, y, z)
    if P.lane_bodies.size > 0:
        run_others(P, S, row, F)


@native
def run_others(P: Problem, S: Reals, row: int, F: Reals) -> None:
    """Loads that are not evaluated by component, with the other sign, into F: by the workspace."""
    W, body, g = P.W, P.body, P.group
    for k in range(P.lane_bodies.size):
        b = P.lane_bodies[k]
        for c in range(6):
            W[body[b].at + c] = S[c * row + b]
        for c in range(3):
            P.F[body[b].first + c] = 0.0
    for k in range(P.sizes.ng):
        if g[k].phases & LOADS and not g[k].phases & BY_COMPONENT:
            call_address(g[k].residual, g[k].count, g[k].ints, g[k].reals, P.W, P.F)
    for k in range(P.lane_bodies.size):
        b = P.lane_bodies[k]
        for c in range(3):
            F[c * row + b] += P.F[body[b].first + c]


@native
def run_masses(P: Problem, S: Reals, row: int, E: Reals) -> None:
    """Add the derivatives of all loads by the accelerations of their bodies to nine rows E."""
    for k in range(P.lane_runs.size):
        run = P.lane_runs[k]
        if run.mass:
            call_address(run.mass, run.count, run.ints, run.reals, run.of, P.W, S, row, E)
