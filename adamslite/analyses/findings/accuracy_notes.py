"""What a run reports of its own accuracy, which ERROR, a bound of each step, does not say.

A run that reached its end is carried out again with a smaller ERROR, without a word and no further
than ``LOOK`` allows.  What lies between both runs is what the first is off by, whatever damps,
amplifies or shifts its errors; a part of the time stands for all of it.  The error of a channel is
a share of the range that this channel has in the run:

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

from collections.abc import Iterator
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
from adamslite.language.expression import calls
from adamslite.language.method import FIXED, FIXED_BY_HINIT, NUMBERS
from adamslite.results.outcomes import Outcome

if TYPE_CHECKING:
    from adamslite.analyses.dynamics.dynamic import Settings
    from adamslite.analyses.dynamics.history import History, Piece
    from adamslite.equations.system import System
    from adamslite.model.model import Model
    from adamslite.results.results import Results

# The second run is at ERROR over this, over its square where that is not too long: both may err
# alike where they damp a vibration or pass a narrow force. Its difference from the first falls
# short of the error by as much as it errs itself. Its longest step is that share of what limits
# those of the first.
FINER, SHORT, SHORTER = 10.0, 1.2, 0.55
# Where ERROR is close to round-off, or most of such a run would take too long, it is coarser:
# by that, or its square where that takes too long as well; steps grow by that power of it.
FINEST, COARSER, COARSEST, STRETCH = 1e-10, 100.0, 1e-3, 0.13
# Residuals times size of the model that a second run may take (30 ms), or this share of the first.
LOOK, SHARE = 1_250_000.0, 0.03
# What has to be allowed, in first runs, for most of a finer one, and for all of a coarser one.
DEARER, CHEAPER = 1.45, 0.5
# Of less than this share of the time it says nothing; numbers that are compared at most.
LEAST_PART, MOST_NUMBERS = 0.02, 2**21
# A coarser run that takes more than this share of the steps is limited as the first one is, by
# expressions of TIME or zones, and errs alike.
ALIKE = 0.8
# Steps so close to HMAX on average are limited by it.
LIMITED = 0.8
# An error that grows by a higher power of the time is amplified.
POWER, LARGEST = 2.5, 10.0
# Rows and elements that are compared.
ROWS, ELEMENTS, MANY = 2_000, 100, 50
# Gaps of constraints that a coordinate has to exceed by so much.
GAPS = 1e3
# Of joints, ERRORs that it has to exceed: which of their coordinates are free is not looked at.
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
# Errors of all channels, their times, and the part of the time in which they are known.
Compared: TypeAlias = "tuple[list[Channel], np.ndarray, float]"


class Channel(NamedTuple):
    """The error of one channel in time (nt,), what it is a share of, and its unit."""

    kind: str
    name: str
    error: np.ndarray
    range: float
    unit: str = ""

    def share(self, rows: int | None = None) -> float:
        """The largest error of the first rows as a share of the range."""
        return float(np.nanmax(self.error[:rows], initial=0.0)) / self.range

    def grown(self, part: float) -> float:
        """The same at the end of the run, when it is known of the first ``part``: a power of the
        time, or an exponential function where it grows faster than ``POWER`` all the time.
        """
        quarters = [max(self.share(len(self.error) * k // 4 + 1), ROUNDING) for k in range(1, 5)]
        growth = np.diff(np.log(quarters))
        power = float((growth / np.diff(np.log([1.0, 2.0, 3.0, 4.0]))).min())
        if part < 1.0 and power > POWER:
            return min(
                self.share() * np.exp(min(4.0 * growth.min() * (1 / part - 1), 60.0)), LARGEST
            )
        return self.share() * part ** -max(power, 0.0)

    def lost(self, factor: float, rows: int) -> int:
        """The first row in which it is not determined; ``rows`` where there is none."""
        late = factor * self.error > LOST * self.range
        return int(late.argmax()) if late.any() else rows


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
    second: Results | None,
    factor: float,
) -> str:
    """What ERROR does not say about the accuracy of a run, in sentences; empty when it does.

    ``counts`` and ``history`` are those of all of it; ``second`` are the results of a second run,
    and ``factor`` is the error over the difference from it.
    """
    if settings.formula.steps == FIXED:
        return "equal steps without error test: compare a run with half of HINIT"
    steps, report = counts.steps, system.report
    found = _compared(system, settings, history, second) if second else None
    if second and not second.outcome.is_requested and second.outcome is not Outcome.STEP_LIMIT:
        told = [f"its error is not known: a second run ended by {second.outcome.name}"]
    elif found:
        told = [*_estimated(system, settings, steps, factor, found)]
    else:
        told = [*_added_up(settings, counts, float(report.spent), history)]
    if told:
        told += _of_method(settings)
        rough = settings.formula.damping and report.rough_steps > OFTEN * steps
        if rough and not (
            found and second and energy_apart(system.model, history, second) < CARRIED
        ):
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


def second_run(
    settings: Settings, counts: contract.Counts, size: int, history: History, finer: bool
) -> tuple[dict[str, Any], float]:
    """The options of a second run, none where it would take too long, and the error of the first
    over the difference of both; ``finer``: it must not be coarser.
    """
    takes = max(float(counts.residuals) * size, 1.0)
    part = max(LOOK, SHARE * takes) / takes
    if part < LEAST_PART or not 1 < history.numbers < MOST_NUMBERS:
        return {}, 0.0
    apart = np.diff(history.whole.times)
    usual = float(np.median(apart[apart > 0.0])) if apart.any() else inf
    longest = min(settings.hmax or inf, usual)
    # Steps may be limited by expressions of TIME: to their mean.
    hmax = SHORTER * min(longest, float(apart.sum()) / max(1, int(counts.steps)) or inf)
    order, factor = settings.formula.order, SHORT
    much = part ** (2.0 if _is_of_order_1(settings) else order + 1.0) > FINER**2
    error = settings.error / (FINER**2 if much else FINER)
    coarser = min(COARSER if part > CHEAPER else COARSER**2, COARSEST / settings.error)
    if not finer and coarser >= FINER and (part < DEARER or settings.error < FINEST):
        error, stretch = settings.error * coarser, coarser**STRETCH
        hmax = stretch * longest
        factor = 1.0 / (min(coarser ** (order / (order + 1.0)), stretch**order) - 1.0)
    options = {
        "integrator": settings.method, "formulation": settings.form, "error": error,
        "hmax": hmax if hmax < inf else None, "max_steps": int(part * int(counts.steps)) + 1,
    }  # fmt: skip
    return options, factor


def _compared(
    system: Ended, settings: Settings, history: History, second: Results
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
    channels = [*_channels(system.model, run, values, gaps, settings.error)]
    if halted:  # by a SENSOR, one of them or both
        shift = abs(float(second.time[-1] - run.times[-1]))
        shifts = np.append(np.zeros(len(values[0]) - 1), shift)
        channels.append(Channel("ends", "the time of its end", shifts, span))
    found = [each for each in channels if 0.0 < each.range < inf]
    return found, run.times[some], max(part, LEAST_PART)


def _channels(
    model: Model, run: Piece, values: tuple[np.ndarray, np.ndarray], least: float, error: float
) -> Iterator[Channel]:
    """What lies between two runs, channel by channel."""
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
    for name, k in column.items():
        kind, _, _ = name.partition("/")
        if kind in ("DIFF", "VARIABLE", "REQUEST", "MREQUEST") and name not in ours:
            x, off = values[0][:, k], np.abs(values[0][:, k] - values[1][:, k])
            size = float(np.abs(x).max(initial=0.0))
            size = size if kind == "DIFF" else max(size, 1.0)
            if kind != "DIFF" and len(off) > MANY:  # a jump that is shifted is one row far off
                off = np.minimum(off, np.append(off[1:], off[-1:]))
            yield Channel("states", name, off, max(float(np.ptp(x)), error * size))
    for i, j, element in islice(_pairs(model), ELEMENTS):
        seen, other_way = one.seen(i, j), other.seen(i, j)
        if seen is not None and other_way is not None:
            rest = max(least, HELD * error) if element.keyword == "JOINT" else least
            less, most = np.sort([np.ptp(each.place, axis=0) for each in (seen, other_way)], 0)
            turning = most < error * float(np.abs(seen.place).max(initial=1.0))
            rests = np.where(turning & (less < VANISHING * most), inf, rest)
            yield from _apart(element.label, seen, other_way, rests, rest)


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
    system: Ended, settings: Settings, steps: int, factor: float, found: Compared
) -> Iterator[str]:
    """The estimated errors of a run, the worst of each kind."""
    channels, times, part = found
    felt = FELT * (LOOSELY if settings.error > LOOSE else 1.0)
    worst: dict[str, Channel] = {}
    for each in channels:
        if each.kind not in worst or each.share() > worst[each.kind].share():
            worst[each.kind] = each
    shares = [(factor * each.grown(part), each) for each in worst.values()]
    shares.sort(key=lambda each: -each[0])
    if not shares or not shares[0][0] > felt:
        return
    texts = []
    for off, each in shares:
        share = f"{off:.2%} of its range" if off < 1.0 else "more than its range"
        if off > 0.1 * felt:
            texts.append(f"{off * each.range:.1e}{each.unit} in {each.name} ({share})")
    longest = system.longest
    limited = steps * longest * LIMITED < float(np.ptp(times)) / part
    remedy = f"a shorter HMAX than {longest:.3g}" if limited else _remedy(settings)
    yield (
        f"estimated global error {', '.join(texts)} after {steps} steps: {remedy} keeps more digits"
    )
    since = min(each.lost(factor, len(times)) for each in channels)
    if since < len(times):
        yield f"from t = {times[since]:.4g} on the result is not determined at this ERROR"


def _remedy(settings: Settings) -> str:
    by_hinit = settings.formula.steps == FIXED_BY_HINIT
    fixed = settings.hinit and (by_hinit or settings.hinit == settings.hmin)
    return "a shorter step" if fixed else f"a smaller ERROR than {settings.error:g}"


# ---- by the method, by sums --------------------------------------------------------------------


def _of_method(settings: Settings) -> Iterator[str]:
    """Why a formula errs."""
    if _is_of_order_1(settings):
        yield (
            f"with GAMMA={settings.damping[2]:g} the formula is of order 1, and a run is off by "
            "the root of ERROR rather than by ERROR; HHT damps as well and is of order 2"
        )
    elif settings.formula.order <= 2:
        yield "the formula is of order 2: GSTIFF, RADAU or RKF45 get further with fewer steps"


def _is_of_order_1(settings: Settings) -> bool:
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
