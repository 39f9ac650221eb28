"""Random problems whose truth does not come from this program.

A *kind* is a list of families; a family draws a deck and states the equations of its motion again,
in Python, or their closed form.  :func:`follow` integrates such equations with DOP853 or RADAU of
scipy, with steps that the family bounds by where the motion is (``pace``), twice, with other steps:
where both differ the truth is unknown.

A problem is fixed by kind, seed and number.
"""

from __future__ import annotations

import zlib
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace

import numpy as np
from scipy.integrate import DOP853, Radau

HEAD = "UNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1, PART=1"
#: Kinds of channels.
LENGTH, SPEED, ANGLE, RATE, RELATIVE, STATE, STATIC = (
    "length", "speed", "angle", "rate", "relative", "state", "static",
)  # fmt: skip
#: Accuracy of the two integrations of a truth, and the share of a range that they may differ by.
TIGHT, TIGHTER, DOUBT = 1e-10, 1e-12, 2e-5
#: The second integration has steps this much shorter.
SHORTER = 0.6
#: Steps of one integration after which a truth is given up.
MOST_STEPS = 60_000
#: A channel marked as sharp is compared with the truth of this share of END before and after.
BLUR = 1e-4
#: Times at which a closed form is looked at for the range of its channels.
SAMPLES = 2000

Values = Sequence[float]
Law = Callable[[float, np.ndarray], Values]
Pace = Callable[[float, np.ndarray], float]


class UnknownTruth(Exception):
    """Why the truth of a problem is not known."""


@dataclass(frozen=True)
class Channel:
    """A column of the results.

    sharp : it changes so fast, now and then, that a small error of time is a large one of it
    """

    column: str
    kind: str
    sharp: bool = False


@dataclass(frozen=True)
class Truth:
    """What a run has to print: least and largest value of every channel at output times.

    ranges : range of every channel in the whole motion
    """

    least: np.ndarray
    most: np.ndarray
    ranges: np.ndarray


@dataclass(frozen=True)
class Posed:
    """A deck, its channels, and how to find the truth.

    halts : the first and the last time [s] at which a SENSOR may end the run when its channel is
        off by a number; infinity: it need not
    """

    title: str
    text: str
    end: float
    steps: int
    channels: tuple[Channel, ...]
    solve: Callable[[], Truth]
    commands: tuple[str, ...] = ()
    halts: Callable[[float], tuple[float, float]] | None = None


@dataclass
class Draw:
    """Random numbers, of four digits as somebody types them, and the lines of a deck."""

    rng: np.random.Generator
    lines: list[str] = field(default_factory=list)
    requests: list[str] = field(default_factory=list)
    channels: list[Channel] = field(default_factory=list)

    def between(self, low: float, high: float) -> float:
        """A number between two others, even."""
        return float(f"{self.rng.uniform(low, high):.4g}")

    def decade(self, low: float, high: float) -> float:
        """A number between two powers of ten, even in its logarithm."""
        return float(f"{10.0 ** self.rng.uniform(low, high):.4g}")

    def pick(self, *options: str) -> str:
        """One of some words."""
        return str(self.rng.choice(options))

    def whole(self, low: int, high: int) -> int:
        """An integer of low to high."""
        return int(self.rng.integers(low, high + 1))

    def chance(self, share: float) -> bool:
        """True in this share of the draws."""
        return bool(self.rng.random() < share)

    def add(self, *lines: str) -> None:
        """Lines of the deck."""
        self.lines += lines

    def mass(self, number: int, mass: float, place: str = "0,0,0", speeds: str = "") -> None:
        """A point mass with a marker of its number."""
        self.add(
            f"POINT_MASS/{number}, MASS={mass!r}, CM={number}, QG={place}{speeds}",
            f"MARKER/{number}, POINT_MASS={number}",
        )

    def measure(self, kind: str, expression: str, sharp: bool = False) -> None:
        """A channel that is judged."""
        count = len(self.requests)
        request, component = divmod(count, 3)
        self.requests.append(expression)
        self.channels.append(Channel(f"REQUEST/{request + 1}.F{component + 2}", kind, sharp))

    def posed(self, end: float, solve: Callable[[np.ndarray], Truth], steps: int = 0) -> Posed:
        """The problem; ``solve`` gives the truth at output times."""
        steps = steps or int(self.rng.choice([5, 10, 20, 50]))
        for first in range(0, len(self.requests), 3):
            some = self.requests[first : first + 3]
            parts = "\\".join(f"F{k + 2}={each}" for k, each in enumerate(some))
            self.add(f"REQUEST/{first // 3 + 1}, {parts}")
        run = f"SIMULATE/DYNAMIC, END={end!r}, STEPS={steps}"
        text = "\n".join([HEAD, *self.lines, run, "END", ""])
        times = np.linspace(0.0, end, steps + 1)
        return Posed("", text, end, steps, tuple(self.channels), lambda: solve(times))

    def integrated(
        self, end: float, law: Law, start: Values, show: Law,
        pace: Pace | None = None, stiff: bool = False, steps: int = 0,
    ) -> Posed:  # fmt: skip
        """The problem whose truth is the solution of y' = law(t, y); ``show`` gives channels."""
        sharp = np.array([channel.sharp for channel in self.channels])

        def solve(times: np.ndarray) -> Truth:
            rows = around(times, BLUR * end if sharp.any() else 0.0)
            first, second = (
                follow(law, start, show, rows.ravel(), pace, share, tight, stiff)
                for share, tight in ((1.0, TIGHT), (SHORTER, TIGHTER))
            )
            return agreed(first, second, sharp, rows.shape[1])

        return self.posed(end, solve, steps)

    def closed(self, end: float, show: Callable[[float], Values], steps: int = 0) -> Posed:
        """The problem whose truth is a closed form of its channels."""

        def solve(times: np.ndarray) -> Truth:
            values = np.array([show(t) for t in times])
            samples = np.array([show(t) for t in np.linspace(0.0, end, SAMPLES)])
            return Truth(values, values, np.ptp(np.vstack([samples, values]), axis=0))

        return self.posed(end, solve, steps)


Family = Callable[[Draw], Posed]
KINDS: dict[str, list[Family]] = {}


def family(kind: str) -> Callable[[Family], Family]:
    """Add a family to a kind."""

    def register(make: Family) -> Family:
        KINDS.setdefault(kind, []).append(make)
        return make

    return register


def pose(kind: str, number: int, seed: int) -> Posed:
    """Problem ``number`` of a kind; families take turns."""
    families = KINDS[kind]
    make = families[number % len(families)]
    draw = Draw(np.random.default_rng([seed, number, zlib.crc32(kind.encode())]))
    posed = make(draw)
    title = f"{kind} {seed}-{number}: {make.__name__}"
    return replace(posed, title=title, text=f"{title}\n{posed.text}")


def follow(
    law: Law, start: Values, show: Law, times: np.ndarray, pace: Pace | None,
    share: float, tight: float, stiff: bool,
) -> tuple[np.ndarray, np.ndarray]:  # fmt: skip
    """Channels at some times and their ranges, by an integrator of scipy.

    Raises
    ------
    UnknownTruth
        When it takes too many steps or does not reach its end.
    """
    end, method = float(times[-1]), (Radau if stiff else DOP853)
    y0, small = np.array(start, float), 1e-2 * tight
    solver = method(law, 0.0, y0, end * (1.0 + 1e-9), rtol=tight, atol=small)
    seen = [np.array(show(0.0, y0), float)]
    found = [seen[0]] * int(np.sum(times <= 0.0))
    for _ in range(MOST_STEPS):
        if pace is not None:
            solver.max_step = share * max(pace(solver.t, solver.y), 1e-9 * end)
        if said := solver.step():
            raise UnknownTruth(f"scipy: {said}")
        dense = solver.dense_output()
        inside = times[(times > solver.t_old) & (times <= solver.t)]
        found += [np.array(show(t, dense(t)), float) for t in inside]
        seen.append(np.array(show(solver.t, solver.y), float))
        if solver.status != "running":
            break
    else:
        raise UnknownTruth("scipy takes too many steps")
    if not np.isfinite(seen).all():
        raise UnknownTruth("the motion is not finite")
    return np.array(found), np.ptp(np.vstack([seen, found]), axis=0)


def around(times: np.ndarray, blur: float) -> np.ndarray:
    """A row of times for every output time, the middle one of which it is."""
    if not blur:
        return times[:, None]
    rows = times[:, None] + np.linspace(-blur, blur, 9)
    return np.clip(rows, times[0], times[-1])


def agreed(
    first: tuple[np.ndarray, np.ndarray], second: tuple[np.ndarray, np.ndarray],
    sharp: np.ndarray, width: int,
) -> Truth:  # fmt: skip
    """The truth that two integrations agree upon; ``width`` times belong to each output.

    Raises
    ------
    UnknownTruth
        When they do not.
    """
    ranges = second[1]
    truths = []
    for values, _ in (first, second):
        grouped = values.reshape(-1, width, len(sharp))
        middle = grouped[:, width // 2]
        least = np.where(sharp, grouped.min(axis=1), middle)
        truths.append((least, np.where(sharp, grouped.max(axis=1), middle)))
    apart = max(
        float(np.max(np.abs(one - other) / np.where(ranges > 0.0, ranges, 1.0)))
        for one, other in zip(*truths, strict=True)
    )
    if not apart <= DOUBT:
        raise UnknownTruth(f"two integrations by scipy are {apart:.0e} apart")
    return Truth(*truths[1], ranges)
