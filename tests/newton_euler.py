"""Newton-Euler equations of constrained rigid bodies, written apart from the program.

Maximal coordinates: every body has the position r of its centre of mass, a quaternion, the velocity
v and the angular velocity w in ground axes.  With G the rows of all constraints

    [ M/ucf  G^T ] [ accelerations ]   [ loads                      ]
    [ G      0   ] [ lam           ] = [ -(second rate, coasting)   ]

Rows are written as formulas of :class:`Jet`, which carries a quantity with its first and second
rate, so that no row is differentiated by hand.  Integrated by DOP853 (Hairer, Norsett, Wanner,
Solving Ordinary Differential Equations I, 1993, section II.5).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

import numpy as np
from scipy.integrate import solve_ivp

Array = np.ndarray


@dataclass(frozen=True)
class Jet:
    """A number or vector along a motion: value, its rate, its second rate while all velocities are
    constant, and the gradient of the rate by the velocities, (..., 6 n).
    """

    value: Array
    rate: Array
    second: Array
    gradient: Array

    def __add__(self, other: Jet) -> Jet:
        return Jet(
            self.value + other.value, self.rate + other.rate, self.second + other.second,
            self.gradient + other.gradient,
        )  # fmt: skip

    def __sub__(self, other: Jet) -> Jet:
        return self + other.times(-1.0)

    def times(self, factor: float) -> Jet:
        """Multiplied by a constant."""
        return Jet(*(factor * part for part in self.parts))

    @property
    def parts(self) -> tuple[Array, Array, Array, Array]:
        """Value, rate, second rate, gradient."""
        return self.value, self.rate, self.second, self.gradient

    def dot(self, other: Jet) -> Jet:
        """Scalar product of two vectors."""
        a, b = self, other
        return Jet(
            a.value @ b.value,
            a.rate @ b.value + a.value @ b.rate,
            a.second @ b.value + 2.0 * a.rate @ b.rate + a.value @ b.second,
            b.value @ a.gradient + a.value @ b.gradient,
        )

    def __mul__(self, other: Jet) -> Jet:
        a, b = self, other
        return Jet(
            a.value * b.value,
            a.rate * b.value + a.value * b.rate,
            a.second * b.value + 2.0 * a.rate * b.rate + a.value * b.second,
            b.value * a.gradient + a.value * b.gradient,
        )


def angle(sine: Jet, cosine: Jet) -> Jet:
    """atan2 of two numbers."""
    s, c = sine, cosine
    size = s.value**2 + c.value**2
    cross = c.value * s.rate - s.value * c.rate
    change = c.value * s.second - s.value * c.second
    growth = 2.0 * (s.value * s.rate + c.value * c.rate)
    return Jet(
        np.arctan2(s.value, c.value),
        cross / size,
        change / size - cross * growth / size**2,
        (c.value * s.gradient - s.value * c.gradient) / size,
    )


def root(a: Jet) -> Jet:
    """Square root of a number."""
    r = np.sqrt(a.value)
    return Jet(
        r, a.rate / (2 * r), a.second / (2 * r) - a.rate**2 / (4 * r**3), a.gradient / (2 * r)
    )


@dataclass(frozen=True)
class Body:
    """Mass, inertia about the centre of mass in body axes (3, 3), that centre in the body frame."""

    mass: float
    inertia: Array
    centre: Array


@dataclass(frozen=True)
class Frame:
    """A marker: number of its body (-1: ground), origin and axes (columns) in the body frame."""

    body: int
    origin: Array
    axes: Array


@dataclass(frozen=True)
class Axes:
    """A marker on its way: origin and the three axes as jets."""

    origin: Jet
    x: Jet
    y: Jet
    z: Jet


Row = Callable[[Axes, Axes, float], list[Jet]]


@dataclass(frozen=True)
class Tie:
    """A constraint between two markers.

    rows : formulas that vanish, or whose rates vanish when ``of_rate``
    """

    name: str
    i: Frame
    j: Frame
    rows: Row
    of_rate: bool = False


@dataclass
class State:
    """Posture and velocities: r (n, 3), rotation (n, 3, 3), v (n, 3), w (n, 3)."""

    r: Array
    rotation: Array
    v: Array
    w: Array


@dataclass
class Assembly:
    """Bodies, constraints, gravity [length/time^2], ucf [mass length / (force time^2)]."""

    bodies: Sequence[Body]
    gravity: Array
    ucf: float = 1.0
    ties: list[Tie] = field(default_factory=list)

    def marker(self, frame: Frame, state: State) -> Axes:
        """Origin and axes as jets."""
        n = len(self.bodies)
        if frame.body < 0:
            still = [constant(v, n) for v in (frame.origin, *frame.axes.T)]
            return Axes(*still)
        b = frame.body
        turn, w = state.rotation[b], state.w[b]
        arm = turn @ (frame.origin - self.bodies[b].centre)
        carried = [_carried(vector, w, b, n) for vector in (arm, *(turn @ frame.axes).T)]
        where = Jet(state.r[b], state.v[b], np.zeros(3), _unit(b, n))
        return Axes(where + carried[0], *carried[1:])

    def rows(self, state: State, time: float, ties: Sequence[Tie]) -> list[Jet]:
        """All rows as jets, in the order of the ties."""
        found = []
        for tie in ties:
            found += tie.rows(self.marker(tie.i, state), self.marker(tie.j, state), time)
        return found

    def accelerations(self, state: State, time: float) -> tuple[Array, Array, Array]:
        """Accelerations (6 n), multipliers (m), gradients G (m, 6 n)."""
        n = len(self.bodies)
        rows = self.rows(state, time, self.ties)
        m = len(rows)
        system, right = np.zeros((6 * n + m, 6 * n + m)), np.zeros(6 * n + m)
        for b, body in enumerate(self.bodies):
            k, turn, w = 6 * b, state.rotation[b], state.w[b]
            inertia = turn @ body.inertia @ turn.T
            system[k : k + 3, k : k + 3] = np.eye(3) * body.mass / self.ucf
            system[k + 3 : k + 6, k + 3 : k + 6] = inertia / self.ucf
            right[k : k + 3] = body.mass * self.gravity / self.ucf
            right[k + 3 : k + 6] = -np.cross(w, inertia @ w) / self.ucf
        G = np.array([row.gradient for row in rows]).reshape(m, 6 * n)
        system[6 * n :, : 6 * n], system[: 6 * n, 6 * n :] = G, G.T
        right[6 * n :] = [-float(row.second) for row in rows]
        found = np.linalg.solve(system, right)
        return found[: 6 * n], found[6 * n :], G

    def reactions(self, state: State, time: float) -> dict[str, Array]:
        """Force and torque (6,) of every tie on its marker I, ground axes, torque about I."""
        _, lam, G = self.accelerations(state, time)
        found, at = {}, 0
        for tie in self.ties:
            count = len(self.rows(state, time, [tie]))
            push = -G[at : at + count].T @ lam[at : at + count]
            found[tie.name] = self._on_marker(tie, push, state)
            at += count
        return found

    def _on_marker(self, tie: Tie, push: Array, state: State) -> Array:
        sign, body = (1.0, tie.i.body) if tie.i.body >= 0 else (-1.0, tie.j.body)
        force, torque = (
            sign * push[6 * body : 6 * body + 3],
            sign * push[6 * body + 3 : 6 * body + 6],
        )
        arm = state.r[body] - self.marker(tie.i, state).origin.value
        return np.concatenate([force, torque + np.cross(arm, force)])

    def run(self, start: State, times: Array, tolerance: float = 1e-12) -> list[State]:
        """States at the times, by DOP853."""
        n = len(self.bodies)

        def rates(time: float, y: Array) -> Array:
            state, p = _unpacked(y, n), y[3 * n : 7 * n].reshape(n, 4)
            a, _, _ = self.accelerations(state, time)
            turning = np.array([_quaternion_rate(p[b], state.w[b]) for b in range(n)])
            a = a.reshape(n, 6)
            return np.concatenate([state.v.ravel(), turning.ravel(), a[:, :3].ravel(),
                                   a[:, 3:].ravel()])  # fmt: skip

        p = np.array([quaternion(start.rotation[b]) for b in range(n)])
        y = np.concatenate([start.r.ravel(), p.ravel(), start.v.ravel(), start.w.ravel()])
        found = solve_ivp(rates, (times[0], times[-1]), y, "DOP853", times, rtol=tolerance,
                          atol=tolerance * np.maximum(1.0, np.abs(y)))  # fmt: skip
        assert found.success, found.message
        return [_unpacked(column, n) for column in found.y.T]


def constant(value: Array, n: int) -> Jet:
    """What does not move."""
    value = np.asarray(value, dtype=float)
    still = np.zeros_like(value)
    return Jet(value, still, still, np.zeros((*value.shape, 6 * n)))


def given(value: float, rate: float, second: float, n: int) -> Jet:
    """A number that follows a function of time."""
    return Jet(*map(np.asarray, (value, rate, second)), np.zeros(6 * n))


def skew(a: Array) -> Array:
    """The matrix of a x."""
    return np.array([[0.0, -a[2], a[1]], [a[2], 0.0, -a[0]], [-a[1], a[0], 0.0]])


def _carried(vector: Array, w: Array, b: int, n: int) -> Jet:
    """A vector fixed to a turning body: rate w x vector."""
    rate = np.cross(w, vector)
    gradient = np.zeros((3, 6 * n))
    gradient[:, 6 * b + 3 : 6 * b + 6] = -skew(vector)
    return Jet(vector, rate, np.cross(w, rate), gradient)


def _unit(b: int, n: int) -> Array:
    gradient = np.zeros((3, 6 * n))
    gradient[:, 6 * b : 6 * b + 3] = np.eye(3)
    return gradient


def _unpacked(y: Array, n: int) -> State:
    p = y[3 * n : 7 * n].reshape(n, 4)
    rotation = np.array([rotation_of(each) for each in p])
    return State(y[: 3 * n].reshape(n, 3), rotation, y[7 * n : 10 * n].reshape(n, 3),
                 y[10 * n :].reshape(n, 3))  # fmt: skip


def quaternion(rotation: Array) -> Array:
    """(cos, axis sin) of half the angle of a rotation matrix."""
    half = 0.5 * np.sqrt(max(0.0, 1.0 + np.trace(rotation)))
    if half > 0.2:
        twist = rotation - rotation.T
        return np.array([half, *(np.array([twist[2, 1], twist[0, 2], twist[1, 0]]) / (4 * half))])
    flip = np.diag([1.0, -1.0, -1.0])  # half a turn about x first
    for axis in range(3):
        flip = -np.eye(3)
        flip[axis, axis] = 1.0
        other = rotation @ flip
        if np.trace(other) > 0.0:
            a, b = quaternion(other), np.zeros(4)
            b[1 + axis] = 1.0
            return np.array([
                a[0] * b[0] - a[1:] @ b[1:], *(a[0] * b[1:] + b[0] * a[1:] + np.cross(a[1:], b[1:]))
            ])  # fmt: skip
    raise AssertionError("no rotation")


def rotation_of(p: Array) -> Array:
    """The rotation matrix of a quaternion, normalised first."""
    e0, *e = p / np.linalg.norm(p)
    e = np.array(e)
    return (e0 * e0 - e @ e) * np.eye(3) + 2.0 * np.outer(e, e) + 2.0 * e0 * skew(e)


def _quaternion_rate(p: Array, w: Array) -> Array:
    return 0.5 * np.array([-w @ p[1:], *(p[0] * w + np.cross(w, p[1:]))])
