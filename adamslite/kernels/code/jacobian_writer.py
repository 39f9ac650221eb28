"""The loop body of the Jacobian kernel.

Slopes with respect to the leaves of an expression are chained to the coordinates of its bodies: a
row of six numbers for a part, force rows and torque rows about its mass centre.
"""

from __future__ import annotations

from adamslite.kernels.code.idle import IdleTest
from adamslite.kernels.code.kinematics import Columns, Vec
from adamslite.kernels.code.residual_writer import ResidualWriter
from adamslite.kernels.code.shape import Outputs, Shape
from adamslite.native.llvm_builder import Value
from adamslite.symbolic.derivatives import Derivatives
from adamslite.symbolic.scope import GIVEN, Load, Scope, Slot
from adamslite.symbolic.types import Expr, Leaf


class JacobianWriter(ResidualWriter):
    """Writes the loop body of the Jacobian; ``blocks`` are the pairs (row node, column node) it
    found, in the order of their integers.
    """

    def __init__(self, shape: Shape, scope: Scope) -> None:
        super().__init__(shape, scope)
        self.blocks: list[tuple[int, int]] = []
        self.rates_only = False
        self.slope = scope.slope

    def jacobian(self, out: Outputs) -> None:
        self.rates_only = out.rates_only
        if out.rates_only:
            given = (*GIVEN, "d", "v", "x", "w", "dif")
            self.slope = Derivatives(lambda symbol: self.scope.leaves[symbol][0] in given)
        self.unless_idle(out, IdleTest(self.b, self.lower.branches))
        for load in out.loads:
            force = [(self.value(f), self.columns(f)) for f in load.force]
            torque = [self.columns(t) for t in load.torque]
            for slot, sign, lever in self._ends(load):
                rows = self._load_rows(load, slot, lever, force, torque, sign > 0)
                for c, columns in enumerate(rows):
                    self._scatter(slot.body, c, columns, sign)
        for node, component, expr in out.rows:
            self._scatter(node, component, self.columns(expr), 1.0)

    def _load_rows(
        self,
        load: Load,
        slot: Slot,
        lever: Vec,
        force: list[tuple[Value, Columns]],
        torque: list[Columns],
        reaction: bool,
    ) -> list[Columns]:
        """Rows of a load on one body: force, and for a part torque about its mass centre."""
        rows = [columns for _, columns in force]
        if slot.kind != "part":
            return rows
        values = [value for value, _ in force]
        for c in range(3):
            total = self._merged(torque[c], 1.0, None)
            p, q = (c + 1) % 3, (c + 2) % 3
            total = self._merged(force[q][1], lever[p], total)
            total = self._merged(force[p][1], self.b.neg(lever[q]), total)
            self._vary_lever(load, slot, values, c, total, reaction)
            rows.append(total)
        return rows

    def _vary_lever(
        self, load: Load, slot: Slot, force: Vec, c: int, total: Columns, reaction: bool
    ) -> None:
        """Add component c of d(lever) x force = -force x d(lever)."""
        cq = self._coefficient(0)
        unit: Vec = [float(k == c) for k in range(3)]
        row = self.g.scale(cq, self.g.cross(force, unit))
        if reaction and load.follows:
            total.position(load.frame, row)
            total.add(slot.body, [self.b.neg(v) for v in row], [0.0, 0.0, 0.0])
        else:
            frame = load.reaction if reaction and load.reaction is not None else load.frame
            total.rotation(frame, self.g.cross(self.g.lever(frame), row))

    def _merged(self, source: Columns, factor: Value, into: Columns | None) -> Columns:
        total = Columns(self.g) if into is None else into
        for body, row in source.bodies.items():
            scaled = [self.b.mul(factor, v) for v in row]
            total.add(body, scaled[:3], scaled[3:] or None)
        for (node, component), value in source.scalars.items():
            total.scalar(node, component, self.b.mul(factor, value))
        return total

    def _coefficient(self, n: int) -> Value:
        return 0.0 if self.rates_only and n < 2 else f"%c{n}"

    def columns(self, expr: Expr) -> Columns:
        """Derivative of one scalar with respect to every unknown it touches."""
        total = Columns(self.g)
        vectors: dict[Leaf, Vec] = {}
        gradient = self.slope.gradient(expr)
        for symbol in sorted(gradient, key=str):
            leaf = self.scope.leaves[symbol]
            slope = self.value(gradient[symbol])
            if leaf[0] in ("z", "dif", "dif1"):
                self._scalar_column(total, leaf, slope)
            else:
                vectors.setdefault(leaf[:-1], [0.0, 0.0, 0.0])[leaf[-1]] = slope
        for leaf, row in vectors.items():
            self._vector_columns(total, leaf, row)
        return total

    def _scalar_column(self, total: Columns, leaf: Leaf, slope: Value) -> None:
        weight = {"z": 3, "dif": 0, "dif1": 4}[leaf[0]]
        component = leaf[2] if leaf[0] == "z" else 0
        total.scalar(leaf[1], component, self.b.mul(self._coefficient(weight), slope))

    def _vector_columns(self, total: Columns, leaf: Leaf, row: Vec) -> None:
        cq, cu, ca = (self._coefficient(n) for n in range(3))
        g = self.g
        if leaf[0] == "x":
            if self.shape.slots[leaf[1]].kind == "part":
                total.rotation(leaf[1], g.scale(cq, g.cross(g.axis(leaf[1], leaf[2]), row)))
            return
        for frame, sign in ((leaf[1], 1.0), (leaf[2], -1.0)):
            signed = g.scale(sign, row)
            if leaf[0] == "d":
                total.position(frame, g.scale(cq, signed))
            elif leaf[0] == "v":
                total.velocity(frame, signed, cq, cu)
            elif leaf[0] == "a":
                total.acceleration(frame, signed, cq, cu, ca)
            else:
                total.rotation(frame, g.scale(cu if leaf[0] == "w" else ca, signed))

    def _scatter(self, node: int, component: int, columns: Columns, sign: float) -> None:
        for body, row in columns.bodies.items():
            self._write_block(node, component, body, row, sign)
        for (other, at), value in columns.scalars.items():
            row = [0.0] * self.shape.widths[other]
            row[at] = value
            self._write_block(node, component, other, row, sign)

    def _write_block(self, node: int, component: int, column: int, row: Vec, sign: float) -> None:
        if all(value == 0.0 for value in row):
            return
        pair = (node, column)
        if pair not in self.blocks:
            self.blocks.append(pair)
        base = self.b.int_at(self.shape.blocks_at + self.blocks.index(pair))
        width = self.shape.widths[column]
        for c, value in enumerate(row):
            self.b.accumulate("F", base, component * width + c, self.b.mul(sign, value))
