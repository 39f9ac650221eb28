"""The cost of accuracy: a scene solved by every integrator at several values of ERROR.

The error of a run is that of ``run_error``, against a tight run that another method confirms; how
much the tight run still changes with its own ERROR is not known any better.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from importlib import import_module
from math import floor, inf, isfinite, log10
from statistics import median
from typing import Protocol, TypeVar

import adamslite
from adamslite.errors import RunFailed, UsageError
from adamslite.language.method import method_of
from adamslite.results.comparison import fits
from adamslite.results.outcomes import Outcome
from adamslite.results.results import Results, UnknownChannel
from adamslite.results.run_error import error_of
from adamslite.verification.variants import Run, Variant

# Errors below it are not told apart; what an error of 10^-k misses of k digits by its logarithm.
LEAST_ERROR, ROUND_OFF = 1e-16, 1e-9
#: ERROR of the charts, and of the reference.
ERRORS = (1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8)
TIGHT, LESS_TIGHT = 1e-10, 1e-8
#: Methods up to this order would need too many steps at ``TIGHT``.
TOO_LOW = 2
#: A hundred times smaller ERROR leaves this much more than the change at most.
EXPLAINED, ROUNDING = 3.0, 1e-12
#: Digits to recommend for.
DIGITS = 3
#: A reference that is not known better than this is none.
USELESS = 1e-2
#: Long runs are repeated less often: (CPU [s] from, at most this often).
SHORTER = ((2.0, 1), (0.5, 2))

#: A run whose quickest repetition takes less than this many times the usual CPU of another one may
#: be as quick.
NOISE = 1.05
#: Numbers of steps, and errors, that differ by less than this part are equal.
EQUAL_STEPS, EQUAL_ERRORS = 0.01, 0.1


@dataclass(kw_only=True)
class Point:
    """One setting of one program.

    error : None where it is not known;  cpu : solve CPU [s], one per run
    reason : why there is no result, else empty;  given_up : because it took too long
    """

    program: str
    setting: str
    error: float | None = None
    steps: int = 0
    cpu: list[float] = field(default_factory=list)
    reason: str = ""
    given_up: bool = False

    @property
    def ok(self) -> bool:
        """Whether the run reached its end."""
        return not self.reason

    @property
    def median(self) -> float:
        """CPU [s] to expect."""
        return median(self.cpu) if self.cpu else inf

    @property
    def least(self) -> float:
        """CPU [s] of the quickest run."""
        return min(self.cpu, default=inf)

    @property
    def digits(self) -> int:
        """Digits that are right; 0 where that is not known, and of an infinite error."""
        if not self.ok or self.error is None or not isfinite(self.error):
            return 0
        return max(0, floor(ROUND_OFF - log10(max(self.error, LEAST_ERROR))))

    def meets(self, target: float) -> bool:
        """Whether the error is known and small enough."""
        return self.ok and self.error is not None and self.error <= target


@dataclass(frozen=True)
class Truth:
    """A reference run, how well it is known, and what it was, in words."""

    results: Results
    doubt: float
    origin: str


@dataclass(frozen=True, repr=False)
class Chart:
    """All points of a scene, integrator after integrator from loose to tight, and their truth.

    As text it is what `adamslite chart` prints.
    """

    points: list[Point]
    truth: Truth
    channels: tuple[str, ...] = ()
    """What the error is that of; the motion of everything when empty."""

    @property
    def useless(self) -> bool:
        """Whether the tight runs do not agree on anything."""
        return not self.truth.doubt <= USELESS

    def recommended(self, digits: int) -> Point | None:
        """The cheapest point with so many digits, if tighter ones of its integrator have them too.

        A single hit at a loose ERROR is luck. Among those that timing cannot tell from the cheapest
        it is the one with most digits.
        """
        sure = []
        for mine in by_program(self.points).values():
            for point in reversed([p for p in mine if not p.given_up]):
                if point.digits < digits:
                    break
                sure.append(point)
        cheapest = min((p.median for p in sure), default=inf)
        ties = [p for p in sure if p.least <= NOISE * cheapest]
        return max(ties, key=lambda p: (p.digits, -p.median), default=None)

    def __str__(self) -> str:
        text = import_module("adamslite.plots.accuracy_text")
        return text.table(self) + text.verdict(self, DIGITS).rstrip()

    def __repr__(self) -> str:
        return f"<Chart: {len(self.points)} runs against {self.truth.origin}>"

    def _repr_html_(self) -> str:
        """Points and recommendation, for a notebook."""
        return adamslite.html(self)


class OfProgram(Protocol):
    """A result of a program."""

    @property
    def program(self) -> str: ...


P = TypeVar("P", bound=OfProgram)


def by_program(points: Iterable[P]) -> dict[str, list[P]]:
    """Points by the name of their program."""
    found: dict[str, list[P]] = {}
    for point in points:
        found.setdefault(point.program, []).append(point)
    return found


class WithSteps(Protocol):
    """A result that took a number of steps and has an error, if that is known."""

    @property
    def steps(self) -> int: ...
    @property
    def error(self) -> float | None: ...


S = TypeVar("S", bound=WithSteps)


def by_steps(points: Iterable[S]) -> list[list[S]]:
    """Neighbours with equally many steps together: their ERROR has no effect on the steps."""
    groups: list[list[S]] = []
    for point in points:
        if groups and abs(point.steps - groups[-1][0].steps) <= EQUAL_STEPS * point.steps:
            groups[-1].append(point)
        else:
            groups.append([point])
    return groups


def alike(points: Iterable[S]) -> list[list[S]]:
    """Neighbours with equally many steps and equal errors together: one run, measured again."""
    groups: list[list[S]] = []
    for same in by_steps(points):
        for k, point in enumerate(same):
            if k and _close(point.error, groups[-1][0].error):
                groups[-1].append(point)
            else:
                groups.append([point])
    return groups


def _close(a: float | None, b: float | None) -> bool:
    return a == b or (a is not None and b is not None and abs(a - b) <= EQUAL_ERRORS * max(a, b))


def largest_group(points: Iterable[S], least: int = 3) -> list[S]:
    """The most neighbours with equally many steps, if these are ``least`` at least, else none."""
    found = max(by_steps(points), key=len, default=[])
    return found if len(found) >= least else []


@dataclass(frozen=True)
class Tight:
    """A tight run, and how far a less tight one of the same method is from it."""

    variant: Variant
    results: Results
    change: float


def find_truth(run: Run, tried: Iterable[Variant], channels: Sequence[str] = ()) -> Truth:
    """The tight run that changes least when its ERROR is made larger, if another method agrees.

    Raises
    ------
    RunFailed
        When no method reaches the end.
    UsageError
        When there is nothing to compare.
    """
    done: list[Tight] = []
    failures: list[str] = []
    for variant in tried:
        if method_of(variant.integrator).order <= TOO_LOW:
            continue
        try:
            tight, less = (run(error=error, **variant.options) for error in (TIGHT, LESS_TIGHT))
        except UsageError as refusal:
            failures.append(str(refusal))
            continue
        if tight.outcome is Outcome.DONE is less.outcome:
            _need_something(tight, channels)
            done.append(Tight(variant, tight, error_of(less, tight, channels)))
        else:
            why = tight.message or less.message or Outcome.NOT_FINITE.sentence
            failures.append(f"{variant.label} ERROR={TIGHT:g}: {why}")
    if not done:
        raise RunFailed(f"there is no reference to chart against. {' '.join(failures)}")
    best, *others = sorted(done, key=lambda each: each.change)
    return _checked(best, others, channels)


def _checked(best: Tight, others: Sequence[Tight], channels: Sequence[str]) -> Truth:
    """How sure the best run is: its own change, if another method agrees.

    Another method does when it is no further away than its own change explains; otherwise nobody
    knows which of them is right, and the distance is what is not known.
    """
    name = f"{best.variant.label} at ERROR={TIGHT:g}"
    own = method_of(best.variant.integrator).family
    rivals = [o for o in others if method_of(o.variant.integrator).family != own] or others
    if not rivals:
        origin = f"{name}, which no other method checks"
        return Truth(best.results, best.change or inf, origin)
    apart = [(error_of(o.results, best.results, channels), o) for o in rivals]
    for distance, other in apart:
        if distance <= EXPLAINED * max(other.change, best.change, ROUNDING):
            origin = f"{name}; {other.variant.label} agrees within {distance:.1e}"
            # No change at all: HMAX decides on the steps, and ERROR says nothing of them.
            return Truth(best.results, best.change or distance, origin)
    distance, other = min(apart, key=lambda pair: pair[0])
    origin = f"{name}; {other.variant.label} disagrees"
    return Truth(best.results, distance, origin)


def _need_something(results: Results, channels: Sequence[str]) -> None:
    for channel in channels:
        if not any(fits(channel, name) for name in results.names):
            try:
                results[channel]
            except UnknownChannel as unknown:  # which says what names are near
                raise UsageError(str(unknown)) from None
    if not results.summary["steps"]:
        raise UsageError(
            "this run takes no integration steps (statics, kinematics, or no time at all): "
            "there is nothing to choose"
        )


def climb(
    run: Run, variant: Variant, errors: Iterable[float], truth: Truth, channels: Sequence[str] = ()
) -> Iterator[Point]:
    """One integrator from loose to tight; up to a rejection or a run that takes too long."""
    for error in errors:
        point = Point(program=variant.label, setting=f"ERROR={error:g}")
        try:
            results = run(error=error, **variant.options)
        except UsageError as refusal:
            point.reason = str(refusal)
            yield point
            return
        point.steps = results.summary["steps"]
        point.cpu.append(results.summary["solve_cpu_s"])
        if results.outcome is Outcome.DONE:
            point.error = max(error_of(results, truth.results, channels), truth.doubt)
        else:
            point.reason = results.message or results.outcome.sentence
        point.given_up = results.outcome is Outcome.INTERRUPTED
        yield point
        if point.given_up:
            return


def repeats_of(cpu: float, repeats: int) -> int:
    """How often a run that took so many seconds is done in all: long ones less often."""
    return next((min(repeats, k) for least, k in SHORTER if cpu > least), repeats)


def measure(
    run: Run,
    tried: Sequence[Variant],
    errors: Sequence[float] = ERRORS,
    repeats: int = 3,
    channels: Sequence[str] = (),
) -> Chart:
    """Chart a scene.

    Parameters
    ----------
    run : function of keyword arguments of `simulate`, returns Results
        INTERRUPTED counts as taking too long; see `patient`.
    tried : sequence of Variant
    errors : sequence of float
        From loose to tight.
    repeats : int
        Each setting is run so often, the settings taking turns.
    channels : sequence of str
        Names or patterns of the results that count; the motion of everything when empty.

    Raises
    ------
    RunFailed, UsageError
        When there is no reference, or nothing to choose.
    """
    truth = find_truth(run, tried, channels)
    made = [
        ({"error": error, **variant.options}, point)
        for variant in tried
        for error, point in zip(errors, climb(run, variant, errors, truth, channels), strict=False)
    ]
    for turn in range(1, repeats):
        for options, point in made:
            if point.ok and turn < repeats_of(point.cpu[0], repeats):
                point.cpu.append(run(**options).summary["solve_cpu_s"])
    return Chart([point for _, point in made], truth, tuple(channels))
