"""Residuals of many instances at once, for bodies that stand behind each other.

Where the instances of a shape follow each other as their bodies do (the sections of a cable, the
rows and columns of a net) the numbers that instance k reads stand k places behind those of the
first, if the places, velocities and forces of all bodies are stored by component::

    S = x of all bodies, y, z, then vx, vy, vz        F = fx, fy, fz

Then there is nothing to gather or scatter, and the loop over a *run* of instances takes as many at
once as the processor has lanes: in blocks, first all forces, which are added to the first body of
every instance, then, from ``T``, those on the second, and so on, since neighbours add to the same
body.

Loads of added mass have a second such function, of the derivatives of F by the accelerations of
their body, nine rows E; their forces are those without acceleration.
"""

from __future__ import annotations

from collections.abc import Iterator

from adamslite.kernels.code.kinematics import Vec
from adamslite.kernels.code.residual_writer import ResidualWriter
from adamslite.kernels.code.shape import Outputs, Shape
from adamslite.native.llvm_builder import FAST, Builder, Value, literal
from adamslite.native.translate.writer import module_text
from adamslite.symbolic.scope import Scope, Slot

#: Instances whose forces stand in ``T`` at a time.
BLOCK = 256
#: Components of a body in S, position and velocity.
COMPONENTS = 6
HEAD = (
    "define void @{name}(i64 %n, ptr noalias readonly %ints, ptr noalias readonly %reals, i64 %m, "
    "ptr noalias readonly %W, ptr noalias readonly %S, i64 %stride, {target}) nounwind"
)
#: Where values are added: rows that are known not to meet, or one behind the other.
APART, TOGETHER = "ptr noalias %F0, ptr noalias %F1, ptr noalias %F2", "ptr noalias %F"
OUTER = """{head} {{
entry:
  %T = alloca [{room} x double], align 64
{prelude}
  br label %blocks
blocks:
  %at = phi i64 [0, %entry], [%then, %{last}]
  %left = sub i64 %n, %at
  %whole = icmp sgt i64 %left, {block}
  %count = select i1 %whole, i64 {block}, i64 %left
  %some = icmp sgt i64 %count, 0
  br i1 %some, label %forces, label %exit
forces:
  %k = phi i64 [0, %blocks], [%k.next, %forces]
  %j = add nuw nsw i64 %at, %k
{body}
  %k.next = add nuw nsw i64 %k, 1
  %k.more = icmp slt i64 %k.next, %count
  br i1 %k.more, label %forces, label %{first}, !llvm.loop !loop
{sums}
{last}:
  %then = add nuw nsw i64 %at, {block}
  br label %blocks
exit:
  ret void
}}"""
SUM = """sum{n}:
  %a{n} = phi i64 [0, %{before}], [%a{n}.next, %sum{n}]
  %a{n}.t = getelementptr double, ptr %T, i64 {first}
  %a{n}.p = getelementptr double, ptr %a{n}.t, i64 %a{n}
  %a{n}.v = load double, ptr %a{n}.p
  %a{n}.j = add nuw nsw i64 %at, %a{n}
  %a{n}.q = getelementptr double, ptr {row}, i64 %a{n}.j
  %a{n}.o = load double, ptr %a{n}.q
  %a{n}.s = {op} {fast} double %a{n}.o, %a{n}.v
  store double %a{n}.s, ptr %a{n}.q
  %a{n}.next = add nuw nsw i64 %a{n}, 1
  %a{n}.more = icmp slt i64 %a{n}.next, %count
  br i1 %a{n}.more, label %sum{n}, label %{after}, !llvm.loop !loop"""


class LaneBuilder(Builder):
    """Numbers of instance %j, by component; ``n_bodies``: integers of a run that are bodies."""

    def __init__(self, n_bodies: int) -> None:
        super().__init__()
        self.n_bodies = n_bodies
        self.prelude: dict[str, str] = {}

    def first(self, name: str, text: str) -> str:
        """A value that all instances share, found before the loops."""
        self.prelude.setdefault(name, f"  {name} = {text}")
        return name

    def int_at(self, position: int) -> str:
        """Integer ``position`` of the run: the first body, or where a signal stands."""
        at = self.first(f"%ia{position}", f"getelementptr i64, ptr %ints, i64 {position}")
        return self.first(f"%i{position}", f"load i64, ptr {at}")

    def component(self, array: str, body: int, component: int) -> str:
        """Address of a component of the first instance's body."""
        name = f"%{array.lower()}{body}.{component}"
        shift = self.first(f"%shift{component}", f"mul i64 %stride, {component}")
        place = self.first(f"{name}.i", f"add i64 {shift}, {self.int_at(body)}")
        return self.first(name, f"getelementptr double, ptr %{array}, i64 {place}")

    def real_at(self, position: int) -> str:
        """Real ``position``, of all instances of the shape behind each other."""
        shift = self.first(f"%ri{position}", f"mul i64 %m, {position}")
        row = self.first(f"%r{position}", f"getelementptr double, ptr %reals, i64 {shift}")
        address = self.emit(("ra", position), f"getelementptr double, ptr {row}, i64 %j")
        return self.emit(("r", position), f"load double, ptr {address}")

    def read(self, array: str, base: str, shift: int) -> str:
        """A component of a body from S, anything else from the workspace as it is."""
        body = int(base.removeprefix("%i"))
        if body >= self.n_bodies:
            return super().read(array, base, shift)
        if shift >= COMPONENTS:
            return literal(0.0)  # what accelerations are worth stands in E
        row = self.component("S", body, shift)
        address = self.emit(("pa", body, shift), f"getelementptr double, ptr {row}, i64 %j")
        return self.emit(("read", body, shift), f"load double, ptr {address}")


class LaneWriter(ResidualWriter):
    """Writes the loads of a shape for runs of instances."""

    b: LaneBuilder

    def __init__(self, shape: Shape, scope: Scope, target: str = APART) -> None:
        super().__init__(shape, scope, LaneBuilder(shape.n_bodies))
        self.target = target
        self.kept: list[Value] = []
        self.sums: list[tuple[int, int, str, int]] = []

    def _add_load(self, slot: Slot, sign: float, force: Vec, torque: Vec, lever: Vec) -> None:
        for component, value in enumerate(force):
            self._keep(slot, component, sign, value)

    def _keep(self, slot: Slot, component: int, sign: float, value: Value) -> None:
        """Add a value to a component of a body."""
        if value == 0.0:
            return
        op = "fadd" if sign > 0.0 else "fsub"
        if slot.body == 0 and self.target == APART:
            self._add(component, op, value)
            return
        if value not in self.kept:
            self.kept.append(value)
        self.sums.append((slot.body, component, op, self.kept.index(value)))

    def _add(self, component: int, op: str, value: Value) -> None:
        """To the first body of every instance: no other instance adds to it meanwhile."""
        b, row = self.b, self._row(0, component)
        at, old, new = b.fresh(), b.fresh(), b.fresh()
        b.lines += [
            f"  {at} = getelementptr double, ptr {row}, i64 %j",
            f"  {old} = load double, ptr {at}",
            f"  {new} = {op} {FAST} double {old}, {b.operand(value)}",
            f"  store double {new}, ptr {at}",
        ]

    def _row(self, body: int, component: int) -> str:
        """Address of a component of what is added to the first instance's body."""
        if self.target == TOGETHER:
            return self.b.component("F", body, component)
        at = f"getelementptr double, ptr %F{component}, i64 {self.b.int_at(body)}"
        return self.b.first(f"%f{body}.{component}", at)

    def masses(self, out: Outputs) -> None:
        """Derivatives of loads by the accelerations of their body: row 3 i + j of component i by
        acceleration j.
        """
        ends = [(load, slot, sign) for load in out.loads for slot, sign, _ in self._ends(load)]
        for load, slot, sign in ends:
            for i, force in enumerate(load.force):
                gradient = self.scope.slope.gradient(force)
                for symbol in sorted(gradient, key=str):
                    leaf = self.scope.leaves[symbol]
                    frames = ((leaf[1], sign), (leaf[2], -sign)) if leaf[0] == "a" else ()
                    for frame, along in frames:
                        if not self.scope.is_ground(frame):
                            slope = self.value(gradient[symbol])
                            self._keep(slot, 3 * i + leaf[3], along, slope)

    def text(self, name: str) -> str:
        """The function."""
        b = self.b
        for number, value in enumerate(self.kept):
            row = b.first(f"%t{number}", f"getelementptr double, ptr %T, i64 {number * BLOCK}")
            b.lines.append(f"  %t{number}.p = getelementptr double, ptr {row}, i64 %k")
            b.lines.append(f"  store double {b.operand(value)}, ptr %t{number}.p")
        sums = "\n".join(self._sums())
        return OUTER.format(
            head=HEAD.format(name=name, target=self.target), room=max(1, len(self.kept) * BLOCK),
            prelude="\n".join(b.prelude.values()), block=BLOCK, body="\n".join(b.lines), sums=sums,
            first="sum0" if self.sums else "done", last="done",
        )  # fmt: skip

    def _sums(self) -> Iterator[str]:
        for n, (body, component, op, number) in enumerate(self.sums):
            yield SUM.format(
                n=n, before=f"sum{n - 1}" if n else "forces", first=number * BLOCK, op=op,
                row=self._row(body, component), fast=FAST,
                after=f"sum{n + 1}" if n + 1 < len(self.sums) else "done",
            )  # fmt: skip


def write_lanes(shape: Shape, name: str, mass: str = "") -> str:
    """LLVM text of a shape's residual for runs of instances, and with a name for it of its added
    mass.
    """
    scope = Scope(shape.slots)
    out: Outputs = shape.outputs(scope)
    writer = LaneWriter(shape, scope)
    writer.residual(out)
    texts, declared = [writer.text(name)], writer.b.declared
    if mass:
        writer = LaneWriter(shape, scope, TOGETHER)
        writer.masses(out)
        texts.append(writer.text(mass))
        declared |= writer.b.declared
    return module_text(declared, texts)
