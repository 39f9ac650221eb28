"""The loop bodies of the kernels that evaluate: residual, angle memory, guards."""

from __future__ import annotations

import math

from adamslite.kernels.code.graph_to_llvm import Lowering
from adamslite.kernels.code.idle import IdleTest, StrictIdleTest
from adamslite.kernels.code.kinematics import Geometry, Vec
from adamslite.kernels.code.shape import Outputs, Shape
from adamslite.kernels.code.workspace import HEAD, MODE, RUN, TIME
from adamslite.native.llvm_builder import Builder, Value
from adamslite.symbolic.graph import node
from adamslite.symbolic.scope import UNFORESEEN, Load, Scope, Slot
from adamslite.symbolic.structure import ordered
from adamslite.symbolic.types import Expr, Frame, Leaf


class ResidualWriter:
    """Writes the loop body of a kernel of values: residual, angle memory, guards."""

    def __init__(self, shape: Shape, scope: Scope, builder: Builder | None = None) -> None:
        self.shape = shape
        self.scope = scope
        self.b = builder or Builder()
        self.g = Geometry(self.b, shape.slots, shape.marker_reals())
        self.lower = Lowering(self.b, {}, shape.tables_at)
        for place, found in enumerate((shape.guards.clock, shape.guards.watch)):
            for n, guard in enumerate(found):
                at = self.b.int_at(shape.branches_at + place)
                self.lower.branches[guard] = self.b.read("W", at, n)

    def value(self, expr: Expr) -> Value:
        """Lower an expression, loading the leaves it uses first."""
        expr, known = node(expr), self.lower.memo
        parts = ordered([expr], lambda top: () if top in known else top.args)
        symbols = [each for each in parts if each.kind == "symbol" and each not in known]
        for symbol in sorted(symbols, key=str):
            if symbol not in self.lower.leaves:
                self.lower.leaves[symbol] = self.leaf(self.scope.leaves[symbol])
        return self.lower(expr)

    def leaf(self, leaf: Leaf) -> Value:
        kind = leaf[0]
        if kind in ("d", "v", "a", "w", "al", "x"):
            return self.g.leaf(leaf)
        if kind == "p":
            return self.b.real_at(leaf[1])
        if kind in ("t", "now", "mode", "run"):
            at = RUN + leaf[1] if kind == "run" else MODE if kind == "mode" else TIME
            return self.b.emit(leaf, f"load double, ptr {self._head(at)}")
        if kind in ("z", "dif"):
            return self.b.read("W", self.b.int_at(leaf[1]), leaf[2] if kind == "z" else 0)
        if kind in ("dif1", "origin"):
            return self.b.read("W", self.b.int_at(leaf[1]), 1 if kind == "dif1" else 2)
        if kind == "sig":
            return self.b.read("W", self.b.int_at(len(self.shape.widths) + leaf[1]), leaf[2])
        if kind == "kept":
            return self.b.real_at(self._kept_at(leaf[1]))
        if kind == "nan":
            return math.nan
        if kind == UNFORESEEN:
            return 0.0
        return self._turns(leaf[1])

    def _head(self, position: int) -> str:
        if position >= HEAD:
            raise IndexError(position)
        return self.b.emit(("head", position), f"getelementptr double, ptr %W, i64 {position}")

    def _kept_at(self, n: int) -> int:
        """The real that holds a number of the last accepted step, behind the angles."""
        return self.shape.n_params + len(self.scope.angles) + n

    def _turns(self, n: int) -> Value:
        """Whole turns that bring the wrapped angle nearest to the remembered one."""
        b = self.b
        gap = b.sub(b.real_at(self.shape.n_params + n), self.value(self.scope.angles[n]))
        turns = b.call("floor", b.add(b.mul(gap, 0.5 / math.pi), 0.5))
        return b.mul(turns, 2 * math.pi)

    def _is_parameter(self, symbol: Expr) -> bool:
        return bool(self.scope.leaves[symbol][0] == "p")

    def unless_idle(self, out: Outputs, test: IdleTest) -> None:
        """Go on to the next instance where all that is evaluated vanishes."""
        idle = test(out.expressions)
        if isinstance(idle, str):
            self.b.lines += [f"  br i1 {idle}, label %latch, label %work", "work:"]

    def residual(self, out: Outputs) -> None:
        self.unless_idle(
            out, StrictIdleTest(self.b, self.lower.branches, self.value, self._is_parameter)
        )
        for load in out.loads:
            force = [self.value(f) for f in load.force]
            torque = [self.value(t) for t in load.torque]
            for body, sign, lever in self._ends(load):
                self._add_load(body, sign, force, torque, lever)
        for at, component, expr in out.rows:
            row = self.b.int_at(self.shape.row_at(at))
            self.b.accumulate("F", row, component, self.value(expr))

    def _ends(self, load: Load) -> list[tuple[Slot, float, Vec]]:
        """The loaded bodies: slot, sign in the residual, lever about the mass centre."""
        ends = []
        slot = self._moving(load.frame)
        if slot is not None:
            ends.append((slot, -1.0, self.g.lever(load.frame)))
        if load.reaction is not None and (other := self._moving(load.reaction)) is not None:
            ends.append((other, 1.0, self._reaction_lever(load, load.reaction)))
        return ends

    def _moving(self, frame: int) -> Slot | None:
        return None if self.scope.is_ground(frame) else self.shape.slots[frame]

    def _reaction_lever(self, load: Load, frame: Frame) -> Vec:
        slot = self.shape.slots[frame]
        if slot.kind == "part" and load.follows:
            return self.g.sub(self.g.position(load.frame), self.g.body(slot.body, 0))
        return self.g.lever(frame)

    def _add_load(self, slot: Slot, sign: float, force: Vec, torque: Vec, lever: Vec) -> None:
        row = self.b.int_at(self.shape.row_at(slot.body))
        values = list(force)
        if slot.kind == "part":
            values += self.g.add(torque, self.g.cross(lever, force))
        for c, value in enumerate(values):
            self.b.accumulate("F", row, c, self.b.mul(sign, value))

    def guard_values(self, place: int) -> None:
        """The guards of the clock (``place`` 0), or those of the watch and places within zones (1),
        which share much of what they are made of: gaps of relations, arguments of floors.
        """
        guards, first = self.shape.guards, self.shape.branches_at
        for n, guard in enumerate(guards.watch if place else guards.clock):
            self.b.accumulate("F", self.b.int_at(first + place), n, self._guard_value(guard))
        for n, zone in enumerate(guards.places if place else ()):
            self.b.accumulate("F", self.b.int_at(first + 2), n, self.value(zone))

    def _guard_value(self, guard: Expr) -> Value:
        for side in guard.args:
            self.value(side)
        return self.lower.gap(guard) if guard.is_relation else self.value(guard.args[0])

    def track(self) -> None:
        kept = [self.value(each) for each in self.scope.kept]
        for n, wrapped in enumerate(self.scope.angles):
            angle = self.b.add(self.value(wrapped), self._turns(n))
            self.b.store_real(self.shape.n_params + n, angle)
        for at, origin in self.scope.origins.items():
            self.b.store("F", self.b.int_at(at), 2, self.value(origin))
        for n, number in enumerate(kept):
            self.b.store_real(self._kept_at(n), number)
        for n, limit in enumerate(self.scope.limits):
            at = self.shape.n_params + self.shape.n_angles + n
            first, now = self.b.real_at(at), self.leaf(("t",))
            left = self.b.logic(
                "and",
                self.b.compare("<", self.value(limit), 0.0),
                self.b.compare("<", now, first),
            )
            self.b.store_real(at, self.b.select(left, now, first))
