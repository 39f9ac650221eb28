"""Numbers whose way into the arrays of a model is known: their derivatives without setting it up.

What a load or a value that is written takes of the text are parameters of kernels with recipes
(:mod:`adamslite.variation.kernels`), which are differentiated; a body that nothing holds is made
anew by its statement.  What else a number does, to markers, joints or an assembled start, is found
by setting the model up with other values of it (:mod:`adamslite.sensitivity.directions`).
"""

from __future__ import annotations

import math
import operator
from collections.abc import Callable, Mapping
from functools import cached_property
from itertools import groupby
from operator import itemgetter
from typing import TYPE_CHECKING, Any, cast

import numpy as np

from adamslite.kernels.groups import LEVELS
from adamslite.language.diagnostics import DeckError
from adamslite.language.traced import WRITTEN, Recipe, Traced, again, places
from adamslite.model.model import PART
from adamslite.sensitivity.directions import SHARE, STENCIL, Direction, slope_around, turns
from adamslite.variation.decks import variable_of
from adamslite.variation.kernels import Refill, of_deck

if TYPE_CHECKING:
    from adamslite.elements.part import Part
    from adamslite.equations.system import System
    from adamslite.kernels.groups import Kernels
    from adamslite.reading.numbers import Named

#: Statements that numbers change through reals of kernels alone.
FORCES = frozenset(
    "SFORCE VFORCE VTORQUE GFORCE SPRINGDAMPER BUSHING VARIABLE REQUEST FIELD NFORCE".split()
)
#: Statements whose numbers decide how a run goes, not what the model is.
RUNNING = frozenset("SIMULATE INTEGRATOR OUTPUT RESULTS EQUILIBRIUM KINEMATICS SENSOR".split())


def slope(recipe: Any, written: Mapping[int, float], at: int) -> float:
    """The derivative of a recipe by the number at a place of the text."""
    if type(recipe) is not tuple or at not in places(recipe):
        return 0.0
    if recipe[0] == WRITTEN:
        return 1.0
    values = [again(each, written) if type(each) is tuple else each for each in recipe[1:]]
    return RULES[recipe[0]](values, [slope(each, written, at) for each in recipe[1:]])


def by_value(recipe: Any, written: Mapping[int, float], number: Named) -> float:
    """The same by the value of a number, which is what its digits mean."""
    if recipe == (WRITTEN, number.at):
        return number.digits(1.0)
    return number.digits(1.0) * slope(recipe, written, number.at)


def _powered(v: list[float], d: list[float]) -> float:
    found = v[1] * math.pow(v[0], v[1] - 1.0) * d[0] if d[0] else 0.0
    return found + (math.pow(v[0], v[1]) * math.log(v[0]) * d[1] if d[1] else 0.0)


#: By operation: the derivative of values ``v`` with derivatives ``d``.
RULES: dict[Any, Callable[[list[float], list[float]], float]] = {
    operator.neg: lambda v, d: -d[0],
    operator.add: lambda v, d: d[0] + d[1],
    operator.sub: lambda v, d: d[0] - d[1],
    operator.mul: lambda v, d: d[0] * v[1] + v[0] * d[1],
    operator.truediv: lambda v, d: (d[0] - v[0] / v[1] * d[1]) / v[1],
    math.pow: _powered,
}


class Known:
    """The numbers of a deck whose way into the arrays of its kernels is known."""

    def __init__(self, kernels: Kernels) -> None:
        self.kernels, deck = kernels, kernels.model.deck
        self.variable = variable_of(deck.base or deck)
        if kernels.refill is None:
            kernels.refill = Refill(kernels, self.variable)
        self.refill: Refill = kernels.refill
        named = (self.variable.numbers.named[name.upper()] for name in deck.values)
        given = {each.at: each.digits(deck.values[each.name]) for each in named}
        self.written = {**self.variable.written, **given}
        self.settled = set().union(*(places(recipe) for _, recipe in self.refill.settled))
        held = [group for group in kernels.groups if group.face in LEVELS]
        self.clocked = any(group.instances.columns.signals for group in held)
        self.tied = {
            int(body) for group in held for each in group.instances.columns.bodies for body in each
        }

    def verify(self, named: list[Named]) -> None:
        """Compare recipes of numbers with the long way, once, all together."""
        fresh = [each for each in named if self._is_plain(each)]
        fresh = [each for each in fresh if each.name not in self.refill.verified]
        values = {each.name: (1.0 + SHARE) * each.value for each in fresh}
        if not values:
            return
        deck = self.kernels.model.deck
        try:
            of_deck(self.kernels, deck.with_values({**deck.values, **values}))
        except DeckError:
            return

    def all(self) -> list[Named]:
        """Every number on which equations may hang."""
        named = self.variable.numbers.named.values()
        return [
            each for each in named
            if each.value != 0.0 and each.statement.keyword not in RUNNING
            and each.at in self.variable.fields and each.at not in self.settled
            and self.variable.is_quick({each.name: each.value})
        ]  # fmt: skip

    def is_known(self, each: Named) -> bool:
        """Whether the way of a number is known, at least where a run starts as it is drawn."""
        return self.is_direct(each) or (each.value != 0.0 and self.is_of_body(each, True))

    def is_direct(self, each: Named) -> bool:
        """Whether a number is known to change reals of loads and of what is written alone."""
        return each.name in self.refill.verified and self._is_plain(each)

    def _is_plain(self, each: Named) -> bool:
        start = each.argument.start or "IC" in each.argument.keys
        if not self.refill.usable or each.at in self.settled or start:
            return False
        own, fields = self.variable.numbers.deck.own, self.variable.fields.get(each.at, [])
        columns = self.refill.columns.get(each.at, set())
        touched = {self.kernels.groups[k].face for k, _ in columns}
        if not {own[n].keyword for n, _ in fields} <= FORCES or touched & {*LEVELS} or not columns:
            return False
        if "signal" in touched and self.clocked:
            return False
        return not any(k in self.refill.deriving for k, _ in columns)

    def is_of_body(self, each: Named, as_drawn: bool) -> bool:
        """Whether a number changes nothing but one body, where constraints have moved nothing at
        the start (``as_drawn``), or hold nothing.
        """
        model, own = self.kernels.model, each.statement
        fields = self.variable.fields.get(each.at, [])
        if own.keyword not in ("PART", "POINT_MASS") or len(fields) != 1:
            return False
        if any((own.keyword, own.key) in each for each in self.refill.deriving.values()):
            return False
        if self.refill.columns.get(each.at) or not self.refill.usable or self.along_others:
            return False
        heavy, body = fields[0][1] in ("mass", "ip"), model.body_index.get((own.keyword, own.key))
        return body is not None and (
            not self.tied or (as_drawn and (heavy or body not in self.tied))
        )

    @cached_property
    def along_others(self) -> bool:
        """Whether speeds are given along axes of other bodies."""
        bodies = self.kernels.model.bodies
        return any(getattr(body.statement, f, None) for body in bodies for f in ("vm", "wm"))

    @cached_property
    def uses(self) -> dict[int, list[tuple[int, int, int, Recipe]]]:
        """By the place of a number: groups, parameters, instances and recipes with it."""
        found: dict[int, list[tuple[int, int, int, Recipe]]] = {}
        for (k, n), entries in self.refill.entries.items():
            for row, recipe in entries:
                for at in places(recipe):
                    found.setdefault(at, []).append((k, n, row, recipe))
        return found

    def load(self, system: System, number: Named, h: float) -> Direction:
        """The derivatives of the arrays by a number of a load, which changes by ``h``."""
        found, uses = _nothing(system, h), sorted(self.uses[number.at], key=itemgetter(0))
        for k, entries in groupby(uses, itemgetter(0)):
            own, group = [*entries], system.kernels.groups[k]
            rows, count = [row for _, _, row, _ in own], len(group.instances)
            whole = group.face == "signal"
            first, last = (0, count - 1) if whole else (min(rows), max(rows))
            reals = system.instances.keep[2 * k + 1].size - 1
            into = np.zeros((last - first + 1, reals // count))
            for _, n, row, recipe in own:
                into[row - first, n] = by_value(recipe, self.written, number)
            found.pieces.append((k, first, len(into), np.append(into.ravel(), 0.0)))
        return found

    def body(self, system: System, number: Named, h: float) -> Direction:
        """The same by a number of a body, from bodies made of values ``h`` apart."""
        own, model, found = number.statement, self.kernels.model, _nothing(system, h)
        (at, name), *_ = self.variable.fields[number.at]
        b = model.body_index[own.keyword, own.key]
        value = getattr(self.variable.numbers.deck.own[at], name)
        if name == "mass" and own.keyword == "POINT_MASS" and type(value) is Traced:
            found.mass[b] = by_value(value.recipe, self.written, number) / model.deck.ucf
            return found
        bodies = {
            k: model.body_of(cast("Part", self.variable.statements({number.name: value})[at]))
            for k, value in ((k, number.value + k * h) for k in STENCIL)
        }

        def rate(name: str) -> Any:
            return slope_around({k: getattr(each, name) for k, each in bodies.items()}, h)

        i, n = system.starts[b], system.n
        found.mass[b], found.start[i : i + 3] = rate("mass"), rate("x")
        found.start[n + i : n + i + 3] = rate("v")
        if bodies[1].width == PART:
            found.inertia[9 * b : 9 * b + 9] = np.ravel(rate("inertia"))
            attitude = 0.5 * (bodies[1].attitude + bodies[-1].attitude)
            found.start[i + 3 : i + 6] = turns(rate("attitude") @ attitude.T)
            found.start[n + i + 3 : n + i + 6] = rate("w")
        return found


def _nothing(system: System, h: float) -> Direction:
    """A direction in which nothing changes."""
    return Direction(
        np.zeros(system.mass.size), np.zeros(system.inertia.size), np.zeros(3),
        np.zeros(2 * system.n + system.ns), h / SHARE,
    )  # fmt: skip
