"""The statements of a model by their faces and shapes, bound but not yet compiled.

Results that are made of the same long chains of VARIABLEs share one kernel, which writes all:

    v_1 = f_1(q)     v_2 = f_2(v_1)     ...     v_n = f_n(v_(n-1))

A statement is evaluated with all VARIABLEs that are written out in it.  A kernel for each result
would evaluate v_1 in each of them, n^2 / 2 functions; a kernel of all evaluates n.
"""

from __future__ import annotations

import itertools
from collections.abc import Hashable, Iterable, Iterator
from dataclasses import dataclass, field
from itertools import chain
from typing import TYPE_CHECKING, Any

from adamslite.assembly.start_posture import settle_start
from adamslite.caching.sources import version_of
from adamslite.deck.counted_turns import counted, counting
from adamslite.deck.statement_diagnostics import diagnose, diagnose_inside
from adamslite.elements.bases.constraint import Constraint
from adamslite.gc_pause import without_collection
from adamslite.kernels.binding import Binder, ForceLoop
from adamslite.kernels.columns import MOST_IN_ALL, Split, TooLarge, same, transposed
from adamslite.kernels.face_writer import FaceWriter
from adamslite.kernels.groups import (
    LEVELS,
    Binding,
    Bundle,
    Instances,
    ShapeGroup,
    Writing,
    members_of,
)
from adamslite.language.diagnostics import DeckError, Diagnostic
from adamslite.language.interfaces import Key
from adamslite.language.statement import Statement
from adamslite.language.traced import Traced
from adamslite.model.chains import Joined, long_chains
from adamslite.model.model import Model
from adamslite.native import compiler
from adamslite.symbolic.types import Tree

if TYPE_CHECKING:
    from adamslite.deck.deck import Deck
    from adamslite.language.interfaces import Key
    from adamslite.language.statement import Statement
    from adamslite.model.model import Model

MOST_NAMED = 5

Numbered = tuple[int, Writing]
"""A statement, or some that write together, with its number among groups and instances."""


def bound(model: Model, audited: bool) -> tuple[Groups, list[tuple[Statement, tuple[str, ...]]]]:
    """All statements of a model, those of one shape together, and the values that they write."""
    settle_start(model)
    groups = Groups()
    with without_collection():
        count = itertools.count()
        for variable in model.signals:  # the group of each hangs on those of others
            add(groups, model, "signal", [(next(count), variable)])
        batches: dict[tuple[type[Writing], str], list[Numbered]] = {}
        for each, face in _contributing(model, audited):
            batches.setdefault((type(each), face), []).append((next(count), each))
        for (_, face), found in batches.items():
            add(groups, model, face, found)
    return groups, [(each, each.result_names) for each in _writing(model)]


def refused(model: Model) -> Diagnostic | None:
    """What is wrong with the first statement that depends on itself or is too large."""
    loops = bound(model, audited=False)[0].loops
    return loops[min(loops)] if loops else None


def _contributing(model: Model, audited: bool) -> Iterator[tuple[Writing, str]]:
    """Statements with what they contribute beside signals; bundles where their first one writes."""
    together = bundles(model, _writing(model))
    first = {bundle.members[0]: bundle for bundle in together}
    others = {member for bundle in together for member in bundle.members[1:]}
    for statement in model.deck.statements:
        for face in faces(statement, model):
            if face != "signal":
                yield statement, face
        if audited and hasattr(statement, "stored") and model.acts(statement):
            yield statement, "stored"
        for face in output_face(statement) if statement not in others else ():
            yield first.get(statement, statement), face
    for statement in counting(model.deck.turns, model.deck.statements):
        yield statement, "counted"


def _writing(model: Model) -> list[Statement]:
    """Statements with results."""
    return [each for each in model.deck.statements if [*output_face(each)]]


def bound_again(model: Model, group: ShapeGroup, statements: list[Writing]) -> Binding | None:
    """The columns of a group for other statements of a model; None where the shape is another."""
    groups = Groups()
    add(groups, model, group.face, [*enumerate(statements)])
    found = [*groups.values()]
    if len(found) != 1 or found[0].name != group.name:
        return None
    return found[0].group().instances.columns


@dataclass
class Collected:
    """A group while statements are bound: their numbers in the order of groups, and their columns,
    part by part.
    """

    face: str
    name: str
    write: FaceWriter
    parts: list[tuple[list[Numbered], Binding]]
    settled: list[Traced] = field(default_factory=list)
    deriving: list[Statement] = field(default_factory=list)
    """As in :class:`adamslite.kernels.binding.Binder`."""

    @property
    def first(self) -> int:
        """The least number."""
        return min(part[0][0] for part, _ in self.parts)

    def columns(self) -> tuple[list[Writing], Binding]:
        """The statements in order, and what fills the slots."""
        numbered = [each for part, _ in self.parts for each in part]
        order = sorted(range(len(numbered)), key=lambda k: numbered[k][0])
        columns = Binding(*(
            [in_order([*chain(*parts)], order) for parts in zip(*slots, strict=True)]
            for slots in zip(*(found.fields() for _, found in self.parts), strict=True)
        ))  # fmt: skip
        return [numbered[k][1] for k in order], columns

    def group(self) -> ShapeGroup:
        """The group, its instances in order."""
        return ShapeGroup(self.face, self.name, self.write, Instances(*self.columns()))


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
        """Forces that depend on themselves or are too large, by the number of the statement."""
        self.size = 0
        """Operations of all shapes."""

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
        return [each.group() for each in self.in_order()]

    def in_order(self) -> list[Collected]:
        """The groups in the order of their first statements."""
        return sorted(self.values(), key=lambda each: each.first)


def add(groups: Groups, model: Model, face: str, statements: list[Numbered]) -> None:
    """Bind one face of statements of one class, those of one shape together."""
    pending = [statements]
    while pending:
        part = pending.pop()
        if not part:
            continue
        try:
            _bind(groups, model, face, part)
        except Split as split:
            parts: dict[Hashable, list[Numbered]] = {}
            for label, each in zip(split.labels, part, strict=True):
                parts.setdefault(label, []).append(each)
            pending += parts.values()
        except (ForceLoop, TooLarge) as fault:
            number, statement = part[0]
            if isinstance(statement, Bundle) and groups.size <= MOST_IN_ALL:
                before, behind = statement.parted(fault.number)
                pending += [part[1:], [(number, behind)], [(number, before)]]
                continue
            groups.loops[number] = _refused(members_of(statement)[0], fault)
            if isinstance(fault, TooLarge):
                return


def _bind(groups: Groups, model: Model, face: str, numbered: list[Numbered]) -> None:
    """Enter statements of one shape; raises :class:`Split` where they are not."""
    members = [members_of(each) for _, each in numbered]
    binder, statements = Binder(model, len(members)), [each[0] for each in members]
    fields, own, statement = *_faced(binder, members, face), statements[0]
    groups.size += binder.size
    if groups.size > MOST_IN_ALL:
        raise binder.too_large(MOST_IN_ALL)
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
    found.settled += binder.settled
    found.deriving += binder.deriving
    binder.deriving = []
    binder.columns = binder.columns.row(slice(1))


def _faced(binder: Binder, members: list[tuple[Statement, ...]], face: str) -> tuple[Tree, int]:
    """What a face is made of, and the slot of its own unknowns."""
    if face == "output":
        return tuple(_results(binder, members)), -1
    statements = [each[0] for each in members]
    if face == "counted":
        found = transposed([counted(each) for each in statements])
        return tuple([binder.expression(nodes) for nodes in found]), -1
    fields = binder.statement(statements)
    if face == "since start":
        return fields, -1
    if face in ("signal", "stored", "sensor"):
        return fields, binder.node_slot([(face.upper(), each.key) for each in statements])
    return fields, binder.unknowns(statements)


def _results(binder: Binder, members: list[tuple[Statement, ...]]) -> Iterator[tuple[int, Tree]]:
    """What each member writes; what is wrong with one of them knows its number."""
    for number, column in enumerate(transposed(members)):
        try:
            yield _written(binder, column)
        except (ForceLoop, TooLarge) as fault:
            fault.number = number
            raise


def _written(binder: Binder, statements: list[Statement]) -> tuple[int, Tree]:
    """The slot of the rows that statements write, and the values."""
    found = transposed([binder.model.outputs_of(each) for each in statements])
    values = tuple([binder.output(nodes, statements) for nodes in found])
    return binder.node_slot([("OUTPUT", each) for each in statements]), values


def _refused(statement: Statement, fault: ForceLoop | TooLarge) -> Diagnostic:
    """What there is to say of a force that depends on itself, and of a statement whose expressions
    grow when VARIABLEs are written out.
    """
    if isinstance(fault, ForceLoop):
        return diagnose_inside(statement, str(fault), "force-loop", other=str(fault))
    return _too_large(statement, fault)


def _too_large(statement: Statement, large: TooLarge) -> Diagnostic:
    code = "deck-too-large" if large.most == MOST_IN_ALL else "expression-too-large"
    named = [f"VARIABLE/{each}" for each in dict.fromkeys(large.variables)]
    few = ", ".join(named[:MOST_NAMED]) + ", ..." * (len(named) > MOST_NAMED)
    hint = f"written out in it: {few}" if named else ""
    return diagnose(statement, code, hint=hint, most=large.most)


def bundles(model: Model, writing: Iterable[Statement]) -> list[Bundle]:
    """Those of the statements that share a VARIABLE that is made of more than a few others."""
    others = {key for key in model.uses if model.variable_kind(key) != "inline"}
    long = long_chains(model.uses, others)
    if not long:
        return []
    joined = Joined()
    for key in long:
        joined.join(key, *(long & model.uses[key]))
    of_chains: dict[Key, list[Statement]] = {}
    for statement in writing:
        found = [key for key in _taken(model, statement) if key in long]
        if found:
            joined.join(*found)
            of_chains.setdefault(found[0], []).append(statement)
    together: dict[Key, list[Statement]] = {}
    for key, statements in of_chains.items():
        together.setdefault(joined.name(key), []).extend(statements)
    return [Bundle(tuple(each)) for each in together.values() if len(each) > 1]


def _taken(model: Model, statement: Statement) -> Iterator[Key]:
    """The VARIABLEs that the results of a statement take the values of."""
    if model.acts(statement):
        for node in model.outputs_of(statement):
            yield from model.used_in(node)


def faces(statement: Statement, model: Model) -> Iterator[str]:
    """What a statement contributes; switched off, it still counts turns for when it is on again."""
    if not model.acts(statement):
        if counted(statement):
            yield "counted"
        if isinstance(statement, Constraint) and statement.counts_from_start:
            yield "since start"
        return
    if model.merges(statement):
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


def output_face(statement: Statement) -> Iterator[str]:
    """The values that it writes, if there are any."""
    if statement.result_names:
        yield "output"
