"""CasADi's IDAS and CVODES on a chain: symbolic right-hand side, exact sparse Jacobian."""

from __future__ import annotations

from functools import partial
from typing import Any

import numpy as np

from benchmarks.peers.program import Laps, Program, Settings, Solution, module_found, tolerances
from benchmarks.scenes import CHAINS, Chain, chain


def right_hand_side(ca: Any, c: Chain) -> Any:
    """Function (t, y) -> y' with y = x, v of mass after mass, expanded to scalars."""
    t, y = ca.MX.sym("t"), ca.MX.sym("y", 6 * c.n)
    q, w, grown = ca.SX.sym("q", 6), ca.SX.sym("w", 6), ca.SX.sym("grown")
    dx, dv = w[:3] - q[:3], w[3:] - q[3:]
    squared = ca.dot(dx, dx)
    spring = c.k * (1 / grown - c.l0 / ca.sqrt(squared))
    pull = (spring + c.d / grown * ca.dot(dx, dv) / squared) * dx
    segment = ca.Function("segment", [q, w, grown], [pull])
    states = ca.reshape(y, 6, c.n)
    row = [ca.DM([*c.left, 0, 0, 0]), states]
    if c.right is not None:
        row.append(ca.DM([*c.right, 0, 0, 0]))
    row = ca.horzcat(*row)
    growth = 1 + c.rate * t
    force = segment.map(c.n_segments)(row[:, :-1], row[:, 1:], ca.repmat(growth, 1, c.n_segments))
    if c.right is None:
        force = ca.horzcat(force, ca.DM.zeros(3, 1))
    mass = ca.repmat(ca.DM(c.mass).T, 3, 1) * growth
    a = (force[:, 1:] - force[:, :-1]) / mass + ca.repmat(ca.DM([0, -c.gravity, 0]), 1, c.n)
    return ca.Function("f", [t, y], [ca.vec(ca.vertcat(states[3:, :], a))]).expand()


def solve(method: str, scene: str, n: int, settings: Settings) -> Solution:
    """Solve with "idas" or "cvodes" and CasADi's default direct solver."""
    import casadi as ca

    laps = Laps()
    c = chain(scene, n)
    f = right_hand_side(ca, c)
    t, y = ca.SX.sym("t"), ca.SX.sym("y", 6 * n)
    options = {
        "reltol": settings["rtol"], "abstol": settings["atol"],
        "max_num_steps": 10_000_000, "newton_scheme": "direct",
    }  # fmt: skip
    problem = {"t": t, "x": y, "ode": f(t, y)}
    integrator = ca.integrator("integrator", method, problem, 0.0, float(c.end), options)
    setup = laps.lap()
    end = integrator(x0=np.hstack((c.position, c.velocity)).ravel())["xf"]
    took = laps.lap()
    steps = int(integrator.stats().get("nsteps", 0))
    return Solution(np.array(end).reshape(n, 6)[:, :3].copy(), setup, took, steps)


PROGRAMS = [
    Program(
        f"CasADi {method}", "implicit", CHAINS, tolerances(1e-3, 1e-9), partial(solve, method),
        module_found("casadi"),
    )
    for method in ("idas", "cvodes")
]  # fmt: skip
