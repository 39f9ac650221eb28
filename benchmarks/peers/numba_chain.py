"""CVODE (scikit-sundae) on a chain whose right-hand side numba has compiled.

One loop over the segments, without arrays between; fastmath, because ours may reorder sums, too.
The banded matrix comes from CVODE's differences: 24 calls of the compiled function, which take less
than one call of a matrix from Python.  BDF and Adams, each with Newton's method.  numba compiles in
the first run of a process only.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cache, partial
from typing import Any

import numpy as np

from benchmarks.peers.program import Laps, Program, Settings, Solution, module_found, tolerances
from benchmarks.scenes import CHAINS, Array, chain

OPTIONS = {"linsolver": "band", "lband": 11, "uband": 11, "max_num_steps": 10_000_000}


@cache
def compiled() -> Callable[..., Any]:
    """rate(t, y, out, ends, mass, numbers) by numba: states (x, v) of mass after mass."""
    import numba

    @numba.njit(fastmath=True)
    def rate(t: float, y: Array, out: Array, ends: Array, mass: Array, numbers: Array) -> None:
        n, (k, d, l0, gravity, growth, closed) = mass.size, numbers
        grown, dx = 1.0 + growth * t, np.zeros(3)
        for i in range(n):
            for j in range(3):
                out[6 * i + j], out[6 * i + 3 + j] = y[6 * i + 3 + j], 0.0
            out[6 * i + 4] = -gravity
        for s in range(n + (closed > 0.0)):
            square = along = 0.0
            for j in range(3):
                x, v = (y[6 * s + j], y[6 * s + 3 + j]) if s < n else (ends[3 + j], 0.0)
                x0, v0 = (y[6 * s - 6 + j], y[6 * s - 3 + j]) if s > 0 else (ends[j], 0.0)
                dx[j] = x - x0
                square += dx[j] * dx[j]
                along += dx[j] * (v - v0)
            length = np.sqrt(square)
            tension = k * (length - l0 * grown) + d * along / length
            pull = tension / (grown * grown * length)
            for j in range(3):
                if s < n:
                    out[6 * s + 3 + j] -= pull * dx[j] / mass[s]
                if s > 0:
                    out[6 * s - 3 + j] += pull * dx[j] / mass[s - 1]

    return rate


def solve(method: str, scene: str, n: int, settings: Settings) -> Solution:
    """Solve with CVODE."""
    from sksundae.cvode import CVODE

    laps = Laps()
    c = chain(scene, n)
    right = np.zeros(3) if c.right is None else c.right
    ends = np.concatenate((c.left, right)).astype(float)
    numbers = np.array([c.k, c.d, c.l0, c.gravity, c.rate, float(c.right is not None)])
    rate, mass = compiled(), np.ascontiguousarray(c.mass, dtype=float)
    start = np.hstack((c.position, c.velocity)).ravel()
    rate(0.0, start, np.zeros(6 * n), ends, mass, numbers)

    def rhs(t: float, y: Array, out: Array) -> None:
        rate(t, y, out, ends, mass, numbers)

    solver = CVODE(rhs, method=method, **OPTIONS, **settings)
    setup = laps.lap()
    run = solver.solve([0, c.end], start)
    values = np.array(run.y[-1]).reshape(n, 6)[:, :3].copy()
    return Solution(values, setup, laps.lap(), ok=bool(run.success))


def installed() -> bool:
    """Both libraries are needed."""
    return module_found("numba")() and module_found("sksundae")()


PROGRAMS = [
    Program(
        f"numba and CVODE {method}", "implicit", CHAINS, tolerances(1e-3, 1e-10),
        partial(solve, method), installed, compiles=True,
    )
    for method in ("BDF", "Adams")
]  # fmt: skip
