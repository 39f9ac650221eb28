"""Whether forces that depend on accelerations are added mass of single bodies.

    f = f_0(t, q, u) + A(t, q, u) a_b        on body b, with the accelerations of body b alone

Such forces need no equations to be solved: the body moves as if its mass were M - A.
"""

from __future__ import annotations

from collections.abc import Iterable

from adamslite.kernels.code.shape import Outputs, Shape
from adamslite.symbolic.graph import node
from adamslite.symbolic.scope import Frame, Load, Scope
from adamslite.symbolic.structure import ordered
from adamslite.symbolic.types import Expr

ACCELERATIONS = ("a", "al")
# Stands for every degree above one, and for what is no polynomial.
HIGHER = 2


def is_added_mass(shape: Shape, scope: Scope, out: Outputs) -> bool:
    """Whether accelerations occur in loads alone, linearly, each in loads on its own body."""
    degrees = Degrees(scope)
    if any(degrees(expr) for _, _, expr in out.rows):
        return False
    return all(_is_own(shape, scope, load, degrees) for load in out.loads)


def is_along_axes(scope: Scope, out: Outputs) -> bool:
    """Whether every component of a force depends on the same one of an acceleration alone."""
    found = [
        (component, scope.leaves[symbol])
        for load in out.loads
        for component, force in enumerate(load.force)
        for symbol in scope.slope.symbols(node(force))
    ]
    return all(leaf[-1] == component for component, leaf in found if leaf[0] in ACCELERATIONS)


def _is_own(shape: Shape, scope: Scope, load: Load, degrees: Degrees) -> bool:
    parts = [node(e) for e in (*load.force, *load.torque)]
    degree = max(map(degrees, parts))
    if degree != 1:
        return degree == 0
    leaves = {scope.leaves[symbol] for e in parts for symbol in scope.slope.symbols(e)}
    frames = [f for leaf in leaves if leaf[0] in ACCELERATIONS for f in leaf[1:3]]
    ends = [load.frame] if load.reaction is None else [load.frame, load.reaction]
    return len(_bodies(shape, scope, [*frames, *ends])) == 1


def _bodies(shape: Shape, scope: Scope, frames: Iterable[Frame]) -> set[int]:
    return {shape.slots[f].body for f in frames if not scope.is_ground(f)}


class Degrees:
    """Degrees of expressions in the accelerations, ``HIGHER`` at most; remembers what it has
    found.
    """

    def __init__(self, scope: Scope) -> None:
        self.scope = scope
        self._found: dict[Expr, int] = {}

    def __call__(self, expr: Expr) -> int:
        expr, known = node(expr), self._found
        for top in ordered([expr], lambda top: () if top in known else top.args):
            if top not in known:
                known[top] = self._degree(top, [known[each] for each in top.args])
        return known[expr]

    def _degree(self, top: Expr, parts: list[int]) -> int:
        """The degree of a node whose arguments have these."""
        if top.kind == "symbol":
            return int(self.scope.leaves[top][0] in ACCELERATIONS)
        if not any(parts):
            return 0
        if top.kind in ("+", "-", "neg"):
            return max(parts)
        if top.kind == "/" and parts[1]:
            return HIGHER
        return min(sum(parts), HIGHER) if top.kind in "*/" else HIGHER
