"""The stick-slip law in numpy, and a solver that begins again wherever its regime changes.

Independent of the program: regimes are followed by terminal events of DOP853.
"""

from typing import NamedTuple

import numpy as np
from scipy.integrate import solve_ivp


class Law(NamedTuple):
    """MU_STATIC, MU_DYNAMIC, STICTION_TRANSITION_VELOCITY, MAX_STICTION_DEFORMATION."""

    rest: float
    moving: float
    vs: float = 0.1
    give: float = 0.01


def step5(x, x0, h0, x1, h1):
    d = min(max((x - x0) / (x1 - x0), 0.0), 1.0)
    return h0 + (h1 - h0) * d**3 * (10 - 15 * d + 6 * d * d)


def odd(x):
    """STEP5(x, -1, -1, 1, 1)."""
    return step5(x, -1.0, -1.0, 1.0, 1.0)


def toward(x):
    return x / max(np.linalg.norm(x), 1e-300)


def coefficient(law, v, creep, slow):
    """Coefficient and direction along the slip v, both vectors."""
    speed = np.linalg.norm(v)
    if slow:
        beta = odd(speed / law.vs)
        held = odd(np.linalg.norm(creep) / law.give) * toward(creep)
        direction = beta * toward(v) + (1 - beta) * held
        return law.rest * direction, direction
    mu = step5(speed, law.vs, law.rest, 1.5 * law.vs, law.moving)
    return mu * toward(v), toward(v)


def longer(law, v, creep):
    """What of v lengthens a creep beyond the greatest: it fades out within one per cent."""
    length = creep @ creep / law.give**2
    if length <= 1:
        return 0 * creep
    return step5(length, 1, 0, 1.01**2, 1) * max(v @ creep, 0) * creep / (creep @ creep)


def solve(law, slip, rates, start, times, held=True, longest=1e-3):
    """Motion (n, nt) and creep (m, nt) of y' = rates(t, y, mu, direction) with slip(y).

    ``held``: whether there is creep; it stays 0 otherwise.
    """
    m, n = len(slip(np.array(start, dtype=float))), len(start)
    y, t = np.array([*start, *np.zeros(m)], dtype=float), times[0]
    slow = np.linalg.norm(slip(y[:n])) < law.vs
    found = np.zeros((n + m, len(times)))
    while t < times[-1]:

        def f(t, y, slow=slow):
            v, creep = slip(y[:n]), y[n:]
            moved = (v - longer(law, v, creep)) * (slow and held)
            return [*rates(t, y[:n], *coefficient(law, v, creep, slow)), *moved]

        def leaves(t, y):
            return law.vs - np.linalg.norm(slip(y[:n]))

        leaves.direction, leaves.terminal = (-1 if slow else 1), True
        part = solve_ivp(
            f, (t, times[-1]), y, "DOP853", rtol=1e-11, atol=1e-13, max_step=longest,
            events=leaves, dense_output=True,
        )  # fmt: skip
        now = (times >= t) & (times <= part.t[-1])
        if now.any():
            found[:, now] = part.sol(times[now])
        t, y = part.t[-1], part.y[:, -1]
        if part.status == 1:
            slow = not slow
            y[n:] = 0.0
    return found[:n], found[n:]
