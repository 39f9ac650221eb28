"""Detects lines of masses that were pushed along themselves and amplified round-off.

A force P that pushes two masses apart along their distance l has the stiffness -P/l across it, so
that whatever they are off the line grows as exp(s t), for masses in a row in the zigzag with

    s^2 = 2 (P/l) (1/m_i + 1/m_j).

The growth of a run is the largest, over the elements, of exp(integral of s dt), from the records.
Where it lifts round-off to what a user sees, no method and no ERROR gives the end of the run, and
two runs that differ in their last digit differ altogether.
Reference: Ziegler, Principles of Structural Stability, 1968, section 1.2.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from adamslite.model.model import POINT

if TYPE_CHECKING:
    from adamslite.analyses.dynamics.history import History
    from adamslite.elements.sforce import Sforce
    from adamslite.elements.springdamper import Springdamper
    from adamslite.model.geometry import Place
    from adamslite.model.model import Model


ROUND_OFF = 2e-16
# Share of the way that grown round-off may come to untold.
FELT = 1e-3
# Numbers of records that are processed together.
BLOCK = 2**16


class _Strut(NamedTuple):
    """A force along a line, the column of its record, and its ends."""

    element: Sforce | Springdamper
    force: int
    i: Place
    j: Place


def buckled(model: Model, history: History) -> str:
    """The element that pushed longest and hardest, and what grew by that; empty when little did."""
    column = {name: k for k, name in enumerate(history.names)}
    struts = _pushed(_struts(model, column), history)
    grown = np.zeros(len(struts))
    ends = _Ends(model, column)
    for time, values in _overlapping(history) if struts else ():
        size = max(1, BLOCK // max(1, len(time)))
        for k in range(0, len(struts), size):
            grown[k : k + size] += _exponents(struts[k : k + size], ends, time, values)
    most = grown.max(initial=0.0)
    if not most > -np.log(ROUND_OFF / FELT):
        return ""
    worst = struts[int(grown.argmax())].element
    return (
        f"{worst.label} pushed masses apart that nothing keeps in line: their distance from it,"
        f" even round-off, grew {_times(most)} times, so that ERROR does"
        " not bound their positions; let a cable only pull (MAX), or give it a bending stiffness"
    )


def _times(exponent: float) -> str:
    """How much something grew; from round-off to the size of the model it is everything."""
    return f"up to {np.exp(exponent):.0e}" if exponent < -np.log(ROUND_OFF) else "more than 1e+15"


def _struts(model: Model, column: dict[str, int]) -> list[_Strut]:
    """Forces along the line between point masses, or one and the ground, that are recorded."""
    found = []
    for element in (*model.deck.of("SFORCE"), *model.deck.of("SPRINGDAMPER")):
        force = column.get(f"{element.label}.f")
        if force is None or element.kind == "ROTATIONAL" or _is_action(element):
            continue
        i, j = model.marker(element.i), model.marker(element.j)
        bodies = [end.body for end in (i, j) if end.body >= 0]
        if bodies and all(model.bodies[b].width == POINT for b in bodies):
            found.append(_Strut(element, force, i, j))
    return found


def _is_action(element: Sforce | Springdamper) -> bool:
    """Whether a force acts on one body only, along an axis instead of the line between both."""
    return element.keyword == "SFORCE" and bool(getattr(element, "actiononly", False))


def _pushed(struts: list[_Strut], history: History) -> list[_Strut]:
    """Those that push somewhere in the records."""
    places, pushed = [each.force for each in struts], np.zeros(len(struts), dtype=bool)
    for _, values in history.blocks() if struts else ():
        pushed |= (~(values[:, places] <= 0.0)).any(axis=0)
    return [struts[k] for k in np.flatnonzero(pushed).tolist()]


def _overlapping(history: History) -> Iterator[tuple[np.ndarray, np.ndarray]]:
    """The blocks of the records, each with the last row of the one before."""
    last: tuple[np.ndarray, np.ndarray] | None = None
    for time, values in history.blocks():
        before = ([time], [values]) if last is None else ([last[0], time], [last[1], values])
        yield np.concatenate(before[0]), np.concatenate(before[1])
        last = time[-1:], values[-1:]


def _exponents(
    struts: list[_Strut], ends: _Ends, time: np.ndarray, values: np.ndarray
) -> np.ndarray:
    """Integral of the growth rate of each element over the records, (len(struts),)."""
    (x, a), (y, b) = (
        ends.at(side, values) for side in ([each.i for each in struts], [each.j for each in struts])
    )  # fmt: skip
    length = np.linalg.norm(x - y, axis=2)
    push = np.maximum(values[:, [each.force for each in struts]], 0.0)
    rate = np.sqrt(2.0 * (a + b) * push / np.where(length > 0.0, length, np.inf))
    rate = np.nan_to_num(rate)
    return 0.5 * np.diff(time) @ (rate[1:] + rate[:-1])


class _Ends:
    """Where the ends of forces are, by the columns of their bodies."""

    def __init__(self, model: Model, column: dict[str, int]) -> None:
        self.model, self.column = model, column
        self.known: dict[int, tuple[list[int], float]] = {}

    def at(self, places: list[Place], values: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Where they are, (nt, n, 3), and what a force of 1 does to them, (n,)."""
        known = [self._body(place.body) for place in places]
        found = values[:, [columns for columns, _ in known]]
        held = [k for k, place in enumerate(places) if place.body < 0]
        if held:
            found[:, held] = [places[k].p for k in held]
        return found, np.array([compliance for _, compliance in known])

    def _body(self, number: int) -> tuple[list[int], float]:
        """The columns of a body, any of the ground, and its compliance."""
        if number < 0:
            return [0, 0, 0], 0.0
        if number not in self.known:
            body = self.model.bodies[number]
            label = body.statement.label
            columns = [self.column[f"{label}.{axis}"] for axis in "xyz"]
            self.known[number] = columns, 1.0 / body.mass if body.mass > 0.0 else 0.0
        return self.known[number]
