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

from collections.abc import Iterable
from typing import TYPE_CHECKING

import numpy as np

from adamslite.model.model import POINT

if TYPE_CHECKING:
    from adamslite.elements.sforce import Sforce
    from adamslite.elements.springdamper import Springdamper
    from adamslite.model.geometry import Place
    from adamslite.model.model import Model

    Strut = Sforce | Springdamper

# The exponential of more is beyond the range of numbers.
EXP_LIMIT = 700.0
ROUND_OFF = 2e-16
# Share of the way that grown round-off may come to untold.
FELT = 1e-3
# Numbers of records that are processed together.
BLOCK = 2**18


def buckled(model: Model, names: tuple[str, ...], time: np.ndarray, values: np.ndarray) -> str:
    """The element that pushed longest and hardest, and what grew by that; empty when little did.

    names, values : columns of the records, (nt, len(names));  time : (nt,)
    """
    column = {name: k for k, name in enumerate(names)}
    struts = _pushed(_struts(model, column), column, values)
    size = max(1, BLOCK // max(1, len(time)))
    blocks = (struts[k : k + size] for k in range(0, len(struts), size))
    found = [_exponents(model, block, column, time, values) for block in blocks]
    grown = np.concatenate([np.zeros(0), *found])
    most = grown.max(initial=0.0)
    if not most > -np.log(ROUND_OFF / FELT):
        return ""
    worst = struts[int(grown.argmax())]
    return (
        f"{worst.label} pushed masses apart that nothing keeps in line: their distance from it,"
        f" even round-off, grew up to {np.exp(min(most, EXP_LIMIT)):.0e} times, so that ERROR does"
        " not bound their positions; let a cable only pull (MAX), or give it a bending stiffness"
    )


def _struts(model: Model, column: dict[str, int]) -> list[Strut]:
    """Forces along the line between point masses, or one and the ground, that are recorded."""
    found = []
    elements: list[Strut] = [*model.deck.of("SFORCE"), *model.deck.of("SPRINGDAMPER")]
    for element in elements:
        ends = [model.marker(end) for end in (element.i, element.j)]
        if f"{element.label}.f" not in column or element.kind == "ROTATIONAL":
            continue
        bodies = [end.body for end in ends]
        points = [b for b in bodies if b >= 0 and model.bodies[b].width == POINT]
        if points and len(points) == sum(b >= 0 for b in bodies):
            found.append(element)
    return found


def _pushed(struts: list[Strut], column: dict[str, int], values: np.ndarray) -> list[Strut]:
    """Those that push somewhere in the records."""
    forces = values[:, [column[f"{each.label}.f"] for each in struts]]
    pushed = np.flatnonzero((~(forces <= 0.0)).any(axis=0))
    return [struts[k] for k in pushed.tolist()]


def _exponents(
    model: Model, struts: list[Strut], column: dict[str, int], time: np.ndarray, values: np.ndarray
) -> np.ndarray:
    """Integral of the growth rate of each element over the records, (len(struts),)."""
    ends = [[model.marker(end) for end in (each.i, each.j)] for each in struts]
    (x, a), (y, b) = (_ends(model, side, column, values) for side in zip(*ends, strict=True))
    length = np.linalg.norm(x - y, axis=2)
    push = np.maximum(values[:, [column[f"{each.label}.f"] for each in struts]], 0.0)
    rate = np.sqrt(2.0 * (a + b) * push / np.where(length > 0.0, length, np.inf))
    rate = np.nan_to_num(rate)
    return 0.5 * np.diff(time) @ (rate[1:] + rate[:-1])


def _ends(
    model: Model, places: Iterable[Place], column: dict[str, int], values: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Where ends are, (nt, n, 3), and what a force of 1 does to them, (n,)."""
    at, fixed, compliance = [], [], []
    for place in places:
        body = model.bodies[place.body] if place.body >= 0 else None
        label = body and body.statement.label
        at.append([column[f"{label}.{axis}"] for axis in "xyz"] if body else [0, 0, 0])
        fixed.append([np.nan] * 3 if body else place.p)
        compliance.append(1.0 / body.mass if body and body.mass > 0.0 else 0.0)
    held = np.array(fixed)
    return np.where(np.isnan(held), values[:, at], held), np.array(compliance)
