"""The loop body of a pullback: weights of rows become weights of what the rows depend on.

With weights nu of loads and rows, phi = nu . F of an instance is one number; its derivatives by
all leaves at once, in reverse mode, are chained to the workspace and to the reals of the instance:

    G[x, v, a, w, al, phi] += d(phi)/d(position, velocity, acceleration, spin, its rate, rotation)
    R[parameter, offset and axes of markers] += d(phi)/d(real)

A load F, T at a lever s of a part with weights (nu_x, nu_phi) gives -(nu_x + nu_phi x s) . F -
nu_phi . T.  G is laid out as the workspace; rotations in ground axes (dR = [phi] R) stand in the
first three places of the attitude.
"""

from __future__ import annotations

from collections.abc import Iterator

from adamslite.kernels.code.idle import IdleTest
from adamslite.kernels.code.kinematics import Vec
from adamslite.kernels.code.module_text import loop_text
from adamslite.kernels.code.residual_writer import ResidualWriter
from adamslite.kernels.code.shape import Outputs, Shape
from adamslite.kernels.code.workspace import (
    ACCELERATION,
    ALPHA,
    ATTITUDE,
    OMEGA,
    POSITION,
    TIME,
    VELOCITY,
)
from adamslite.native.llvm_builder import Value
from adamslite.symbolic.derivatives import Derivatives
from adamslite.symbolic.graph import ZERO, Node, add, mul, node
from adamslite.symbolic.guards import guards
from adamslite.symbolic.scope import LASTING, ORIGIN, Load, Scope, Slot
from adamslite.symbolic.types import Leaf

HEAD = (
    "define void @{name}(i64 %n, ptr noalias readonly %ints, ptr noalias readonly %reals, "
    "ptr noalias readonly %W, ptr readonly %N, ptr %G, ptr noalias %R) nounwind"
)

SEED = "seed"
# Leaves by which nothing is differentiated: weights, and what lasts but parameters.
HELD = (SEED, *(kind for kind in LASTING if kind != "p"))
NOTHING: Vec = [0.0, 0.0, 0.0]


def write_pullback(shape: Shape, name: str, face: str, n_ints: int) -> str:
    """LLVM text of ``{name}_pullback(n, ints, reals, W, N, G, R)``: N the weights of rows, R beside
    the reals of the instances; N and G may be the same.  Of guards, whose weights stand as they do
    themselves, ``{name}_pullback_guards`` does the same.
    """
    scope = Scope(shape.slots)
    out = shape.outputs(scope)
    shape.n_angles, shape.n_limits = len(scope.angles) + len(scope.kept), len(scope.limits)
    if face != "output":
        shape.guards = guards(out.expressions, scope.leaves, face, scope.written)
    bodies = [(f"{name}_pullback", HEAD, _writer(shape, scope))]
    bodies[0][2].pullback(out)
    if shape.guards.clock or shape.guards.watch:
        bodies.append((f"{name}_pullback_guards", HEAD, _writer(shape, scope)))
        bodies[1][2].guards()
    return loop_text([*bodies], n_ints, shape.n_reals)


def _writer(shape: Shape, scope: Scope) -> PullbackWriter:
    writer = PullbackWriter(shape, scope)
    writer.b.lines.append("  %rg = getelementptr double, ptr %R, i64 %ro")
    return writer


class PullbackWriter(ResidualWriter):
    """Writes the loop body; weights are read from ``%N``, sums go to ``%G`` and ``%rg``."""

    def pullback(self, out: Outputs) -> None:
        """All that loads and rows depend on."""
        self.seeds: list[Value] = []
        self.unless_idle(out, IdleTest(self.b, self.lower.branches))
        total = ZERO
        for load in out.loads:
            force, torque = self._weights(load)
            for weights, values in ((force, load.force), (torque, load.torque)):
                for weight, value in zip(weights, values, strict=True):
                    total = add(total, mul(self._seed(weight), node(value)))
        for at, component, expr in out.rows:
            weight = self.b.read("N", self.b.int_at(self.shape.row_at(at)), component)
            total = add(total, mul(self._seed(weight), node(expr)))
        self._chain(total)
        for load in out.loads:
            self._levers(load)

    def guards(self) -> None:
        """All that guards of the clock and of the watch depend on."""
        self.seeds = []
        total = ZERO
        for place, found in enumerate((self.shape.guards.clock, self.shape.guards.watch)):
            for n, guard in enumerate(found):
                weight = self.b.read("N", self.b.int_at(self.shape.branches_at + place), n)
                gap = guard.args[0]
                if guard.is_relation:
                    large, small = guard.args[:: -1 if guard.kind.startswith("<") else 1]
                    gap = large - small
                total = add(total, mul(self._seed(weight), node(gap)))
        self._chain(total)

    def leaf(self, leaf: Leaf) -> Value:
        """Weights beside the leaves of the scope."""
        return self.seeds[leaf[1]] if leaf[0] == SEED else super().leaf(leaf)

    def _seed(self, weight: Value) -> Node:
        """A symbol that stands for a weight."""
        if not isinstance(weight, str):
            return node(weight)
        if weight not in self.seeds:
            self.seeds.append(weight)
        return self.scope.symbol(SEED, self.seeds.index(weight))

    def _rows_of(self, slot: Slot) -> tuple[Vec, Vec]:
        """Weights of the force rows and the torque rows of a body."""
        row = self.b.int_at(self.shape.row_at(slot.body))
        force: Vec = [self.b.read("N", row, c) for c in range(3)]
        if slot.kind != "part":
            return force, NOTHING
        return force, [self.b.read("N", row, 3 + c) for c in range(3)]

    def _weights(self, load: Load) -> tuple[Vec, Vec]:
        """What the force and the torque of a load are multiplied by."""
        force, torque = NOTHING, NOTHING
        for slot, sign, lever in self._ends(load):
            moved, turned = self._rows_of(slot)
            arm = self.g.cross(turned, lever) if slot.kind == "part" else NOTHING
            force = self.g.add(force, self.g.scale(sign, self.g.add(moved, arm)))
            torque = self.g.add(torque, self.g.scale(sign, turned))
        return force, torque

    def _levers(self, load: Load) -> None:
        """d(lever) of nu_phi . (lever x F) = lever . (F x nu_phi)."""
        force: Vec = [self.value(f) for f in load.force]
        for slot, sign, _ in self._ends(load):
            if slot.kind != "part":
                continue
            row = self.g.scale(sign, self.g.cross(force, self._rows_of(slot)[1]))
            if sign > 0.0 and load.follows:
                self._position(load.frame, row)
                self._put(slot.body, POSITION, self.g.scale(-1.0, row))
            else:
                frame = load.reaction if sign > 0.0 and load.reaction is not None else load.frame
                self._lever(frame, row)

    def _chain(self, total: Node) -> None:
        """The gradient of ``total`` by leaves, carried on to workspace and reals."""
        leaves = self.scope.leaves
        gradient = Derivatives(lambda symbol: leaves[symbol][0] in HELD).gradient(total)
        vectors: dict[Leaf, Vec] = {}
        for symbol in sorted(gradient, key=str):
            leaf, slope = leaves[symbol], self.value(gradient[symbol])
            if leaf[0] == "p":
                self._real(leaf[1], slope)
            elif leaf[0] in ("t", "now"):
                self.b.accumulate("G", "0", TIME, slope)
            elif leaf[0] == "sig":
                self.b.accumulate(
                    "G", self.b.int_at(len(self.shape.widths) + leaf[1]), leaf[2], slope
                )
            elif leaf[0] in ("z", "dif", "dif1"):
                place = leaf[2] if leaf[0] == "z" else int(leaf[0] == "dif1")
                self.b.accumulate("G", self.b.int_at(leaf[1]), place, slope)
            else:
                vectors.setdefault(leaf[:-1], [0.0, 0.0, 0.0])[leaf[-1]] = slope
        for leaf, row in vectors.items():
            if leaf[0] == "x":
                self._axis(leaf[1], leaf[2], row)
            else:
                self._differences(leaf, row)

    def _differences(self, leaf: Leaf, row: Vec) -> None:
        of = {
            "d": self._position, "v": self._velocity, "a": self._acceleration,
            "w": self._spin, "al": self._spin_rate,
        }[leaf[0]]  # fmt: skip
        of(leaf[1], row)
        of(leaf[2], self.g.scale(-1.0, row))

    # ---- from markers to bodies ---------------------------------------------------------------

    def _put(self, body: int, quantity: int, row: Vec) -> None:
        for c, value in enumerate(row):
            self.b.accumulate("G", self.b.int_at(body), quantity + c, value)

    def _real(self, position: int, value: Value) -> None:
        self.b.accumulate("rg", "0", position, value)

    def _lever(self, frame: int, row: Vec) -> None:
        """row . ds of a marker, s = R p."""
        slot = self.shape.slots[frame]
        if not slot.offset:
            return
        if slot.kind == "part":
            self._put(slot.body, ATTITUDE, self.g.cross(self.g.lever(frame), row))
        for c, value in enumerate(self._in_axes(slot, row)):
            self._real(self.g.reals[frame] + c, value)

    def _in_axes(self, slot: Slot, row: Vec) -> Vec:
        """R^T row: a row of ground axes in those of the body."""
        if slot.kind != "part":
            return row
        attitude = self.g.body(slot.body, ATTITUDE, 9)
        return [self.g.dot(attitude[c::3], row) for c in range(3)]

    def _moving_part(self, frame: int) -> Iterator[Slot]:
        """The slot of a marker that is on a body."""
        if frame != ORIGIN and self.shape.slots[frame].kind != "ground":
            yield self.shape.slots[frame]

    def _position(self, frame: int, row: Vec) -> None:
        for slot in self._moving_part(frame):
            self._put(slot.body, POSITION, row)
        if frame != ORIGIN:
            self._lever(frame, row)

    def _velocity(self, frame: int, row: Vec) -> None:
        for slot in self._moving_part(frame):
            self._put(slot.body, VELOCITY, row)
            if slot.kind == "part":
                self._put(slot.body, OMEGA, self.g.cross(self.g.lever(frame), row))
                self._lever(frame, self.g.cross(row, self.g.omega(frame)))

    def _acceleration(self, frame: int, row: Vec) -> None:
        g = self.g
        for slot in self._moving_part(frame):
            self._put(slot.body, ACCELERATION, row)
            if slot.kind != "part":
                continue
            s, w = g.lever(frame), g.omega(frame)
            spun = g.cross(row, w)
            self._put(slot.body, ALPHA, g.cross(s, row))
            self._put(slot.body, OMEGA, g.add(g.cross(g.cross(w, s), row), g.cross(s, spun)))
            self._lever(frame, g.add(g.cross(row, g.alpha(frame)), g.cross(spun, w)))

    def _spin(self, frame: int, row: Vec) -> None:
        for slot in self._moving_part(frame):
            if slot.kind == "part":
                self._put(slot.body, OMEGA, row)

    def _spin_rate(self, frame: int, row: Vec) -> None:
        for slot in self._moving_part(frame):
            if slot.kind == "part":
                self._put(slot.body, ALPHA, row)

    def _axis(self, frame: int, c: int, row: Vec) -> None:
        slot = self.shape.slots[frame]
        if slot.kind == "part":
            self._put(slot.body, ATTITUDE, self.g.cross(self.g.axis(frame, c), row))
        if slot.turned:
            first = self.g.reals[frame] + (3 if slot.offset else 0)
            for r, value in enumerate(self._in_axes(slot, row)):
                self._real(first + 3 * r + c, value)
