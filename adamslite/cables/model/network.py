"""A cable scene about its start, as masses and springs: the linear model that advice rests on.

Coordinates are the way of each wheel's rim along the route, the displacements of weights and
carriages, and of the nodes in the sections of the spans. With B the elongation of all sections,

    M u" + C u' + K u = f - B' k d,     K = B' k B + K_across,     C = B' k tau B,     k = EA/H

where d are elongations given from outside: what a cable needs that moves across its line. What laws
prescribe, u_P, has the static shape G = -K_FF^-1 K_FP, and w = u_F - G u_P vibrates in modes:

    q" + 2 z w q' + w^2 q = phi.(f - B' k d - (M_FF G + M_FP) u_P")

which are solved exactly for forces that are linear between instants. A rigid cable without mass
has the elongation -d in every span instead, and its tensions are what keeps it.

Modes come from the singular values of F L^-T, where K = F' F and M = L L': the rates w themselves
and not their squares. Round-off is a share of the largest rate, that of waves in a short section,
and would drown what swings slowly, or only drifts, if it were one of its square.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from math import sqrt

import numpy as np

from adamslite.cables.model.modes import CREEPS, ROUND_OFF, SLOW, Modes, Times

#: Coordinates of a displacement, with their shares.
Terms = tuple[tuple[int, float], ...]
# Of the largest rate: what is slower has no stiffness.
LIMP = 1e-12


@dataclass(frozen=True)
class Bar:
    """A span: the displacements of its start and finish along it; `pull` is the rigidity [force] of
    its sections at both ends, EA or, across, the tension.

    `points`: whether the half sections at start and finish go with a point in all directions, and
    not with a rim. `falls`: acceleration along it of what starts out of balance.
    """

    start: Terms
    finish: Terms
    length: float
    pull: tuple[float, float]
    points: tuple[bool, bool] = (False, False)
    falls: float = 0.0


@dataclass(frozen=True)
class Network:
    """Masses of coordinates, their speeds at the start, spans between them, and what drives them.

    `ways` has what laws prescribe, by coordinate, at equal instants; `forces` what pulls others;
    `across` rigidities of weights that the tension of their spans holds in place. What lies on a
    wheel moves with its rim, and not with one of the `carriages`.
    """

    masses: tuple[float, ...]
    bars: tuple[Bar, ...]
    density: float
    end: float
    instants: int
    speeds: tuple[float, ...]
    damping_time: float = 0.0
    ways: Mapping[int, np.ndarray] = field(default_factory=dict)
    forces: Mapping[int, np.ndarray | float] = field(default_factory=dict)
    across: tuple[tuple[tuple[int, ...], np.ndarray], ...] = ()
    carriages: frozenset[int] = frozenset()

    @property
    def transit(self) -> float:
        """Of a wave along the longest span."""
        return max(bar.length * sqrt(self.density / bar.pull[0]) if bar.pull[0] > 0 else 0.0
                   for bar in self.bars)  # fmt: skip

    @property
    def step(self) -> float:
        """Between instants."""
        return self.end / self.instants

    @property
    def times(self) -> Times:
        """What its modes need of them."""
        return Times(self.end, self.step, self.transit)


@dataclass(frozen=True)
class Motion:
    """Displacements of the coordinates of a network, and tensions at the start and finish of every
    span less those at rest: a row for every instant.

    `stretch` has the elongation of every section, `spread` by how much modes that are too fast for
    the instants make the tensions larger and smaller in between, `ringing` how much all those do
    that the waves in the cable are. `rates` and `swings` [displacement] are those of every mode.
    """

    ways: np.ndarray
    tensions: np.ndarray
    stretch: np.ndarray
    spread: np.ndarray
    ringing: np.ndarray
    rates: np.ndarray
    swings: np.ndarray


class Sections:
    """The matrices of a network with `n` sections in each span; `n` = 0: without mass."""

    def __init__(self, of: Network, n: int) -> None:
        self.of, self.n = of, n
        self.counts = [n or 1] * len(of.bars)
        nodes = sum(self.counts) - len(of.bars)
        size = len(of.masses) + nodes
        self.size = size
        self.mass = np.zeros((size, size))
        self.mass[range(len(of.masses)), range(len(of.masses))] = of.masses
        self.b = np.zeros((sum(self.counts), size))
        self.k = np.zeros(sum(self.counts))
        self.h = np.zeros(sum(self.counts))
        self.weight = np.zeros(size)
        self.half: list[float] = []
        self.first: list[int] = []
        self._lay()
        self.across = np.zeros((size, size))
        for coordinates, rigidity in of.across:
            self.across[np.ix_(coordinates, coordinates)] += rigidity
        given = np.array(sorted(of.ways), dtype=int)
        self.given = given
        self.free = np.setdiff1d(np.arange(size), given)

    def _lay(self) -> None:
        row, node = 0, len(self.of.masses)
        for bar, count in zip(self.of.bars, self.counts, strict=True):
            h = bar.length / count
            heavy = self.of.density * h if self.n else 0.0
            places = [bar.start, *(((node + i, 1.0),) for i in range(count - 1)), bar.finish]
            for i in range(count):
                share = (i + 0.5) / count
                self.k[row + i] = (bar.pull[0] * (1 - share) + bar.pull[1] * share) / h
                self.h[row + i] = h
                for j, c in places[i]:
                    self.b[row + i, j] -= c
                for j, c in places[i + 1]:
                    self.b[row + i, j] += c
            for i in range(count - 1):
                self.mass[node + i, node + i] = heavy
                self.weight[node + i] = heavy * bar.falls
            for terms, point in zip((bar.start, bar.finish), bar.points, strict=True):
                self._half(terms, point, heavy / 2)
                for j, c in terms:
                    if j not in self.of.carriages:
                        self.weight[j] += c * heavy / 2 * bar.falls
            self.half.append(heavy / 2)
            self.first.append(row)
            row, node = row + count, node + count - 1

    def _half(self, terms: Terms, point: bool, mass: float) -> None:
        """A half section on what is at the end of a span."""
        terms = tuple(each for each in terms if each[0] not in self.of.carriages)
        for j, c in terms:
            for i, d in terms:
                if point and i == j:
                    self.mass[i, i] += mass
                elif not point:
                    self.mass[i, j] += mass * c * d

    @cached_property
    def factor(self) -> np.ndarray:
        """F of K = F' F, in as many rows as coordinates at least."""
        rows = [np.sqrt(np.maximum(self.k, 0.0))[:, None] * self.b]
        for coordinates, rigidity in self.of.across:
            squares, ways = np.linalg.eigh(rigidity)
            rows.append(np.zeros((len(squares), self.size)))
            rows[-1][:, coordinates] = np.sqrt(np.maximum(squares, 0.0))[:, None] * ways.T
        rows.append(np.zeros((max(self.size - sum(map(len, rows)), 0), self.size)))
        return np.concatenate(rows)

    def along(self, terms: Terms, ways: np.ndarray) -> np.ndarray:
        """The displacement of a half section at an end of a span, of coordinates in columns."""
        total = np.zeros(len(ways))
        for j, c in terms:
            if j not in self.of.carriages:
                total = total + c * ways[:, j]
        return total


def respond(
    of: Network, n: int, extra: np.ndarray | None = None, window: float = 0.0, rigid: bool = False
) -> Motion:
    """How a network moves in its run.

    Parameters
    ----------
    n : int
        Sections of a span; 0 for a cable without mass.
    extra : ndarray, (instants + 1, sections)
        Elongations d.
    window : float
        Vibrations are seen through a mean over this time.
    rigid : bool
        Whether its spans keep their lengths, but for `extra`.
    """
    at = Sections(of, n)
    ways = _prescribed(of, at)
    if rigid:
        return _rigid(of, at, ways, extra)
    return _elastic(of, at, ways, extra, window)


def _prescribed(of: Network, at: Sections) -> np.ndarray:
    """Ways of the coordinates that laws prescribe, in columns."""
    ways = np.zeros((of.instants + 1, len(at.given)))
    for column, j in enumerate(at.given):
        ways[:, column] = of.ways[j]
    return ways


def _rates(ways: np.ndarray, h: float) -> tuple[np.ndarray, np.ndarray]:
    """First rate at the start, and the second at every instant."""
    second = np.zeros_like(ways)
    second[1:-1] = (ways[2:] - 2 * ways[1:-1] + ways[:-2]) / h**2
    if len(ways) > 3:
        second[0], second[-1] = second[1], second[-2]
    start = (ways[1] - ways[0]) / h - second[0] * h / 2
    return start, second


def _loads(of: Network, at: Sections) -> np.ndarray:
    """Forces on all coordinates at every instant."""
    found = np.tile(at.weight, (of.instants + 1, 1))
    for j, force in of.forces.items():
        found[:, j] += force
    return found


def _elastic(
    of: Network, at: Sections, ways: np.ndarray, extra: np.ndarray | None, window: float
) -> Motion:
    free, given = at.free, at.given
    loads = _loads(of, at)
    if extra is not None:
        loads = loads - extra @ (at.k[:, None] * at.b)
    modes = _modes(of, at)
    shape = -modes.held @ at.factor[:, given]
    starts, rates = _rates(ways, of.step)
    pushed = at.mass[np.ix_(free, free)] @ shape + at.mass[np.ix_(free, given)]
    forces = loads[:, free] - rates @ pushed.T
    speeds = np.zeros(at.size)
    speeds[: len(of.speeds)] = of.speeds
    w, fast, swings = modes.run(forces, speeds[free] - shape @ starts, window)
    moved, fastness = np.zeros((len(w), at.size)), np.zeros((len(w), at.size))
    moved[:, free], moved[:, given] = w + ways @ shape.T, ways
    fastness[:, free], fastness[:, given] = fast + rates @ shape.T, rates
    stretch = moved @ at.b.T + (0.0 if extra is None else extra)
    each = np.zeros((len(modes.rates), at.size))
    each[:, free] = modes.shapes.T
    pulls = _at_ends(at, each @ at.b.T * at.k, -(modes.rates**2)[:, None] * each, rests=False)
    ringing = modes.largest @ np.abs(pulls)
    tensions = _at_ends(at, stretch * at.k, fastness)
    swung = modes.swings * np.abs(modes.shapes).max(axis=0)
    return Motion(
        moved, tensions, stretch, swings @ np.abs(pulls), ringing, modes.rates, swung
    )  # fmt: skip


def _modes(of: Network, at: Sections) -> Modes:
    """Of what is free."""
    free = at.free
    lower = np.linalg.inv(np.linalg.cholesky(at.mass[np.ix_(free, free)]))
    columns, rates, shapes = np.linalg.svd(at.factor[:, free] @ lower.T, full_matrices=False)
    modes = Modes(of.times, lower.T @ shapes.T, at.mass[np.ix_(free, free)], rates)
    still = rates > LIMP * rates.max(initial=0.0)
    modes.held = (modes.shapes[:, still] / rates[still]) @ columns[:, still].T
    damped = of.damping_time * at.k @ (at.b[:, free] @ modes.shapes) ** 2
    modes.damping = np.minimum(damped / (2 * modes.rates), CREEPS)
    return modes


def _at_ends(at: Sections, pulls: np.ndarray, fast: np.ndarray, rests: bool = True) -> np.ndarray:
    """Tensions at the start and finish of every span: with the half sections there."""
    found = np.zeros((len(pulls), 2 * len(at.of.bars)))
    for p, (bar, count) in enumerate(zip(at.of.bars, at.counts, strict=True)):
        row, half, falls = at.first[p], at.half[p], bar.falls if rests else 0.0
        at_start, at_finish = (at.along(terms, fast) - falls for terms in (bar.start, bar.finish))
        found[:, 2 * p] = pulls[:, row] - half * at_start
        found[:, 2 * p + 1] = pulls[:, row + count - 1] + half * at_finish
    return found


def _rigid(of: Network, at: Sections, ways: np.ndarray, extra: np.ndarray | None) -> Motion:
    """B u = -d: coordinates along the null space of B, tensions from what they lack."""
    free, given = at.free, at.given
    b, fixed = at.b[:, free], at.b[:, given]
    inverse = np.linalg.pinv(b)
    forced = -(ways @ fixed.T)
    if extra is not None:
        forced = forced - extra
    if (
        np.abs(forced @ (np.eye(len(b)) - b @ inverse).T).max()
        > ROUND_OFF + SLOW * np.abs(forced).max()
    ):
        raise np.linalg.LinAlgError("a rigid cable cannot move so")
    base = forced @ inverse.T
    _, rates = _rates(base, of.step)
    kept = _null(b)
    mass, across = (m[np.ix_(free, free)] for m in (at.mass, at.across))
    loads = _loads(of, at)[:, free]
    pushed = loads - rates @ mass.T - base @ across.T
    speeds = np.zeros(at.size)
    speeds[: len(of.speeds)] = of.speeds
    found, fast = base, rates
    if kept.shape[1]:
        small = _reduced(of, kept.T @ mass @ kept, kept.T @ across @ kept)
        start = np.linalg.solve(small.mass, kept.T @ mass @ speeds[free])
        z, zz, _ = small.run(pushed @ kept, start, 0.0)
        found, fast = base + z @ kept.T, rates + zz @ kept.T
    lacks = loads - fast @ mass.T - found @ across.T
    pulls = lacks @ np.linalg.pinv(b.T).T
    moved = np.zeros((len(ways), at.size))
    moved[:, free], moved[:, given] = found, ways
    ends = np.repeat(pulls, 2, axis=1)
    nothing = np.zeros_like(ends)
    return Motion(
        moved, ends, np.zeros((len(ways), len(b))), nothing, nothing[0], nothing[0], nothing
    )  # fmt: skip


def _reduced(of: Network, mass: np.ndarray, stiffness: np.ndarray) -> Modes:
    """Modes of given matrices without damping."""
    lower = np.linalg.inv(np.linalg.cholesky(mass))
    squares, shapes = np.linalg.eigh(lower @ stiffness @ lower.T)
    return Modes(of.times, lower.T @ shapes, mass, np.sqrt(np.maximum(squares, 0.0)))


def _null(b: np.ndarray) -> np.ndarray:
    """Columns that span what `b` takes to zero."""
    _, sizes, rows = np.linalg.svd(b)
    rank = int((sizes > ROUND_OFF * max(sizes.max(initial=0.0), 1.0)).sum())
    return rows[rank:].T
