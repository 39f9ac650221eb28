"""Values of tables: points of a SPLINE, joined in one of three ways, and of a CURVE."""

from __future__ import annotations

from adamslite.language.function import function
from adamslite.symbolic.formulas import (
    floor,
    lookup,
    lookup_between,
    lookup_between_with_corners,
    lookup_with_corners,
)
from adamslite.symbolic.scope import Scope
from adamslite.symbolic.types import Expr, Tree

# Methods of INTERP.
METHODS = {1: "linear", 3: "natural"}


@function("AKISPL", "x:number z:number id:spline iord:constant{0..2}=0")
def akispl(scope: Scope, x: Expr, z: Expr, id: Tree, iord: int = 0) -> Expr:
    """SPLINE id at x by Akima's cubics, or its derivative of order iord by x.

    The slope at a point follows from the chords next to it: little overshoot, bends that jump at
    the points.  z chooses among a family of curves, linear between neighbours; 0 for a single
    curve.  Where z meets a curve, steps end.
    Unit: that of Y, per x for each order.  Source: Adams/Solver function AKISPL; Akima, J. ACM 17
    (1970) 589-602.
    """
    return _value(scope, id, "akima", x, z, iord)


@function("CUBSPL", "x:number z:number id:spline iord:constant{0..2}=0")
def cubspl(scope: Scope, x: Expr, z: Expr, id: Tree, iord: int = 0) -> Expr:
    """SPLINE id at x by a cubic spline, or its derivative of order iord by x.

    Slopes and bends are continuous, bends at both ends are zero.  z as in AKISPL.
    Unit: that of Y, per x for each order.  Source: Adams/Solver function CUBSPL; the ends, which
    its page leaves open, are those of a natural spline.
    """
    return _value(scope, id, "natural", x, z, iord)


@function("INTERP", "x:number method:constant{1,3} id:spline iord:constant{0..2}=0")
def interp(scope: Scope, x: Expr, method: int, id: Tree, iord: int = 0) -> Expr:
    """SPLINE id, a single curve, at x; method 1: straight lines, 3: the cubic spline of CUBSPL.

    At the corners of straight lines steps end, as where IF changes its branch.
    Unit: that of Y, per x for each order iord.  Source: Adams/Solver function INTERP, there for
    time histories in files alone.
    """
    if METHODS[method] == "linear" and not scope.of_time(x):
        spline = scope.statement(id)
        return lookup_with_corners(spline.linear, spline.pieces, x, iord)
    return _value(scope, id, METHODS[method], x, 0, iord)


@function("CURVE", "alpha:number iord:constant{0..2} comp:constant{1..3} id:curve")
def curve(scope: Scope, alpha: Expr, iord: int, comp: int, id: Tree) -> Expr:
    """A coordinate (comp 1 x, 2 y, 3 z) of CURVE id at alpha, or its derivative by alpha.

    alpha runs from -1 at the first point to 1 at the last, in proportion to the chords between the
    points, with FUNCTION=USER from MINPAR to MAXPAR; a closed curve goes on from the first.
    Unit: length.  Source: Adams/Solver function CURVE, whose page leaves open how alpha is spread
    over points that are not equally far apart.
    """
    found = scope.statement(id)
    span = found.last - found.first
    s = (alpha - found.first) / span
    if found.closed:
        s = s - floor(s)
    return lookup(found.over_alpha, s, comp - 1, iord) / span**iord


def _value(scope: Scope, id: Tree, kind: str, x: Expr, z: Expr, order: int) -> Expr:
    """A table of a statement, or its derivative by x."""
    spline = scope.statement(id)
    table = getattr(spline, kind)
    if not spline.family:
        return lookup(table, x, order=order)
    if spline.strips is None or scope.of_time(z):
        return lookup_between(table, x, z)
    return lookup_between_with_corners(table, spline.strips, x, z)
