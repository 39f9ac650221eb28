"""From a model to native kernels: statements grouped by shape, each shape compiled once.

A statement shows several *faces*: the loads it exerts, its constraint rows at position, velocity
and acceleration level, its algebraic or differential equation, the values it writes.  All
instances of one face with one shape form a :class:`Group`, run by one kernel in one call.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from functools import cache
from importlib.util import find_spec
from pathlib import Path
from typing import Any

from adamslite import native
from adamslite.caching.entries import recall, recall_json
from adamslite.caching.sources import version_of
from adamslite.model import Model
from adamslite.shape import Binder, Binding, Tree
from adamslite.statement import Statement
from adamslite.symbolic import Scope
from adamslite.uncollected import uncollected
from adamslite.view import Reader, reactions, symbolic_view


@dataclass
class Group:
    """The instances of one shape: ``face`` names what its kernels compute."""

    face: str
    name: str
    make: Callable[[], tuple[str, dict]]
    instances: list[tuple[Statement, Binding]] = field(default_factory=list)
    code: bytes = b""
    meta: dict[str, Any] = field(default_factory=dict)


@dataclass
class Kernels:
    """A model with its compiled groups and the values it writes.

    ``outputs``: (statement, result names) in the order of the output rows.
    """

    model: Model
    groups: list[Group]
    outputs: list[tuple[Statement, tuple[str, ...]]]
    addresses: dict[str, int]
    compiled: int


LEVELS = ("reactions", "position", "velocity", "acceleration")
WITH_JACOBIAN = ("loads", "equation", *LEVELS)


def compile_model(model: Model, progress: Any = None) -> Kernels:
    """Bind every statement, compile the shapes not seen before, link all of them."""
    groups: dict[tuple, Group] = {}
    outputs = []
    with uncollected():
        for statement in model.deck.statements:
            for face in faces(statement, model):
                _add(groups, model, statement, face)
            if getattr(statement, "result_names", ()):
                outputs.append((statement, statement.result_names))
                _add(groups, model, statement, "output")
    fresh = sum(_compile(group, progress) for group in groups.values())
    addresses = native.addresses((group.code, _entry_points(group)) for group in groups.values())
    return Kernels(model, list(groups.values()), outputs, addresses, fresh)


def faces(statement: Statement, model: Model) -> Iterator[str]:
    """What a statement contributes to the equations."""
    if not model.acts(statement):
        return
    if hasattr(statement, "loads"):
        yield "loads"
    if (statement.keyword, statement.key) in model.held:
        rate = statement.is_rate(model)
        yield from ("reactions", "velocity", "acceleration") if rate else LEVELS
    if hasattr(statement, "equation"):
        kind = model.variable_kind(statement.key) if statement.keyword == "VARIABLE" else "loop"
        if kind != "inline":
            yield "equation" if kind == "loop" else "signal"


def _add(groups: dict[tuple, Group], model: Model, statement: Statement, face: str) -> None:
    binder = Binder(model, inline_signals=face == "signal")
    if face == "output":
        fields: Tree = tuple(binder.output(node, statement) for node in statement.outputs(model))
        own = binder.node_slot(("OUTPUT", statement))
    else:
        fields = binder.statement(statement)
        own = binder.unknowns(statement)
        if face == "signal":
            own = binder.node_slot(("SIGNAL", statement.key))
    rate = (statement.keyword, statement.key) in model.held and statement.is_rate(model)
    key = binder.key(face, (statement.keyword, fields, own, rate))
    if key not in groups:
        name = "k" + native.digest(repr(key), version_of("compiled"), algebra())
        groups[key] = Group(face, name, _maker(binder, statement, face, fields, own, name, model))
    groups[key].instances.append((statement, binder.instance))


def _maker(
    binder: Binder,
    statement: Statement,
    face: str,
    fields: Tree,
    own: int,
    name: str,
    model: Model,
) -> Callable[[], tuple[str, dict]]:
    """A function that writes the kernels of this shape."""

    def make() -> tuple[str, dict]:
        from adamslite.kernel import Shape, write_kernels

        at = binder.instance
        n_bodies = len(at.bodies)
        widths = [model.body_width(b) for b in at.bodies]
        widths += [model.node_width(n) for n in at.nodes]
        level = LEVELS.index(face) - 1 if face in LEVELS else 0
        level -= level > 0 and statement.is_rate(model)
        outputs = _Writer(binder, statement.keyword, face, fields, own, n_bodies, level)
        shape = Shape(binder.slots, widths, n_bodies, len(at.params), 0, len(at.signals), outputs)
        return write_kernels(shape, name, face in WITH_JACOBIAN, face != "output")

    return make


@dataclass
class _Writer:
    """Writes loads and rows of one face with a scope."""

    binder: Binder
    keyword: str
    face: str
    fields: Tree
    own: int
    n_bodies: int
    level: int

    def __call__(self, scope: Scope) -> Any:
        from adamslite.kernel import Outputs

        scope.read = Reader(scope, self.n_bodies)
        widths = self.binder.model.node_width
        nodes = self.binder.instance.nodes
        for keyword, fields, node in self.binder.elements:
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
            return Outputs(loads=reactions(view, scope))
        if self.face == "equation":
            return Outputs(rows=[(row, 0, view.cls.equation(view, scope))])
        if self.face == "signal":
            return Outputs(
                rows=[(row, n, e) for n, e in enumerate(_rates(scope, view.function, 2))]
            )
        rows = [_rates(scope, e, self.level)[-1] for e in view.cls.constraints(view, scope)]
        numbered = [(row, n, e) for n, e in enumerate(rows)]
        return Outputs(rows=numbered, rates_only=self.face == "acceleration")


def _rates(scope: Scope, expr: Any, order: int) -> list[Any]:
    """An expression and its total time derivatives up to ``order``."""
    found = [expr]
    for _ in range(order):
        found.append(scope.derivative(found[-1]))
    return found


def _compile(group: Group, progress: Any) -> bool:
    """Fetch or make the object code; True when it was made."""
    made: list[tuple[str, dict]] = []

    def text_and_meta() -> tuple[str, dict]:
        if not made:
            if progress is not None and group.face == "loads":
                progress.say(
                    f"compiling the expressions of {group.instances[0][0].label} (kept for later)"
                )
            made.append(group.make())
        return made[0]

    group.meta = recall_json(f"{group.name}.json", lambda: text_and_meta()[1])
    group.code = recall(f"{group.name}.o", lambda: native.object_code(text_and_meta()[0]))
    return bool(made)


def _entry_points(group: Group) -> list[str]:
    names = [f"{group.name}_residual"]
    if group.face in WITH_JACOBIAN:
        names.append(f"{group.name}_jacobian")
    if group.meta["angles"]:
        names.append(f"{group.name}_track")
    names += [f"{group.name}_{kind}" for kind, found in group.meta["guards"].items() if found]
    return names


@cache
def algebra() -> str:
    """Version of sympy, whose transformations shape the text of a kernel; sympy is not imported."""
    place = find_spec("sympy").submodule_search_locations[0]
    return (Path(place) / "release.py").read_text(encoding="utf-8")
