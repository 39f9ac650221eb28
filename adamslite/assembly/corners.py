"""Corners of functions of time: where a value or its slope jumps.

A function such as IF or MAX has edges, expressions that pass through zero where it is not smooth.
The edges are followed over a stretch of time; where one passes through zero, values and slopes on
both sides are compared.  MAX(0, TIME - 1)**2 has an edge at 1 and no corner.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from adamslite.assembly.reader import NumberReader
from adamslite.assembly.scope import Posture
from adamslite.language.expression import Call, Node, Ref, calls
from adamslite.language.function import FUNCTIONS
from adamslite.language.interfaces import Key
from adamslite.model.model import Model
from adamslite.symbolic.duals import Dual
from adamslite.symbolic.formulas import with_numbers
from adamslite.symbolic.types import Expr

# Times at which edges are evaluated, halvings of the interval in which one passes through zero.
SAMPLES, HALVINGS = 400, 25
# How near an edge both sides are, of the time there is; jumps of less than a share of the largest
# value or slope are none.
BESIDE, LEAST = 1e-7, 1e-4
#: Operations that are evaluated in search of the corners of a deck, which take a second or so.
MOST = 200_000


class TooManyOperations(Exception):
    """The search takes longer than its findings are worth."""


def suspects(model: Model, node: Node, least: int) -> Iterator[Call]:
    """Calls in an expression, or in VARIABLEs it depends on, of functions with less than ``least``
    continuous derivatives.
    """
    seen: set[Key] = set()
    pending = [node]
    while pending:
        for call in calls(pending.pop()):
            function = FUNCTIONS[call.name]
            if not function.smooth and (function.order or 0) < least:
                yield call
            for ref in call.args:
                if isinstance(ref, Ref) and ref.kind == "VARIABLE" and ref.id not in seen:
                    seen.add(ref.id)
                    pending.append(model.variable(ref.id).function)


class Corners:
    """The search for corners in a model, and how many operations it may still take."""

    def __init__(self, model: Model) -> None:
        self.model, self.posture, self.left = model, Posture.start(model), MOST

    def first(self, node: Node, least: int, until: float) -> tuple[str, float] | None:
        """The function behind the first corner up to a time, and when; None where there is none.

        ``node`` depends on TIME alone.

        Raises
        ------
        TooManyOperations
            When as many as are allowed have been evaluated.
        """
        calls = list(suspects(self.model, node, least))
        grid = np.linspace(0.0, until, SAMPLES + 1).tolist()
        edges, values = [], []
        for instant in map(self._at, grid):
            values.append(instant.followed(node))
            edges.append([instant.edges(call) for call in calls])
        sizes = np.nanmax(np.abs(values), axis=0, initial=0.0)
        found: tuple[float, str] | None = None
        for low, high, call, edge in _passages(edges):
            if found and grid[low] > found[0]:
                break
            t = self._crossing(calls[call], edge, grid[low], grid[high])
            before, after = (self._at(t + side * BESIDE * until).followed(node) for side in (-1, 1))
            jumps = np.abs(after - before) > LEAST * sizes
            if jumps[: least + 1].any():
                found = min(found or (t, calls[call].name), (t, calls[call].name))
        return (found[1], found[0]) if found else None

    def _at(self, time: float) -> _Instant:
        return _Instant(self, time)

    def _crossing(self, call: Call, edge: int, low: float, high: float) -> float:
        """The time at which an edge of a call passes through zero."""
        start = np.sign(self._at(low).edges(call)[edge])
        for _ in range(HALVINGS):
            middle = 0.5 * (low + high)
            if np.sign(self._at(middle).edges(call)[edge]) == start:
                low = middle
            else:
                high = middle
        return 0.5 * (low + high)


class _Instant(NumberReader):
    """Values at one time, each of them found once."""

    def __init__(self, search: Corners, time: float) -> None:
        super().__init__(search.model, search.posture, True, rates=True, room=0)
        self.now, self._search = time, search
        # The node is kept, too, so that no other one gets its id.
        self._found: dict[int, tuple[Node, Expr]] = {}

    def value(self, node: Node) -> Expr:
        known = self._found.get(id(node))
        if known is None:
            self._search.left -= 1
            if self._search.left < 0:
                raise TooManyOperations
            known = self._found[id(node)] = node, super().value(node)
        return known[1]

    def followed(self, node: Node) -> np.ndarray:
        """Value and slope (2,)."""
        with with_numbers():
            found = self.value(node)
        slope = found.slope[-1] if np.ndim(found.slope) else 0.0
        return np.array([found.value, slope])

    def edges(self, call: Call) -> list[float]:
        """What passes through zero where a function is not smooth."""
        edges = FUNCTIONS[call.name].edges
        with with_numbers():
            found = edges(*self.arguments(call)) if edges else ()
        return [each.value if isinstance(each, Dual) else float(each) for each in found]


def _passages(edges: list[list[list[float]]]) -> list[tuple[int, int, int, int]]:
    """Where edges (times, calls, edges of each) change their sign: numbers of the times before and
    after, of the call and of its edge, by time.
    """
    found = []
    for call in range(len(edges[0])):
        signs = np.sign([each[call] for each in edges])
        for edge, sign in enumerate(signs.T):
            known = np.flatnonzero(np.isfinite(sign) & (sign != 0.0))
            for k in np.flatnonzero(sign[known[:-1]] != sign[known[1:]]).tolist():
                found.append((int(known[k]), int(known[k + 1]), call, edge))
    return sorted(found)
