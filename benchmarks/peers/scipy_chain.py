"""The methods of scipy.integrate on a chain, with the numpy right-hand side of ``scenes``.

Radau and BDF are given the sparsity of the Jacobian, LSODA its bandwidth.
"""

from __future__ import annotations

from functools import partial
from typing import Any

import numpy as np

from benchmarks.peers.program import Laps, Program, Settings, Solution, module_found, tolerances
from benchmarks.scenes import CHAINS, Array, acceleration, chain

#: Half bandwidth of the Jacobian when the six states of a mass stand together.
BAND = 11


def solve(method: str, scene: str, n: int, settings: Settings) -> Solution:
    """Solve with one of scipy's methods."""
    import scipy.integrate

    laps = Laps()
    c = chain(scene, n)
    a = acceleration(c)
    together = method == "LSODA"

    def split(y: Array) -> tuple[Array, Array]:
        if together:
            z = y.reshape(n, 6)
            return z[:, :3], z[:, 3:]
        return tuple(y.reshape(2, n, 3))

    def join(x: Array, v: Array) -> Array:
        return np.hstack((x, v)).ravel() if together else np.concatenate((x.ravel(), v.ravel()))

    def rhs(t: float, y: Array) -> Array:
        x, v = split(y)
        return join(v, a(t, x, v))

    start, options = join(c.position, c.velocity), structure(method, n)
    solver = getattr(scipy.integrate, method)(rhs, 0.0, start, c.end, **settings, **options)
    setup, steps = laps.lap(), 0
    while solver.status == "running":
        solver.step()
        steps += 1
    if solver.status == "failed":
        return Solution(np.full((n, 3), np.nan), setup, laps.lap(), steps, ok=False)
    return Solution(split(solver.y)[0].copy(), setup, laps.lap(), steps)


def structure(method: str, n: int) -> dict[str, Any]:
    """What the method is told about the Jacobian."""
    if method == "LSODA":
        return {"lband": BAND, "uband": BAND}
    if method == "DOP853":
        return {}
    from scipy.sparse import bmat, csr_matrix, diags, identity, kron

    neighbours = diags([1.0, 1.0, 1.0], [-1, 0, 1], shape=(n, n))
    block = kron(neighbours, np.ones((3, 3)))
    return {"jac_sparsity": csr_matrix(bmat([[None, identity(3 * n)], [block, block]]))}


def program(method: str, kind: str) -> Program:
    """One of scipy's methods as a program."""
    return Program(
        f"scipy {method}", kind, CHAINS, tolerances(1e-3, 1e-9), partial(solve, method),
        module_found("scipy"),
    )  # fmt: skip


PROGRAMS = [
    program("Radau", "implicit"),
    program("BDF", "implicit"),
    program("LSODA", "implicit"),
    program("DOP853", "explicit"),
]
