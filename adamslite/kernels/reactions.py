"""Reactions: the loads by which a constraint keeps its rows at zero."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from adamslite.symbolic.scope import ZERO, Load, Scope, cross, scale
from adamslite.symbolic.types import Expr, Leaf, Symbol


def reactions(rows: Iterable[Expr], multipliers: Sequence[Symbol], scope: Scope) -> list[Load]:
    """-G^T lam as loads: what a constraint of rows g and multipliers lam exerts.

    A row g gives the force -lam dg/dd on I of each relative position d(i,j), the opposite on J,
    and the torque -lam sum x_c cross dg/dx_c on the part of each axis used; for velocity rows d
    and x are replaced by v and w (Jourdain's principle).
    """
    loads = []
    for row, lam in zip(rows, multipliers, strict=True):
        groups: dict[Leaf, list[Expr]] = {}
        gradient = scope.slope.gradient(row)
        for symbol in sorted(gradient, key=str):
            leaf = scope.leaves[symbol]
            if leaf[0] in ("d", "x", "v", "w"):
                groups.setdefault(leaf[:-1], [0, 0, 0])[leaf[-1]] = gradient[symbol]
        rates = any(leaf[0] in ("v", "w") for leaf in groups)
        for leaf, slope in groups.items():
            pull = scale(-lam, (slope[0], slope[1], slope[2]))
            if leaf[0] == ("v" if rates else "d"):
                loads.append(Load(leaf[1], pull, ZERO, leaf[2]))
            elif leaf[0] == "w":
                loads.append(Load(leaf[1], ZERO, pull, leaf[2]))
            elif leaf[0] == "x" and not rates and scope.turns(leaf[1]):
                axis = scope.vector("x", leaf[1], leaf[2])
                loads.append(Load(leaf[1], ZERO, cross(axis, pull)))
    return loads
