"""scikit-sundae on a chain: IDA (implicit residual) and CVODE (BDF), banded, numpy call-backs."""

from __future__ import annotations

from functools import partial

import numpy as np

from benchmarks.peers.program import Laps, Program, Settings, Solution, module_found, tolerances
from benchmarks.scenes import CHAINS, Array, acceleration, chain

OPTIONS = {"linsolver": "band", "lband": 11, "uband": 11, "max_num_steps": 10_000_000}


def solve(method: str, scene: str, n: int, settings: Settings) -> Solution:
    """Solve with IDA or CVODE; the six states of a mass stand together."""
    from sksundae.cvode import CVODE
    from sksundae.ida import IDA

    laps = Laps()
    c = chain(scene, n)
    a = acceleration(c)

    def residual(t: float, y: Array, rate: Array, out: Array) -> None:
        z, dz, r = y.reshape(n, 6), rate.reshape(n, 6), out.reshape(n, 6)
        r[:, :3] = dz[:, :3] - z[:, 3:]
        r[:, 3:] = dz[:, 3:] - a(t, z[:, :3], z[:, 3:])

    def rhs(t: float, y: Array, rate: Array) -> None:
        z, dz = y.reshape(n, 6), rate.reshape(n, 6)
        dz[:, :3] = z[:, 3:]
        dz[:, 3:] = a(t, z[:, :3], z[:, 3:])

    start = np.hstack((c.position, c.velocity)).ravel()
    if method == "IDA":
        rate = np.hstack((c.velocity, a(0.0, c.position, c.velocity))).ravel()
        solver = IDA(residual, **OPTIONS, **settings)
        setup = laps.lap()
        run = solver.solve([0, c.end], start, rate)
    else:
        solver = CVODE(rhs, method="BDF", **OPTIONS, **settings)
        setup = laps.lap()
        run = solver.solve([0, c.end], start)
    values = np.array(run.y[-1]).reshape(n, 6)[:, :3].copy()
    return Solution(values, setup, laps.lap(), ok=bool(run.success))


PROGRAMS = [
    Program(
        f"scikit-sundae {method}", "implicit", CHAINS, tolerances(1e-3, 1e-9),
        partial(solve, method), module_found("sksundae"),
    )
    for method in ("IDA", "CVODE")
]  # fmt: skip
