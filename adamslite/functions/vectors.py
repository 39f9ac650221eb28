"""Vectors: three components that the reader writes out as scalar functions.

An expression may join vectors v, w and numbers c, as Adams/Solver C++ does::

    v + w    v - w    -v    c*v    v*c    v/c         by components
    v*w                                               a number: the dot product
    MAG(v)                                            its size, sqrt(v*v)
    UV(v)                                             the unit vector v/MAG(v)

A whole expression is a number, but for FXYZ= and TXYZ=, which are vectors.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

from adamslite.language.expression import NEGATE, Call, Node, Num, Op
from adamslite.language.function import function
from adamslite.symbolic.scope import Scope
from adamslite.symbolic.types import Expr


class Components(NamedTuple):
    """A vector as three expressions."""

    x: Node
    y: Node
    z: Node


Value = Node | Components
Writing = Callable[..., Value]

UV = """Unit vector along v: v/MAG(v).

    Unit: none.  Not defined where v is zero.  Source: Adams/Solver C++ function UV.
    """
MAG = """Size of v: the square root of v*v.

    Vectors v, w and numbers c are joined as v + w, v - w, -v, c*v, v/c; v*w is the dot product.
    They may stand in any expression whose value is a number, and are the values of FXYZ= and TXYZ=.
    Unit: that of v.  Where v is zero its derivative does not exist.
    Source: Adams/Solver C++ function MAG.
    """

TRANS = """Vector v, which has its components along the axes of k, along the axes of marker i.

    Unit: that of v.  Source: Adams/Solver C++ lists the name, but publishes no page of it: a note
    says so where it is used; DX(i,j,k), DY and DZ leave nothing open.
    """

ASSUMED = ("TRANS",)
"""Functions whose meaning is not published."""
VECTORS: dict[str, Writing] = {}
"""Function of vectors -> how it is written in scalar functions, from its resolved arguments."""


def combined(op: str, left: Value, right: Value) -> Value | None:
    """An operation on vectors and numbers; None where there is none."""
    if isinstance(left, Components):
        if isinstance(right, Components):
            if op in "+-":
                return Components(*[Op(op, pair) for pair in zip(left, right, strict=True)])
            return dot_product(left, right) if op == "*" else None
        return Components(*[Op(op, (a, right)) for a in left]) if op in ("*", "/") else None
    if isinstance(right, Components):
        return Components(*[Op(op, (left, b)) for b in right]) if op == "*" else None
    return Op(op, (left, right))


def negated(value: Value) -> Value:
    """The negative of a vector or a number."""
    if isinstance(value, Components):
        return Components(*[Op(NEGATE, (a,)) for a in value])
    return Op(NEGATE, (value,))


def dot_product(v: Components, w: Components) -> Node:
    """v . w"""
    x, y, z = (Op("*", pair) for pair in zip(v, w, strict=True))
    return Op("+", (Op("+", (x, y)), z))


def _size(v: Components) -> Node:
    return Call("SQRT", (dot_product(v, v),))


def _unit(v: Components) -> Components:
    return Components(*[Op("/", (a, _size(v))) for a in v])


def _seen_by(v: Components, i: Node, k: Node) -> Components:
    axes = (VECTORS[f"UV{axis}"](i, k) for axis in "XYZ")
    return Components(*[dot_product(v, axis) for axis in axes if isinstance(axis, Components)])


def _vector(name: str, signature: str, page: str, writing: Writing) -> None:
    """Register a function that is written out when it is read."""

    def unwritten(scope: Scope, *args: object) -> Expr:
        raise AssertionError(f"{name} is written out before it is evaluated")

    unwritten.__doc__ = page
    VECTORS[name] = writing
    function(name, signature)(unwritten)


def _of_family(family: str, signature: str, what: str, unit: str) -> None:
    """A vector whose components are functions of their own: DXYZ of DX, DY, DZ."""

    def writing(*args: Node) -> Components:
        return Components(*[Call(family + axis, args) for axis in "XYZ"])

    parts = f"{family}X, {family}Y, {family}Z"
    source = f"Source: Adams/Solver C++ function {family}XYZ."
    page = (
        f"Vector of {what}.\n\n    {parts} along the axes of k.  Unit: {unit}.\n    {source}\n    "
    )
    _vector(f"{family}XYZ", signature, page, writing)


def _of_axis(number: int) -> None:
    """The unit vector along an axis of a marker, by its direction cosines."""
    axis = "XYZ"[number]

    def writing(*args: Node) -> Components:
        places = range(3 * number + 1, 3 * number + 4)
        return Components(*[Call("ORIENT", (Num(29.0), Num(float(n)), *args)) for n in places])

    page = (
        f"Unit vector along the {axis.lower()} axis of marker i, components along the axes of k.\n"
        f"\n    Unit: none.  Source: Adams/Solver C++ function UV{axis}; k is an extension.\n    "
    )
    _vector(f"UV{axis}", "i:marker k:marker=0", page, writing)


_of_family("D", "i:marker j:marker=0 k:marker=0", "the displacement of i from j", "length")
_of_family(
    "V", "i:marker j:marker=0 k:marker=0 l:marker=0",
    "the velocity of i against j, taken in frame l", "length/time",
)  # fmt: skip
_of_family(
    "ACC", "i:marker j:marker=0 k:marker=0 l:marker=0",
    "the acceleration of i against j, taken in frame l", "length/time^2",
)  # fmt: skip
_of_family("W", "i:marker j:marker=0 k:marker=0", "the angular velocity of i against j", "rad/time")
_of_family(
    "WDT", "i:marker j:marker=0 k:marker=0 l:marker=0",
    "the rate of the angular velocity of i against j, taken in frame l", "rad/time^2",
)  # fmt: skip
_of_family("F", "i:marker j:marker=0 k:marker=0", "the net force on i", "force")
_of_family("T", "i:marker j:marker=0 k:marker=0", "the net torque on i", "force times length")
for _number in range(3):
    _of_axis(_number)
_vector("UV", "v:vector", UV, _unit)
_vector("MAG", "v:vector", MAG, _size)
_vector("TRANS", "v:vector i:marker k:marker=0", TRANS, _seen_by)
