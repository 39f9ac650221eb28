"""From a model to native kernels: statements grouped by shape, each shape compiled once.

A statement shows several *faces*: the loads it exerts, its constraint rows at position, velocity
and acceleration level, its algebraic or differential equation, the values it writes.  All
instances of one face with one shape form a :class:`ShapeGroup`, run by one kernel in one call.
"""

from __future__ import annotations

import itertools
from collections.abc import Hashable, Iterable, Iterator
from dataclasses import dataclass
from itertools import chain
from typing import TYPE_CHECKING, Any

from adamslite.assembly.start_posture import settle_start
from adamslite.caching.entries import recall, recall_json
from adamslite.caching.sources import version_of
from adamslite.deck.counted_turns import counted, counting
from adamslite.deck.statement_diagnostics import diagnose_inside
from adamslite.elements.bases.constraint import Constraint
from adamslite.gc_pause import without_collection
from adamslite.kernels.binding import Binder, ForceLoop
from adamslite.kernels.columns import Split, same, transposed
from adamslite.kernels.faces import faces, output_face
from adamslite.kernels.groups import (
    LEVELS,
    WITH_JACOBIAN,
    Binding,
    Instances,
    Kernels,
    Meta,
    ShapeGroup,
    Writer,
    linked,
)
from adamslite.kernels.reactions import reactions
from adamslite.kernels.reader import ExpressionReader, symbolic_view
from adamslite.language.diagnostics import DeckError, Diagnostic
from adamslite.language.interfaces import Key
from adamslite.language.statement import Statement
from adamslite.model.model import Model
from adamslite.native import compiler
from adamslite.progress import Progress
from adamslite.symbolic.scope import Scope, UndefinedRate
from adamslite.symbolic.types import Expr, Tree

if TYPE_CHECKING:  # a deck whose shapes are cached needs no expressions
    from adamslite.deck.deck import Deck
    from adamslite.kernels.code.shape import Outputs, Shape

SCALARS = {"stored": "stored", "sensor": "relation", "equation": "equation"}
"""Faces of one number, and the method that writes it."""

Numbered = tuple[int, Statement]
"""A statement with its number in the order of groups and instances."""


def compile_model(
    model: Model,
    progress: Progress | None = None,
    audited: bool = False,
) -> Kernels:
    """Bind every statement, compile the shapes not seen before, link all of them.

    ``audited``: what elastic elements store too.
    """
    settle_start(model)
    groups = Groups()
    outputs = []
    batches: dict[tuple[type[Statement], str], list[Numbered]] = {}
    count = itertools.count()

    def add(statement: Statement, face: str) -> None:
        batches.setdefault((type(statement), face), []).append((next(count), statement))

    with without_collection():
        for variable in model.signals:  # the group of each hangs on those of others
            _add(groups, model, "signal", [(next(count), variable)])
        for statement in model.deck.statements:
            for face in faces(statement, model):
                if face != "signal":
                    add(statement, face)
            if audited and hasattr(statement, "stored") and model.acts(statement):
                add(statement, "stored")
            for face in output_face(statement):
                outputs.append((statement, statement.result_names))
                add(statement, face)
        for each in counting(model.deck.turns, model.deck.statements):
            add(each, "counted")
        for (_, face), found in batches.items():
            _add(groups, model, face, found)
        made = groups.made(model.deck)
    fresh = sum(_compile(group, progress) for group in made)
    return Kernels(model, made, outputs, linked(made), fresh)


@dataclass
class Collected:
    """A group while statements are bound: their numbers in the order of groups, and their columns,
    part by part.
    """

    face: str
    name: str
    write: FaceWriter
    parts: list[tuple[list[Numbered], Binding]]

    @property
    def first(self) -> int:
        """The least number."""
        return min(part[0][0] for part, _ in self.parts)

    def group(self) -> ShapeGroup:
        """The group, its instances in order."""
        numbered = [each for part, _ in self.parts for each in part]
        order = sorted(range(len(numbered)), key=lambda k: numbered[k][0])
        columns = Binding(*(
            [in_order([*chain(*parts)], order) for parts in zip(*slots, strict=True)]
            for slots in zip(*(found.fields() for _, found in self.parts), strict=True)
        ))  # fmt: skip
        statements = [numbered[k][1] for k in order]
        return ShapeGroup(self.face, self.name, self.write, Instances(statements, columns))


def in_order(column: list[Any], order: list[int]) -> list[Any]:
    """A column with its rows in another order."""
    return [column[k] for k in order]


class Groups(dict[Tree, Collected]):
    """Groups by their keys; those of signals are evaluated in the order in which they are made."""

    def __init__(self) -> None:
        super().__init__()
        self.order: dict[Tree, int] = {}
        self.order_of: dict[Key, int] = {}
        self.loops: dict[int, Diagnostic] = {}
        """Forces that depend on themselves, by the number of the statement."""

    def key_of_signal(self, key: Tree, variable: Key, reads: list[Key]) -> Tree:
        """The key of a group of this shape that is not evaluated before what the instance reads;
        within a group instances are evaluated in turn.
        """
        least = max((self.order_of.get(each, 0) for each in reads), default=0)
        while self.order.setdefault(key, len(self.order)) < least:
            key = ("again", key)
        self.order_of[variable] = self.order[key]
        return key

    def made(self, deck: Deck) -> list[ShapeGroup]:
        """The groups in the order of their first statements.

        Raises
        ------
        DeckError
            When a force depends on itself.
        """
        if self.loops:
            raise DeckError([self.loops[min(self.loops)]], deck)
        return [each.group() for each in sorted(self.values(), key=lambda each: each.first)]


def _add(groups: Groups, model: Model, face: str, statements: list[Numbered]) -> None:
    """Bind one face of statements of one class, those of one shape together."""
    pending = [statements]
    while pending:
        part = pending.pop()
        try:
            _bind(groups, model, face, part)
        except Split as split:
            parts: dict[Hashable, list[Numbered]] = {}
            for label, each in zip(split.labels, part, strict=True):
                parts.setdefault(label, []).append(each)
            pending += parts.values()
        except ForceLoop as loop:
            number, statement = part[0]
            groups.loops[number] = _loop(statement, str(loop))


def _bind(groups: Groups, model: Model, face: str, numbered: list[Numbered]) -> None:
    """Enter statements of one shape; raises :class:`Split` where they are not."""
    statements = [statement for _, statement in numbered]
    binder, statement = Binder(model, len(statements)), statements[0]
    fields, own = _bound(binder, statements, face)
    held = (((each.keyword, each.key) in model.held, each) for each in statements)
    rate = same([on and isinstance(s, Constraint) and s.is_rate(model) for on, s in held])
    key = binder.key(face, (statement.keyword, fields, own, rate))
    name = repr(key)
    if face == "signal":
        key = groups.key_of_signal(key, statement.key, binder.instance.signals)
    found = groups.get(key)
    if found is None:
        name = "k" + compiler.digest(name, version_of("kernels.compile"))
        level = LEVELS.index(face) - 1 if face in LEVELS else 0
        level -= level > 0 and rate
        write = FaceWriter(binder, statement.keyword, face, fields, own, level)
        found = groups[key] = Collected(face, name, write, [])
    found.parts.append((numbered, binder.columns))
    binder.columns = binder.columns.row(slice(1))


def _bound(binder: Binder, statements: list[Statement], face: str) -> tuple[Tree, int]:
    """What a face is made of, and the slot of its own unknowns."""
    if face == "output":
        found = transposed([binder.model.outputs_of(each) for each in statements])
        values = tuple([binder.output(nodes, statements) for nodes in found])
        return values, binder.node_slot([("OUTPUT", each) for each in statements])
    if face == "counted":
        found = transposed([counted(each) for each in statements])
        return tuple([binder.expression(nodes) for nodes in found]), -1
    fields = binder.statement(statements)
    if face == "since start":
        return fields, -1
    if face in ("signal", "stored", "sensor"):
        return fields, binder.node_slot([(face.upper(), each.key) for each in statements])
    return fields, binder.unknowns(statements)


@dataclass
class FaceWriter:
    """Writes loads and rows of one face with a scope; ``level``: how often they are differentiated
    by time.
    """

    binder: Binder
    keyword: str
    face: str
    fields: Tree
    own: int
    level: int

    @property
    def n_bodies(self) -> int:
        """Bodies among the nodes."""
        return len(self.binder.instance.bodies)

    def kernels(self, name: str) -> tuple[str, Meta]:
        """LLVM text of all kernels of the shape, and what an instance must provide."""
        from adamslite.kernels.code.module_text import write_kernels

        return write_kernels(self._shape(), name, self.face, self.face in WITH_JACOBIAN)

    def lanes(self, name: str, mass: str) -> str:
        """LLVM text of the residual for runs of instances, and of added mass if there is any."""
        from adamslite.kernels.code.lane_writer import write_lanes

        return write_lanes(self._shape(), name, mass)

    def _shape(self) -> Shape:
        from adamslite.kernels.code.shape import Shape

        at, model = self.binder.instance, self.binder.model
        widths = [model.body_width(b) for b in at.bodies]
        widths += [model.node_width(n) for n in at.nodes]
        counts = (len(at.params), 0, 0, len(at.signals), len(at.tables))
        return Shape(self.binder.slots, widths, self.n_bodies, *counts, self)

    def __call__(self, scope: Scope) -> Outputs:
        from adamslite.kernels.code.shape import Outputs

        scope.read = ExpressionReader(scope, self.n_bodies)
        widths = self.binder.model.node_width
        nodes = self.binder.instance.nodes
        scope.variables = self.binder.variables
        for part in self.binder.parts:
            if part[0] == "var":
                scope.read(part)
                continue
            keyword, fields, node = self.binder.elements[part[1]]
            width = widths(nodes[node]) if node >= 0 else 0
            scope.elements.append(symbolic_view(keyword, fields, node, width, scope, self.n_bodies))
        row = self.n_bodies + self.own
        if self.face in ("output", "counted"):
            values = [(row, n, scope.read(tree)) for n, tree in enumerate(self.fields)]
            return Outputs(rows=values if self.face == "output" else [])
        width = widths(nodes[self.own]) if self.own >= 0 else 0
        view = symbolic_view(self.keyword, self.fields, self.own, width, scope, self.n_bodies)
        if self.face == "loads":
            return Outputs(loads=view.cls.loads(view, scope))
        if self.face == "reactions":
            rows = view.cls.constraints(view, scope)
            return Outputs(loads=reactions(rows, view.unknowns, scope))
        if self.face in SCALARS:
            return Outputs(rows=[(row, 0, getattr(view.cls, SCALARS[self.face])(view, scope))])
        if self.face == "since start":
            view.cls.constraints(view, scope)
            return Outputs()
        if self.face == "signal":
            return Outputs(
                rows=[(row, n, e) for n, e in enumerate(_rates(scope, view.function, 2))]
            )
        rows = [_rates(scope, e, self.level)[-1] for e in view.cls.constraints(view, scope)]
        numbered = [(row, n, e) for n, e in enumerate(rows)]
        return Outputs(rows=numbered, rates_only=self.face == "acceleration")


def _rates(scope: Scope, expr: Expr, order: int) -> list[Expr]:
    """An expression and its total time derivatives up to ``order``."""
    found = [expr]
    for _ in range(order):
        found.append(scope.derivative(found[-1]))
    return found


def _compile(group: ShapeGroup, progress: Progress | None) -> bool:
    """Fetch or make the object code; True when it was made."""
    made: list[tuple[str, Meta]] = []

    def text_and_meta() -> tuple[str, Meta]:
        if not made:
            if progress is not None and group.face == "loads":
                label = group.instances.statements[0].label
                progress.say(f"compiling the expressions of {label} (kept for later)")
            made.append(_kernels(group))
        return made[0]

    group.meta = recall_json(f"{group.name}.json", lambda: text_and_meta()[1])
    group.code = recall(group.entry, lambda: compiler.straight_code(text_and_meta()[0]))
    return bool(made)


def writer_of(kernels: Kernels, group: ShapeGroup) -> Writer:
    """The writer of a group; of kernels that were kept between runs one instance is bound again."""
    if group.write is None:
        made = Groups()
        _add(made, kernels.model, group.face, [(0, group.instances.statements[0])])
        (group.write,) = (each.write for each in made.values() if each.name == group.name)
    return group.writer


def lanes(kernels: Kernels, group: ShapeGroup) -> tuple[int, int]:
    """Addresses of the residual for runs of instances and of their added mass, 0 without any; made
    when they are first asked for.
    """
    symbol, mass = f"{group.name}_lanes", f"{group.name}_mass" if group.meta["mass"] else ""

    def compiled() -> bytes:
        return compiler.object_code(writer_of(kernels, group).lanes(symbol, mass))

    if symbol not in kernels.addresses:
        code = recall(f"{symbol}.o", compiled)
        names = [symbol, mass] if mass else [symbol]
        kernels.addresses.update(compiler.addresses([(code, names)]))
    return kernels.addresses[symbol], kernels.addresses[mass] if mass else 0


def _kernels(group: ShapeGroup) -> tuple[str, Meta]:
    try:
        return group.writer.kernels(group.name)
    except UndefinedRate as fault:
        raise DeckError([_no_rate(group, fault)], group.writer.binder.model.deck) from None


def unformed(model: Model, statements: Iterable[Statement]) -> Iterator[Diagnostic]:
    """What there is to say of statements whose equations cannot be formed; nothing is compiled."""
    groups = Groups()
    for statement in statements:
        for face in (*faces(statement, model), *output_face(statement)):
            _add(groups, model, face, [(0, statement)])
            if groups.loops:
                yield groups.loops.pop(0)
                break
    for found in groups.values():
        group = found.group()
        try:
            group.writer(Scope(group.writer.binder.slots))
        except UndefinedRate as fault:
            yield _no_rate(group, fault)


def _loop(statement: Statement, other: str) -> Diagnostic:
    return diagnose_inside(statement, other, "force-loop", other=other)


def _no_rate(group: ShapeGroup, fault: UndefinedRate) -> Diagnostic:
    """What the equations would need the rate of."""
    kind, at, *_ = fault.leaf
    what = {"a": "an acceleration", "al": "an angular acceleration"}.get(kind, "a second rate")
    label = ""
    if kind in ("z", "dif1"):
        binder = group.writer.binder
        label = binder.model.element(*binder.instance.nodes[at - group.writer.n_bodies]).label
        circular = label.startswith("VARIABLE")
        what = f"{label}, which depends on itself" if circular else f"a reaction of {label}"
        what = f"the rate of {label}" if kind == "dif1" else what
    return diagnose_inside(group.instances.statements[0], label, "no-rate", what=what)
