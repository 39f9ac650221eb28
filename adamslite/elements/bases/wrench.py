"""Forces with six components between two markers, and the matrix law that most of them follow.

Equations, all components along the axes of J (d = r_I - r_J)::

    displacement   x = (d . x_J, d . y_J, d . z_J, AX(I,J), AY(I,J), AZ(I,J))
    rate           v = (d seen from J, angular velocity of I less that of J)
    on I           (force, torque) = preload - K (x - rest) - C v
    on J           -force,  -torque - d x force

The torque on J holds the moment of the pair of forces, so that momentum balances however far I is
from J.  AX, AY and AZ are projected angles: all three small, or only AZ large.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from adamslite.elements.bases.joint_coordinates import relative_velocity
from adamslite.functions.forces import MEASURES
from adamslite.language.expression import COMPONENTS, Ref, measure
from adamslite.language.function import FUNCTIONS
from adamslite.language.statement import Statement
from adamslite.symbolic.scope import ZERO, Load, along_axes, cross, dot, scale

if TYPE_CHECKING:
    from adamslite.language.expression import Node
    from adamslite.language.interfaces import DrawnModel
    from adamslite.symbolic.scope import Scope
    from adamslite.symbolic.types import Expr, Frame, Seen

Row = tuple[float, ...]
SIX = range(6)
NOTHING: Row = (0.0,) * 6


class Wrench(Statement):
    """Mixed into statements that exert a force and a torque on I."""

    @property
    def result_names(self) -> tuple[str, ...]:
        """Force and torque on I, ground axes, torque about I's origin."""
        return ("fx", "fy", "fz", "tx", "ty", "tz")

    def outputs(self, model: DrawnModel) -> list[Node]:
        """Values of ``result_names``."""
        own = Ref(self.keyword, self.key)
        return [measure(MEASURES[self.keyword], own, component) for component in COMPONENTS]


class Compliance(Wrench):
    """Mixed into statements whose wrench is linear in displacement and rate.

    Their ``derived`` gives the fields ``stiffness`` and ``damping`` (6 rows of 6), ``rest`` and
    ``preload`` (6 values); an entry of zero is left out of the equations.
    """

    beyond = "turned past 90 degrees about x or y of J, where AX and AY are no angles any more"
    """What it means that z_I . z_J is below zero."""

    def loads(self: Seen, scope: Scope) -> list[Load]:
        """The wrench on I and what J gets."""
        source = _source(self)
        if any(row[3] != 0 or row[4] != 0 for row in self.stiffness):
            scope.limit(dot(scope.axes(source)[2], scope.axes(self.j)[2]))
        strained, rates = _strained(self, scope), rate(scope, source, self.j)
        total = list(self.preload)
        for matrix, values in ((self.stiffness, strained), (self.damping, rates)):
            total = [t - _product(row, values) for t, row in zip(total, matrix, strict=True)]
        return between(scope, self.i, self.j, total)

    def stored(self: Seen, scope: Scope) -> Expr:
        """(x - rest) . K (x - rest)/2 - preload . (x - rest), for a symmetric K.

        Between two markers x_i . K x/2, half of what they store together.
        """
        strained = _strained(self, scope)
        alone = getattr(self, "by", None) is None
        own = strained if alone else displacement(scope, self.i, self.j)
        pulls = zip(self.stiffness, self.preload, strict=True)
        pulled = [_product(row, strained) / 2 - force for row, force in pulls]
        return _product(pulled, own)


def _source(element: Seen) -> Frame:
    """The marker whose displacement counts."""
    by = getattr(element, "by", None)
    return element.i if by is None else by


def _strained(element: Seen, scope: Scope) -> list[Expr]:
    """x - rest"""
    found = displacement(scope, _source(element), element.j)
    return [x - x0 for x, x0 in zip(found, element.rest, strict=True)]


def _product(row: Sequence[Expr], values: Sequence[Expr]) -> Expr:
    return sum(a * x for a, x in zip(row, values, strict=True) if a != 0)


def displacement(scope: Scope, i: int, j: int) -> list[Expr]:
    """Position and projected angles of I relative to J."""
    place = [dot(scope.position(i, j), axis) for axis in scope.axes(j)]
    return place + [FUNCTIONS[name].body(scope, i, j) for name in ("AX", "AY", "AZ")]


def rate(scope: Scope, i: Frame, j: Frame) -> list[Expr]:
    """Velocity and angular velocity of I seen from J."""
    speed = [relative_velocity(scope, i, j, axis) for axis in range(3)]
    return speed + [dot(scope.omega(i, j), axis) for axis in scope.axes(j)]


def between(scope: Scope, i: int, j: int, wrench: list[Expr]) -> list[Load]:
    """Loads of a wrench on I with components along the axes of J."""
    axes = scope.axes(j)
    fx, fy, fz, tx, ty, tz = wrench
    force, torque = along_axes(axes, (fx, fy, fz)), along_axes(axes, (tx, ty, tz))
    moment = cross(scope.position(i, j), force)
    return [Load(i, force, torque, j), Load(j, ZERO, scale(-1, moment))]


def diagonal(values: Row) -> tuple[Row, ...]:
    """A matrix with these six values on its diagonal."""
    return tuple(tuple(values[r] if r == c else 0.0 for c in SIX) for r in SIX)


def by_columns(values: Row) -> tuple[Row, ...]:
    """A matrix of 36 values given column by column."""
    return tuple(tuple(values[6 * c + r] for c in SIX) for r in SIX)


def symmetric(values: Row) -> tuple[Row, ...]:
    """A symmetric matrix of 21 values: its lower triangle, column by column."""
    lower = iter(values)
    half = {(r, c): next(lower) for c in SIX for r in range(c, 6)}
    return tuple(tuple(half[max(r, c), min(r, c)] for c in SIX) for r in SIX)


def times(factor: float, matrix: tuple[Row, ...]) -> tuple[Row, ...]:
    """A multiple of a matrix."""
    return tuple(tuple(factor * value for value in row) for row in matrix)
