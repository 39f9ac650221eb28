"""Whether lines of masses were pushed along themselves, which no stiffness against bending holds.

A force P that pushes two masses apart along their distance l has the stiffness -P/l across it, so
that whatever they are off the line grows as exp(s t), for masses in a row in the zigzag with

    s^2 = 2 (P/l) (1/m_i + 1/m_j).

The growth of a run is the largest, over the elements, of exp(integral of s dt), from the records.
Where it lifts round-off to what a user sees, no method and no ERROR gives the end of the run, and
two runs that differ in their last digit differ altogether.
Reference: Ziegler, Principles of Structural Stability, 1968, section 1.2.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from adamslite.model import POINT, Model

ROUND_OFF = 2e-16
# Share of the way that grown round-off may come to untold.
FELT = 1e-3
FORCES = ("SFORCE", "SPRINGDAMPER")


def buckled(model: Model, names: tuple[str, ...], time: np.ndarray, values: np.ndarray) -> str:
    """The element that pushed longest and hardest, and what grew by that; empty when little did.

    names, values : columns of the records, (nt, len(names));  time : (nt,)
    """
    column = {name: k for k, name in enumerate(names)}
    worst, most = None, -np.log(ROUND_OFF / FELT)
    for element in _struts(model, column):
        grown = _exponent(model, element, column, time, values)
        if grown > most:
            worst, most = element, grown
    if worst is None:
        return ""
    return (
        f"{worst.label} pushed masses apart that nothing keeps in line: what they are off it, even"
        f" round-off, grew up to {np.exp(min(most, 700.0)):.0e} times, and behind that no ERROR"
        " tells where they are; let a cable only pull (MAX), or give it a stiffness against bending"
    )


def _struts(model: Model, column: dict[str, int]) -> list[Any]:
    """Forces along the line between point masses, or one and the ground, that are recorded."""
    found = []
    for element in (s for word in FORCES for s in model.deck.of(word)):
        ends = [model.marker(end) for end in (element.i, element.j)]
        if f"{element.label}.f" not in column or element.kind.startswith("ROT") or None in ends:
            continue
        bodies = [end.body for end in ends]
        points = [b for b in bodies if b >= 0 and model.bodies[b].width == POINT]
        if points and len(points) == sum(b >= 0 for b in bodies):
            found.append(element)
    return found


def _exponent(
    model: Model, element: Any, column: dict[str, int], time: np.ndarray, values: np.ndarray
) -> float:
    """Integral of the growth rate of one element over the records."""
    push = np.maximum(values[:, column[f"{element.label}.f"]], 0.0)
    if not push.any():
        return 0.0
    apart, compliance = np.zeros((len(time), 3)), 0.0
    for sign, end in ((1.0, model.marker(element.i)), (-1.0, model.marker(element.j))):
        if end.body < 0:
            apart += sign * end.p
        else:
            body = model.bodies[end.body]
            at = [column[f"{body.statement.label}.{axis}"] for axis in "xyz"]
            apart += sign * values[:, at]
            compliance += 1.0 / body.mass if body.mass > 0.0 else 0.0
    length = np.linalg.norm(apart, axis=1)
    rate = np.sqrt(2.0 * compliance * push / np.where(length > 0.0, length, np.inf))
    rate = np.nan_to_num(rate)
    return float(0.5 * (rate[1:] + rate[:-1]) @ np.diff(time))
