"""Numbers whose way into the arrays of a model is known: their derivatives without setting it up.

What a load or a value that is written takes of the text are parameters of kernels with recipes
(:mod:`adamslite.variation.kernels`), which are differentiated; of the mass of a body its statement
is made anew.  Neither moves the start, unless something assembles it.
"""

from __future__ import annotations

import math
import operator
from collections.abc import Callable, Iterator, Mapping
from typing import TYPE_CHECKING, Any, cast

import numpy as np

from adamslite.language.traced import WRITTEN, again, places
from adamslite.sensitivity.directions import SHARE, STENCIL, Direction, Piece, slope_around
from adamslite.variation.decks import variable_of

if TYPE_CHECKING:
    from adamslite.deck.deck import Deck
    from adamslite.elements.part import Part
    from adamslite.equations.system import System
    from adamslite.kernels.groups import Kernels
    from adamslite.reading.numbers import Named
    from adamslite.variation.kernels import Refill

#: Statements whose numbers do not move the start.
LOADS = frozenset("SFORCE VFORCE VTORQUE GFORCE SPRINGDAMPER BUSHING FIELD REQUEST".split())
#: What kernels of these faces take is in no equation that the start fulfils.
AFTERWARDS = {"loads", "output"}


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


def written_in(deck: Deck) -> dict[int, float]:
    """By their places in the text: the values of all numbers of a deck, as digits."""
    variable = variable_of(deck.base or deck)
    named = (variable.numbers.named[name.upper()] for name in deck.values)
    given = {each.at: each.digits(deck.values[each.name]) for each in named}
    return {**variable.written, **given}


def alone(deck: Deck) -> set[str]:
    """Numbers of bodies of which it was seen that no kernel and no start hangs on them."""
    found: set[str] = (deck.base or deck).kept.setdefault(alone, set())
    return found


class Known:
    """The numbers of a deck whose values were put into kernels before, and what was seen then."""

    def __init__(self, kernels: Kernels) -> None:
        deck = kernels.model.deck
        self.variable = variable_of(deck.base or deck)
        self.refill: Refill | None = kernels.refill
        self.alone = alone(deck)
        self.faces = [group.face for group in kernels.groups]
        self.written = written_in(deck)

    def is_load(self, number: Named) -> bool:
        """Whether a number is in parameters of loads and of what is written, and nowhere else."""
        return number.statement.keyword in LOADS and self._is_verified(number)

    def is_mass(self, number: Named) -> bool:
        """Whether it is the mass or the inertia of a body, and in no kernel."""
        fields = self.variable.fields.get(number.at, [])
        of_mass = bool(fields) and all(name in ("mass", "ip") for _, name in fields)
        return of_mass and number.name in self.alone

    def _is_verified(self, number: Named) -> bool:
        """Whether values of it were compared with the long way, and no statement derives of it."""
        refill, own = self.refill, (number.statement.keyword, number.statement.key)
        if refill is None or not refill.usable or number.name not in refill.verified:
            return False
        columns = refill.columns.get(number.at, set())
        derived = any(own in each for each in refill.deriving.values())
        settled = any(number.at in places(recipe) for _, recipe in refill.settled)
        faces = {self.faces[k] for k, _ in columns}
        return not derived and not settled and faces <= AFTERWARDS

    def load(self, system: System, number: Named, h: float) -> Direction:
        """The derivatives of the arrays by a number of a load, which changes by ``h``."""
        found = _nothing(system, h)
        found.pieces = [*self._pieces(system, number)]
        return found

    def _pieces(self, system: System, number: Named) -> Iterator[Piece]:
        assert self.refill is not None
        rows: dict[int, np.ndarray] = {}
        for k, n in self.refill.columns.get(number.at, ()):
            count = len(system.kernels.groups[k].instances)
            reals = system.instances.keep[2 * k + 1].size - 1
            into = rows.setdefault(k, np.zeros((count, reals // count)))
            for row, recipe in self.refill.entries[k, n]:
                into[row, n] = by_value(recipe, self.written, number)
        for k, found in sorted(rows.items()):
            touched = np.flatnonzero(found.any(axis=1))
            if touched.size:
                first, last = int(touched[0]), int(touched[-1])
                taken = found[first : last + 1].ravel()
                yield k, first, last - first + 1, np.append(taken, 0.0)

    def mass(self, system: System, number: Named, h: float) -> Direction:
        """The same by a number of a mass, from bodies made of values ``h`` apart."""
        own, model = number.statement, system.model
        b = model.body_index[own.keyword, own.key]
        bodies = {}
        for k in STENCIL:
            changed = self.variable.statements({number.name: number.value + k * h})
            bodies[k] = model.body_of(cast("Part", next(iter(changed.values()))))
        found = _nothing(system, h)
        found.mass[b] = slope_around({k: each.mass for k, each in bodies.items()}, h)
        of_bodies = {k: np.ravel(each.inertia) for k, each in bodies.items()}
        found.inertia[9 * b : 9 * b + 9] = slope_around(of_bodies, h)
        return found


def _nothing(system: System, h: float) -> Direction:
    """A direction in which nothing changes."""
    return Direction(
        np.zeros(system.mass.size), np.zeros(system.inertia.size), np.zeros(3),
        np.zeros(2 * system.n + system.ns), h / SHARE,
    )  # fmt: skip
