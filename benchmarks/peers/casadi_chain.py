"""CasADi's IDAS and CVODES on a chain: symbolic right-hand side, exact sparse Jacobian.

Evaluated by CasADi's own interpreter, or ("jit") as C that a compiler has translated with -O2.
"""

from __future__ import annotations

import contextlib
import shutil
import tempfile
from collections.abc import Callable
from functools import cache, partial
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


@cache
def integrator(method: str, jit: bool, scene: str, n: int, rtol: float, atol: float) -> Any:
    """CasADi's integrator with its default direct solver, kept with the code that it has compiled;
    the files of the compiler are written to a folder that is deleted.
    """
    import casadi as ca

    c = chain(scene, n)
    f = right_hand_side(ca, c)
    t, y = ca.SX.sym("t"), ca.SX.sym("y", 6 * n)
    options = {
        "reltol": rtol, "abstol": atol, "max_num_steps": 10_000_000, "newton_scheme": "direct",
    }  # fmt: skip
    if jit:
        how = {"compiler": compiler(), "flags": ["-O2"]}
        options |= {"jit": True, "compiler": "shell", "jit_options": how}
    problem = {"t": t, "x": y, "ode": f(t, y)}
    with tempfile.TemporaryDirectory() as folder, contextlib.chdir(folder):
        return ca.integrator("integrator", method, problem, 0.0, float(c.end), options)


def solve(method: str, jit: bool, scene: str, n: int, settings: Settings) -> Solution:
    """Solve with "idas" or "cvodes"."""
    import casadi  # noqa: F401  an import is no set-up

    laps = Laps()
    if not jit:
        integrator.cache_clear()
    solver = integrator(method, jit, scene, n, settings["rtol"], settings["atol"])
    c = chain(scene, n)
    setup = laps.lap()
    end = solver(x0=np.hstack((c.position, c.velocity)).ravel())["xf"]
    took = laps.lap()
    steps = int(solver.stats().get("nsteps", 0))
    return Solution(np.array(end).reshape(n, 6)[:, :3].copy(), setup, took, steps)


def compiler() -> str:
    """A compiler of C, empty where there is none."""
    return next((name for name in ("gcc", "clang", "cc") if shutil.which(name)), "")


def installed(jit: bool) -> Callable[[], bool]:
    """Whether CasADi is there, and for ``jit`` a compiler."""
    found = module_found("casadi")
    return lambda: found() and (not jit or bool(compiler()))


PROGRAMS = [
    Program(
        f"CasADi {method}{', jit' if jit else ''}", "implicit", CHAINS, tolerances(1e-3, 1e-9),
        partial(solve, method, jit), installed(jit), compiles=jit,
    )
    for method in ("idas", "cvodes")
    for jit in (False, True)
]  # fmt: skip
