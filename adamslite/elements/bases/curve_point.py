"""The point of a curve that a constraint has as an unknown.

Equation (c the curve in the axes of its marker, p the path of the point from where it starts)::

    s = s0 + p / length of the chords,      c(s),   c'(s) = dc/ds

p is the x coordinate of a massless point mass, y and z of which the constraint keeps at zero, so
that it has a velocity and an acceleration like any coordinate.  Its equation of motion says that
the reaction has no component along the curve.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from adamslite.language.statement import STATEMENTS
from adamslite.symbolic.formulas import floor, lookup
from adamslite.symbolic.scope import ORIGIN

if TYPE_CHECKING:
    from adamslite.language.interfaces import Key
    from adamslite.language.statement import Statement
    from adamslite.symbolic.scope import Scope
    from adamslite.symbolic.types import Expr, Frame, Seen

COORDINATES = range(3)


def carriers(name: str, owner: Statement, kept: bool) -> tuple[Statement, Statement]:
    """The massless point mass of this name and a marker on it; ``kept``: it starts where the deck
    wants it, whatever else has to move.
    """
    facts = {"exact": ("X",)} if kept else {}
    point = STATEMENTS["POINT_MASS"](id=name, mass=0.0, spans=owner.spans, **facts)
    marker = STATEMENTS["MARKER"](id=name, point_mass=point.key, spans=owner.spans)
    return point, marker


def parameter(scope: Scope, path: Frame, start: Expr, curve: Seen) -> tuple[Expr, list[Expr]]:
    """s, and the coordinates of the carrier that are not used."""
    p, *unused = scope.position(path, ORIGIN)
    s = start + p / curve.length
    return (s - floor(s) if curve.closed else s), unused


def point(curve: Seen, s: Expr, order: int = 0) -> tuple[Expr, ...]:
    """c(s), or a derivative of it, along the axes of the marker of the curve."""
    return tuple(lookup(curve.table, s, component, order) for component in COORDINATES)


def carrier_name(owner: Statement, curve: str = "") -> str:
    """``PTCV_1``, ``CVCV_1_I``."""
    key: Key = owner.key
    return f"{owner.keyword}_{key}{'_' if curve else ''}{curve}"
