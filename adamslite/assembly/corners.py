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

# Times at which edges are evaluated, halvings of the interval in which one passes through zero.
SAMPLES, HALVINGS = 400, 60
# How near an edge both sides are, of the time there is; jumps of less than a share of the largest
# value or slope are none.
BESIDE, LEAST = 1e-7, 1e-4


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


def corner(model: Model, node: Node, least: int, until: float) -> tuple[str, float] | None:
    """The function behind the first corner up to a time, and when; None where there is none.

    ``node`` depends on TIME alone.
    """
    grid = np.linspace(0.0, until, SAMPLES + 1)
    follow = _Follower(model)
    values = np.array([follow.at(node, t) for t in grid.tolist()])
    sizes = np.nanmax(np.abs(values), axis=0, initial=0.0)
    found = []
    for call in suspects(model, node, least):
        for t in _edges(follow, call, grid):
            before, after = (follow.at(node, t + side * BESIDE * until) for side in (-1, 1))
            jumps = np.abs(after - before) > LEAST * sizes
            if jumps[: least + 1].any():
                found.append((t, call.name))
    return (min(found)[1], min(found)[0]) if found else None


class _Follower:
    """Values of expressions at any time."""

    def __init__(self, model: Model) -> None:
        self.model = model
        self.posture = Posture.start(model)

    def _reader(self, time: float) -> NumberReader:
        reader = NumberReader(self.model, self.posture, True, rates=True, room=0)
        reader.now = time
        return reader

    def at(self, node: Node, time: float) -> np.ndarray:
        """Value and slope (2,)."""
        with with_numbers():
            found = self._reader(time).value(node)
        slope = found.slope[-1] if np.ndim(found.slope) else 0.0
        return np.array([found.value, slope])

    def edges(self, call: Call, time: float) -> list[float]:
        """What passes through zero where a function is not smooth."""
        edges = FUNCTIONS[call.name].edges
        with with_numbers():
            found = edges(*self._reader(time).arguments(call)) if edges else ()
        return [each.value if isinstance(each, Dual) else float(each) for each in found]


def _edges(follow: _Follower, call: Call, grid: np.ndarray) -> Iterator[float]:
    """The times at which an edge of a call passes through zero."""
    signs = np.sign([follow.edges(call, t) for t in grid.tolist()])
    for column, sign in enumerate(signs.T):
        known = np.flatnonzero(np.isfinite(sign) & (sign != 0.0))
        for first, last in zip(known[:-1], known[1:], strict=True):
            if sign[first] != sign[last]:
                yield _crossing(follow, call, column, float(grid[first]), float(grid[last]))


def _crossing(follow: _Follower, call: Call, column: int, low: float, high: float) -> float:
    start = np.sign(follow.edges(call, low)[column])
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        if np.sign(follow.edges(call, middle)[column]) == start:
            low = middle
        else:
            high = middle
    return 0.5 * (low + high)
