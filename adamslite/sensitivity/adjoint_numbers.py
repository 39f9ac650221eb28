"""From numbers of the equations to numbers of a deck.

Reals of kernels are known functions of the numbers of the text
(:mod:`adamslite.variation.kernels`): recipes are differentiated, and of bodies that nothing holds
their statements.  What else a number does, to markers, joints or an assembled start, is found by
setting the model up with other values of it (:mod:`adamslite.sensitivity.directions`).
"""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING, cast

import numpy as np

from adamslite.kernels.groups import LEVELS
from adamslite.language.diagnostics import DeckError
from adamslite.language.traced import Recipe, Traced, places
from adamslite.model.model import PART
from adamslite.sensitivity.adjoint_sweep import Derivatives
from adamslite.sensitivity.directions import SHARE, Snapshot
from adamslite.sensitivity.recipes import by_value, written_in
from adamslite.variation.decks import variable_of
from adamslite.variation.kernels import Refill, of_deck

if TYPE_CHECKING:
    from adamslite.elements.part import Part
    from adamslite.equations.system import System
    from adamslite.reading.numbers import Named
    from adamslite.sensitivity.study import Study

#: Statements that numbers change through reals of kernels alone.
FORCES = frozenset(
    "SFORCE VFORCE VTORQUE GFORCE SPRINGDAMPER BUSHING VARIABLE REQUEST FIELD NFORCE".split()
)
#: Statements whose numbers decide how a run goes, not what the model is.
RUNNING = frozenset("SIMULATE INTEGRATOR OUTPUT RESULTS EQUILIBRIUM KINEMATICS SENSOR".split())
#: Weights of the values of the stencil.
AROUND = {1: 8.0, -1: -8.0, 2: -1.0, -2: 1.0}


class Chain:
    """The way from numbers of a deck to those of the equations of its kernels."""

    def __init__(self, study: Study) -> None:
        self.study, self.kernels = study, study.kernels
        deck = self.kernels.model.deck
        self.variable = variable_of(deck.base or deck)
        if self.kernels.refill is None:
            self.kernels.refill = Refill(self.kernels, self.variable)
        self.refill: Refill = self.kernels.refill
        self.written = written_in(deck)
        self.settled = set().union(*(places(recipe) for _, recipe in self.refill.settled))
        self.faces = [group.face for group in self.kernels.groups]
        self.clocked = any(
            group.face in LEVELS and group.instances.columns.signals
            for group in self.kernels.groups
        )
        self.base: Snapshot | None = None

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

    def is_direct(self, each: Named) -> bool:
        """Whether a number is known to change reals of loads and of what is written alone."""
        return each.name in self.refill.verified and self._is_plain(each)

    def _is_plain(self, each: Named) -> bool:
        if not self.refill.usable or each.at in self.settled or self._starts(each):
            return False
        own, fields = self.variable.numbers.deck.own, self.variable.fields.get(each.at, [])
        columns = self.refill.columns.get(each.at, set())
        touched = {self.faces[k] for k, _ in columns}
        if not {own[n].keyword for n, _ in fields} <= FORCES or touched & {*LEVELS} or not columns:
            return False
        if "signal" in touched and self.clocked:
            return False
        return not any(k in self.refill.deriving for k, _ in columns)

    def _starts(self, each: Named) -> bool:
        """Whether it is an initial condition."""
        return each.argument.start or "IC" in each.argument.keys

    def along(
        self,
        system: System,
        as_drawn: bool,
        settled: bool,
        derivatives: Derivatives,
        named: list[Named],
    ) -> np.ndarray:
        """The derivatives by numbers of the deck; ``as_drawn``: constraints have moved nothing at
        the start, ``settled``: another analysis has led to it, so that any number may move it.
        """
        self.system, self.free = system, system.m == 0 or as_drawn
        if settled:
            return np.array([self._around(derivatives, each) for each in named])
        return np.array([self._along(derivatives, each) for each in named])

    def _along(self, derivatives: Derivatives, each: Named) -> float:
        if self.is_direct(each):
            return self._direct(derivatives, each)
        body = self._body_of(each)
        if body >= 0:
            return self._of_body(derivatives, each, body)
        return self._around(derivatives, each)

    def _direct(self, derivatives: Derivatives, each: Named) -> float:
        total = 0.0
        for k, n, row, recipe in self.uses[each.at]:
            factor = by_value(recipe, self.written, each)
            total += factor * derivatives.numbers.reals[k][row, n]
        return total

    @cached_property
    def uses(self) -> dict[int, list[tuple[int, int, int, Recipe]]]:
        """By the place of a number: groups, parameters, instances and recipes with it."""
        found: dict[int, list[tuple[int, int, int, Recipe]]] = {}
        for (k, n), entries in self.refill.entries.items():
            for row, recipe in entries:
                for at in places(recipe):
                    found.setdefault(at, []).append((k, n, row, recipe))
        return found

    def _body_of(self, each: Named) -> int:
        """The body that a number belongs to, if it changes nothing else, else -1."""
        model, own = self.system.model, each.statement
        fields = self.variable.fields[each.at]
        if own.keyword not in ("PART", "POINT_MASS") or len(fields) != 1:
            return -1
        if any((own.keyword, own.key) in each for each in self.refill.deriving.values()):
            return -1
        found = int(model.body_index.get((own.keyword, own.key), -1))
        if self.system.m and not (self.free and fields[0][1] in ("mass", "ip")):
            found = -1 if found in self.tied or not self.free else found
        if self.along_others or self.refill.columns.get(each.at) or not self.refill.usable:
            return -1
        return found

    @cached_property
    def tied(self) -> set[int]:
        """Bodies that constraints touch."""
        return {
            int(body)
            for group in self.kernels.groups
            if group.face in LEVELS
            for column in group.instances.columns.bodies
            for body in column
        }

    @cached_property
    def along_others(self) -> bool:
        """Whether speeds are given along axes of other bodies."""
        bodies = self.system.model.bodies
        return any(getattr(body.statement, f, None) for body in bodies for f in ("vm", "wm"))

    def _of_body(self, derivatives: Derivatives, each: Named, b: int) -> float:
        """By making one body with other values."""
        h, total, system = self.study.step(each), 0.0, self.system
        i, n, model = system.starts[b], system.n, system.model
        (number, name), *_ = self.variable.fields[each.at]
        own = self.variable.numbers.deck.own[number]
        value = getattr(own, name)
        if name == "mass" and own.keyword == "POINT_MASS" and type(value) is Traced:
            factor = by_value(value.recipe, self.written, each)
            return float(factor * derivatives.numbers.mass[b] / model.deck.ucf)
        here = model.body_of(cast("Part", self.variable.deck.own[number]))
        for share, weight in AROUND.items():
            changed = self.variable.statements({each.name: each.value + share * h})
            there = model.body_of(cast("Part", changed[number]))
            part = derivatives.numbers.mass[b] * (there.mass - here.mass)
            part += (derivatives.start[i : i + 3] * (there.x - here.x)).sum()
            part += (derivatives.start[n + i : n + i + 3] * (there.v - here.v)).sum()
            if here.width == PART:
                turns = slice(i + 3, i + 6)
                part += (derivatives.numbers.inertia[b] * (there.inertia - here.inertia)).sum()
                part += (derivatives.start[n + i + 3 : n + i + 6] * (there.w - here.w)).sum()
                part += derivatives.start[turns] @ _turn(here.attitude, there.attitude)
            total += weight * float(part)
        return total / (12.0 * h)

    def _around(self, derivatives: Derivatives, each: Named) -> float:
        """By setting the model up with other values."""
        if self.base is None:
            self.base = self.study.snapshot(self.study.kernels)[1]
        found = self.study.direction(self.system, self.base, each)
        numbers = derivatives.numbers
        total = float(derivatives.start @ found.start)
        total += float(numbers.mass @ found.mass + numbers.gravity @ found.gravity)
        total += float(numbers.inertia.ravel() @ found.inertia)
        for k, first, count, reals in found.pieces:
            weights = numbers.reals[k][first : first + count].ravel()
            total += float(weights @ reals[: weights.size])
        return total


def _turn(here: np.ndarray, there: np.ndarray) -> np.ndarray:
    """The small rotation from one attitude to another, in ground axes."""
    turn = there @ here.T
    return 0.5 * np.array(
        [turn[2, 1] - turn[1, 2], turn[0, 2] - turn[2, 0], turn[1, 0] - turn[0, 1]]
    )
