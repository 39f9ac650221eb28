"""The difference of results from a reference, channel by channel.

Channel c is inside its tolerance when at every reference time t

    |value_c(t) - reference_c(t)| - H_c(t) <= A + R |reference_c(t)| + P max_t |reference_c|

where H is half a unit of the last digit of a reference printed with few digits, or of a file that
rounds, else 0. The angles psi and phi of a PART are compared without whole turns.
The reference may hold any few of the channels. Its times must be output times of the results unless
an interpolation is requested.
"""

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from difflib import get_close_matches
from fnmatch import fnmatchcase

import numpy as np

import adamslite
from adamslite.results.results import Results

#: Two times are the same when they differ by less than this part of the reference's time span.
SAME_TIME = 1e-9

#: Angles that may have whole turns more or less.
TURNING, TURN = (".psi", ".phi"), 2 * np.pi

INTERPOLATIONS = ("linear", "cubic")


class Mismatch(ValueError):
    """Results and reference that cannot be compared at all; says why."""


@dataclass(frozen=True, kw_only=True)
class Tolerance:
    """How far a channel may be off: A + R |reference| + P max|reference|, see the module.

    `digits` is the number of significant digits that the reference is printed with: what rounding
    to them hides is no difference. 0 means the reference is as good as its tolerance needs.
    """

    abs: float = 0.0
    rel: float = 0.0
    peak: float = 0.0
    digits: int = 0

    def allowed(self, reference: np.ndarray) -> np.ndarray:
        """Return the allowed difference at each time, shape (nt,), for the (nt,) reference."""
        size = np.abs(reference)
        return self.abs + self.rel * size + self.peak * size.max(initial=0.0)

    def off(self, value: np.ndarray, reference: np.ndarray) -> np.ndarray:
        """Return how far (nt,) `value` is from all numbers that are printed like `reference`."""
        return np.maximum(np.abs(value - reference) - self.hidden(reference), 0.0)

    def hidden(self, reference: np.ndarray) -> np.ndarray:
        """Return what rounding to `digits` may hide of the (nt,) reference, shape (nt,)."""
        size = np.abs(reference)
        if not self.digits:
            return np.zeros_like(size)
        leading = np.floor(np.log10(size, out=np.zeros_like(size), where=size > 0))
        return np.where(size > 0, 0.5 * 10.0 ** (leading + 1 - self.digits), 0.0)

    def __str__(self) -> str:
        parts = (
            ("abs", self.abs),
            ("rel", self.rel),
            ("peak", self.peak),
            ("digits", self.digits),
        )
        return " ".join(f"{name} {value:g}" for name, value in parts if value) or "exact"


#: The tolerance of `compare` when none is given.
USUAL = Tolerance(abs=1e-6, peak=1e-6)


@dataclass(frozen=True, kw_only=True)
class Difference:
    """The worst a channel does, and when it first leaves its tolerance.

    Parameters
    ----------
    name : str
        Channel, or the text of a measure.
    worst : float
        |value - reference| beyond its rounding, where it is largest compared with what is allowed.
    allowed : float
        What is allowed there.
    time : float or None
        When that is.
    leaves : float or None
        First reference time outside the tolerance; None when it never leaves.
    inside : bool
        Whether all differences are within the tolerance.
    """

    name: str
    worst: float
    allowed: float
    time: float | None = None
    leaves: float | None = None
    inside: bool

    @property
    def cells(self) -> tuple[str, ...]:
        """Its row under ``HEAD``."""
        time = "" if self.time is None else f"{self.time:.6g}"
        leaves = "" if self.leaves is None else f"{self.leaves:.6g}"
        if not self.inside and self.leaves is None:
            leaves = "outside"
        return self.name, f"{self.worst:.3e}", f"{self.allowed:.3e}", time, leaves

    @property
    def severity(self) -> float:
        """Part of the tolerance that is used up: above 1 (or not a number) is outside."""
        if self.inside and self.worst == 0:
            return 0.0
        ratio = self.worst / self.allowed if self.allowed else np.inf
        return float(ratio) if np.isfinite(ratio) else float("inf")


#: Titles of the columns of a comparison.
HEAD = ("channel", "worst", "allowed", "at t", "outside from")


@dataclass(frozen=True, repr=False)
class Comparison:
    """All differences between results and a reference, in the order of the reference's columns.

    As text it is the table that `adamslite diff --all` prints.
    """

    differences: tuple[Difference, ...]

    @property
    def outside(self) -> list[Difference]:
        """The differences that are too large, the worst first."""
        found = [each for each in self.differences if not each.inside]
        return sorted(found, key=lambda each: -each.severity)

    @property
    def outside_first(self) -> list[Difference]:
        """All differences, those that are too large before the others."""
        return [*self.outside, *(each for each in self.differences if each.inside)]

    @property
    def verdict(self) -> str:
        """How many channels were compared, and how many are outside."""
        outside, count = len(self.outside), len(self.differences)
        their = "its tolerance" if outside == 1 else "their tolerances"
        found = f"{outside} outside {their}" if outside else "all within their tolerances"
        return f"{count} compared, {found}"

    def __str__(self) -> str:
        return "\n".join([*table_lines(self.outside_first), self.verdict])

    def __repr__(self) -> str:
        return f"<Comparison: {self.verdict}>"

    @property
    def inside(self) -> bool:
        """Whether every channel is within its tolerance."""
        return all(difference.inside for difference in self.differences)

    @property
    def worst(self) -> Difference | None:
        """The difference that uses up most of its tolerance."""
        return max(self.differences, key=lambda difference: difference.severity, default=None)

    def __iter__(self) -> Iterator[Difference]:
        return iter(self.differences)

    def _repr_html_(self) -> str:
        """Differences as a table, for a notebook."""
        return adamslite.html(self)


def compare(
    results: Results,
    reference: Results,
    tolerance: Tolerance | Callable[[str], Tolerance] = USUAL,
    interpolate: str | None = None,
) -> Comparison:
    """Compare `results` with the channels and times of `reference`.

    Parameters
    ----------
    results, reference : Results
        The channels of the reference may be a subset.
    tolerance : Tolerance or function of a channel name that returns one
        By default 1e-6, plus 1e-6 of the channel's largest reference value.
    interpolate : {None, "linear", "cubic"}
        How to get values at reference times that are not output times; None makes them an error.

    Raises
    ------
    Mismatch
        When the results lack a channel or a time of the reference.
    """
    tolerance_of = tolerance if callable(tolerance) else lambda _: tolerance
    missing = [name for name in reference.names if name not in results]
    if missing:
        others = f" and {len(missing) - 1} more" if len(missing) > 1 else ""
        near = get_close_matches(missing[0].casefold(), [n.casefold() for n in results], n=1)
        exact = next((name for name in results if [name.casefold()] == near), "")
        hint = f"; did you mean {exact}?" if exact else ""
        raise Mismatch(f"the results have no channel '{missing[0]}'{others}{hint}")
    hidden = [each.printed.hidden(each.time) for each in (results, reference)]
    rounded = sum(float(each.max(initial=0.0)) for each in hidden)
    sample = sampler(results, reference.time, interpolate, rounded)

    def difference(name: str) -> Difference:
        turning = name.casefold().endswith(TURNING)
        history, expected = results[name], reference[name]
        value = sample(np.unwrap(history) if turning and interpolate else history)
        if turning:
            value = value - TURN * np.round((value - expected) / TURN)
        slack = results.printed.hidden(value) + reference.printed.hidden(expected)
        return _difference(name, value, expected, reference.time, tolerance_of(name), slack)

    return Comparison(tuple(map(difference, reference.names)))


def table_lines(differences: Iterable[Difference]) -> list[str]:
    """A head, and a line for each channel."""
    rows = [HEAD, *(each.cells for each in differences)]
    width = max(len(row[0]) for row in rows)
    return [
        f"{name:{width}}  {worst:>10}  {allowed:>10}  {time:>10}  {leaves}".rstrip()
        for name, worst, allowed, time, leaves in rows
    ]


def need_content(reference: Results) -> None:
    """Reject a reference with which nothing could differ.

    Raises
    ------
    Mismatch
        In one sentence.
    """
    if not reference.names:
        raise Mismatch("the reference has no channel at all")
    if not reference.time.size:
        raise Mismatch("the reference has no output time at all")


def of_different_decks(results: Results, reference: Results) -> str:
    """A sentence where the two are not of one deck; else empty."""
    hashes = [each.meta.get("deck hash") for each in (results, reference)]
    if not all(hashes) or hashes[0] == hashes[1]:
        return ""
    titles = [each.meta.get("deck", "") for each in (results, reference)]
    same = titles[0] == titles[1]
    what = f"both called '{titles[0]}'" if same else f"'{titles[0]}' and '{titles[1]}'"
    return f"A and B are results of different decks, {what}"


def fits(pattern: str, name: str) -> bool:
    """Whether channel `name` is meant by `pattern` (`PART/2.x`, `PART/*.x`), in any case."""
    return fnmatchcase(name.casefold(), pattern.casefold())


def sampler(
    results: Results, times: np.ndarray, interpolate: str | None, rounded: float = 0.0
) -> Callable[[np.ndarray], np.ndarray]:
    """Return the function from a history of `results`, shape (nt,), to its values at `times`.

    Output times that differ by no more than ``rounded`` are the same.
    """
    if times.size == 0:
        return lambda history: history[:0]
    if results.time.size == 0:
        raise Mismatch("the results hold no output time at all")
    _need_numbers("results", results.time)
    _need_numbers("reference", times)
    slack = max(SAME_TIME * max(float(np.ptp(times)), abs(float(times[-1]))), rounded)
    if _same_times(results.time, times, 0.0 if interpolate else slack):
        return lambda history: history
    _need_order(results.time)
    _need_within(times, results.time, slack)
    if interpolate == "linear":
        return lambda history: np.interp(times, results.time, history)
    if interpolate == "cubic":
        return lambda history: _cubic(results.time, history, times)
    return _at_output_times(results.time, times, slack)


def _need_numbers(whose: str, times: np.ndarray) -> None:
    """A row without a time belongs to no other row."""
    rows = np.flatnonzero(~np.isfinite(times))
    if rows.size:
        raise Mismatch(f"row {rows[0] + 1} of the {whose} has the time {times[rows[0]]:g}")


def _same_times(covered: np.ndarray, times: np.ndarray, slack: float) -> bool:
    """Whether each row belongs to the row in its place, also where a run went back or recorded one
    time twice.
    """
    return covered.shape == times.shape and bool((np.abs(covered - times) <= slack).all())


def _need_order(covered: np.ndarray) -> None:
    """Where a run returned to an earlier state, a time has several rows and nothing lies between
    two.
    """
    back = np.flatnonzero(np.diff(covered) < 0.0)
    if back.size:
        raise Mismatch(
            f"the results go back from t = {covered[back[0]]:g} to {covered[back[0] + 1]:g}: "
            "nothing can be interpolated; choose the same output times"
        )


def _need_within(times: np.ndarray, covered: np.ndarray, slack: float) -> None:
    if times.min() < covered[0] - slack or times.max() > covered[-1] + slack:
        raise Mismatch(
            f"the reference goes from t = {times.min():g} to {times.max():g}, "
            f"the results only from {covered[0]:g} to {covered[-1]:g}"
        )


def _at_output_times(
    covered: np.ndarray, times: np.ndarray, slack: float
) -> Callable[[np.ndarray], np.ndarray]:
    after = np.searchsorted(covered, times).clip(0, covered.size - 1)
    before = (after - 1).clip(0)
    nearest = np.where(
        np.abs(covered[before] - times) < np.abs(covered[after] - times), before, after
    )
    off = np.abs(covered[nearest] - times) > slack
    if off.any():
        raise Mismatch(
            f"t = {times[off][0]:.12g} is not an output time of the results "
            f"(the nearest is {covered[nearest][off][0]:.12g}); "
            "choose the same output step, or state an interpolation (linear, cubic)"
        )
    last = np.searchsorted(covered, covered[nearest], side="right") - 1  # of rows at one time
    return lambda history: history[last]


def _cubic(covered: np.ndarray, history: np.ndarray, times: np.ndarray) -> np.ndarray:
    """All of a spline depends on each of its points: one that is not finite, or slopes that are
    larger than any number, leave no value.
    """
    from scipy.interpolate import CubicSpline

    last = np.append(np.diff(covered) > 0.0, True)  # of records at one time
    if not np.isfinite(history[last]).all():
        return np.full(times.shape, np.nan)
    if last.sum() < 2:
        return np.full(times.shape, history[-1])
    with np.errstate(over="ignore", invalid="ignore"):
        try:
            return CubicSpline(covered[last], history[last])(times)
        except ValueError:  # of slopes that are not finite
            return np.full(times.shape, np.nan)


def _difference(
    name: str,
    value: np.ndarray,
    reference: np.ndarray,
    times: np.ndarray,
    tolerance: Tolerance,
    hidden: np.ndarray,
) -> Difference:
    """The worst of a channel; all arrays (nt,), ``hidden`` what rounding of files hides."""
    off = tolerance.off(value, reference)
    off = np.where(hidden > 0, np.maximum(off - hidden, 0.0), off)
    allowed = tolerance.allowed(reference)
    # A value that is not a number is never inside, even where the reference is not one either.
    outside = ~(off <= allowed)
    if off.size == 0:
        return Difference(name=name, worst=0.0, allowed=0.0, inside=True)
    with np.errstate(divide="ignore", invalid="ignore"):
        used = np.where(outside & (allowed == 0), np.inf, np.nan_to_num(off / allowed, nan=0.0))
    used[~np.isfinite(off)] = np.inf
    worst = int(np.argmax(used))
    return Difference(
        name=name,
        worst=float(off[worst]),
        allowed=float(allowed[worst]),
        time=float(times[worst]),
        leaves=float(times[outside][0]) if outside.any() else None,
        inside=not outside.any(),
    )
