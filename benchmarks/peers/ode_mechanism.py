"""scipy, scikit-sundae and CasADi on planar mechanisms, with the equations of ``planar``.

All on index 1: ODE solvers get the accelerations, IDA and IDAS accelerations and multipliers as
algebraic unknowns. Constraints are not stabilised; within these runs they drift little.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import Any

import numpy as np

from benchmarks.mechanisms import PLANAR, watched
from benchmarks.peers.program import Laps, Program, Settings, Solution, module_found, tolerances
from benchmarks.planar import Equations, planar
from benchmarks.scenes import Array

#: More bodies make dense matrices the bottleneck, and a user would not do this.
LARGEST = 50


def solution(scene: str, n: int, y: Array, setup: float, took: float, steps: int) -> Solution:
    """The watched values of an end state."""
    size = 3 * planar(scene, n).n
    place, speed = y[:size].reshape(-1, 3), y[size : 2 * size].reshape(-1, 3)
    values = watched(scene, n, place, speed)
    return Solution(values, setup, took, steps, bool(np.isfinite(values).all()))


def finished(scene: str, n: int, run: Any, setup: float, took: float) -> Solution:
    """What a run of SUNDIALS came to; an early end is reported."""
    if not run.success:
        return Solution(np.full(1, np.nan), setup, took, ok=False)
    return solution(scene, n, np.array(run.y[-1]), setup, took, 0)


def scipy(method: str, scene: str, n: int, settings: Settings) -> Solution:
    """One of scipy's methods on the accelerations."""
    import scipy.integrate

    m = planar(scene, n)
    laps = Laps()
    equations = Equations(m)
    solver = getattr(scipy.integrate, method)(
        equations.rhs, 0.0, equations.start, m.end, **settings
    )
    setup, steps = laps.lap(), 0
    while solver.status == "running":
        solver.step()
        steps += 1
    if solver.status == "failed":
        return Solution(np.full(1, np.nan), setup, laps.lap(), steps, ok=False)
    return solution(scene, n, solver.y, setup, laps.lap(), steps)


def cvode(scene: str, n: int, settings: Settings) -> Solution:
    """CVODE, dense difference Jacobian."""
    from sksundae.cvode import CVODE

    m = planar(scene, n)
    laps = Laps()
    equations = Equations(m)

    def rhs(t: float, y: Array, rate: Array) -> None:
        rate[:] = equations.rhs(t, y)

    solver = CVODE(rhs, method="BDF", max_num_steps=10_000_000, **settings)
    setup = laps.lap()
    run = solver.solve([0.0, m.end], equations.start)
    return finished(scene, n, run, setup, laps.lap())


def ida(scene: str, n: int, settings: Settings) -> Solution:
    """IDA on places, speeds and multipliers."""
    from sksundae.ida import IDA

    m = planar(scene, n)
    laps = Laps()
    equations = Equations(m)
    size, weights = 3 * m.n, equations.weights.ravel()

    def residual(t: float, y: Array, rate: Array, out: Array) -> None:
        place, speed = y[: 2 * size].reshape(2, -1, 3)
        a = rate[size : 2 * size]
        gradient, gamma = equations.constraints(place, speed)
        out[:size] = rate[:size] - y[size : 2 * size]
        force = equations.forces(place).ravel() - gradient.T @ y[2 * size :]
        out[size : 2 * size] = weights * a - force
        out[2 * size :] = gradient @ a - gamma

    a, lam = equations.accelerations(m.place, m.speed)
    start = np.concatenate((equations.start, lam))
    rate = np.concatenate((m.speed.ravel(), a.ravel(), 0.0 * lam))
    algebraic = list(range(2 * size, 2 * size + m.rows))
    solver = IDA(residual, algebraic_idx=algebraic, max_num_steps=10_000_000, **settings)
    setup = laps.lap()
    run = solver.solve([0.0, m.end], start, rate)
    return finished(scene, n, run, setup, laps.lap())


def idas(scene: str, n: int, settings: Settings) -> Solution:
    """CasADi's IDAS: symbolic equations, exact sparse Jacobian."""
    import casadi as ca

    m = planar(scene, n)
    laps = Laps()
    equations = Equations(m)
    problem = symbolic(ca, equations)
    options = {
        "reltol": settings["rtol"], "abstol": settings["atol"],
        "max_num_steps": 10_000_000, "newton_scheme": "direct",
    }  # fmt: skip
    solver = ca.integrator("integrator", "idas", problem, 0.0, float(m.end), options)
    a, lam = equations.accelerations(m.place, m.speed)
    setup = laps.lap()
    end = solver(x0=equations.start, z0=np.concatenate((a.ravel(), lam)))["xf"]
    took = laps.lap()
    steps = int(solver.stats().get("nsteps", 0))
    return solution(scene, n, np.array(end).ravel(), setup, took, steps)


def symbolic(ca: Any, e: Equations) -> dict[str, Any]:
    """x = places and speeds, z = accelerations and multipliers."""
    m, size = e.m, 3 * e.m.n
    q, v, a = (ca.SX.sym(name, size) for name in "qva")
    lam = ca.SX.sym("lam", m.rows)

    def point(body: int, p: Array) -> Any:
        if body < 0:
            return ca.DM(p)
        c, s = ca.cos(q[3 * body + 2]), ca.sin(q[3 * body + 2])
        turned = ca.vertcat(c * p[0] - s * p[1], s * p[0] + c * p[1])
        return q[3 * body : 3 * body + 2] + turned

    pins = [point(i, p) - point(j, r) for i, p, j, r in m.pins]
    slides = [q[3 * b + 1 : 3 * b + 3] for b in m.guides]
    g = ca.vertcat(*pins, *slides)
    gradient = ca.jacobian(g, q)
    energy = sum(
        0.5 * k * (ca.norm_2(point(i, p) - point(j, r)) - l0) ** 2
        for i, p, j, r, k, l0 in m.springs
    )
    force = ca.DM(e.force.ravel()) - (ca.gradient(energy, q) if m.springs else 0)
    bent = ca.jtimes(ca.jtimes(g, q, v), q, v)
    rows = [ca.DM(e.weights.ravel()) * a + gradient.T @ lam - force, gradient @ a + bent]
    return {
        "x": ca.vertcat(q, v), "z": ca.vertcat(a, lam),
        "ode": ca.vertcat(v, a), "alg": ca.vertcat(*rows),
    }  # fmt: skip


def ladder(scene: str, n: int) -> list[Settings]:
    """Tolerances; nothing for large mechanisms."""
    return tolerances(1e-3, 1e-10)(scene, n) if n <= LARGEST else []


def program(name: str, kind: str, run: Callable[..., Solution], module: str) -> Program:
    """One solver as a program."""
    return Program(f"{name}, mechanism", kind, PLANAR, ladder, run, module_found(module))


PROGRAMS = [
    *(program(f"scipy {name}", "implicit", partial(scipy, name), "scipy")
      for name in ("Radau", "BDF", "LSODA")),
    program("scipy DOP853", "explicit", partial(scipy, "DOP853"), "scipy"),
    program("scikit-sundae IDA", "implicit", ida, "sksundae"),
    program("scikit-sundae CVODE", "implicit", cvode, "sksundae"),
    program("CasADi idas", "implicit", idas, "casadi"),
]  # fmt: skip
