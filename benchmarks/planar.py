"""A planar mechanism as arrays, and its equations for programs that take a right-hand side.

Place of body b: (x, y, phi) of its mass centre.  Every joint in the plane is a pin::

    g = r_i + R(phi_i) p - r_j - R(phi_j) q = 0

or a guide along x, which keeps y and phi.  Index 1, accelerations and multipliers from::

    [ M  G^T ] [ a  ]   [ f     ]        gamma = R(phi_i) p phi_i'^2 - R(phi_j) q phi_j'^2
    [ G  0   ] [ lam] = [ gamma ]
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from benchmarks.mechanisms import GROUND, Mechanism, mechanism
from benchmarks.scenes import Array


@dataclass(frozen=True)
class Planar:
    """mass, inertia, torque : (n,);  place, speed : (n, 3);  gravity : (2,).

    pins : (i, p, j, q), bodies (or ``GROUND``) and points from the mass centre
    guides : bodies that slide along x;  springs : (i, p, j, q, stiffness, free length)
    """

    mass: Array
    inertia: Array
    torque: Array
    place: Array
    speed: Array
    gravity: Array
    pins: tuple[tuple[int, Array, int, Array], ...]
    guides: tuple[int, ...]
    springs: tuple[tuple[int, Array, int, Array, float, float], ...]
    end: float

    @property
    def n(self) -> int:
        """Number of bodies."""
        return len(self.mass)

    @property
    def rows(self) -> int:
        """Number of constraint rows."""
        return 2 * (len(self.pins) + len(self.guides))


def planar(scene: str, n: int) -> Planar:
    """The plane of a mechanism that moves in x and y."""
    m: Mechanism = mechanism(scene, n)
    angle = np.arctan2(m.attitude[:, 1, 0], m.attitude[:, 0, 0])
    slides = [j for j in m.joints if j.kind == "TRANSLATIONAL"]
    return Planar(
        mass=m.mass, inertia=m.inertia[:, 2, 2], torque=m.torque, gravity=m.gravity[:2], end=m.end,
        place=np.column_stack([m.x[:, :2], angle]),
        speed=np.column_stack([m.v[:, :2], m.w[:, 2]]),
        pins=tuple((j.i, j.p[:2], j.j, j.q[:2]) for j in m.joints if j not in slides),
        guides=tuple(j.i for j in slides),
        springs=tuple((i, p[:2], j, q[:2], k, l0) for i, p, j, q, k, l0 in m.springs),
    )  # fmt: skip


class Equations:
    """Accelerations of a planar mechanism, as a careful numpy user writes them."""

    def __init__(self, m: Planar) -> None:
        self.m = m
        self.weights = np.repeat(m.mass, 3).reshape(-1, 3)
        self.weights[:, 2] = m.inertia
        self.force = np.zeros((m.n, 3))
        self.force[:, :2] = m.mass[:, None] * m.gravity
        self.force[:, 2] = m.torque
        self.ends = [
            (
                np.array([pin[side] for pin in m.pins]),
                np.array([pin[side + 1] for pin in m.pins]),
                sign,
            )
            for side, sign in ((0, 1.0), (2, -1.0))
        ]
        self.gradient = np.zeros((m.rows, 3 * m.n))
        for row, body in enumerate(m.guides, start=len(m.pins)):
            self.gradient[2 * row, 3 * body + 1] = self.gradient[2 * row + 1, 3 * body + 2] = 1.0

    def forces(self, place: Array) -> Array:
        """Weights, torques and springs (n, 3)."""
        if not self.m.springs:
            return self.force
        force = self.force.copy()
        for i, p, j, q, k, l0 in self.m.springs:
            arm_i, arm_j = _turned(place, i, p), _turned(place, j, q)
            d = _centre(place, i) + arm_i - _centre(place, j) - arm_j
            pull = -k * (1.0 - l0 / np.hypot(*d)) * d
            for body, arm, f in ((i, arm_i, pull), (j, arm_j, -pull)):
                if body != GROUND:
                    force[body, :2] += f
                    force[body, 2] += arm[0] * f[1] - arm[1] * f[0]
        return force

    def constraints(self, place: Array, speed: Array) -> tuple[Array, Array]:
        """G (rows, 3 n) and gamma (rows,)."""
        gradient, gamma = self.gradient, np.zeros((self.m.rows // 2, 2))
        pins = np.arange(len(self.m.pins))
        for body, point, sign in self.ends:
            moving = body != GROUND
            b, p, row = body[moving], point[moving], 2 * pins[moving]
            c, s = np.cos(place[b, 2]), np.sin(place[b, 2])
            arm = np.column_stack([c * p[:, 0] - s * p[:, 1], s * p[:, 0] + c * p[:, 1]])
            gradient[row, 3 * b] = gradient[row + 1, 3 * b + 1] = sign
            gradient[row, 3 * b + 2] = -sign * arm[:, 1]
            gradient[row + 1, 3 * b + 2] = sign * arm[:, 0]
            gamma[pins[moving]] += sign * arm * speed[b, 2:] ** 2
        return gradient, gamma.ravel()

    def accelerations(self, place: Array, speed: Array) -> tuple[Array, Array]:
        """a (n, 3) and the multipliers (rows,)."""
        gradient, gamma = self.constraints(place, speed)
        f, w = self.forces(place).ravel(), self.weights.ravel()
        mobile = gradient / w
        lam = np.linalg.solve(mobile @ gradient.T, mobile @ f - gamma)
        return ((f - gradient.T @ lam) / w).reshape(-1, 3), lam

    def rhs(self, t: float, y: Array) -> Array:
        """y' of y = places and speeds (6 n,)."""
        place, speed = y.reshape(2, -1, 3)
        return np.concatenate((y[y.size // 2 :], self.accelerations(place, speed)[0].ravel()))

    @property
    def start(self) -> Array:
        """y at the start (6 n,)."""
        return np.concatenate((self.m.place.ravel(), self.m.speed.ravel()))


def _centre(place: Array, body: int) -> Array:
    return np.zeros(2) if body == GROUND else place[body, :2]


def _turned(place: Array, body: int, p: Array) -> Array:
    if body == GROUND:
        return p
    c, s = np.cos(place[body, 2]), np.sin(place[body, 2])
    return np.array([c * p[0] - s * p[1], s * p[0] + c * p[1]])
