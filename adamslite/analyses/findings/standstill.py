"""Motion by the rows of a run: joints that stood still, which could be FIXED, and its energy.

Places are those of I relative to J, along the axes of J, at all output times.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from adamslite.elements.joint import Joint
from adamslite.elements.marker import Marker
from adamslite.model.attitude_angles import rotations_313

if TYPE_CHECKING:
    from adamslite.analyses.dynamics.history import History
    from adamslite.deck.deck import Deck
    from adamslite.language.interfaces import Key
    from adamslite.model.model import Model
    from adamslite.results.results import Results

#: Of the extent of the motion, and an angle: what moves less stands still.
STILL = 1e-6
#: Larger models are not looked at: it would take a noticeable part of the run.
MOST_JOINTS, MOST_PLACES = 30, 20_000
# A way below this share of a coordinate is its rounding: the body is at rest.
ROUNDING = 1e-12
#: What names a joint, and does not need it to be of its kind.
INDIFFERENT = frozenset({"FRICTION", "GRAPHICS", "INFO", "MREQUEST", "REQUEST", "SENSOR"})
#: So many are named.
MOST_NAMED = 5


class Frame(NamedTuple):
    """Places (nt, 3) and axes (nt, 3, 3) of a marker in ground, or (3,) and (3, 3) where fixed."""

    place: np.ndarray
    axes: np.ndarray


def _needed(deck: Deck) -> set[tuple[str, Key]]:
    """What is named by something that acts, and so needs a joint to be of its kind."""
    from adamslite.model.mergeable import referred

    acting = (each for each in deck.statements if each.keyword not in INDIFFERENT)
    return {each for statement in acting for each in referred(statement)}


class Parts:
    """Frames of markers by the columns of the results."""

    def __init__(self, model: Model, column: dict[str, int], values: np.ndarray) -> None:
        self.model = model
        self.column = column
        self.values = values
        self.known: dict[str, Frame] = {}

    def extent(self) -> float:
        """The largest way of a part along an axis."""
        places = [k for name, k in self.column.items() if name.endswith((".x", ".y", ".z"))]
        return float(np.ptp(self.values[:, places], axis=0).max(initial=0.0))

    def moved(self, joint: Joint) -> tuple[float, float] | None:
        """How far I went from where it was to J, and turned; None of what has no columns."""
        seen = self.seen(joint.i, joint.j)
        if seen is None:
            return None
        way, turn = np.ptp(seen.place, axis=0), np.ptp(seen.axes, axis=0)
        return float(way.max()), float(turn.max())

    def seen(self, marker: Key, observer: Key) -> Frame | None:
        """A marker as seen from another; None of what has no columns."""
        i, j = self.frame(marker), self.frame(observer)
        if i is None or j is None:
            return None
        across = np.swapaxes(j.axes, -1, -2)
        return Frame((across @ (i.place - j.place)[..., None])[..., 0], across @ i.axes)

    def frame(self, marker: Key) -> Frame | None:
        """The frame of a marker; None where its part has no columns."""
        fixed = self.model.marker(marker)
        if fixed is None or fixed.body < 0:
            return Frame(fixed.p[None], fixed.axes[None]) if fixed else None
        owner = self.model.deck.get(Marker, marker).owner
        part = self.model.deck.find(*owner) if owner else None
        if part is None or f"{part.label}.x" not in self.column:
            return None
        centre, own = self.model.marker_in_body(part.cm)
        at = self.of_body(part.label)
        origin, axes = self.model.marker_in_body(marker)
        base = at.axes @ own.T
        return Frame(at.place + base @ (origin - centre), base @ axes)

    def of_body(self, label: str) -> Frame:
        """The mass centre of a body in ground; what does not turn has the axes of the start."""
        if label not in self.known:
            first = self.column[f"{label}.x"]
            place, angles = self.values[:, first : first + 3], self.values[:, first + 3 : first + 6]
            turns = f"{label}.psi" in self.column
            axes = rotations_313(angles) if turns else np.eye(3)[None]
            self.known[label] = Frame(place, axes)
        return self.known[label]


def standing(model: Model, history: History) -> str:
    """The joints that did not move though something did, in a sentence; empty without any."""
    joints = [j for j in model.deck.of(Joint) if model.acts(j) and j.coordinates]
    most = min(MOST_JOINTS, MOST_PLACES / max(history.count, 1))
    if history.count < 3 or not 1 < len(joints) <= most:
        return ""
    table = history.whole
    parts = Parts(model, {name: k for k, name in enumerate(table.names)}, table.values)
    moved = {j: found for j in joints if (found := parts.moved(j)) is not None}
    extent = parts.extent()
    still = {j: by for j, by in moved.items() if by[0] <= STILL * extent and by[1] <= STILL}
    if not still or not extent > 0.0:
        return ""
    needed = _needed(model.deck)
    still = {j: by for j, by in still.items() if ("JOINT", j.key) not in needed}
    if not still:
        return ""
    labels = [j.label for j in still]
    more = f" and {len(still) - MOST_NAMED} more" if len(still) > MOST_NAMED else ""
    by, turned = (max(each[k] for each in still.values()) for k in (0, 1))
    return (
        f"{', '.join(labels[:MOST_NAMED])}{more} moved by at most {by:.2g} and {turned:.2g} rad "
        "at the output times: FIXED would do the same"
    )


def largest_travel(history: History) -> float:
    """The largest range of a place of a body; 0 where nothing moves beyond rounding."""
    places = [k for k, name in enumerate(history.names) if name.endswith((".x", ".y", ".z"))
              and name.startswith(("PART/", "POINT_MASS/"))]  # fmt: skip
    least, most = np.full(len(places), np.inf), np.full(len(places), -np.inf)
    for _, values in history.blocks():
        least = np.minimum(least, values[:, places].min(axis=0))
        most = np.maximum(most, values[:, places].max(axis=0))
    travel = float((most - least).max(initial=0.0))
    size = float(np.maximum(-least, most).max(initial=0.0))
    return travel if ROUNDING * size < travel < np.inf else 0.0


def energy_apart(model: Model, history: History, second: Results) -> float:
    """The largest kinetic energy of what lies between two runs, over the largest of the first."""
    run, weight = history.whole, dict[str, float]()
    for body in model.bodies:
        turning = float(np.abs(body.inertia).max(initial=0.0))
        for axis in "xyz":
            weight[f"{body.statement.label}.v{axis}"] = body.mass
            weight[f"{body.statement.label}.w{axis}"] = turning
    weights = np.array([weight.get(name, 0.0) for name in run.names])
    rows = min(run.count, len(second.time))
    apart = run.values[:rows] - np.asarray(second.values)[:rows]
    most = float((np.nan_to_num(run.values[:rows]) ** 2 @ weights).max(initial=0.0))
    return float((np.nan_to_num(apart) ** 2 @ weights).max(initial=0.0)) / (most or 1.0)
