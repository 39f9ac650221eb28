"""A statement as its physics sees it: frames for markers, symbols for numbers, expressions.

The reverse of :mod:`adamslite.kernels.binding`, whose bound trees :class:`Reader` turns into sympy.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

from adamslite.kernels.binding import Tree
from adamslite.language.expression import OPERATORS
from adamslite.language.function import FUNCTIONS
from adamslite.language.statement import STATEMENTS, Statement
from adamslite.symbolic.scope import Load, Scope


class View:
    """A statement as its physics sees it: frames, symbols, expressions, words."""

    def __init__(
        self,
        cls: type[Statement],
        fields: dict[str, Any],
        unknowns: list[Any],
        anew: Callable[[], View] | None = None,
    ) -> None:
        self.__dict__.update(fields)
        self.cls = cls
        self.unknowns = unknowns
        self.anew = anew

    def own_loads(self, scope: Scope) -> list[Load]:
        """Loads of a force, or the reactions of a constraint."""
        if hasattr(self.cls, "loads"):
            return self.cls.loads(self, scope)
        with scope.everything_moves():
            return reactions(self.anew() if self.anew else self, scope)

    def side(self, jflag: int) -> tuple[int | None, int | None]:
        """The frame that is measured, and the only partner that counts (None: all)."""
        sides = self.__dict__.get("sides")
        return sides[jflag] if sides else (self.end(jflag), None)

    def end(self, jflag: int) -> int | None:
        """The frame called I (``jflag`` 0) or J: its own, or that of the (first) joint it acts
        on.
        """
        known = self.__dict__
        held = known.get("joint") or (known.get("joints") or (None,))[0]
        if held is not None:
            return held.end(jflag)
        names = ("j", "jfloat", "j_part") if jflag else ("i",)
        return next((known[name] for name in names if known.get(name) is not None), None)


def reactions(view: View, scope: Scope) -> list[Load]:
    """-G^T lam as loads: what the constraint exerts.

    A row g gives the force -lam dg/dd on I of each relative position d(i,j), the opposite on J,
    and the torque -lam sum x_c cross dg/dx_c on the part of each axis used; for velocity rows d
    and x are replaced by v and w (Jourdain's principle).
    """
    from adamslite.symbolic.scope import ZERO, cross, scale
    from adamslite.symbolic.sympy_nodes import sp

    loads = []
    for row, lam in zip(view.cls.constraints(view, scope), view.unknowns, strict=True):
        row = sp.S.Zero + row
        groups: dict[tuple, list[Any]] = {}
        for symbol in sorted(scope.slope.symbols(row), key=str):
            leaf = scope.leaves[symbol]
            if leaf[0] in ("d", "x", "v", "w"):
                slope = groups.setdefault(leaf[:-1], [sp.S.Zero] * 3)
                slope[leaf[-1]] = scope.slope(row, symbol)
        rates = any(leaf[0] in ("v", "w") for leaf in groups)
        for leaf, slope in groups.items():
            pull = scale(-lam, tuple(slope))
            if leaf[0] == ("v" if rates else "d"):
                loads.append(Load(leaf[1], pull, ZERO, leaf[2]))
            elif leaf[0] == "w":
                loads.append(Load(leaf[1], ZERO, pull, leaf[2]))
            elif leaf[0] == "x" and not rates and scope.turns(leaf[1]):
                axis = scope.vector("x", leaf[1], leaf[2])
                loads.append(Load(leaf[1], ZERO, cross(axis, pull)))
    return loads


class Reader:
    """Turns bound trees into sympy with a scope."""

    def __init__(self, scope: Scope, n_bodies: int) -> None:
        self.scope = scope
        self.n_bodies = n_bodies
        self.memo: dict[Tree, Any] = {}

    def __call__(self, tree: Tree) -> Any:
        if tree[0] == "c":  # not remembered: 0.0 and False are one key
            return self._read(tree)
        if tree not in self.memo:
            self.memo[tree] = self._defined(self._read(tree))
        return self.memo[tree]

    def _defined(self, value: Any) -> Any:
        """What sympy knows to be undefined (a pole, a division by zero) becomes not-a-number."""
        from adamslite.symbolic.sympy_nodes import sp

        if isinstance(value, sp.Basic) and value.has(sp.zoo, sp.nan):
            return self.scope.symbol("nan")
        return value

    def _read(self, tree: Tree) -> Any:
        scope = self.scope
        match tree:
            case ("p", _) | ("sig", _, _):
                return scope.symbol(*tree)
            case ("c", value):
                return _exact(value) if isinstance(value, float) else value
            case ("t",) | ("mode",):
                return scope.symbol(tree[0])
            case ("m", number) | ("tab", number):
                return number
            case ("v", trees):
                return tuple(self(t) for t in trees)
            case ("s", keyword, fields):
                return View(STATEMENTS[keyword], {name: self(t) for name, t in fields}, [])
            case ("z", node, component):
                return scope.symbol("z", self.n_bodies + node, component)
            case ("o", op, args):
                return self._operation(op, [self(t) for t in args])
        return self._call(tree)

    def _call(self, tree: Tree) -> Any:
        function = FUNCTIONS[tree[1]]
        args = []
        for n, arg in enumerate(tree[2]):
            statement = function.parameter(n).statement
            if statement is None or statement == "MARKER":
                args.append(self(arg))
            else:
                args.append(self._shifted(arg))
        return function.body(self.scope, *args)

    def _shifted(self, arg: Tree) -> Tree:
        return ("dif", self.n_bodies + arg[1]) if arg[0] == "dif" else arg

    def _operation(self, op: str, args: list[Any]) -> Any:
        from adamslite.symbolic.sympy_nodes import power

        return power(*args) if op == "**" else OPERATORS[op].function(*args)


def _exact(value: float) -> Any:
    from adamslite.symbolic.sympy_nodes import sp

    doubled = 2.0 * value
    if math.isfinite(doubled) and doubled == int(doubled) and abs(doubled) < 1e6:
        return sp.Rational(int(doubled), 2)
    return sp.Float(value, 17)


def symbolic_view(
    keyword: str, fields: Tree, node: int, width: int, scope: Scope, n_bodies: int
) -> View:
    """The statement of bound fields; ``node`` is the slot of its own unknowns or -1."""
    cls = STATEMENTS[keyword]
    values = {name: scope.read(tree) for name, tree in fields}

    def anew() -> View:
        """The same view read where everything moves."""
        read = Reader(scope, n_bodies)
        return View(cls, {name: read(tree) for name, tree in fields}, own)

    if keyword == "DIFF" and node >= 0:
        own = [scope.symbol(kind, n_bodies + node) for kind in ("dif", "dif1")]
    else:
        own = [scope.symbol("z", n_bodies + node, c) for c in range(width)] if node >= 0 else []
    return View(cls, values, own, anew)
