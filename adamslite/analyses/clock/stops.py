"""Stops of a run: the times at which a guard of time changes its branch.

Guards of the clock (:mod:`adamslite.symbolic.guards`) are functions of time alone, so their changes
are found before the run:

1. bisection with enclosures separates the changes, however near to each other they are, and
   proves that there is none elsewhere (:mod:`adamslite.analyses.clock.changes`);
2. bisection of every change down to round-off, by the native kernels that the run itself uses.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from adamslite.analyses.clock.changes import NOISE, around_changes
from adamslite.analyses.clock.clock import Clock
from adamslite.analyses.clock.enclosures import enclose
from adamslite.integrators.contract import CLOCK, LEAST_STEP
from adamslite.native.worker import require_time
from adamslite.symbolic.guards import FLOOR, STRICT

if TYPE_CHECKING:
    from adamslite.analyses.clock.clock import Program
    from adamslite.equations.system import System
    from adamslite.language.statement import Statement
    from adamslite.native.worker import Over

    Programs = dict[Program, Statement]

# Changes nearer to each other, or to an output time, than this share of the run are one; they are
# located to that of round-off.
SAME, ROUND_OFF = 1e-13, 1e-16
# A guard that jumps is not round-off beside a change: this share of its largest value is.
LOUD = 1e-9
# So many whole numbers floors may pass in a run: their changes have to fit into memory.
MOST = 2**19
# Times whose branches are found at once: what is needed on the way takes little memory.
BLOCK = 2**15
# Where a guard is sampled between two changes.
WITHIN = np.array([0.25, 0.5, 0.75])


def stops(system: System, times: np.ndarray) -> np.ndarray:
    """Times inside the run over ``times`` (nt,) at which it must stop, and its end; sorted."""
    return edges(system, Clock(system.kernels), times)[0]


def edges(
    system: System, clock: Clock, times: np.ndarray, over: Over = None
) -> tuple[np.ndarray, list[Statement]]:
    """The stops, and the statements whose changes are too many to find all of them.

    Raises
    ------
    Overspent
        When it was ``over`` before.
    """
    start, end = float(times[0]), float(times[-1])
    if not system.guarded["clock"] or not end > start:
        return np.array([end]), []
    guards, floors = clock.programs("guards"), clock.programs("floors")
    found, overfull = _grid(guards, floors, start, end, over)

    def stops() -> np.ndarray:
        return merged(_lasting(system, _changes(system, found, over), start, end), times)

    decided_by = ("stops", *guards, None, *floors, found.tobytes(), times.tobytes())
    return system.layout.once(decided_by, stops), overfull


def merged(found: np.ndarray, times: np.ndarray) -> np.ndarray:
    """Times inside the run and its end, sorted, without those that differ by round-off."""
    start, end = float(times[0]), float(times[-1])
    if (found == end).all():
        return np.array([end])
    same = same_time(start, end)
    after = np.searchsorted(times, found).clip(1, len(times) - 1)
    low, high = times[after - 1], times[after]
    near = np.where(found - low <= high - found, low, high)
    found = np.where(np.abs(near - found) <= same, near, found)
    inside = np.sort(found[(found > start + same) & (found < end - same)])
    return np.append(inside[np.diff(inside, prepend=-np.inf) > same], end)


def same_time(start: float, end: float) -> float:
    """Times nearer to each other are one; a step between them would be round-off of the time."""
    return max(SAME * (end - start), LEAST_STEP * abs(end))


def _grid(
    guards: Programs, floors: Programs, start: float, end: float, over: Over = None
) -> tuple[np.ndarray, list[Statement]]:
    """Times so dense that every guard changes once at most between two of them, and the
    statements of which that could not be reached.
    """
    times, overfull, passed = [np.array([start, end])], [], 0.0
    for floor in (False, True):
        for program, statement in (floors if floor else guards).items():
            require_time(over)
            found = around_changes(program, start, end, floor)
            times.append(found.times)
            passed += _passed(program, found.times) if floor else 0.0
            overfull += [] if found.whole and passed <= MOST else [statement]
    return np.unique(np.concatenate(times)), overfull


def _passed(program: Program, times: np.ndarray) -> float:
    """How many whole numbers a floor passes, which is monotonic between the times."""
    values = np.floor(enclose(program, times, times)[0])
    return float(np.abs(np.diff(values[np.isfinite(values)])).sum())


class _Spans(NamedTuple):
    """Spans of time (n,) and the branches of all guards at their ends (n, bytes)."""

    below: np.ndarray
    above: np.ndarray
    left: np.ndarray
    right: np.ndarray

    def of(self, which: np.ndarray | slice) -> _Spans:
        """Some of them."""
        return _Spans(*(each[which] for each in self))

    def are_fine(self, least: float) -> np.ndarray:
        """Which of them are as brief as round-off, (n,)."""
        middle = 0.5 * (self.below + self.above)
        brief = self.above - self.below <= least
        return brief | (middle <= self.below) | (middle >= self.above)


def _changes(system: System, grid: np.ndarray, over: Over = None) -> np.ndarray:
    """Every change between two times of the grid, sorted; a floor may pass several numbers.

    Branches of all spans are most of the memory: a block of spans is dropped when it is halved.
    """
    least = ROUND_OFF * (grid[-1] - grid[0])
    found = [grid[:0]]
    blocks = [_changed(system, grid[at : at + BLOCK + 1]) for at in range(0, len(grid) - 1, BLOCK)]
    while blocks:
        for at, block in enumerate(blocks):
            fine = block.are_fine(least)
            found.append(block.above[fine])
            blocks[at] = block.of(~fine)
        if sum(len(block.below) for block in blocks) > MOST + len(grid):
            break  # the rest is reported as too many
        halves: list[_Spans] = []
        while blocks:
            require_time(over)
            half = _halved(system, blocks.pop())
            halves += [half.of(slice(at, at + BLOCK)) for at in range(0, len(half.below), BLOCK)]
        blocks = halves
    return np.unique(np.concatenate(found))


def _changed(system: System, times: np.ndarray) -> _Spans:
    """The spans between times in which a guard changes."""
    branches = _branches(system, times)
    spans = _Spans(times[:-1], times[1:], branches[:-1], branches[1:])
    return spans.of((spans.left != spans.right).any(axis=1))


def _halved(system: System, spans: _Spans) -> _Spans:
    """The halves of spans in which a guard changes."""
    below, above, left, right = spans
    middle = 0.5 * (below + above)
    inner = _branches(system, middle)
    lower, upper = (left != inner).any(axis=1), (inner != right).any(axis=1)
    return _Spans(
        np.concatenate([below[lower], middle[upper]]),
        np.concatenate([middle[lower], above[upper]]),
        np.concatenate([left[lower], inner[upper]]),
        np.concatenate([inner[lower], right[upper]]),
    )


def _lasting(system: System, found: np.ndarray, start: float, end: float) -> np.ndarray:
    """Changes without those to and fro where a guard is round-off of zero: in neighbouring spans of
    that kind it has the branch of the widest.
    """
    if len(found) < 2:
        return found
    ends = np.concatenate([[start], found, [end]])
    width = np.diff(ends)
    size = np.max([np.abs(each).max(axis=(0, 1)) for each in _within(system, ends)], axis=0)
    # Beside a change a value is round-off, of what may be much larger than what is left of it.
    noise = np.clip(_beside(system, found, end - start), NOISE * size, LOUD * size)
    zero = np.empty((len(width), len(noise)), bool)
    branch = np.empty(zero.shape)
    for at, each in zip(range(0, len(width), BLOCK), _within(system, ends), strict=True):
        zero[at : at + BLOCK] = (np.abs(each) <= noise).all(axis=1)
        branch[at : at + BLOCK] = _branch(system, each[:, len(WITHIN) // 2])
    for guard in np.flatnonzero((zero[1:] & zero[:-1]).any(axis=0)):
        spans = np.flatnonzero(zero[:, guard])
        for run in np.split(spans, np.flatnonzero(np.diff(spans) > 1) + 1):
            branch[run, guard] = branch[run[width[run].argmax()], guard]
    return found[(branch[1:] != branch[:-1]).any(axis=1)]


def _within(system: System, ends: np.ndarray) -> Iterator[np.ndarray]:
    """Values of the guards inside spans between times, (n, WITHIN, guards), some spans at once."""
    for at in range(0, len(ends) - 1, BLOCK):
        here = ends[at : at + BLOCK + 1]
        times = here[:-1, None] + np.diff(here)[:, None] * WITHIN
        yield sample(system, times.ravel()).reshape(*times.shape, -1)


def _beside(system: System, found: np.ndarray, length: float) -> np.ndarray:
    """Sixteen times the largest value of each guard beside its own changes, (guards,)."""
    near = ROUND_OFF * max(length, float(np.abs(found).max()))
    blocks = [found[at : at + BLOCK] for at in range(0, len(found), BLOCK)]
    return 16.0 * np.max([_largest(system, each, near) for each in blocks], axis=0)


def _largest(system: System, found: np.ndarray, near: float) -> np.ndarray:
    """The largest value of each guard so near to changes of its own, (guards,)."""
    before, behind = sample(system, found - near), sample(system, found + near)
    changes = _branch(system, before) != _branch(system, behind)
    largest = np.maximum(np.abs(before), np.abs(behind))
    return np.where(changes, largest, 0.0).max(axis=0)


def _branches(system: System, times: np.ndarray) -> np.ndarray:
    """Branches of all guards of the clock at ``times`` as bytes to compare, (nt, bytes): eight of
    each floor and one of any other guard.
    """
    floors = system.numbering.kind[: len(system.guarded["clock"])] == FLOOR
    wide = 8 * np.count_nonzero(floors)
    found = np.empty((len(times), wide + np.count_nonzero(~floors)), np.uint8)
    for at in range(0, len(times), BLOCK):
        branch = _branch(system, sample(system, times[at : at + BLOCK]))
        numbers = branch[:, floors] + 0.0  # zero has one sign
        numbers[np.isnan(numbers)] = np.nan
        found[at : at + BLOCK, :wide] = np.ascontiguousarray(numbers).view(np.uint8)
        found[at : at + BLOCK, wide:] = branch[:, ~floors]
    return found


def _branch(system: System, values: np.ndarray) -> np.ndarray:
    """Branch of every guard of the clock by its values, (nt, guards)."""
    kind = system.numbering.kind[: values.shape[1]]
    relation = np.where(kind == STRICT, values > 0.0, values >= 0.0)
    return np.where(kind == FLOOR, np.floor(values), relation)


def sample(system: System, times: np.ndarray) -> np.ndarray:
    """Values of the guards of the clock at ``times``, (nt, guards)."""
    count = len(system.guarded["clock"])
    kept = system.times, system.record
    system.times = np.ascontiguousarray(times, dtype=float)
    system.record = np.zeros(len(times) * count + 1)
    system.run(CLOCK)
    values = system.record[:-1].reshape(len(times), count)
    system.times, system.record = kept
    return values
