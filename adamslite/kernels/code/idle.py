"""When an instance has nothing to add: what it evaluates vanishes on the branches that are held.

Most pairs that may touch do not.  Where the held branches say so, the loop goes on to the next
instance before a root, a power or an angle is computed.  A value vanishes

    a product      where one of its factors does
    a sum          where all of its terms do
    a choice       where each piece that its held conditions leave open vanishes

A condition that is not held leaves both sides open.
"""

from __future__ import annotations

from collections.abc import Iterable
from functools import reduce

from adamslite.native.llvm_builder import Builder, Value
from adamslite.symbolic.types import Expr

Truth = bool | str
"""Known now, or the name of an ``i1``."""
ALWAYS: Truth = True
NEVER: Truth = False


class IdleTest:
    """Writes the test; ``branches``: the value that holds the branch of each guard."""

    def __init__(self, builder: Builder, branches: dict[Expr, Value]) -> None:
        self.b = builder
        self.branches = branches
        self.memo: dict[Expr, Truth] = {}

    def __call__(self, expressions: Iterable[Expr]) -> Truth:
        """Whether all of them vanish."""
        return reduce(self._both, map(self._vanishes, expressions), ALWAYS)

    def _vanishes(self, expr: Expr) -> Truth:
        if expr not in self.memo:
            self.memo[expr] = self._found(expr)
        return self.memo[expr]

    def _found(self, expr: Expr) -> Truth:
        if expr.kind == "number":
            return bool(expr == 0)
        if expr.kind in ("neg", "/"):
            return self._vanishes(expr.args[0])
        if expr.kind == "*":
            return reduce(self._either, map(self._vanishes, expr.args), NEVER)
        if expr.kind in ("+", "-"):
            return reduce(self._both, map(self._vanishes, expr.args), ALWAYS)
        return expr.kind == "choice" and expr.order is not None and self._choice(expr)

    def _choice(self, expr: Expr) -> Truth:
        """From the last piece back to the first: what the conditions before it leave open."""
        found = self._vanishes(expr.args[-1])
        for piece, condition in reversed([*expr.pieces]):
            here, passed = self._vanishes(piece), self._fails(condition)
            kept = self._both(here, self._either(found, self._holds(condition)))
            found = self._either(kept, self._both(passed, found))
        return found

    def _holds(self, cond: Expr) -> Truth:
        """Whether a condition is known to hold."""
        return self._known(cond, ">")

    def _fails(self, cond: Expr) -> Truth:
        """Whether a condition is known not to hold."""
        return self._known(cond, "<")

    def _known(self, cond: Expr, side: str) -> Truth:
        opposite = "<" if side == ">" else ">"
        if cond.kind in ("and", "or"):
            parts = [self._known(each, side) for each in cond.args]
            every = (cond.kind == "and") == (side == ">")
            return (
                reduce(self._both, parts, ALWAYS) if every else reduce(self._either, parts, NEVER)
            )
        if cond.kind == "not":
            return self._known(cond.args[0], opposite)
        branch = self.branches.get(cond)
        return False if branch is None else self.b.compare(side, branch, 0.0)

    def _both(self, a: Truth, b: Truth) -> Truth:
        if isinstance(a, bool) or a == b:
            return b if a else False
        return self._both(b, a) if isinstance(b, bool) else self.b.logic("and", a, b)

    def _either(self, a: Truth, b: Truth) -> Truth:
        if isinstance(a, bool):
            return True if a else b
        if a == b or b is False:
            return a
        return True if b is True else self.b.logic("or", a, b)
