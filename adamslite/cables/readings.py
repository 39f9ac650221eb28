"""What is read off a run of a cable scene: the figures that its accuracy is asked for.

Greatest, least and mean tension at both ends of every span, as shares of the greatest there, and
greatest, least and mean place of every weight, as shares of its way. Tensions are means over half
the time of a wave along the cable: a front's overshoot in a chain of masses is none of the cable's.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from math import inf, sqrt

import numpy as np

from adamslite.cables.geometry import FreeSpan
from adamslite.cables.pieces import Piece, pieces
from adamslite.cables.sliders import is_wire
from adamslite.cables.span_statements import is_kept
from adamslite.cables.vocabulary import Spec

# Of the time of a wave along the longest span: what a tension is the mean of.
SEEN = 0.5
# Of the length of the cable: weights that move by less do not.
STILL = 1e-6
WORDS = ("greatest", "least", "mean")
AXES = "xyz"
Key = tuple[str, int, int]
"""tension, span, end; or position, station, axis."""


@dataclass(frozen=True)
class Series:
    """Columns of a run over its time."""

    time: np.ndarray
    columns: Mapping[str, np.ndarray]


@dataclass(frozen=True)
class Readings:
    """Figures and the scale of each."""

    figures: Mapping[Key, tuple[np.ndarray, float]]

    @property
    def lowest(self) -> tuple[float, float]:
        """The least tension as a share of the greatest at its place, and itself; 0 without one."""
        both = [(values[1] / scale, float(values[1])) for key, (values, scale)
                in self.figures.items() if key[0] == "tension" and scale > 0]  # fmt: skip
        return min(both, default=(0.0, 0.0))


def columns(spec: Spec, spans: list[FreeSpan]) -> tuple[str, ...]:
    """Names of all columns that are read, at any level."""
    found = [name for piece in pieces(spec, spans) for name in _tensions(spec, piece)]
    return (*dict.fromkeys(found), *(name for i in _weights(spec) for name in _places(spec, i)))


def read_off(spec: Spec, spans: list[FreeSpan], run: Series) -> Readings:
    """The figures of a run."""
    found: dict[Key, tuple[np.ndarray, float]] = {}
    transit = max(span.length for span in spans) / spec.cable.speed
    step = (run.time[-1] - run.time[0]) / max(len(run.time) - 1, 1)
    window = round(SEEN * transit / step) if step > 0 else 0
    for piece in pieces(spec, spans):
        for end, pull in _pulls(spec, piece, run).items():
            mean = smoothed(pull, window)
            found["tension", piece.number, end] = _summed(mean), float(np.abs(mean).max())
    for i in _weights(spec):
        ways = [run.columns[name] for name in _places(spec, i) if name in run.columns]
        ways = [way - way[0] for way in ways]
        moved = sqrt(sum(float(np.abs(way).max()) ** 2 for way in ways))
        if moved > STILL * max(span.length for span in spans):
            for axis, way in enumerate(ways):
                found["position", i, axis] = _summed(way), moved
    return Readings(found)


def _weights(spec: Spec) -> list[int]:
    return [i for i, each in enumerate(spec.route) if each.is_free]


def _places(spec: Spec, i: int) -> list[str]:
    word = "PART" if spec.route[i].kind == "body" else "POINT_MASS"
    return [f"{word}/{spec.marker(i)}.{axis}" for axis in AXES]


def _tensions(spec: Spec, piece: Piece) -> list[str]:
    """Columns of a span: of elastic cables, and of the rigid one."""
    slides = spec.route[piece.root].slides
    rigid = piece.root if slides else piece.label
    return [f"REQUEST/{piece.label}.F2", f"REQUEST/{piece.label}.F3", f"GCON/{rigid}.f"]


def _pulls(spec: Spec, piece: Piece, run: Series) -> dict[int, np.ndarray]:
    """Tensions at root and tip; of a rigid cable one for both, none where nothing keeps it."""
    *both, rigid = _tensions(spec, piece)
    if both[0] in run.columns:
        found = {end: run.columns.get(name) for end, name in enumerate(both)}
        return {end: pull for end, pull in found.items() if pull is not None and np.any(pull)}
    on_wire = spec.route[piece.root].slides and is_wire(spec, piece.root)
    if rigid not in run.columns or on_wire or not is_kept(spec, piece):
        return {}
    return dict.fromkeys((0, 1), -run.columns[rigid])


def _summed(values: np.ndarray) -> np.ndarray:
    return np.array([values.max(), values.min(), values.mean()])


def smoothed(values: np.ndarray, window: int) -> np.ndarray:
    """Its moving mean."""
    if window < 2 or window >= len(values):
        return values
    sums = np.concatenate([[0.0], np.cumsum(values)])
    found: np.ndarray = (sums[window:] - sums[:-window]) / window
    return found


def apart(one: Readings, truth: Readings, asked: tuple[str, ...]) -> tuple[float, Key, int]:
    """The largest difference of an asked figure as a share of its scale, and which it is: inf where
    one of them has no such figure."""
    worst: tuple[float, Key, int] = (0.0, ("", 0, 0), 0)
    for key, (exact, scale) in truth.figures.items():
        if key[0] not in asked or not scale > 0:
            continue
        if key not in one.figures:
            return inf, key, 0
        off = np.abs(one.figures[key][0] - exact) / scale
        if not off.max() <= worst[0]:
            worst = float(off.max()), key, int(off.argmax())
    return worst


def named(key: Key, which: int) -> str:
    """What a figure is called."""
    kind, i, k = key
    if kind == "tension":
        return f"{WORDS[which]} tension of span {i}"
    return f"{WORDS[which]} {AXES[k]} of station {i + 1}"
