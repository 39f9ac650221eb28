"""Geometry of bodies and markers in generated code: local inputs and their derivatives.

Everything is in ground axes.  A body has a mass centre x with velocity u and acceleration a; a part
also has an attitude R, angular velocity w and angular acceleration al.  A marker has a lever
s = R p (p fixed in the part), so

    r = x + s,   v = u + w x s,   acc = a + al x s + w x (w x s),   axis_c = R e_c

and with dphi the rotation of the part in ground axes (dR = [dphi] R)

    dr   = dx + dphi x s
    dv   = du + dw x s + w x (dphi x s)
    dacc = da + dal x s + al x (dphi x s) + dw x (w x s) + w x (dw x s) + w x (w x (dphi x s)).

A *row* is the derivative of one scalar with respect to a vector; the functions below carry rows
from local inputs to a body's (x, phi), weighted with ``cq`` for positions, ``cu`` for velocities
and ``ca`` for accelerations, so that one kernel serves every integration method.
"""

from __future__ import annotations

from collections.abc import Callable

from adamslite.kernels.code.workspace import (
    ACCELERATION,
    ALPHA,
    ATTITUDE,
    OMEGA,
    POSITION,
    VELOCITY,
)  # fmt: skip
from adamslite.native.llvm_builder import Builder, Value
from adamslite.symbolic.scope import ORIGIN, Slot
from adamslite.symbolic.types import Leaf

Vec = list[Value]


class Geometry:
    """Local inputs of the markers of one shape, created when needed."""

    def __init__(self, b: Builder, slots: list[Slot], reals: list[int]) -> None:
        self.b = b
        self.slots = slots
        self.reals = reals
        self.memo: dict[Leaf, Vec] = {}

    def _once(self, key: Leaf, make: Callable[[], Vec]) -> Vec:
        if key not in self.memo:
            self.memo[key] = make()
        return self.memo[key]

    def cross(self, a: Vec, c: Vec) -> Vec:
        b = self.b
        return [
            b.sub(b.mul(a[1], c[2]), b.mul(a[2], c[1])),
            b.sub(b.mul(a[2], c[0]), b.mul(a[0], c[2])),
            b.sub(b.mul(a[0], c[1]), b.mul(a[1], c[0])),
        ]

    def add(self, *vectors: Vec) -> Vec:
        total: Vec = [0.0, 0.0, 0.0]
        for vector in vectors:
            total = [self.b.add(t, v) for t, v in zip(total, vector, strict=True)]
        return total

    def sub(self, a: Vec, c: Vec) -> Vec:
        return [self.b.sub(p, q) for p, q in zip(a, c, strict=True)]

    def scale(self, factor: Value, a: Vec) -> Vec:
        return [self.b.mul(factor, v) for v in a]

    def dot(self, a: Vec, c: Vec) -> Value:
        b = self.b
        return b.add(b.add(b.mul(a[0], c[0]), b.mul(a[1], c[1])), b.mul(a[2], c[2]))

    def body(self, body: int, quantity: int, size: int = 3) -> Vec:
        """A quantity of a body from the workspace."""
        base = self.b.int_at(body)
        return [self.b.read("W", base, quantity + c) for c in range(size)]

    def _reals(self, frame: int, first: int, size: int) -> Vec:
        return [self.b.real_at(self.reals[frame] + first + c) for c in range(size)]

    def _matrix_times(self, matrix: Vec, v: Vec) -> Vec:
        return [self.dot(matrix[3 * r : 3 * r + 3], v) for r in range(3)]

    def lever(self, frame: int) -> Vec:
        """s = R p for a part, p for a point mass."""
        slot = self.slots[frame]
        if not slot.offset:
            return [0.0, 0.0, 0.0]
        fixed = self._reals(frame, 0, 3)
        if slot.kind != "part":
            return fixed
        return self._once(
            ("s", frame),
            lambda: self._matrix_times(self.body(slot.body, ATTITUDE, 9), fixed),
        )

    def omega(self, frame: int) -> Vec:
        if frame == ORIGIN or self.slots[frame].kind != "part":
            return [0.0, 0.0, 0.0]
        return self.body(self.slots[frame].body, OMEGA)

    def alpha(self, frame: int) -> Vec:
        if frame == ORIGIN or self.slots[frame].kind != "part":
            return [0.0, 0.0, 0.0]
        return self.body(self.slots[frame].body, ALPHA)

    def position(self, frame: int) -> Vec:
        if frame == ORIGIN:
            return [0.0, 0.0, 0.0]
        slot = self.slots[frame]
        if slot.kind == "ground":
            return self.lever(frame)
        return self._once(
            ("r", frame), lambda: self.add(self.body(slot.body, POSITION), self.lever(frame))
        )

    def velocity(self, frame: int) -> Vec:
        if frame == ORIGIN or self.slots[frame].kind == "ground":
            return [0.0, 0.0, 0.0]
        return self.add(
            self.body(self.slots[frame].body, VELOCITY),
            self.cross(self.omega(frame), self.lever(frame)),
        )

    def acceleration(self, frame: int) -> Vec:
        if frame == ORIGIN or self.slots[frame].kind == "ground":
            return [0.0, 0.0, 0.0]
        w, s = self.omega(frame), self.lever(frame)
        return self.add(
            self.body(self.slots[frame].body, ACCELERATION),
            self.cross(self.alpha(frame), s),
            self.cross(w, self.cross(w, s)),
        )

    def axis(self, frame: int, c: int) -> Vec:
        """Axis ``c`` of a marker."""
        slot = self.slots[frame]
        first = 3 if slot.offset else 0
        fixed = self._reals(frame, first, 9)[c::3] if slot.turned else None
        if slot.kind != "part":
            return fixed if fixed is not None else [float(c == r) for r in range(3)]
        attitude = self.body(slot.body, ATTITUDE, 9)
        if fixed is None:
            return attitude[c::3]
        return self._once(("x", frame, c), lambda: self._matrix_times(attitude, fixed))

    def leaf(self, leaf: Leaf) -> Value:
        """The value of a kinematic leaf of :class:`adamslite.symbolic.scope.Scope`."""
        if leaf[0] == "x":
            return self.axis(leaf[1], leaf[2])[leaf[3]]
        of = {
            "d": self.position,
            "v": self.velocity,
            "a": self.acceleration,
            "w": self.omega,
            "al": self.alpha,
        }[leaf[0]]
        return self.sub(of(leaf[1]), of(leaf[2]))[leaf[3]]


class Columns:
    """Derivatives of one scalar by the unknowns: a row for a body, a value for a scalar."""

    def __init__(self, geometry: Geometry) -> None:
        self.g = geometry
        self.bodies: dict[int, Vec] = {}
        self.scalars: dict[tuple[int, int], Value] = {}

    def add(self, body: int, translation: Vec, rotation: Vec | None) -> None:
        """Add a row on a body's translation and, for a part, rotation."""
        row = self.bodies.setdefault(body, [0.0] * (3 if rotation is None else 6))
        for c, value in enumerate(translation + (rotation or [])):
            row[c] = self.g.b.add(row[c], value)

    def scalar(self, node: int, component: int, value: Value) -> None:
        key = (node, component)
        self.scalars[key] = self.g.b.add(self.scalars.get(key, 0.0), value)

    def position(self, frame: int, row: Vec) -> None:
        """Add row . dr of a marker, ``row`` already weighted with cq."""
        slot = self._slot(frame)
        if slot is None:
            return
        turning = self.g.cross(self.g.lever(frame), row) if slot.kind == "part" else None
        self.add(slot.body, row, turning)

    def velocity(self, frame: int, row: Vec, cq: Value, cu: Value) -> None:
        """Add row . dv of a marker."""
        slot, g = self._slot(frame), self.g
        if slot is None:
            return
        turning = None
        if slot.kind == "part":
            s = g.lever(frame)
            turning = g.add(
                g.scale(cu, g.cross(s, row)), g.scale(cq, g.cross(s, g.cross(row, g.omega(frame))))
            )
        self.add(slot.body, g.scale(cu, row), turning)

    def acceleration(self, frame: int, row: Vec, cq: Value, cu: Value, ca: Value) -> None:
        """Add row . dacc of a marker."""
        slot, g = self._slot(frame), self.g
        if slot is None:
            return
        turning = None
        if slot.kind == "part":
            s, w = g.lever(frame), g.omega(frame)
            spun = g.cross(row, w)
            by_position = g.add(g.cross(row, g.alpha(frame)), g.cross(spun, w))
            by_velocity = g.add(g.cross(g.cross(w, s), row), g.cross(s, spun))
            turning = g.add(
                g.scale(cq, g.cross(s, by_position)),
                g.scale(cu, by_velocity),
                g.scale(ca, g.cross(s, row)),
            )
        self.add(slot.body, g.scale(ca, row), turning)

    def rotation(self, frame: int, row: Vec) -> None:
        """Add row . dphi (or dw, dal) of a marker's part, ``row`` already weighted."""
        slot = self._slot(frame)
        if slot is not None and slot.kind == "part":
            self.add(slot.body, [0.0, 0.0, 0.0], row)

    def _slot(self, frame: int) -> Slot | None:
        if frame == ORIGIN or self.g.slots[frame].kind == "ground":
            return None
        return self.g.slots[frame]
