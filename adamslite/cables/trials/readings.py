"""What is read off a run of a cable scene: the figures that its accuracy is asked for.

Greatest, least and mean tension at both ends of every span, as shares of the greatest there, and
greatest, least and mean place of every weight, as shares of its way. Tensions are means over half
the time of a wave along the span: a front's overshoot in a chain of masses is none of the cable's.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import inf, sqrt

import numpy as np

from adamslite.cables.deck.form_rules import runs_in
from adamslite.cables.description.vocabulary import Spec
from adamslite.cables.layout.geometry import FreeSpan
from adamslite.cables.statements.pieces import Piece, pieces
from adamslite.cables.statements.sliders import is_wire
from adamslite.cables.statements.span_statements import is_kept

# Of the time of a wave along the span: what a tension is the mean of.
SEEN = 0.5
# Of the length of the cable: weights that move by less do not.
STILL = 2e-8
# What a difference may be of the one before it: powers 2 and 2/3 of the sections; at most, where
# sections are too few to show a power; and safety on what that leaves.
FASTEST, SLOWEST, LARGEST, SAFETY = 0.25, 0.63, 1.0, 1.25
# Output steps: a weight that meets a wheel within so many ended the run, so many ago at most.
HITS, LATE = 1.5, 3.5
# Keeps quotients finite.
NOTHING = 1e-12
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
    moved = (i for i, each in enumerate(spec.route) if each.is_free or each.is_wheel)
    return (*dict.fromkeys(found), *(name for i in moved for name in _places(spec, i)))


def read_off(spec: Spec, spans: list[FreeSpan], run: Series) -> Readings:
    """The figures of a run."""
    found: dict[Key, tuple[np.ndarray, float]] = {}
    step = (run.time[-1] - run.time[0]) / max(len(run.time) - 1, 1)
    for piece in pieces(spec, spans):
        transit = piece.span.length / spec.cable.speed
        window = round(SEEN * transit / step) if step > 0 else 0
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


def collision(spec: Spec, run: Series) -> str:
    """The weight that runs into a wheel at the end of an early-ended run; empty without one.

    Its span, sqrt(d^2 - R^2) long, would have no length before the next output step; behind that
    the last rows may have any.
    """
    step = float(np.median(np.diff(run.time))) if len(run.time) > 1 else 0.0
    late = run.time[1:] > run.time[-1] - LATE * step if step else ()
    for i, j in [*spec.pairs, *(pair[::-1] for pair in spec.pairs)]:
        weight, wheel = spec.route[i], spec.route[j]
        if step and weight.kind in ("mass", "body") and wheel.is_wheel:
            squares = ((_way(spec, i, run) - _way(spec, j, run)) ** 2).sum(axis=0)
            lengths = np.sqrt(np.maximum(squares - wheel.radius**2, 0.0))
            left = lengths[1:] / np.maximum(-np.diff(lengths), NOTHING)  # in steps
            for k in np.flatnonzero(late & (left < HITS))[:1]:
                return runs_in(spec, i, j, run.time[k + 1] + left[k] * step)
    return ""


def _way(spec: Spec, i: int, run: Series) -> np.ndarray:
    """Places of a station over time: (3, nt); where it is drawn if they are no columns."""
    still = np.ones(len(run.time))
    names = zip(_places(spec, i), spec.route[i].at, strict=True)
    return np.array([run.columns.get(name, x * still) for name, x in names])


def _weights(spec: Spec) -> list[int]:
    return [i for i, each in enumerate(spec.route) if each.is_free]


def _places(spec: Spec, i: int) -> list[str]:
    each = spec.route[i]
    word = "PART" if each.kind == "body" or each.is_wheel else "POINT_MASS"
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


Doubts = Mapping[Key, np.ndarray]
"""How far greatest, least and mean of a figure may be off, as shares of its scale."""


def apart(
    one: Readings, truth: Readings, asked: tuple[str, ...], doubts: Doubts | None = None
) -> tuple[float, Key, int]:
    """The largest difference of an asked figure as a share of its scale, with what the truth may
    be off itself, and which it is: inf where one of them has no such figure."""
    worst: tuple[float, Key, int] = (0.0, ("", 0, 0), 0)
    for key in _asked(truth, asked):
        if key not in one.figures:
            return inf, key, 0
        off = np.abs(_difference(key, one, truth, truth))
        if doubts is not None:
            off = off + doubts[key]
        if not off.max() <= worst[0]:
            worst = float(off.max()), key, int(off.argmax())
    return worst


def doubts_of(finer: Sequence[Readings], asked: tuple[str, ...]) -> dict[Key, np.ndarray]:
    """How far the last of some finer and finer models may be off, by figure.

    With d the last difference and f what it is of the one before, it is d f/(1 - f) where
    differences fall with one sign, with some safety: those of fronts fall more slowly. Where they
    do not fall yet they are taken to fall as slowly as those of fronts from here on. Where they
    change their sign the truth lies between the last two models, which is said with some safety;
    of two models the difference is taken.
    """
    truth, found = finer[-1], {}
    for key in _asked(truth, asked):
        if any(key not in each.figures for each in finer[-3:]):
            found[key] = np.full(len(WORDS), inf)
            continue
        last = _difference(key, truth, finer[-2], truth)
        found[key] = np.abs(last)
        if len(finer) > 2:
            before = _difference(key, finer[-2], finer[-3], truth)
            share = last / np.where(before == 0, NOTHING, before)
            next_one = np.abs(last) * np.clip(share, FASTEST, LARGEST)
            rest = SAFETY * next_one / (1 - np.clip(share, FASTEST, SLOWEST))
            found[key] = np.where(share > 0, rest, SAFETY * np.abs(last))
    return found


def differences(
    one: Readings, other: Readings, truth: Readings, asked: tuple[str, ...]
) -> dict[Key, np.ndarray]:
    """How far two models are apart, by figure, with some safety, where both have it."""
    return {
        key: SAFETY * np.abs(_difference(key, one, other, truth))
        for key in _asked(truth, asked)
        if key in one.figures and key in other.figures
    }


def larger(one: Doubts, other: Doubts) -> dict[Key, np.ndarray]:
    """Of two doubts the larger, by figure."""
    return {key: np.maximum(each, other.get(key, 0.0)) for key, each in one.items()}


def _asked(of: Readings, asked: tuple[str, ...]) -> list[Key]:
    return [key for key, (_, scale) in of.figures.items() if key[0] in asked and scale > 0]


def _difference(key: Key, one: Readings, other: Readings, truth: Readings) -> np.ndarray:
    """Of a figure, as a share of its scale."""
    found: np.ndarray = (one.figures[key][0] - other.figures[key][0]) / truth.figures[key][1]
    return found


def named(key: Key, which: int) -> str:
    """What a figure is called."""
    kind, i, k = key
    if kind == "tension":
        return f"{WORDS[which]} tension of span {i}"
    return f"{WORDS[which]} {AXES[k]} of station {i + 1}"
