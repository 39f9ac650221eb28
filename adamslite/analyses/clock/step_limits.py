"""Limits of the step size where expressions of time change within less than a step.

An error test compares the ends of a step: a pulse between them is not there.  Where a curve has a
time scale s (:mod:`adamslite.analyses.clock.changes`) below the longest step, or where two edges
are nearer than that to each other, steps are

    h <= share * s,     share = the least, or as many steps as are worth it shared among all pulses

A share of a half is enough to see what there is; the error test does the rest in methods that test
velocities.  The others need as many steps for a pulse as its impulse is to have digits: of 1/n of
its length, trapezoids leave n^-2.

Corners of tables are stops without a pace: a curve between two of them is a straight line, and each
is the end of a step.  Where it is steep, methods that do not test velocities keep the pace.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from adamslite.analyses.clock.changes import Found, time_scales
from adamslite.analyses.clock.stops import edges, merged, same_time
from adamslite.caching.entries import recall_json
from adamslite.caching.sources import version_of
from adamslite.integrators import contract
from adamslite.native import compiler
from adamslite.native.worker import require_time

if TYPE_CHECKING:
    from adamslite.analyses.clock.clock import Clock, Program
    from adamslite.equations.system import System
    from adamslite.language.statement import Statement
    from adamslite.native.worker import Over

# From a step as short as round-off of the run to one of its length.
DOUBLINGS = 64
# Steps per time scale at least (to see it) and, where it must be integrated without an error test
# of velocities; how many steps of a run are worth that.
SEEN, FINE, WORTH = 2.0, 32.0, 8192.0
# What would need more steps than this is left to the error test, and reported.
MOST = 1e5
# Curves slower than this share of the longest step cannot be missed, nor what lies between two
# stops this many of the longest steps apart; nearer stops bound a pulse.
SHORT, LONG, NEAR = 0.5, 2.0, 0.25
# Pulses up to this many time scales long get equal steps, which add up to the impulse best.
BRIEF = 32.0
# A span between two stops is five time scales long.
PARTS = 5.0


@dataclass(frozen=True)
class Timetable:
    """What is known of time before a run.

    ``stops`` (k,): where steps end and branches may change, the end last.  ``paces`` (3 n,): see
    :class:`adamslite.integrators.contract.Pace`.  ``paced``: statements that change within less
    than the longest step;  ``overfull``: those that change too often to follow all of it.
    """

    stops: np.ndarray
    paces: np.ndarray
    paced: list[Statement]
    overfull: list[Statement]


def timetable(
    system: System,
    clock: Clock,
    times: np.ndarray,
    longest: float,
    fine: bool,
    over: Over = None,
) -> Timetable:
    """Stops and paces of a run over ``times`` (nt,) with steps up to ``longest``.

    ``fine``: the method does not test velocities; raises as :func:`~.stops.edges` does.
    """
    start, end = float(times[0]), float(times[-1])
    if not end > start:
        return Timetable(np.array([end]), np.array(contract.NO_PACE), [], [])
    found, overfull = edges(system, clock, times, over)
    edged, corners, spans, paced = [found], [], [np.zeros((0, 3))], []
    curves, slopes = clock.programs("curves"), clock.programs("slopes")
    known = all_time_scales([*curves, *slopes], start, end, SHORT * longest, over)
    for statement, curve in zip(curves.values(), known, strict=False):
        edged.append(curve.times)
        if not curve.whole or _crossings(curve.spans) * SEEN > MOST:
            overfull.append(statement)
        else:
            paced += [statement] if len(curve.spans) else []
            spans.append(curve.spans)
    for statement, slope in zip(slopes.values(), known[len(curves) :], strict=True):
        corners.append(slope.times)
        overfull += [statement] if not slope.whole else []
    found = merged(np.concatenate([*edged, *corners]), times)
    if len(found) == 1 and not any(map(len, spans)):
        return Timetable(found, np.array(contract.NO_PACE), paced, overfull)
    between = _between(merged(np.concatenate(edged), times), start)
    if fine and corners:
        steep = _overlapping(_between(found, start), np.concatenate(spans))
        between = _least(np.concatenate([between, steep]))
    gaps = between[:, 1] - between[:, 0]
    spans.append(between[gaps < NEAR * longest])
    scales, looks = _least(np.concatenate(spans)), between[gaps < LONG * longest]
    rows = _rows(_paces(scales, looks, longest, fine), found, start)
    return Timetable(found, rows, paced, overfull)


def _between(found: np.ndarray, start: float) -> np.ndarray:
    """The spans between stops with their time scales, (n, 3); none where there are no stops."""
    low = np.append(start, found[:-1])
    return np.stack([low, found, (found - low) / PARTS], axis=1)[len(found) == 1 :]


def _overlapping(between: np.ndarray, spans: np.ndarray) -> np.ndarray:
    """Those between stops (k, 3) that have a part in common with spans (n, 3)."""
    low, high = np.sort(spans[:, 0]), np.sort(spans[:, 1])
    begun = np.searchsorted(low, between[:, 1], side="left")
    ended = np.searchsorted(high, between[:, 0], side="right")
    return between[begun > ended]


def _crossings(spans: np.ndarray) -> float:
    """How often a curve crosses its range at its largest rates."""
    return float(((spans[:, 1] - spans[:, 0]) / spans[:, 2]).sum())


def _least(spans: np.ndarray) -> np.ndarray:
    """Spans that do not overlap, each with the least of the third columns there, (n, 3)."""
    ends = np.unique(spans[:, :2])
    least = np.full(max(0, len(ends) - 1), np.inf)
    first, last = np.searchsorted(ends, spans[:, 0]), np.searchsorted(ends, spans[:, 1])
    for a, b, value in zip(first.tolist(), last.tolist(), spans[:, 2].tolist(), strict=True):
        least[a:b] = np.minimum(least[a:b], value)
    table = np.stack([ends[:-1], ends[1:], least], axis=1)
    return table[np.isfinite(least)]


def _paces(scales: np.ndarray, looks: np.ndarray, longest: float, fine: bool) -> np.ndarray:
    """Spans with their longest steps from spans with their time scales, (n, 3); in ``looks`` it is
    enough to have steps at all.
    """
    spans = [looks / (1.0, 1.0, SEEN)]
    if len(scales):
        per_scale = min(FINE, max(SEEN, WORTH / _crossings(scales))) if fine else SEEN
        groups = [group / (1.0, 1.0, per_scale) for group in _pulses(scales)]
        spans += groups + [_approach(group, longest) for group in groups]
    return np.concatenate(spans)


def _rows(spans: np.ndarray, stops: np.ndarray, start: float) -> np.ndarray:
    """The rows of ``P.paces``; what is nearer to a stop than round-off is at the stop."""
    never, same = contract.NO_PACE[1], same_time(start, stops[-1])
    for each in (stops[:-1], stops[1:]) if len(stops) > 1 else ():
        near = each[np.searchsorted(each, spans[:, :2] + same).clip(1, len(each)) - 1]
        spans[:, :2] = np.where(np.abs(near - spans[:, :2]) <= same, near, spans[:, :2])
    rows = [(contract.NO_PACE[0], never)]
    for low, high, step in _least(spans).tolist():
        if high - low <= same:
            continue
        if low - rows[-1][0] <= same:  # the end of the span before
            low = rows.pop()[0]
        if rows[-1][1] != step:
            rows.append((low, step))
        rows.append((high, never))
    return _with_fences(rows)


def _pulses(scales: np.ndarray) -> list[np.ndarray]:
    """Runs of neighbouring spans; what is brief becomes one span, for equal steps, and elsewhere
    time scales change gradually.
    """
    breaks = np.flatnonzero(scales[1:, 0] > scales[:-1, 1]) + 1
    groups = np.split(scales, breaks)
    for k, group in enumerate(groups):
        low, high, least = group[0, 0], group[-1, 1], group[:, 2].min()
        if high - low <= BRIEF * least:
            groups[k] = np.array([[low, high, least]])
        else:
            groups[k] = _graded(group)
    return groups


def _graded(group: np.ndarray) -> np.ndarray:
    """Spans with time scales that nowhere grow faster than the time passes, (n, 3); what is long
    for the scale of its neighbours is divided, into parts that double.
    """
    low, high, scale = group.T
    behind, before = scale.copy(), scale.copy()
    behind[1:] = np.minimum(scale[1:], np.minimum.accumulate(scale - high)[:-1] + low[1:])
    before[:-1] = np.minimum(
        scale[:-1], np.minimum.accumulate((scale + low)[::-1])[-2::-1] - high[:-1]
    )
    least = np.minimum(behind, before)
    parts: list[np.ndarray] = []
    for (start, end, size), left, right, some in zip(group, behind, before, least, strict=True):
        if end - start <= BRIEF * some:
            parts.append(np.array([[start, end, some]]))
            continue
        way = np.exp2(np.arange(1, DOUBLINGS)) - 1.0
        cuts = np.concatenate([start + left * way, end - right * way])
        ends = np.unique(np.concatenate([[start, end], cuts[(cuts > start) & (cuts < end)]]))
        limits = np.minimum(left + ends[:-1] - start, right + end - ends[1:])
        parts.append(np.stack([ends[:-1], ends[1:], np.minimum(limits, size)], axis=1))
    return np.concatenate(parts)


def _approach(group: np.ndarray, longest: float) -> np.ndarray:
    """Spans beside a pulse in which steps are as long as the way to it, (n, 3): what the curve is
    at its edge would otherwise count for the whole of a long step.
    """
    low, high = group[0, 0], group[-1, 1]
    way = group[:, 2].min() * np.exp2(np.arange(DOUBLINGS))
    way = way[way < longest]
    ends, step = np.cumsum(np.append(0.0, way)), way
    before = np.stack([low - ends[1:], low - ends[:-1], step], axis=1)
    behind = np.stack([high + ends[:-1], high + ends[1:], step], axis=1)
    return np.concatenate([before, behind])


def _with_fences(rows: list[tuple[float, float]]) -> np.ndarray:
    """Rows of (since when, longest step, fence): the fence is where a later row first requires
    shorter steps.
    """
    table: list[tuple[float, float, float]] = []
    later: list[tuple[float, float]] = []
    for when, step in reversed(rows):
        while later and later[-1][1] >= step:
            later.pop()
        table.append((when, step, later[-1][0] if later else contract.NO_PACE[2]))
        later.append((when, step))
    return np.array(table[::-1]).ravel()


#: Instructions of all programs from which on to keep is faster than to find again.
LARGE = 2000
PLAIN = (str, int, float)


def all_time_scales(
    programs: Sequence[Program], start: float, end: float, longest: float, over: Over = None
) -> list[Found]:
    """What :func:`time_scales` finds of each program; Overspent is raised when it was ``over``
    before.
    """

    def scales(program: Program) -> Found:
        require_time(over)
        return time_scales(program, start, end, longest)

    def found() -> list[Found]:
        return [scales(program) for program in programs]

    words = [word for program in programs for instruction in program for word in instruction]
    if sum(map(len, programs)) < LARGE or not all(isinstance(word, PLAIN) for word in words):
        return found()
    known = repr((programs, start, end, longest))
    name = f"scales{compiler.digest(version_of('analyses.clock.changes'), known)}.json"
    kept = recall_json(name, lambda: [_numbers(each) for each in found()])
    return [
        Found(np.array(times), np.array(spans).reshape(-1, 3), whole)
        for times, spans, whole in kept
    ]


def _numbers(found: Found) -> tuple[list[float], list[list[float]], bool]:
    return found.times.tolist(), found.spans.tolist(), found.whole
