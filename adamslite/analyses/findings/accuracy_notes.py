"""What a run reports of its own accuracy, which ERROR, a bound of each step, does not say.

A run that reached its end is carried out again with a smaller ERROR, without a word, or with a
larger one where that would take too long (:mod:`second_runs`).  What lies between both runs is what
the first is off by, whatever damps, amplifies or shifts its errors; a part of the time stands for
all of it.  The error of a channel is a share of the range that this channel has in the run:

    x, y, z of a body         from the least to the largest
    attitude of a part        the largest turn
    DIFF, VARIABLE, REQUEST   the same, but for numbers of the integrator (HSIZE)
    markers of an element     of x, y, z and turn of I seen from J, which is what it feels

What stays within ERROR (DIFF states: ERROR of their size) or the gaps of constraints is at rest.
The end is a channel where a SENSOR ends a run.  Without a second run, the estimated errors of all
steps are added up.  Oscillations between events (contacts, dead zones) amplify them, because an
error of one pass shifts every later event: n events make 1 + n/``SHIFTED`` of a sum.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import islice
from math import inf
from typing import TYPE_CHECKING, Any, NamedTuple, TypeAlias

import numpy as np

from adamslite.analyses.findings.standstill import (
    INDIFFERENT,
    ROUNDING,
    Frame,
    Parts,
    energy_apart,
    largest_travel,
)
from adamslite.integrators import contract
from adamslite.language.expression import Call, calls
from adamslite.language.method import FIXED, FIXED_BY_HINIT, NUMBERS
from adamslite.results.outcomes import Outcome
from adamslite.results.summary import UNDETERMINED

if TYPE_CHECKING:
    from adamslite.analyses.dynamics.dynamic import Settings
    from adamslite.analyses.dynamics.history import History, Piece
    from adamslite.equations.system import System
    from adamslite.model.model import Model
    from adamslite.results.results import Results

# Of less than this share of the time a second run says nothing.
LEAST_PART = 0.02
# Steps so close to HMAX on average are limited by it.
LIMITED = 0.8
# An error that grows by a higher power of the time is amplified.
POWER, LARGEST, LATER = 2.5, 1.0, 50
# Rows and elements that are compared.
ROWS, ELEMENTS, MANY = 2_000, 100, 50
# Gaps of constraints that a coordinate has to exceed by so much.
GAPS = 1e3
# DIFF states, which a step tests as if they were 1, are of this size at least: less is round-off.
LIMP = 1e-3
# Of joints, ERRORs of both runs that it has to exceed: which of their coordinates are free is not
# looked at.
# Angles that go from pi to -pi, which are one.
WRAPPED, TURN = ("PSI", "THETA", "PHI", "YAW", "PITCH", "ROLL"), 2.0 * np.pi
# Of a vector: a component within this share of it is judged by as much.
PART = 1e-3
# A range within errors of turns is theirs where it is the second share of itself in the other run.
HELD, VANISHING = 100.0, 0.5
# Share of its range that a channel may be off untold: this at a small ERROR, and more at a large
# one, whose user expects no more.
FELT, LOOSE, LOOSELY = 3e-4, 1e-4, 7.0
# Share of its range from which on a channel is not determined.
LOST = 0.3
# Share of the largest travel from which a sum of estimates is reported.
FELT_IN_SUM = 1e-3
# Share of rough steps that is reported, where what they damped carries so much of the energy.
OFTEN, CARRIED, FIRST_ORDER = 0.05, 0.01, 1e-9
# Events after which a sum counts twice.
SHIFTED = 15.0
# Errors of all channels, their times, and the end of the run.
Compared: TypeAlias = "tuple[list[Channel], np.ndarray, float]"


class Channel(NamedTuple):
    """The error of one channel in time (nt,), what it is a share of, and its unit."""

    kind: str
    name: str
    error: np.ndarray
    range: float
    unit: str = ""

    def share(self) -> float:
        """The largest error as a share of the range."""
        return float(np.nanmax(self.error, initial=0.0)) / self.range

    def course(self, factor: float, times: np.ndarray, end: float) -> tuple[np.ndarray, np.ndarray]:
        """Times up to ``end``, and ``factor`` of the largest error until then as a share of the
        range. Behind ``times`` it is a power of the time, or an exponential function where it has
        grown faster than ``POWER`` all the time. Then a coarser run is worth nothing from where
        both have nothing in common.
        """
        error = np.broadcast_to(np.nan_to_num(self.error), times.shape)
        shares = np.maximum.accumulate(error) / self.range
        lost = int(np.searchsorted(shares, LOST)) if factor < 1.0 else len(times)
        for rows in (min(max(lost, 5), len(times)), len(times)):
            quarters = np.fmax(
                shares[[min(rows * k // 4, rows - 1) for k in (1, 2, 3, 4)]], ROUNDING
            )
            growth = np.diff(np.log(quarters))
            power = float((growth / np.diff(np.log([1.0, 2.0, 3.0, 4.0]))).min())
            if power > POWER:
                break
        known = max(times[rows - 1] - times[0], LEAST_PART * (end - times[0]))
        later = np.linspace(1.0, max((end - times[0]) / known, 1.0), LATER)
        grown = later ** max(power, 0.0)
        if power > POWER:
            grown = np.exp(np.minimum(4.0 * growth.min() * (later - 1.0), 60.0))
        ours, ahead = factor * shares[:rows], factor * quarters[-1] * grown
        ahead = np.minimum(ahead, max(LARGEST, ours[-1]))
        return np.append(times[:rows], times[0] + later * known), np.append(ours, ahead)


class Ended(NamedTuple):
    """What is left of a system whose run has ended: its report, the longest step it might take."""

    model: Model
    outcome: Outcome
    report: contract.Report
    holonomic: int
    longest: float

    @classmethod
    def of(cls, system: System, outcome: Outcome) -> Ended:
        """A copy of what the system has."""
        report = contract.Report.zeros()
        report[:] = system.report
        return cls(system.model, outcome, report, system.holonomic, float(system.settings.h_max))


def accuracy_notes(
    system: Ended,
    settings: Settings,
    counts: contract.Counts,
    history: History,
    seconds: Sequence[Results],
    factor: float,
) -> str:
    """What ERROR does not say about the accuracy of a run, in sentences; empty when it does.

    ``counts`` and ``history`` are those of all of it; ``seconds`` are the results of second runs,
    and ``factor`` is the error over the difference from them.
    """
    if settings.formula.steps == FIXED:
        return "equal steps without error test: compare a run with half of HINIT"
    steps, report = counts.steps, system.report
    found = [each for run in seconds if (each := _compared(system, settings, history, run, factor))]
    ends = [run.outcome for run in seconds if not run.outcome.is_requested]
    if ends and ends[0] is not Outcome.STEP_LIMIT:
        told = [f"its error is not known: a second run ended by {ends[0].name}"]
    elif found:
        told = [*_estimated(system, settings, steps, factor, found)]
    else:
        told = [*_added_up(settings, counts, float(report.spent), history)]
    if told:
        told += _of_method(settings)
        rough = settings.formula.damping and report.rough_steps > OFTEN * steps
        if rough and not (found and energy_apart(system.model, history, seconds[0]) < CARRIED):
            told.append(
                f"accelerations changed by more than half in {report.rough_steps} of {steps} "
                "steps: vibrations faster than the steps were damped, not followed; where they "
                "matter, GSTIFF or RADAU follow them"
            )
    told += _of_steps(settings, report)
    if report.floor > 0.0:
        told.append(
            f"round-off of positions leaves up to {report.floor:.1e} of a velocity in a step: "
            "this model keeps no smaller ERROR"
        )
    if told and settings.form != settings.formula.formulations[0] and system.holonomic:
        told.append("I3 does not test velocities, so that their errors add up; SI2 does")
    return "; ".join(told)


# ---- by a second run ---------------------------------------------------------------------------


def _compared(
    system: Ended, settings: Settings, history: History, second: Results, factor: float
) -> Compared | None:
    """What lies between a run and a second one; None where they have no times in common."""
    run = history.whole
    rows = min(run.count, len(second.time))
    same = np.isclose(run.times[:rows], second.time[:rows], rtol=1e-9, atol=0.0)
    rows = rows if same.all() else int(same.argmin())
    if not rows or run.names != second.names or not np.ptp(run.times) > 0.0:
        return None
    span = float(np.ptp(run.times))
    part = float(np.ptp(run.times[:rows])) / span
    halted = second.outcome.is_requested and Outcome.HALTED in (second.outcome, system.outcome)
    if part < LEAST_PART and not halted:
        return None
    some = slice(0, rows, -(-rows // ROWS))
    values = run.values[some], np.asarray(second.values)[some]
    gaps = max(settings.error, GAPS * float(system.report.violation))
    held = HELD * settings.error / min(factor, 1.0)
    channels = [*_channels(system.model, run, values, settings.error, gaps, held)]
    if halted:  # by a SENSOR, one of them or both
        shift = abs(float(second.time[-1] - run.times[-1]))
        shifts = np.append(np.zeros(len(values[0]) - 1), shift)
        channels.append(Channel("ends", "the time of its end", shifts, span))
    found = [each for each in channels if 0.0 < each.range < inf]
    return found, run.times[some], float(run.times[-1])


def _channels(
    model: Model, run: Piece, values: tuple[np.ndarray, np.ndarray], error: float, *least: float
) -> Iterator[Channel]:
    """What lies between two runs, channel by channel; ``least``: of elements, of joints."""
    column = {name: k for k, name in enumerate(run.names)}
    one, other = (Parts(model, column, each) for each in values)
    bodies = [each.label for each in model.moving if f"{each.label}.x" in column]
    for label in bodies:
        yield from _apart(label, one.of_body(label), other.of_body(label), error, error)
    ours = {
        f"{each.label}.{name}"
        for each in model.deck.of("REQUEST") if not each.called.isdisjoint(NUMBERS)
        for name, node in zip(each.result_names, each.outputs(model), strict=True)
        if any(calls(node, *NUMBERS))
    }  # fmt: skip
    wrapped, whole = _measured(model)
    for name, k in column.items():
        kind, _, _ = name.partition("/")
        if kind in ("DIFF", "VARIABLE", "REQUEST", "MREQUEST") and name not in ours:
            x, off = values[0][:, k], np.abs(values[0][:, k] - values[1][:, k])
            off = np.minimum(off, np.abs(off - TURN)) if name in wrapped else off
            size = float(np.abs(x).max(initial=0.0))
            size = max(size, LIMP if kind == "DIFF" else 1.0)
            if kind != "DIFF" and len(off) > MANY:  # a jump that is shifted is one row far off
                off = np.minimum(off, np.append(off[1:], off[-1:]))
            least_range = error * size
            if name in whole and whole[name] in column:
                vector = np.abs(values[0][:, column[whole[name]]])
                least_range = max(least_range, float(vector.max()) * min(error / FELT, PART))
            yield Channel("states", name, off, max(float(np.ptp(x)), least_range))
    for i, j, element in islice(_pairs(model), ELEMENTS):
        seen, other_way = one.seen(i, j), other.seen(i, j)
        if seen is not None and other_way is not None:
            rest = max(least) if element.keyword == "JOINT" else least[0]
            less, most = np.sort([np.ptp(each.place, axis=0) for each in (seen, other_way)], 0)
            turning = most < error * float(np.abs(seen.place).max(initial=1.0))
            rests = np.where(turning & (less < VANISHING * most), inf, rest)
            yield from _apart(element.label, seen, other_way, rests, rest)


def _measured(model: Model) -> tuple[set[str], dict[str, str]]:
    """Columns of REQUESTs that are angles; and those that are components of a vector, by the column
    of its length."""
    wrapped, whole = set(), {}
    for each in model.deck.of("REQUEST"):
        if each.kind or not each.called.isdisjoint(WRAPPED):
            named = zip(each.result_names, each.outputs(model), strict=True)
            wrapped |= {f"{each.label}.{name}" for name, node in named
                        if isinstance(node, Call) and node.name in WRAPPED}  # fmt: skip
        for k in (2, 3, 4, 6, 7, 8) if each.kind else ():
            whole[f"{each.label}.F{k}"] = f"{each.label}.F{1 if k < 5 else 5}"
    return wrapped, whole


def _pairs(model: Model) -> Iterator[tuple[Any, Any, Any]]:
    """Markers of two moving bodies, and what acts between them."""
    for each in model.deck.statements:
        i, j, follower = (getattr(each, end, None) for end in ("i", "j", "jfloat"))
        j = j or follower
        if i and j and each.keyword not in INDIFFERENT and model.acts(each):
            a, b = model.marker(i), model.marker(j)
            if a is not None and b is not None and -1 < a.body != b.body > -1:
                yield i, j, each


def _apart(label: str, one: Frame, other: Frame, way: Any, turn: float) -> Iterator[Channel]:
    """Coordinates and attitudes of a frame in two runs; at rest within ``way`` and ``turn``."""
    off = np.abs(one.place - other.place)
    ranges = np.maximum(np.ptp(one.place, axis=0), ROUNDING / FELT * np.abs(one.place).max(axis=0))
    ranges = np.maximum(ranges, way)
    for k, axis in enumerate("xyz"):
        yield Channel("places", f"{label} {axis}", off[:, k], float(ranges[k]))
    turned, off = _angle(one.axes, one.axes[:1]), _angle(one.axes, other.axes)
    turn = max(turn, float(turned.max(initial=0.0)))
    yield Channel("turns", label, off, turn, " rad")


def _angle(one: np.ndarray, other: np.ndarray) -> np.ndarray:
    """The angle between attitudes (nt,) [rad]."""
    apart = np.linalg.norm(one - other, axis=(1, 2)) / np.sqrt(8.0)
    return 2.0 * np.arcsin(np.minimum(apart, 1.0))


def _estimated(
    system: Ended, settings: Settings, steps: int, factor: float, found: list[Compared]
) -> Iterator[str]:
    """The estimated errors of a run, the worst of each kind."""
    felt = FELT * (LOOSELY if settings.error > LOOSE else 1.0)
    since, worst = inf, dict[str, tuple[float, Channel]]()
    for channels, times, end in found:
        for each in sorted(channels, key=Channel.share, reverse=True)[:MANY]:
            at, course = each.course(factor, times, end)
            since = min(since, float(at[course > LOST].min(initial=inf)))
            if each.kind not in worst or course[-1] > worst[each.kind][0]:
                worst[each.kind] = float(course[-1]), each
    shares = sorted(worst.values(), key=lambda each: -each[0])
    if not shares or not shares[0][0] > felt:
        return
    texts = []
    for off, each in shares:
        share = f"{off:.2%} of its range" if off < 1.0 else "more than its range"
        if off > 0.1 * felt:
            texts.append(f"{off * each.range:.1e}{each.unit} in {each.name} ({share})")
    longest = system.longest
    limited = steps * longest * LIMITED < end - times[0]
    remedy = f"a shorter HMAX than {longest:.3g}" if limited else _remedy(settings)
    yield (
        f"estimated global error {', '.join(texts)} after {steps} steps: {remedy} keeps more digits"
    )
    if since < inf:
        yield f"from t = {since:.4g} on {UNDETERMINED}"


def _remedy(settings: Settings) -> str:
    by_hinit = settings.formula.steps == FIXED_BY_HINIT
    fixed = settings.hinit and (by_hinit or settings.hinit == settings.hmin)
    return "a shorter step" if fixed else f"a smaller ERROR than {settings.error:g}"


# ---- by the method, by sums --------------------------------------------------------------------


def _of_method(settings: Settings) -> Iterator[str]:
    """Why a formula errs."""
    if is_of_order_1(settings):
        yield (
            f"with GAMMA={settings.damping[2]:g} the formula is of order 1, and a run is off by "
            "the root of ERROR rather than by ERROR; HHT damps as well and is of order 2"
        )
    elif settings.formula.order <= 2:
        yield "the formula is of order 2: GSTIFF, RADAU or RKF45 get further with fewer steps"


def is_of_order_1(settings: Settings) -> bool:
    """Whether GAMMA and ALPHA cost NEWMARK an order."""
    alpha, _, gamma = settings.damping
    return bool(settings.formula.damping) and abs(gamma + alpha - 0.5) > FIRST_ORDER


def _of_steps(settings: Settings, report: contract.Report) -> Iterator[str]:
    """What there is to say of steps that a user has chosen."""
    if settings.formula.damping and report.divided:
        yield (
            f"steps were divided {report.divided} times, because the corrector did not converge "
            f"with the requested {settings.hinit:g}: a shorter HINIT, or none, for an error test"
        )
    most = contract.STABLE * report.stable_step
    if settings.formula.steps == FIXED_BY_HINIT and (settings.hinit or 0.0) > most > 0.0:
        yield (
            f"HINIT={settings.hinit:g} is close to the longest stable step, "
            f"{report.stable_step:.3g} by estimate: above it vibrations grow without "
            f"bound; stay below {most:.3g}"
        )


def _added_up(
    settings: Settings, counts: contract.Counts, spent: float, history: History
) -> Iterator[str]:
    """The sum of the errors of all steps, where nothing better is known."""
    spent *= settings.error * (1.0 + float(counts.restarts) / SHIFTED)
    share = spent / (largest_travel(history) or 1.0)  # what only turns: of a radian
    if share > FELT_IN_SUM:
        amount = f"{share:.2%} of" if share < 1.0 else "more than"
        yield (
            f"the estimated errors of {counts.steps} steps add up to {amount} the largest travel "
            f"of a body, a bound where forces damp them: {_remedy(settings)} keeps more digits"
        )
