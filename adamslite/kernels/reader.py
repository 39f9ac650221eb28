"""From bound trees to expressions: the reverse of :mod:`adamslite.kernels.binding`."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from typing import TYPE_CHECKING

from adamslite.language.expression import OPERATORS
from adamslite.language.function import find_function
from adamslite.language.statement import class_of
from adamslite.symbolic.graph import NAN, Node, power
from adamslite.symbolic.graph import node as as_node
from adamslite.symbolic.scope import ZERO, Load, Scope, cross, scale
from adamslite.symbolic.types import Expr, Leaf, Physics, Read, Symbol, Tree


class ExpressionReader:
    """Turns bound trees into expressions of a scope."""

    def __init__(self, scope: Scope, n_bodies: int) -> None:
        self.scope = scope
        self.n_bodies = n_bodies
        self.memo: dict[Tree, Read] = {}
        self.seen: set[Expr] = set()

    def __call__(self, tree: Tree) -> Read:
        if tree[0] == "c":  # not remembered: 0.0 and False are one key
            return self._read(tree)
        if tree not in self.memo:
            self.memo[tree] = self._defined(self._read(tree))
        return self.memo[tree]

    def _defined(self, value: Read) -> Read:
        """What is known to be undefined (a pole, a division by zero) becomes not-a-number."""
        if isinstance(value, Node):
            self.scope.written[value] = None
            if self._is_undefined(value):
                return self.scope.symbol("nan")
        return value

    def _is_undefined(self, value: Expr) -> bool:
        """Whether a pole or not-a-number is part of an expression; each part is visited once."""
        pending = [value]
        while pending:
            top = pending.pop()
            if top in self.seen:
                continue
            if top is NAN:
                return True
            self.seen.add(top)
            pending += top.args
        return False

    def _read(self, tree: Tree) -> Read:
        scope = self.scope
        match tree:
            case ("p", _) | ("sig", _, _):
                return scope.symbol(*tree)
            case ("c", value):
                return as_node(value) if isinstance(value, float) else value
            case ("t",) | ("mode",):
                return scope.symbol(tree[0])
            case ("m", number) | ("tab", number):
                return number
            case ("v", trees):
                return tuple(self(t) for t in trees)
            case ("e" | "var", number):
                return scope.elements[number] if tree[0] == "e" else self(scope.variables[number])
            case ("s", keyword, fields):
                return View(class_of(keyword), {name: self(t) for name, t in fields}, [])
            case ("z" | "dif" | "dif1" | "origin", node, *component):
                return scope.symbol(tree[0], self.n_bodies + node, *component)
            case ("o", op, args):
                return self._operation(op, [self(t) for t in args])
        return self._call(tree)

    def _call(self, tree: Tree) -> Read:
        """A call of a deck function, which gets ids as they are bound: see Scope.statement."""
        function = find_function(tree[1])
        kinds = [function.parameter(n).statement for n in range(len(tree[2]))]
        args = [
            self(arg) if kind in (None, "MARKER") else arg
            for arg, kind in zip(tree[2], kinds, strict=True)
        ]
        return function.body(self.scope, *args)

    def _operation(self, op: str, args: list[Expr]) -> Expr:
        nodes = map(as_node, args)
        return power(*nodes) if op == "**" else OPERATORS[op].function(*nodes)


def symbolic_view(
    keyword: str, fields: Tree, node: int, width: int, scope: Scope, n_bodies: int
) -> View:
    """The statement of bound fields; ``node`` is the slot of its own unknowns or -1."""
    cls = class_of(keyword)
    values = {name: scope.read(tree) for name, tree in fields}

    def moving_view() -> View:
        """The same view read where everything moves."""
        read = ExpressionReader(scope, n_bodies)
        return View(cls, {name: read(tree) for name, tree in fields}, own)

    if keyword == "DIFF" and node >= 0:
        own = [scope.symbol(kind, n_bodies + node) for kind in ("dif", "dif1")]
    else:
        own = [scope.symbol("z", n_bodies + node, c) for c in range(width)] if node >= 0 else []
    return View(cls, values, own, moving_view)


class View:
    """A statement as its physics sees it: frames, symbols, expressions, words."""

    def __init__(
        self,
        cls: Physics,
        fields: dict[str, Read],
        unknowns: list[Symbol],
        moving_view: Callable[[], View] | None = None,
    ) -> None:
        self.__dict__.update(fields)
        self.cls = cls
        self.unknowns = unknowns
        self.moving_view = moving_view

    if TYPE_CHECKING:

        def __getattr__(self, name: str) -> Read:
            """A field."""

    def own_loads(self, scope: Scope) -> list[Load]:
        """Loads of a force, or the reactions of a constraint."""
        if hasattr(self.cls, "loads"):
            return self.cls.loads(self, scope)
        with scope.everything_moves():
            view = self.moving_view() if self.moving_view else self
            return reactions(view.cls.constraints(view, scope), view.unknowns, scope)

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
