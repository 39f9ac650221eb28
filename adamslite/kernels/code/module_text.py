"""The LLVM text of all kernels of a shape."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from adamslite.kernels.code.added_mass import ACCELERATIONS, is_added_mass, is_along_axes
from adamslite.kernels.code.clock_program import Instruction, clock_programs
from adamslite.kernels.code.jacobian_writer import JacobianWriter
from adamslite.kernels.code.residual_writer import ResidualWriter
from adamslite.kernels.code.shape import Outputs, Shape
from adamslite.native.translate import REGISTERED
from adamslite.native.translate.modules import definitions
from adamslite.native.translate.writer import module_text
from adamslite.symbolic.guards import guards
from adamslite.symbolic.scope import Scope

Body = tuple[str, str, ResidualWriter]
"""A kernel: its name, its head, what has written it."""
RESIDUAL_HEAD = (
    "define void @{name}(i64 %n, ptr noalias readonly %ints, ptr noalias readonly %reals, "
    "ptr noalias readonly %W, ptr noalias %F) nounwind"
)
TRACK_HEAD = (
    "define void @{name}(i64 %n, ptr noalias readonly %ints, ptr noalias %reals, ptr %W, ptr %F) "
    "nounwind"
)
# Signals are read where they are written: each behind those that it takes.
SIGNAL_HEAD = (
    "define void @{name}(i64 %n, ptr noalias readonly %ints, ptr noalias readonly %reals, ptr %W, "
    "ptr %F) nounwind"
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
  %k = phi i64 [0, %entry], [%next, %latch]
  %io = mul i64 %k, {n_ints}
  %ip = getelementptr i64, ptr %ints, i64 %io
  %ro = mul i64 %k, {n_reals}
  %rp = getelementptr double, ptr %reals, i64 %ro
{body}
  br label %latch
latch:
  %next = add nuw nsw i64 %k, 1
  %more = icmp slt i64 %next, %n
  br i1 %more, label %loop, label %exit, !llvm.loop !loop
exit:
  ret void
}}
"""


def write_kernels(
    shape: Shape, name: str, face: str, with_jacobian: bool
) -> tuple[str, dict[str, Any]]:
    """LLVM text of a shape's kernels and what an instance must provide.

    Choices keep their branch within a step, except in what is written: the ``face`` "output".

    Returns
    -------
    text, meta
        ``meta["blocks"]``: pairs (row node, column node) of Jacobian blocks in the order of the
        integers; ``meta["n_ints"]``: integers of an instance; ``meta["angles"]``: how many angles
        and numbers it remembers, ``meta["counted"]``: (number, (measure, slots of its markers))
        of each; ``meta["limits"]``: how many times of leaving its law;
        ``meta["tracks"]``: whether accepted steps concern it;
        ``meta["mass"]``: a force depends on accelerations, ``meta["added_mass"]``: if at all, as
        the mass of a body does, ``meta["along_axes"]``: each of its components on its own;
        ``meta["touches"]``: of guards of the watch that tell whether something is touched their
        numbers, and whether their gap is the distance;
        ``meta["guards"]``: kinds of the guards of the clock and of the watch; ``meta["clock"]``:
        what depends on time alone.
    """
    scope = Scope(shape.slots)
    out = shape.outputs(scope)
    shape.n_angles, shape.n_limits = len(scope.angles) + len(scope.kept), len(scope.limits)
    clock: dict[str, list[list[Instruction]]] = {}
    if face != "output":
        shape.guards = guards(out.expressions, scope.leaves, face, scope.written)
        clock = clock_programs(face, out.expressions, shape.guards.clock, scope.leaves)
    blocks: list[tuple[int, int]] = []
    bodies: list[Body] = []
    if with_jacobian:
        jacobian = JacobianWriter(shape, scope)
        jacobian.jacobian(out)
        blocks = jacobian.blocks
        bodies.append((f"{name}_jacobian", JACOBIAN_HEAD, jacobian))
    bodies.append(_of_residual(shape, scope, out, name, face))
    tracks = bool(shape.n_angles or shape.n_limits or scope.origins)
    if tracks:
        bodies.append(_of_track(shape, scope, name))
    bodies += _of_guards(shape, scope, name)
    n_ints = shape.blocks_at + len(blocks)
    meta = {
        "n_ints": n_ints,
        "blocks": blocks,
        "angles": shape.n_angles,
        "counted": scope.counted(),
        "limits": len(scope.limits),
        "tracks": tracks,
        "guards": shape.guards.kinds,
        "touches": _touches(shape, scope),
        "clock": clock,
        "mass": any(leaf[0] in ACCELERATIONS for leaf in scope.symbols),
        "added_mass": is_added_mass(shape, scope, out),
        "along_axes": is_along_axes(scope, out),
    }
    return loop_text(bodies, n_ints, shape.n_reals), meta


def _touches(shape: Shape, scope: Scope) -> list[tuple[int, bool]]:
    """Of guards of the watch that tell whether something is touched their numbers, and whether
    their gap is the distance."""
    watch = shape.guards.watch
    return [
        (watch.index(relation), in_length)
        for relation, in_length in scope.touches.items()
        if relation in watch
    ]


def _of_residual(shape: Shape, scope: Scope, out: Outputs, name: str, face: str) -> Body:
    """The kernel that evaluates what a shape writes."""
    writer = ResidualWriter(shape, scope)
    writer.residual(out)
    return f"{name}_residual", SIGNAL_HEAD if face == "signal" else RESIDUAL_HEAD, writer


def _of_track(shape: Shape, scope: Scope, name: str) -> Body:
    """The kernel that follows what is remembered of accepted steps."""
    writer = ResidualWriter(shape, scope)
    writer.track()
    return f"{name}_track", TRACK_HEAD, writer


def _of_guards(shape: Shape, scope: Scope, name: str) -> Iterator[Body]:
    """The kernels that evaluate the guards of the clock, and those of the state."""
    kinds = shape.guards.kinds
    evaluated = {"clock": kinds["clock"], "watch": kinds["watch"] + kinds["zone"]}
    for place, (kind, found) in enumerate(evaluated.items()):
        if found:
            writer = ResidualWriter(shape, scope)
            writer.guard_values(place)
            yield f"{name}_{kind}", RESIDUAL_HEAD, writer


def loop_text(bodies: list[Body], n_ints: int, n_reals: int) -> str:
    """LLVM text of kernels that go through instances of ``n_ints`` integers, ``n_reals`` reals."""
    declared, parts = definitions(
        REGISTERED[name] for name in sorted({name for *_, w in bodies for name in w.b.called})
    )
    for name, head, writer in bodies:
        prelude = "".join(
            f"  %cp{n} = getelementptr double, ptr %c, i64 {n}\n  %c{n} = load double, ptr %cp{n}\n"
            for n in range(5)
        )
        parts.append(
            LOOP.format(
                head=head.format(name=name),
                prelude=prelude if head is JACOBIAN_HEAD else "",
                n_ints=n_ints,
                n_reals=n_reals,
                body="\n".join(writer.b.finished()),
            )
        )
        declared |= writer.b.declared
    return module_text(declared, parts)
