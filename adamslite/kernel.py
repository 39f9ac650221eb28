"""Native kernels of one expression shape: residual, Jacobian, angle memory, guards.

A *shape* is a statement with every id, number and marker replaced by a slot.  Its sympy loads and
rows are differentiated once with respect to the local inputs of
:class:`~adamslite.symbolic.Scope`, chained to body coordinates by :mod:`adamslite.kinematics`,
and written as one loop over all instances:

    residual(n, ints, reals, W, F)           F[row] -= load,  F[row] += row expression
    jacobian(n, ints, reals, W, c, J)        J[block] += c0 F_q + c1 F_u + c2 F_a + c3 F_z + c4 F_s'
    track   (n, ints, reals, W)              remembers angles at an accepted step
    clock   (n, ints, reals, W, F)           guards of time (adamslite.guards), F = their values
    watch   (n, ints, reals, W, F)           guards of the state

q holds positions and rotations of bodies (and states s of DIFF), z multipliers and variables.
W is the workspace (:mod:`adamslite.kinematics`), ``c`` five coefficients.  The integers of an
instance are

    W offset of each node | W offset of each signal | row of each node | W offset of the branches of
    clock and watch, if there are guards | block offset of each pair

and its reals: parameters, remembered angles, marker levers and axes.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

from adamslite.algebra import sp
from adamslite.guards import Guards, guards
from adamslite.kinematics import HEAD, MODE, TIME, Columns, Geometry, Vec
from adamslite.lowering import Builder, Lowering, Value
from adamslite.symbolic import Load, Scope, Slot

RESIDUAL_HEAD = (
    "define void @{name}(i64 %n, ptr noalias readonly %ints, ptr noalias {reals} %reals, "
    "ptr noalias readonly %W, ptr noalias %F) nounwind"
)
JACOBIAN_HEAD = (
    "define void @{name}(i64 %n, ptr noalias readonly %ints, ptr noalias readonly %reals, "
    "ptr noalias readonly %W, ptr noalias readonly %c, ptr noalias %F) nounwind"
)
LOOP = """{head} {{
entry:
{prelude}  %some = icmp sgt i64 %n, 0
  br i1 %some, label %loop, label %exit
loop:
  %k = phi i64 [0, %entry], [%next, %loop]
  %io = mul i64 %k, {n_ints}
  %ip = getelementptr i64, ptr %ints, i64 %io
  %ro = mul i64 %k, {n_reals}
  %rp = getelementptr double, ptr %reals, i64 %ro
{body}
  %next = add nuw nsw i64 %k, 1
  %more = icmp slt i64 %next, %n
  br i1 %more, label %loop, label %exit
exit:
  ret void
}}
"""


@dataclass
class Shape:
    """The structure shared by all instances of a shape.

    ``slots``: markers.  ``widths``: unknowns of each node, bodies first (3 point, 6 part), then
    scalar nodes.  ``n_bodies``: how many nodes are bodies.  ``n_params``, ``n_angles``,
    ``n_signals``: counts.  ``outputs``: writes loads and rows with a scope.  ``guards``: found when
    they are written.
    """

    slots: list[Slot]
    widths: list[int]
    n_bodies: int
    n_params: int
    n_angles: int
    n_signals: int
    outputs: Callable[[Scope], Outputs]
    guards: Guards = field(default_factory=Guards)

    def marker_reals(self) -> list[int]:
        """First real of each marker."""
        first, at = [], self.n_params + self.n_angles
        for slot in self.slots:
            first.append(at)
            at += 3 * slot.offset + 9 * slot.turned
        return [*first, at]

    @property
    def n_reals(self) -> int:
        return self.marker_reals()[-1]

    def row_at(self, node: int) -> int:
        """The integer that holds the row of a node."""
        return len(self.widths) + self.n_signals + node

    @property
    def branches_at(self) -> int:
        """The integer that holds where the branches of the clock begin; the next: of the watch."""
        return 2 * len(self.widths) + self.n_signals

    @property
    def blocks_at(self) -> int:
        return self.branches_at + 2 * bool(self.guards)


@dataclass
class Outputs:
    """Loads on bodies and scalar rows (node, component, expression) of one shape.

    ``rates_only``: only derivatives with respect to accelerations and multipliers are asked for, as
    from the second derivative of a constraint; the others would be most of the code.
    """

    loads: list[Load] = field(default_factory=list)
    rows: list[tuple[int, int, Any]] = field(default_factory=list)
    rates_only: bool = False

    @property
    def expressions(self) -> list[Any]:
        """Everything that is evaluated."""
        loads = [e for load in self.loads for e in (*load.force, *load.torque)]
        return [sp.S.Zero + e for e in (*loads, *(row[2] for row in self.rows))]


class Writer:
    """Writes the loop body of one kernel."""

    def __init__(self, shape: Shape, scope: Scope) -> None:
        self.shape = shape
        self.scope = scope
        self.b = Builder()
        self.g = Geometry(self.b, shape.slots, shape.marker_reals())
        self.lower = Lowering(self.b, {})
        self.blocks: list[tuple[int, int]] = []
        self.rates_only = False
        for place, found in enumerate((shape.guards.clock, shape.guards.watch)):
            for n, guard in enumerate(found):
                at = self.b.int_at(shape.branches_at + place)
                self.lower.branches[guard] = self.b.read("W", at, n)

    def value(self, expr: Any) -> Value:
        """Lower an expression, loading the leaves it uses first."""
        expr = sp.S.Zero + expr
        for symbol in sorted(expr.free_symbols, key=str):
            if symbol not in self.lower.leaves:
                self.lower.leaves[symbol] = self.leaf(self.scope.leaves[symbol])
        return self.lower(expr)

    def leaf(self, leaf: tuple) -> Value:
        kind = leaf[0]
        if kind in ("d", "v", "a", "w", "al", "x"):
            return self.g.leaf(leaf)
        if kind == "p":
            return self.b.real_at(leaf[1])
        if kind in ("t", "mode"):
            return self.b.emit(
                (kind,), f"load double, ptr {self._head(TIME if kind == 't' else MODE)}"
            )
        if kind in ("z", "dif"):
            return self.b.read("W", self.b.int_at(leaf[1]), leaf[2] if kind == "z" else 0)
        if kind == "dif1":
            return self.b.read("W", self.b.int_at(leaf[1]), 1)
        if kind == "sig":
            return self.b.read("W", self.b.int_at(len(self.shape.widths) + leaf[1]), leaf[2])
        if kind == "nan":
            return math.nan
        return self._turns(leaf[1])

    def _head(self, position: int) -> str:
        if position >= HEAD:
            raise IndexError(position)
        return self.b.emit(("head", position), f"getelementptr double, ptr %W, i64 {position}")

    def _turns(self, n: int) -> Value:
        """Whole turns that bring the wrapped angle nearest to the remembered one."""
        b = self.b
        gap = b.sub(b.real_at(self.shape.n_params + n), self.value(self.scope.angles[n]))
        turns = b.call("floor", b.add(b.mul(gap, 0.5 / math.pi), 0.5))
        return b.mul(turns, 2 * math.pi)

    def residual(self, out: Outputs) -> None:
        for load in out.loads:
            force = [self.value(f) for f in load.force]
            torque = [self.value(t) for t in load.torque]
            for body, sign, lever in self._ends(load):
                self._add_load(body, sign, force, torque, lever)
        for node, component, expr in out.rows:
            self.b.accumulate(
                "F", self.b.int_at(self.shape.row_at(node)), component, self.value(expr)
            )

    def _ends(self, load: Load) -> list[tuple[Slot, float, Vec]]:
        """The loaded bodies: slot, sign in the residual, lever about the mass centre."""
        ends = []
        slot = self._moving(load.frame)
        if slot is not None:
            ends.append((slot, -1.0, self.g.lever(load.frame)))
        other = self._moving(load.reaction) if load.reaction is not None else None
        if other is not None:
            ends.append((other, 1.0, self._reaction_lever(load)))
        return ends

    def _moving(self, frame: int) -> Slot | None:
        return None if self.scope.is_ground(frame) else self.shape.slots[frame]

    def _reaction_lever(self, load: Load) -> Vec:
        slot = self.shape.slots[load.reaction]
        if slot.kind == "part" and load.follows:
            return self.g.sub(self.g.position(load.frame), self.g.body(slot.body, 0))
        return self.g.lever(load.reaction)

    def _add_load(self, slot: Slot, sign: float, force: Vec, torque: Vec, lever: Vec) -> None:
        row = self.b.int_at(self.shape.row_at(slot.body))
        values = list(force)
        if slot.kind == "part":
            values += self.g.add(torque, self.g.cross(lever, force))
        for c, value in enumerate(values):
            self.b.accumulate("F", row, c, self.b.mul(sign, value))

    def jacobian(self, out: Outputs) -> None:
        self.rates_only = out.rates_only
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
        self, load: Load, slot: Slot, lever: Vec, force: list, torque: list, reaction: bool
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
        unit = [float(k == c) for k in range(3)]
        row = self.g.scale(cq, self.g.cross(force, unit))
        if reaction and load.follows:
            total.position(load.frame, row)
            total.add(slot.body, [self.b.neg(v) for v in row], [0.0, 0.0, 0.0])
        else:
            frame = load.reaction if reaction else load.frame
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

    def columns(self, expr: Any) -> Columns:
        """Derivative of one scalar with respect to every unknown it touches."""
        expr = sp.S.Zero + expr
        total = Columns(self.g)
        vectors: dict[tuple, Vec] = {}
        for symbol in sorted(expr.free_symbols, key=str):
            leaf = self.scope.leaves[symbol]
            if leaf[0] in ("p", "t", "mode", "sig", "turn", "nan"):
                continue
            if self.rates_only and leaf[0] in ("d", "v", "x", "w", "dif"):
                continue
            slope = self.value(sp.diff(expr, symbol))
            if leaf[0] in ("z", "dif", "dif1"):
                self._scalar_column(total, leaf, slope)
            else:
                vectors.setdefault(leaf[:-1], [0.0, 0.0, 0.0])[leaf[-1]] = slope
        for leaf, row in vectors.items():
            self._vector_columns(total, leaf, row)
        return total

    def _scalar_column(self, total: Columns, leaf: tuple, slope: Value) -> None:
        weight = {"z": 3, "dif": 0, "dif1": 4}[leaf[0]]
        component = leaf[2] if leaf[0] == "z" else 0
        total.scalar(leaf[1], component, self.b.mul(self._coefficient(weight), slope))

    def _vector_columns(self, total: Columns, leaf: tuple, row: Vec) -> None:
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

    def guard_values(self, place: int) -> None:
        """The guards of the clock (``place`` 0) or the watch (1): gaps of relations, arguments of
        floors.
        """
        base = self.b.int_at(self.shape.branches_at + place)
        for n, guard in enumerate((self.shape.guards.clock, self.shape.guards.watch)[place]):
            for side in guard.args:
                self.value(side)
            is_floor = not hasattr(guard, "rel_op")
            value = self.value(guard.args[0]) if is_floor else self.lower.gap(guard)
            self.b.accumulate("F", base, n, value)

    def track(self) -> None:
        for n, wrapped in enumerate(self.scope.angles):
            angle = self.b.add(self.value(wrapped), self._turns(n))
            self.b.store_real(self.shape.n_params + n, angle)


def write_kernels(shape: Shape, name: str, with_jacobian: bool, guarded: bool) -> tuple[str, dict]:
    """LLVM text of a shape's kernels and what an instance must provide.

    ``guarded``: choices keep their branch within a step; for equations, not for what is written.

    Returns
    -------
    text, meta
        ``meta["blocks"]``: pairs (row node, column node) of Jacobian blocks in the order of the
        integers; ``meta["n_ints"]``: integers of an instance; ``meta["angles"]``: how many angles
        it remembers; ``meta["mass"]``: a force depends on accelerations; ``meta["guards"]``: kinds
        of the guards of the clock and of the watch.
    """
    scope = Scope(shape.slots)
    out = shape.outputs(scope)
    shape.n_angles = len(scope.angles)
    if guarded:
        shape.guards = guards(out.expressions, scope.leaves)
    blocks: list[tuple[int, int]] = []
    bodies: list[tuple[str, str, Writer]] = []
    if with_jacobian:
        writer = Writer(shape, scope)
        writer.jacobian(out)
        blocks = writer.blocks
        bodies.append((f"{name}_jacobian", JACOBIAN_HEAD, writer))
    writer = Writer(shape, scope)
    writer.residual(out)
    bodies.append((f"{name}_residual", RESIDUAL_HEAD, writer))
    if scope.angles:
        writer = Writer(shape, scope)
        writer.track()
        bodies.append((f"{name}_track", RESIDUAL_HEAD, writer))
    for place, (kind, found) in enumerate(shape.guards.kinds.items()):
        if found:
            writer = Writer(shape, scope)
            writer.guard_values(place)
            bodies.append((f"{name}_{kind}", RESIDUAL_HEAD, writer))
    n_ints = shape.blocks_at + len(blocks)
    meta = {
        "n_ints": n_ints,
        "blocks": blocks,
        "angles": len(scope.angles),
        "guards": shape.guards.kinds,
        "mass": any(leaf[0] in ("a", "al") for leaf in scope.symbols),
    }
    return _module(bodies, n_ints, shape.n_reals), meta


def _module(bodies: list[tuple[str, str, Writer]], n_ints: int, n_reals: int) -> str:
    parts, declared = [], set()
    for name, head, writer in bodies:
        prelude = "".join(
            f"  %cp{n} = getelementptr double, ptr %c, i64 {n}\n  %c{n} = load double, ptr %cp{n}\n"
            for n in range(5)
        )
        reals = "" if name.endswith("_track") else "readonly"
        parts.append(
            LOOP.format(
                head=head.format(name=name, reals=reals),
                prelude=prelude if head is JACOBIAN_HEAD else "",
                n_ints=n_ints,
                n_reals=n_reals,
                body="\n".join(writer.b.lines),
            )
        )
        declared |= writer.b.declared
    return "\n".join([*sorted(declared), *parts, "!0 = !{}"])
