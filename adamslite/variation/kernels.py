"""Kernels with other numbers: parameters are put in again, nothing is bound or compiled.

Binding the traced numbers of a deck (:mod:`adamslite.language.traced`) shows which parameters of
which instances each number is in, and by which operations; what statements derive is bound again
where it may have changed.  A number that has become part of a shape (a zero, an exponent, a
constant of a call) may not change.  Where one does, and where bodies or markers become of another
kind, kernels are made the long way, with the same result.  Each name is compared with that when it
is first used.
"""

from __future__ import annotations

from array import array
from collections.abc import Iterable, Iterator, Mapping
from copy import copy
from dataclasses import dataclass, field, replace
from math import isfinite
from operator import is_not
from typing import Any

from adamslite.assembly.start_posture import settle_start
from adamslite.deck.deck import Deck
from adamslite.elements.bases.constraint import Constraint
from adamslite.elements.part import Part
from adamslite.elements.point_mass import PointMass
from adamslite.gc_pause import without_collection
from adamslite.kernels.collecting import bound, bound_again
from adamslite.kernels.compile import compile_model
from adamslite.kernels.groups import Binding, Instances, Kernels, replaced
from adamslite.language.diagnostics import DeckError
from adamslite.language.expression import Ref, walk
from adamslite.language.statement import Statement
from adamslite.language.traced import Recipe, Traced, again, places
from adamslite.model.merging import merged
from adamslite.model.model import PART, Model, assemble
from adamslite.reading.numbers import Given
from adamslite.variation.decks import Variable, is_quick, variable_of
from adamslite.variation.decks import with_values as varied

#: Statements on which every place and attitude may depend.
GEOMETRY = ("PART", "POINT_MASS", "MARKER", "UNITS")
Own = tuple[str, Any]
"""Keyword and id of a statement."""
Column = tuple[int, int]
"""Number of a group, and of a parameter in it."""


@dataclass
class Refill:
    """Kernels, and where their numbers come from.

    Attributes
    ----------
    entries : dict
        Of each column with traced numbers, their rows and recipes.
    columns : dict
        The columns that a number of the text is in, by its place.
    settled : list of (float, Recipe)
        Numbers that have become part of shapes.
    deriving : dict
        By the number of a group, the statements on which what it derives depends.
    usable : bool
        Whether traced numbers are bound to the same shapes.
    """

    kernels: Kernels
    variable: Variable
    merging: bool = False
    entries: dict[Column, list[tuple[int, Recipe]]] = field(default_factory=dict)
    columns: dict[int, set[Column]] = field(default_factory=dict)
    settled: list[tuple[float, Recipe]] = field(default_factory=list)
    deriving: dict[int, set[Own]] = field(default_factory=dict)
    usable: bool = False
    verified: set[str] = field(default_factory=set)
    slow: set[str] = field(default_factory=set)

    def __post_init__(self) -> None:
        model, deck = self.kernels.model, self.variable.numbers.deck
        if model.merges_parts or model.deck.delays or not self.variable.alike or model.deck.base:
            return
        try:
            groups, _ = bound(Model(deck, model.without), self.kernels.audited)
            collected = groups.in_order()
        except DeckError:
            return
        if [each.name for each in collected] != [each.name for each in self.kernels.groups]:
            return
        self.usable = True
        for k, each in enumerate(collected):
            self._enter(k, each.columns()[1].params)
            self.settled += [(float(value), value.recipe) for value in each.settled]
            if each.deriving:
                self.deriving[k] = _influences(model, each.deriving)

    def _enter(self, k: int, params: list[Any]) -> None:
        """The recipes of one group."""
        for n, column in enumerate(params):
            found = [(row, v.recipe) for row, v in enumerate(column) if type(v) is Traced]
            plain = self.kernels.groups[k].instances.columns.params[n]
            self.usable &= [*map(float, column)] == [*plain]
            if found:
                self.entries[k, n] = found
            for at in set().union(*(places(recipe) for _, recipe in found)):
                self.columns.setdefault(at, set()).add((k, n))

    # ---- other numbers ------------------------------------------------------------------------

    def filled(self, deck: Deck) -> Kernels | None:
        """The kernels of a deck with other numbers; None where its shapes are others."""
        old = self.kernels.model
        if not self.usable or len(deck.statements) != len(old.deck.statements):
            return None
        pairs = zip(old.deck.statements, deck.statements, strict=True)
        changed = {id(a): b for a, b in pairs if a is not b}
        owns = {(each.keyword, each.key) for each in changed.values()}
        moved = any(keyword in GEOMETRY for keyword, _ in owns)
        model = _in_place(old, deck, changed)
        if moved and not _moved(model, changed.values()):
            model = Model(deck, old.without)
        settle_start(model)
        if self.merging and merged(model) is not model:
            return None
        if not _alike(old, model) or (moved and not _placed_alike(old, model)):
            return None
        params = self._params(deck)
        if params is None:
            return None
        groups = []
        for k, group in enumerate(self.kernels.groups):
            before = group.instances.writing
            writing = [replaced(each, changed) for each in before]
            columns: Binding | None = group.instances.columns
            if k in self.deriving and (moved or not owns.isdisjoint(self.deriving[k])):
                columns = bound_again(model, group, writing)
            elif k in params or any(map(is_not, writing, before)):
                columns = _with(group.instances.columns, params.get(k, {}), changed)
            if columns is None:
                return None
            instances = group.instances.but(writing, columns)
            groups.append(replace(group, instances=instances))
        outputs = [(changed.get(id(each), each), names) for each, names in self.kernels.outputs]
        return replace(self.kernels, model=model, groups=groups, outputs=outputs, compiled=0)

    def _params(self, deck: Deck) -> dict[int, dict[int, array[float]]] | None:
        """New columns of parameters, by group and number; None where a shape would be another."""
        numbers = self.variable.numbers
        named = [numbers.named[name.upper()] for name in deck.values]
        new = {each.at: each.digits(deck.values[each.name]) for each in named}
        written = {**self.variable.written, **new}
        found: dict[int, dict[int, array[float]]] = {}
        known: dict[int, float] = {}

        def value(recipe: Recipe) -> float:
            if id(recipe) not in known:
                known[id(recipe)] = again(recipe, written)
            return known[id(recipe)]

        try:
            if any(value(recipe) != before for before, recipe in self.settled):
                return None
            for k, n in set().union(*(self.columns.get(at, ()) for at in new)):
                column = self.kernels.groups[k].instances.columns.params[n][:]
                for row, recipe in self.entries[k, n]:
                    column[row] = value(recipe)
                    if column[row] == 0.0 or not isfinite(column[row]):
                        return None
                found.setdefault(k, {})[n] = column
        except (ArithmeticError, ValueError):
            return None
        return found


def with_values(kernels: Kernels, values: Given) -> Kernels:
    """Kernels of the deck with other numbers; errors as for a deck."""
    with without_collection():
        return of_deck(kernels, varied(kernels.model.deck, values))


def of_deck(kernels: Kernels, deck: Deck, merging: bool = False) -> Kernels:
    """Kernels of a deck that has other numbers than that of ``kernels``.

    ``merging``: parts that are held together are made one body, where ``kernels`` have none.
    """
    if kernels.refill is None:
        base = kernels.model.deck.base or kernels.model.deck
        kernels.refill = Refill(kernels, variable_of(base), merging)
    refill: Refill = kernels.refill
    if not (is_quick(deck) and refill.slow.isdisjoint(deck.values)):
        return _compiled(refill, deck)
    filled = refill.filled(deck)
    fresh = refill.variable.numbers.others(deck.values) - refill.verified
    if filled is not None and not fresh:
        return filled
    found = _compiled(refill, deck)
    if filled is not None:
        (refill.verified if _same(filled, found) else refill.slow).update(fresh)
    return found


def _compiled(refill: Refill, deck: Deck) -> Kernels:
    """The kernels of a deck the long way."""
    old = refill.kernels.model
    model = assemble(deck, old.without)
    model = merged(model) if refill.merging or old.merges_parts else model
    made = compile_model(model, audited=refill.kernels.audited)
    names = ([group.name for group in each.groups] for each in (made, refill.kernels))
    if refill.usable and next(names) == next(names):
        made.refill = refill
    return made


def _with(
    columns: Binding, params: Mapping[int, array[float]], changed: Mapping[int, Statement]
) -> Binding:
    """Columns with other parameters, and with statements that changed."""
    nodes = [_renewed(column, changed) for column in columns.nodes]
    found = [params.get(n, column) for n, column in enumerate(columns.params)]
    return replace(columns, params=found, nodes=nodes)


def _renewed(nodes: Any, changed: Mapping[int, Statement]) -> Any:
    """Nodes of outputs name the statement that writes."""
    if nodes[0][0] != "OUTPUT":
        return nodes
    return [(kind, changed.get(id(each), each)) for kind, each in nodes]


def _influences(model: Model, statements: Iterable[Statement]) -> set[Own]:
    """Statements, those that they refer to, and so on."""
    found: set[Own] = set()
    pending = [*statements]
    while pending:
        each = pending.pop()
        if (each.keyword, each.key) in found:
            continue
        found.add((each.keyword, each.key))
        for own in _referred(each):
            other = model.deck.find(*own)
            pending += [other] if other is not None else []
    return found


def _referred(statement: Statement) -> Iterator[Own]:
    """Keywords and ids that a statement refers to."""
    for name, argument in statement.arguments.items():
        value = getattr(statement, name)
        if value is None:
            continue
        if argument.kind == "reference":
            yield argument.to, value
        elif argument.kind == "references":
            yield from ((argument.to, each) for each in value)
        elif argument.kind == "expression":
            yield from ((each.kind, each.id) for each in walk(value) if type(each) is Ref)


def _in_place(old: Model, deck: Deck, changed: Mapping[int, Statement]) -> Model:
    """The model of a deck in which no body and no marker has changed."""
    made = copy(old)
    made.deck, made.known, made.folded, made.start = deck, {}, {}, None
    found = (changed.get(id(each), each) for each in old.constraints)
    made.constraints = [each for each in found if isinstance(each, Constraint)]
    vars(made).pop("signals", None)
    return made


def _moved(model: Model, changed: Iterable[Statement]) -> bool:
    """Give bodies of a model that stands in place their new numbers; False where markers move too,
    or speeds are given along those of other bodies.

    A marker on a part stands where it did in the axes of the part; on a point mass it turns.
    """
    found = [each for each in changed if each.keyword in GEOMETRY]
    at = [model.body_index.get((each.keyword, each.key), -1) for each in found]
    along = any(getattr(each.statement, f, None) for each in model.bodies for f in ("vm", "wm"))
    if along or min(at, default=0) < 0:
        return False
    model.bodies, model.of_bodies = [*model.bodies], {}
    for number, each in zip(at, found, strict=True):
        assert isinstance(each, Part | PointMass)
        model.bodies[number] = model.body_of(each)
    turned = {number for number in at if model.body_width(number) != PART}
    places = model.places.items()
    model.places = {key: each for key, each in places if each is None or each.body not in turned}
    return True


def _alike(one: Model, other: Model) -> bool:
    """Whether bodies and constraints are the same ones in the same order."""
    bodies = ([(b.statement.label, b.width) for b in model.bodies] for model in (one, other))
    rows = ([(c.keyword, c.key, c.n_rows) for c in model.constraints] for model in (one, other))
    return [*next(bodies)] == [*next(bodies)] and [*next(rows)] == [*next(rows)]


def _placed_alike(one: Model, other: Model) -> bool:
    """Whether every marker that is used is offset and turned as it was."""
    pairs = ((place, other.marker(marker)) for marker, place in one.places.items())
    return all(here is there or _kind(here) == _kind(there) for here, there in pairs)


def _kind(place: Any) -> Any:
    return place and (place.kind, place.body, place.offset, place.turned)


def _same(one: Kernels, other: Kernels) -> bool:
    """Whether two have the same shapes and numbers."""
    return len(one.groups) == len(other.groups) and all(
        a.name == b.name and _equal(a.instances, b.instances)
        for a, b in zip(one.groups, other.groups, strict=True)
    )


def _equal(one: Instances, other: Instances) -> bool:
    """Whether instances have the same numbers, markers and tables."""
    a, b = one.columns, other.columns
    return all(
        [*map(_in_bytes, one)] == [*map(_in_bytes, other)]
        for one, other in ((a.params, b.params), (a.markers, b.markers), (a.tables, b.tables))
    )


def _in_bytes(column: Any) -> object:
    """A column as it can be compared: not-a-number is itself, and zeros have signs."""
    if isinstance(column, array):
        return column.tobytes()
    return [each.data.tobytes() if hasattr(each, "data") else each for each in column]
