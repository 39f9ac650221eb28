"""The scope in which functions and elements compute numbers instead of writing expressions.

It answers what :class:`adamslite.symbolic.scope.Scope` does, for one posture of a model.  A frame
is the id of a marker, ``ORIGIN`` the global frame.  Every number carries its derivatives by the
motions of bodies::

    [ x and a small rotation in ground axes of each body | their rates v, w | time ]

of the bodies that are met, in the order in which they are met.  The second and third part are there
only where rates count.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from adamslite.language.interfaces import Key
from adamslite.model.model import Model
from adamslite.symbolic.duals import Dual, Number, atan2
from adamslite.symbolic.scope import ORIGIN
from adamslite.symbolic.types import Expr, Measure

# Coordinates of a body: three of its place, three of a rotation.
WIDTH = 6
DYNAMICS = 4.0
Vector = tuple[Dual, Dual, Dual]
Frame = Key


class Unmeasured(Exception):
    """A quantity that no posture has: an acceleration, a force."""


class Crowded(Exception):
    """There are more bodies than columns."""


@dataclass
class Posture:
    """Places (n, 3), attitudes (n, 3, 3) and velocities (n, 6) of the bodies of a model."""

    x: np.ndarray
    attitude: np.ndarray
    speed: np.ndarray

    @classmethod
    def start(cls, model: Model) -> Posture:
        """Where an assembly starts: as the deck draws it, or where its joints close."""
        bodies = model.bodies
        places = [model.start_of(body) for body in range(len(bodies))]
        return cls(
            np.array([x for x, _ in places]).reshape(-1, 3),
            np.array([attitude for _, attitude in places]).reshape(-1, 3, 3),
            np.array([[*body.v, *body.w] for body in bodies]).reshape(-1, WIDTH),
        )


def skew(a: np.ndarray) -> np.ndarray:
    """The matrix of a x b, by b."""
    return np.array([[0.0, -a[2], a[1]], [a[2], 0.0, -a[0]], [-a[1], a[0], 0.0]])


class NumberScope:
    """Measures of one posture.

    Parameters
    ----------
    model, posture
    slopes : bool
        Whether derivatives are computed.
    rates : bool
        Whether derivatives by velocities are, too.
    room : int
        Bodies for which there are columns.
    """

    def __init__(
        self, model: Model, posture: Posture, slopes: bool, rates: bool = False, room: int = 2
    ) -> None:
        self.model = model
        self.posture = posture
        self.slopes = slopes
        self.rates = rates
        self.room = room
        self.bodies: list[int] = []
        """Bodies that were met, in the order of their columns."""
        self.width = WIDTH * room
        self.now = 0.0
        self._points: dict[Frame, tuple[np.ndarray, Any, np.ndarray, Any]] = {}
        self._variables: dict[Key, Expr] = {}
        self._known_at = self.now

    # what markers measure

    def _blank(self) -> np.ndarray:
        return np.zeros((3, 2 * self.width + 1 if self.rates else self.width))

    def _column(self, body: int) -> int:
        if body not in self.bodies:
            if len(self.bodies) == self.room:
                raise Crowded
            self.bodies.append(body)
        return WIDTH * self.bodies.index(body)

    def _body(self, k: Frame) -> int:
        """The body of a frame; -1 of what cannot move."""
        if k == ORIGIN:
            return -1
        return self.model.marker(k).body

    def _at(self, k: Frame) -> tuple[np.ndarray, Any, np.ndarray, Any]:
        """Place and velocity of a frame with their slopes."""
        if k not in self._points:
            self._points[k] = self._moved(k)
        return self._points[k]

    def _moved(self, k: Frame) -> tuple[np.ndarray, Any, np.ndarray, Any]:
        body = self._body(k)
        if body < 0:
            origin = np.zeros(3) if k == ORIGIN else self.model.marker(k).p
            return origin, 0.0, np.zeros(3), 0.0
        place, at = self.model.marker(k), self.posture
        turns = place.kind == "part"
        arm = at.attitude[body] @ place.p if turns else place.p
        v, w = at.speed[body, :3], at.speed[body, 3:]
        velocity = v + skew(w) @ arm if turns else v
        if not self.slopes:
            return at.x[body] + arm, 0.0, velocity, 0.0
        by_place, by_speed, c = self._blank(), self._blank(), self._column(body)
        by_place[:, c : c + 3] = np.eye(3)
        if turns:
            by_place[:, c + 3 : c + 6] = -skew(arm)
        if self.rates:
            by_speed[:, self.width : -1] = by_place[:, : self.width]
        return at.x[body] + arm, by_place, velocity, by_speed

    def _difference(self, values: np.ndarray, slope: Any) -> Vector:
        slopes = slope if isinstance(slope, np.ndarray) else (0.0, 0.0, 0.0)
        x, y, z = values.tolist()
        return Dual(x, slopes[0]), Dual(y, slopes[1]), Dual(z, slopes[2])

    def position(self, i: Frame, j: Frame) -> Vector:
        """r_i - r_j."""
        a, b = self._at(i), self._at(j)
        return self._difference(a[0] - b[0], a[1] - b[1])

    def velocity(self, i: Frame, j: Frame) -> Vector:
        """Derivative of r_i - r_j in ground."""
        a, b = self._at(i), self._at(j)
        return self._difference(a[2] - b[2], a[3] - b[3])

    def omega(self, i: Frame, j: Frame = ORIGIN) -> Vector:
        """Angular velocity of i less that of j."""
        (a, by_a), (b, by_b) = self._spin(i), self._spin(j)
        return self._difference(a - b, by_a - by_b)

    def _spin(self, k: Frame) -> tuple[np.ndarray, Any]:
        if not self.turns(k):
            return np.zeros(3), 0.0
        body = self._body(k)
        w = self.posture.speed[body, 3:]
        if not (self.slopes and self.rates):
            return w, 0.0
        slope, c = self._blank(), self.width + self._column(body)
        slope[:, c + 3 : c + 6] = np.eye(3)
        return w, slope

    def acceleration(self, i: Frame, j: Frame) -> Vector:
        """No posture has one."""
        raise Unmeasured

    def alpha(self, i: Frame, j: Frame = ORIGIN) -> Vector:
        """No posture has one."""
        raise Unmeasured

    def axes(self, k: Frame) -> tuple[Vector, Vector, Vector]:
        """The x, y and z axes of marker k."""
        axes, column = np.eye(3), -1
        if k != ORIGIN:
            axes = self.model.marker(k).axes
        if self.turns(k):
            body = self._body(k)
            axes = self.posture.attitude[body] @ axes
            column = self._column(body) if self.slopes else -1
        return tuple(self._axis(axes[:, c], column) for c in range(3))  # type: ignore[return-value]

    def _axis(self, axis: np.ndarray, column: int) -> Vector:
        slope: Any = 0.0
        if column >= 0:
            slope = self._blank()
            slope[:, column + 3 : column + 6] = -skew(axis)
        return self._difference(axis, slope)

    def is_ground(self, k: Frame) -> bool:
        """True when ``k`` can never move."""
        return self._body(k) < 0

    def turns(self, k: Frame) -> bool:
        """True when the axes of ``k`` can rotate."""
        return k != ORIGIN and self.model.marker(k).kind == "part"

    # the rest

    @property
    def time(self) -> Dual:
        """The start, or the time that is set."""
        if not (self.slopes and self.rates):
            return Dual(self.now)
        slope = np.zeros(2 * self.width + 1)
        slope[-1] = 1.0
        return Dual(self.now, slope)

    @property
    def mode(self) -> Dual:
        """Dynamics."""
        return Dual(DYNAMICS)

    def angle(self, sine: Number, cosine: Number, of: Measure) -> Dual:
        """Before the first step there are no turns to count."""
        return atan2(sine, cosine)

    def side(self, normal: Vector, clear: bool, of: Measure) -> float:
        """Before the first step there is no other side."""
        return 1.0

    def of_time(self, value: Expr) -> bool:
        """Tables need not be held on a piece."""
        return True

    def limit(self, value: Expr) -> None:
        """Nothing is remembered."""

    def touch(self, relation: Any, in_length: bool = True) -> Any:
        """Nothing is remembered."""
        return relation

    def load(self, id: Any, jflag: int) -> Any:
        """No posture has one."""
        raise Unmeasured

    def derivative(self, value: Number) -> Dual:
        """Total time derivative, where rates count: slope times velocity."""
        if not self.rates:
            raise Unmeasured
        if not isinstance(value, Dual) or not isinstance(value.slope, np.ndarray):
            return Dual(0.0)
        speed = np.zeros(self.width)
        for column, body in enumerate(self.bodies):
            speed[WIDTH * column : WIDTH * (column + 1)] = self.posture.speed[body]
        slope = np.zeros_like(value.slope)
        slope[self.width : -1] = value.slope[: self.width]
        return Dual(float(value.slope[: self.width] @ speed + value.slope[-1]), slope)

    def statement(self, id: Any) -> Any:
        """The statement that a reference means; bound by the reader."""
        raise Unmeasured
