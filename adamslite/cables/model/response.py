"""What a cable scene does with few sections and with many, by its linear model.

Along the cable it is a :class:`~adamslite.cables.model.network.Network` of springs and masses;
across it is a string whose slopes y' need the elongation y'^2/2, which drives the springs. Compared
are the figures that a user reads: the greatest, least and mean tension at both ends of every span,
and the greatest, least and mean place of every weight.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from math import inf, isfinite, log2, sqrt

import numpy as np

from adamslite.cables.model.network import Motion, Network, Sections, respond

# Sections that are tried, and those that stand for a cable.
COUNTS = (1, 2, 3, 4, 6, 8, 11, 16, 23, 32, 45, 64)
MANY = 128
# Instants of a run: in a period of a weight on its cable, in the time of a wave along it.
IN_A_BOUNCE, IN_A_TRANSIT = 24, 6
FEWEST, MOST = 300, 3000
# Weights that move by less than this share of the cable's length do not.
STILL = 1e-7
# Time of the mean in which fronts are seen, in times of a wave along the cable.
SEEN = 0.5
# Of instants: time of the mean in which kinks are seen.
SMOOTH = 4.0
# Key of the rigid cable among numbers of sections.
RIGID = 0
# Errors of twice the sections: between the powers 2 and 1 of their number.
FASTEST, SLOWEST = 0.25, 0.5
# Keeps quotients finite [N].
NOTHING = 1e-12


@dataclass(frozen=True)
class String:
    """The motion of some spans across their lines; `bars` are those spans in the network along
    them, `weight` the coordinate of the weight there, with its number."""

    network: Network
    bars: tuple[int, ...]
    weight: int


@dataclass(frozen=True, eq=False)
class Machine:
    """A scene: along and across its cable.

    `rests` are the tensions at the start and finish of every span at rest, `weights` the
    coordinates of every weight, `transit` the time of a wave along the longest span.
    """

    network: Network
    strings: tuple[String, ...]
    rests: np.ndarray
    weights: tuple[tuple[int, ...], ...]
    transit: float
    known: dict[int, Figures] = field(default_factory=dict)

    @property
    def rigidity(self) -> float:
        """EA [force]."""
        return self.network.bars[0].pull[0]

    @property
    def longest(self) -> float:
        """Span."""
        return max(bar.length for bar in self.network.bars)


@dataclass(frozen=True)
class Figures:
    """Tensions and places: greatest, least and mean of each, and what errors are a share of."""

    tension: dict[int, tuple[np.ndarray, float]]
    position: dict[int, tuple[np.ndarray, float]]
    lowest: float = inf
    ringing: float = 0.0


def instants(end: float, transit: float, bounce: float) -> int:
    """Of a run: fine enough for bounces, and for waves where they are not too many."""
    fine = end / (transit / IN_A_TRANSIT)
    slow = end / (bounce / IN_A_BOUNCE)
    return int(min(max(FEWEST, slow, fine if fine <= MOST else 0.0), MOST))


def figures(of: Machine, n: int, rigid: bool = False) -> Figures:
    """Of a model with n sections, or of a rigid cable without mass."""
    motion, places = _motion(of, n, rigid)
    return _read(of, motion, places, rigid)


def steps_of(of: Machine, n: int, error: float, order: float) -> float:
    """Steps that follow the vibrations of a model with n sections.

    A method whose step h makes an error A (w h)^order of a vibration A sin w t takes steps of
    (ERROR/A)^(1/order)/w.
    """
    motion, _ = _motion(of, n, rigid=False)
    paces = (motion.rates * (motion.swings / error) ** (1 / order)).max(axis=1, initial=0.0)
    return float(paces.mean() * of.network.end)


def _motion(of: Machine, n: int, rigid: bool) -> tuple[Motion, dict[int, list[np.ndarray]]]:
    """Along the cable, and across it by weight."""
    count = 0 if rigid else n
    at = Sections(of.network, count)
    extra = np.zeros((of.network.instants + 1, sum(at.counts)))
    places: dict[int, list[np.ndarray]] = {i: [] for i in range(len(of.weights))}
    for string in of.strings:
        # Kinks faster than the instants are seen as their mean.
        swings = respond(
            string.network, count, window=max(SEEN * of.transit, SMOOTH * of.network.step)
        )
        row = 0
        own = Sections(string.network, count)
        for p, size in zip(string.bars, own.counts, strict=True):
            stretch = swings.stretch[:, row : row + size]
            extra[:, at.first[p] : at.first[p] + size] += stretch**2 / (2 * own.h[row])
            row += size
        places[string.weight].append(swings.ways[:, 0])
    return respond(of.network, count, extra, SEEN * of.transit, rigid), places


def _read(of: Machine, motion: Motion, places: dict[int, list[np.ndarray]], rigid: bool) -> Figures:
    rests = of.rests
    if rigid:
        rests = np.repeat(np.minimum(rests[::2], rests[1::2]), 2)
    pulls, spread = motion.tensions + rests, motion.spread
    tension = {k: (_summed(pulls[:, k], spread[:, k]), float((np.abs(pulls) + spread)[:, k].max()))
               for k in range(pulls.shape[1])}  # fmt: skip
    largest = [max(scale, NOTHING) for _, scale in tension.values()]
    ringing = float((motion.ringing / largest).max())
    position, key = {}, 0
    for i, coordinates in enumerate(of.weights):
        found = [motion.ways[:, j] for j in coordinates] + places[i]
        moved = sqrt(sum(float(np.abs(way).max()) ** 2 for way in found))
        for way in found:
            if moved > STILL * of.longest:
                position[key] = _summed(way), moved
            key += 1
    return Figures(tension, position, float((pulls - spread).min()), ringing)


def _summed(values: np.ndarray, spread: np.ndarray | float = 0.0) -> np.ndarray:
    return np.array([(values + spread).max(), (values - spread).min(), values.mean()])


def apart(one: Figures, truth: Figures, asked: tuple[str, ...]) -> float:
    """The largest difference of an asked figure, as a share of its scale."""
    worst = 0.0
    both = {"tension": (one.tension, truth.tension), "position": (one.position, truth.position)}
    for mine, exact in (both[each] for each in asked if each in both):
        for key, (values, scale) in exact.items():
            if key in mine and scale > 0:
                worst = max(worst, float(np.abs(mine[key][0] - values).max()) / scale)
    return worst


@dataclass(frozen=True)
class Errors:
    """What models leave out: of a rigid cable, and by sections; least tension, load over EA of the
    cable, what waves in it make of the greatest tension. `power`: with which the errors of many
    sections fall."""

    rigid: float
    of_sections: dict[int, float]
    lowest: float
    load: float
    ringing: float
    power: float

    def sections(self, p: float) -> float:
        """The least number with an error below `p`; beyond what was tried by its power."""
        counts = list(self.of_sections)
        for k, n in enumerate(counts):
            if all(self.of_sections[m] < p for m in counts[k : k + 2]):
                return n
        last = counts[-1]
        return last * (max(self.of_sections[last], p) / p) ** (1 / self.power)


def errors(of: Machine, p: float, asked: tuple[str, ...], given: int = 0) -> Errors:
    """Of models of a scene, up to the second in a row that leaves less than `p`; the least tension
    is that of the `given` sections."""
    truth = _known(of, MANY)
    rest, power = _remainder(of, asked)
    found: list[float] = []
    for n in COUNTS:
        found.append(apart(_known(of, n), truth, asked) + rest)
        if max(found[-2:]) < p and len(found) > 1:
            break
    else:
        found.append(rest)
    try:
        rigid = apart(_known(of, RIGID), truth, asked)
    except np.linalg.LinAlgError:
        rigid = inf
    scales = [scale for _, scale in truth.tension.values()]
    return Errors(
        rigid, dict(zip((*COUNTS, MANY), found, strict=False)),
        _known(of, min(given, MANY)).lowest if given else truth.lowest,
        min(scales) / of.rigidity,
        truth.ringing,
        power,
    )  # fmt: skip


def is_usable(of: Machine) -> bool:
    """Whether its numbers can be computed: not where sizes are too many decades apart."""
    try:
        with np.errstate(all="ignore"):
            truth = _known(of, MANY)
    except (np.linalg.LinAlgError, ValueError):
        return False
    figures = [*truth.tension.values(), *truth.position.values()]
    return all(np.isfinite(values).all() and isfinite(scale) for values, scale in figures)


def worst(found: list[Errors]) -> Errors:
    """The largest errors of several models."""
    most = max(found, key=lambda each: len(each.of_sections))
    return Errors(
        max(each.rigid for each in found),
        {n: max(e.of_sections.get(n, 0.0) for e in found) for n in most.of_sections},
        min(each.lowest for each in found), min(each.load for each in found),
        max(each.ringing for each in found), min(each.power for each in found),
    )  # fmt: skip


def _remainder(of: Machine, asked: tuple[str, ...]) -> tuple[float, float]:
    """What the many sections leave out themselves, by how halves and quarters of them do, and the
    power with which it falls."""
    halves = [_known(of, MANY >> k) for k in range(3)]
    last, before = (apart(halves[k + 1], halves[k], asked) for k in range(2))
    falls = min(max(last / max(before, NOTHING), FASTEST), SLOWEST)
    return last * falls / (1 - falls), -log2(falls)


def _known(of: Machine, n: int) -> Figures:
    """Figures, once for all accuracies."""
    if n not in of.known:
        of.known[n] = figures(of, n, n == RIGID)
    return of.known[n]
