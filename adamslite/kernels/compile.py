"""From a model to native kernels: statements grouped by shape, each shape compiled once.

A statement shows several *faces*: the loads it exerts, its constraint rows at position, velocity
and acceleration level, its algebraic or differential equation, the values it writes.  All
instances of one face with one shape form a :class:`ShapeGroup`, run by one kernel in one call.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING

from adamslite.caching.entries import recall, recall_json
from adamslite.caching.sources import version_of
from adamslite.deck.statement_diagnostics import diagnose_inside
from adamslite.elements.bases.constraint import Constraint
from adamslite.gc_pause import without_collection
from adamslite.kernels.binding import Binder, ForceLoop
from adamslite.kernels.groups import (
    LEVELS,
    WITH_JACOBIAN,
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
    from adamslite.kernels.code.shape import Outputs, Shape


def compile_model(
    model: Model,
    progress: Progress | None = None,
    audited: bool = False,
) -> Kernels:
    """Bind every statement, compile the shapes not seen before, link all of them.

    ``audited``: what elastic elements store too.
    """
    groups = Groups()
    add = partial(_add, groups, model)
    outputs = []
    with without_collection():
        for variable in model.signals:
            add(variable, "signal")
        for statement in model.deck.statements:
            for face in faces(statement, model):
                if face != "signal":
                    add(statement, face)
            if audited and hasattr(statement, "stored") and model.acts(statement):
                add(statement, "stored")
            for face in _output(statement):
                outputs.append((statement, statement.result_names))
                add(statement, face)
    fresh = sum(_compile(group, progress) for group in groups.values())
    made = list(groups.values())
    return Kernels(model, made, outputs, linked(made), fresh)


def faces(statement: Statement, model: Model) -> Iterator[str]:
    """What a statement contributes to the equations."""
    if not model.acts(statement):
        return
    if hasattr(statement, "loads"):
        yield "loads"
    if isinstance(statement, Constraint):
        rate = statement.is_rate(model)
        yield from ("reactions", "velocity", "acceleration") if rate else LEVELS
    if hasattr(statement, "relation"):
        yield "sensor"
    if hasattr(statement, "equation"):
        kind = model.variable_kind(statement.key) if statement.keyword == "VARIABLE" else "loop"
        if kind != "inline":
            yield "equation" if kind == "loop" else "signal"


def _output(statement: Statement) -> Iterator[str]:
    if statement.result_names:
        yield "output"


class Groups(dict[Tree, ShapeGroup]):
    """Groups by their keys; those of signals are evaluated in the order in which they are made."""

    def __init__(self) -> None:
        super().__init__()
        self.order: dict[Tree, int] = {}
        self.order_of: dict[Key, int] = {}

    def key_of_signal(self, key: Tree, variable: Key, reads: list[Key]) -> Tree:
        """The key of a group of this shape that is not evaluated before what the instance reads;
        within a group instances are evaluated in turn.
        """
        least = max((self.order_of.get(each, 0) for each in reads), default=0)
        while self.order.setdefault(key, len(self.order)) < least:
            key = ("again", key)
        self.order_of[variable] = self.order[key]
        return key


def _add(groups: Groups, model: Model, statement: Statement, face: str) -> None:
    binder = Binder(model)
    try:
        fields, own = _bound(binder, statement, face)
    except ForceLoop as loop:
        raise DeckError([_loop(statement, str(loop))], model.deck) from None
    held = (statement.keyword, statement.key) in model.held
    rate = held and isinstance(statement, Constraint) and statement.is_rate(model)
    key = binder.key(face, (statement.keyword, fields, own, rate))
    name = repr(key)
    if face == "signal":
        key = groups.key_of_signal(key, statement.key, binder.instance.signals)
    group = groups.get(key)
    if group is None:
        name = "k" + compiler.digest(name, version_of("kernels.compile"))
        level = LEVELS.index(face) - 1 if face in LEVELS else 0
        level -= level > 0 and rate
        write = FaceWriter(binder, statement.keyword, face, fields, own, level)
        group = groups[key] = ShapeGroup(face, name, write)
    group.instances.append((statement, binder.instance))


def _bound(binder: Binder, statement: Statement, face: str) -> tuple[Tree, int]:
    """What a face is made of, and the slot of its own unknowns."""
    if face == "output":
        values = tuple(binder.output(node, statement) for node in statement.outputs(binder.model))
        return values, binder.node_slot(("OUTPUT", statement))
    fields = binder.statement(statement)
    if face in ("signal", "stored", "sensor"):
        return fields, binder.node_slot((face.upper(), statement.key))
    return fields, binder.unknowns(statement)


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
        if self.face == "output":
            return Outputs(rows=[(row, n, scope.read(t)) for n, t in enumerate(self.fields)])
        width = widths(nodes[self.own]) if self.own >= 0 else 0
        view = symbolic_view(self.keyword, self.fields, self.own, width, scope, self.n_bodies)
        if self.face == "loads":
            return Outputs(loads=view.cls.loads(view, scope))
        if self.face == "reactions":
            rows = view.cls.constraints(view, scope)
            return Outputs(loads=reactions(rows, view.unknowns, scope))
        if self.face == "stored":
            return Outputs(rows=[(row, 0, view.cls.stored(view, scope))])
        if self.face == "sensor":
            return Outputs(rows=[(row, 0, view.cls.relation(view, scope))])
        if self.face == "equation":
            return Outputs(rows=[(row, 0, view.cls.equation(view, scope))])
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
                progress.say(
                    f"compiling the expressions of {group.instances[0][0].label} (kept for later)"
                )
            made.append(_kernels(group))
        return made[0]

    group.meta = recall_json(f"{group.name}.json", lambda: text_and_meta()[1])
    group.code = recall(group.entry, lambda: compiler.straight_code(text_and_meta()[0]))
    return bool(made)


def writer_of(kernels: Kernels, group: ShapeGroup) -> Writer:
    """The writer of a group; of kernels that were kept between runs one instance is bound again."""
    if group.write is None:
        made = Groups()
        _add(made, kernels.model, group.instances[0][0], group.face)
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
        try:
            for face in (*faces(statement, model), *_output(statement)):
                _add(groups, model, statement, face)
        except DeckError as fault:
            yield from fault.diagnostics
    for group in groups.values():
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
    return diagnose_inside(group.instances[0][0], label, "no-rate", what=what)
