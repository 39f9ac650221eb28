"""The scenes: what moves, as plain arrays, from the numbers in scenes.json.

Chains (S1 swinging cable, S2 transverse impact, S5 payout)::

    anchor o--/\\/\\--o--/\\/\\--o ... o [--/\\/\\--o anchor]
                     0         1       n-1

    m g_t x_i" = S_(i+1) - S_i + m g_t g,     g_t = 1 + rate t   (rate = 0 in S1 and S2)
    S_i = (k/g_t (l - g_t l0) + d/g_t d.d'/l) d/l,   d = x_i - x_(i-1),  l = |d|

Mechanisms are in ``mechanisms``.
"""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np

Array = np.ndarray

CHAINS = ("S1", "S2", "S5")
#: S1 at its start: N cables of different N, the same time in units of a wave through one segment.
STARTING = "S1-start"
SEGMENTS_PASSED = 300.0
#: ... and the same time in seconds, for methods that step over waves and would hardly have started.
FALLING = "S1-fall"
FALL = 0.4
SCALING = (STARTING, FALLING)
SCALING_SIZES = (10, 50, 200, 1000, 10000)


@cache
def parameters() -> dict[str, dict[str, Any]]:
    """Everything in scenes.json, by scene."""
    return json.loads((Path(__file__).parent / "scenes.json").read_text())


def sizes(scene: str) -> list[int]:
    """The values of N a scene is meant for; a slider-crank has one."""
    return parameters().get(scene, {}).get("N", [1])


@dataclass(frozen=True)
class Chain:
    """n point masses joined in a row by springs with dampers; SI units, ground axes.

    mass : (n,) at t = 0;  position, velocity : (n, 3) at t = 0;  left, right : (3,) anchors,
    right may be missing.  Stiffness k [N/m], damping d [N s/m] and free length l0 [m] of each
    segment are those at t = 0; gravity [m/s^2] pulls along -y; rate [1/s] is the growth of S5.
    """

    title: str
    mass: Array
    position: Array
    velocity: Array
    left: Array
    right: Array | None
    k: float
    d: float
    l0: float
    gravity: float
    end: float
    rate: float = 0.0

    @property
    def n(self) -> int:
        """Number of masses."""
        return len(self.mass)

    @property
    def n_segments(self) -> int:
        """Number of springs."""
        return self.n + (self.right is not None)

    @property
    def top_frequency(self) -> float:
        """Bound of the undamped circular frequencies [rad/s]; the one-mass one for n = 1."""
        return 2.0 * float(np.sqrt(self.k / self.mass.min()))


def chain(scene: str, n: int) -> Chain:
    """The chain of a scene with n moving masses."""
    return impact(n) if scene == "S2" else cable(scene, n)


def cable(scene: str, n: int) -> Chain:
    """S1 and S5: n masses from a fixed end, released from the horizontal."""
    p = parameters()["S1" if scene in SCALING else scene]
    l0 = p["L"] / n
    k = p["EA"] / l0
    passing = SEGMENTS_PASSED * l0 / (p["EA"] / p["rho"]) ** 0.5
    end = {STARTING: passing, FALLING: FALL}.get(scene) or p["T"]
    position = np.zeros((n, 3))
    position[:, 0] = l0 * np.arange(1, n + 1)
    return Chain(
        title=f"{scene}: {p['what'].partition(',')[0].partition(':')[0]}, {n} masses",
        mass=np.full(n, p["rho"] * l0), position=position, velocity=np.zeros((n, 3)),
        left=np.zeros(3), right=None, k=k, d=p["beta"] * k, l0=l0,
        gravity=p["g"], end=end, rate=p.get("rate", 0.0),
    )  # fmt: skip


def impact(n: int) -> Chain:
    """S2: n masses between two fixed ends under tension T0, the middle one struck along -y."""
    p = parameters()["S2"]
    pitch = p["L"] / (n + 1)
    l0 = pitch / (1 + p["T0"] / p["EA"])
    k = p["EA"] / l0
    mass = np.full(n, p["rho"] * l0)
    position, velocity = np.zeros((n, 3)), np.zeros((n, 3))
    position[:, 0] = pitch * np.arange(1, n + 1)
    mass[n // 2] += p["M_impact"]
    velocity[n // 2, 1] = -p["v_impact"]
    return Chain(
        title=f"S2: transverse impact on a taut cable, {n} masses",
        mass=mass, position=position, velocity=velocity,
        left=np.zeros(3), right=np.array([p["L"], 0.0, 0.0]),
        k=k, d=p["beta"] * k, l0=l0, gravity=p["g"], end=p["T"],
    )  # fmt: skip


def acceleration(c: Chain) -> Callable[[float, Array, Array], Array]:
    """Return a(t, x, v), each (n, 3): what a careful numpy user writes."""
    n = c.n
    x_all, v_all = np.zeros((c.n_segments + 1, 3)), np.zeros((c.n_segments + 1, 3))
    x_all[0] = c.left
    if c.right is not None:
        x_all[-1] = c.right
    per_mass = 1.0 / c.mass[:, None]

    def rule(t: float, x: Array, v: Array) -> Array:
        grown = 1.0 + c.rate * t
        x_all[1 : n + 1] = x
        v_all[1 : n + 1] = v
        dx, dv = np.diff(x_all, axis=0), np.diff(v_all, axis=0)
        length = np.sqrt(np.einsum("ij,ij->i", dx, dx))
        stretch = length - c.l0 * grown
        tension = c.k * stretch + c.d * np.einsum("ij,ij->i", dx, dv) / length
        force = (tension / (grown * length))[:, None] * dx
        a = -force[:n]
        a[: c.n_segments - 1] += force[1:]
        a *= per_mass / grown
        a[:, 1] -= c.gravity
        return a

    return rule
