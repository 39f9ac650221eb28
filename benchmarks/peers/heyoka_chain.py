"""heyoka on a chain: Taylor's series of adaptive order, compiled for the scene and the tolerance.

The order follows from the tolerance alone, so that each setting has code of its own; heyoka keeps
it in memory, so that only the first run of a setting compiles. Code for every mass is two to five
times faster than loops over equal expressions ("compact mode"), and compiles in seconds up to some
hundred masses.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from benchmarks.peers.program import Laps, Program, Settings, Solution, module_found
from benchmarks.scenes import CHAINS, Chain, chain

#: Masses from which on the scene is compiled in compact mode.
COMPACT = 100


def equations(hy: Any, c: Chain) -> list[tuple[Any, Any]]:
    """Pairs (state, its rate), x and v of mass after mass."""
    growth = 1.0 + c.rate * hy.time if c.rate else 1.0
    x = [hy.make_vars(*(f"{a}{i}" for a in "xyz")) for i in range(c.n)]
    v = [hy.make_vars(*(f"v{a}{i}" for a in "xyz")) for i in range(c.n)]
    ends_x, ends_v = [c.left.tolist(), *x], [[0.0] * 3, *v]
    if c.right is not None:
        ends_x, ends_v = [*ends_x, c.right.tolist()], [*ends_v, [0.0] * 3]
    pulls = [
        pull(hy, c, growth, *ends)
        for ends in zip(ends_x, ends_x[1:], ends_v, ends_v[1:], strict=False)
    ]
    if c.right is None:
        pulls.append([0.0] * 3)
    rates = []
    for i in range(c.n):
        weight = [0.0, -c.gravity, 0.0]
        for k in range(3):
            force = pulls[i + 1][k] - pulls[i][k]
            rates.append((x[i][k], v[i][k]))
            rates.append((v[i][k], force / (float(c.mass[i]) * growth) + weight[k]))
    return rates


def pull(hy: Any, c: Chain, growth: Any, xa: Any, xb: Any, va: Any, vb: Any) -> list[Any]:
    """The force of one segment on its first end."""
    d = [b - a for a, b in zip(xa, xb, strict=True)]
    w = [b - a for a, b in zip(va, vb, strict=True)]
    squared = hy.sum([e * e for e in d])
    rate = hy.sum([e * f for e, f in zip(d, w, strict=True)])
    size = c.k / growth - c.k * c.l0 / hy.sqrt(squared) + c.d / growth * rate / squared
    return [size * e for e in d]


def solve(scene: str, n: int, settings: Settings) -> Solution:
    """Solve with heyoka's adaptive integrator."""
    import heyoka as hy

    laps = Laps()
    c = chain(scene, n)
    start = np.stack((c.position, c.velocity), axis=-1).ravel()
    integrator = hy.taylor_adaptive(
        equations(hy, c), start, tol=settings["rtol"], compact_mode=n >= COMPACT, fast_math=True
    )
    setup = laps.lap()
    outcome, _, _, steps, *_ = integrator.propagate_until(c.end)
    took = laps.lap()
    done = outcome == hy.taylor_outcome.time_limit
    values = integrator.state.reshape(n, 3, 2)[:, :, 0].copy()
    return Solution(values, setup, took, int(steps), done, "" if done else str(outcome))


def ladder(scene: str, n: int) -> list[Settings]:
    """Tolerances two a decade; tighter ones have higher orders and longer steps."""
    return [{"rtol": float(f"{x:.2g}")} for x in np.geomspace(1e-2, 1e-15, 27)]


PROGRAMS = [
    Program(
        "heyoka Taylor", "explicit", CHAINS, ladder, solve, module_found("heyoka"),
        compiles=True,
    )
]  # fmt: skip
