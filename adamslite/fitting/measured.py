"""What was measured: columns of a file in the units of the deck, and how far they may be off.

Bands are those of reference files (:mod:`adamslite.verification.reference_file`)::

    # tolerance REQUEST/1.F2: abs 20
    # tolerance PART/2.v*: rel 0.01 abs 1e-3

Equation: a value is trusted to ``A + R |value| + P max |value|``, and one that is printed with few
digits to half a unit of the last one over sqrt(3), the standard deviation of rounding; both are
added as squares.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace
from math import sqrt

import numpy as np

from adamslite.errors import UsageError
from adamslite.results.comparison import TURN, TURNING
from adamslite.results.results import Results
from adamslite.results.selection import near, selected
from adamslite.results.unit_factors import unit_factor
from adamslite.verification.reference_file import Reference

#: A hole in the times is as long as so many usual intervals.
HOLE = 5.0
MOST_NAMED = 4


@dataclass(frozen=True, eq=False)
class Measured:
    """Times (nt,), and of each channel values (nt, nc), not a number where nothing was measured.

    ``bands`` (nt, nc): how far each may be off, zero for a channel of which the file does not say
    it; ``notes``: sentences about what was done to the file.
    """

    name: str
    time: np.ndarray
    channels: tuple[str, ...]
    values: np.ndarray
    bands: np.ndarray
    notes: tuple[str, ...] = ()

    @property
    def known(self) -> np.ndarray:
        """Where there is a value (nt, nc)."""
        return np.isfinite(self.values)

    @property
    def count(self) -> int:
        """How many values there are."""
        return int(self.known.sum())

    def apart(self, curves: np.ndarray) -> np.ndarray:
        """Curves less measured values (nt, nc), of angles without whole turns."""
        found, turning = curves - self.values, self.turning
        found[:, turning] -= TURN * np.round(np.nan_to_num(found[:, turning]) / TURN)
        return found

    def rms(self, curves: np.ndarray) -> np.ndarray:
        """Root mean square of what each curve is off (nc,)."""
        return np.asarray(np.sqrt(np.nanmean(self.apart(curves) ** 2, axis=0)))

    @property
    def turning(self) -> np.ndarray:
        """Which channels are angles that may have whole turns more or less (nc,)."""
        return np.array([name.casefold().endswith(TURNING) for name in self.channels])


def measured_of(
    reference: Reference,
    run: Results,
    patterns: Iterable[str] = (),
    window: tuple[float | None, float | None] = (None, None),
) -> Measured:
    """What is fitted of a file.

    Parameters
    ----------
    reference : Reference
        The file as it was read.
    run : Results
        Of the deck, with its channels and units.
    patterns : iterable of str
        Columns of the file; all of them unless given.
    window : (float or None, float or None)
        From when to when, in the time of the deck.

    Raises
    ------
    UsageError
        When the file does not go with the deck, in one sentence.
    """
    table, name = reference.table, reference.path.name or "the measurement"
    if not table.names or not table.time.size:
        raise UsageError(f"{name}: nothing was measured, it has no column or no time")
    wanted = [patterns] if isinstance(patterns, str) else [*patterns]
    chosen = selected(table.names, wanted) if wanted else range(len(table.names))
    names = _known([table.names[k] for k in chosen], name, run)
    notes: list[str] = []
    factors, time = _in_units_of_the_deck(name, table, names, run, notes)
    _need_order(name, time)
    inside = _inside(name, time, window, run)
    values = (table.values[:, [*chosen]] * factors)[inside]
    found = Measured(name, time[inside], tuple(names), values, np.zeros_like(values), tuple(notes))
    found = replace(found, notes=(*notes, *_gaps(found)))
    return replace(found, bands=_bands(reference, [*chosen], inside, factors, found))


def _known(names: Sequence[str], file: str, run: Results) -> list[str]:
    """The columns as the deck calls them."""
    for name in names:
        if name not in run:
            raise UsageError(
                f"{file}: the deck has no result '{name}'{near(name, run.names)}; --of takes some "
                f"columns of the file alone"
            )
    own = {each.casefold(): each for each in run.names}
    return [own[name.casefold()] for name in names]


def _in_units_of_the_deck(
    file: str, table: Results, names: Sequence[str], run: Results, notes: list[str]
) -> tuple[np.ndarray, np.ndarray]:
    """What numbers are multiplied with (nc,), and the times in the unit of the deck (nt,)."""
    changed: dict[str, str] = {}
    unnamed: list[str] = []

    def factor(name: str) -> float:
        have, want = table.channel(name).unit, run.channel(name).unit
        if not have or not want:
            if have and not table.unit_symbols:
                raise UsageError(
                    f"{file}: '{name}' is in {have}, and its unit in the deck is not known"
                    + ("; CUNITS of the REQUEST names it" if "REQUEST/" in name.upper() else "")
                )
            unnamed.append(name)
            return 1.0
        found = unit_factor(have, want)
        if found is None:
            raise UsageError(f"{file}: '{name}' is in {have}, in the deck it is in {want}")
        if have != want:
            changed[have] = want
        return found

    time = table.time * factor("time")
    factors = np.array([factor(name) for name in names])
    if changed:
        words = ", ".join(f"{have} to {want}" for have, want in changed.items())
        notes.append(f"converted to the units of the deck: {words}")
    if unnamed:
        notes.append(f"{_listed(unnamed)}: no unit is named, taken in the units of the deck")
    return factors, time


def _need_order(file: str, time: np.ndarray) -> None:
    if not np.isfinite(time).all():
        raise UsageError(f"{file}: row {int(np.argmin(np.isfinite(time))) + 1} has no time")
    wrong = np.flatnonzero(np.diff(time) <= 0.0)
    if wrong.size:
        at, after = time[wrong[0]], time[wrong[0] + 1]
        what = f"t = {at:g} is there twice" if at == after else f"t = {after:g} follows {at:g}"
        raise UsageError(f"{file}: {what}; times have to increase")


def _inside(
    file: str, time: np.ndarray, window: tuple[float | None, float | None], run: Results
) -> np.ndarray:
    """The rows between two times (nt,)."""
    low, high = (-np.inf if window[0] is None else window[0]), (
        np.inf if window[1] is None else window[1]
    )  # fmt: skip
    inside = np.asarray((time >= low) & (time <= high))
    if not inside.any():
        raise UsageError(f"{file}: nothing was measured from t = {low:g} to {high:g}")
    first, last = time[inside][[0, -1]]
    begin, end = float(run.time[0]), float(run.time[-1])
    slack = 1e-9 * max(abs(last), abs(end))
    if first < begin - slack or last > end + slack:
        raise UsageError(
            f"{file}: measured from t = {first:g} to {last:g}, and the run goes from {begin:g} to "
            f"{end:g}; --end T makes it longer, --from T --to T take a part of the file"
        )
    return inside


def _gaps(found: Measured) -> list[str]:
    """Sentences on values and times that are missing."""
    notes, known = [], found.known
    for k, name in enumerate(found.channels):
        missing = np.flatnonzero(~known[:, k])
        if missing.size == len(found.time):
            raise UsageError(f"{found.name}: '{name}' has no number at any time")
        if missing.size:
            first = found.time[missing[0]]
            notes.append(
                f"{name}: {missing.size} of {len(found.time)} values are no number, the first at "
                f"t = {first:g}; left out"
            )
    steps = np.diff(found.time)
    if steps.size > 2:
        longest, usual = int(np.argmax(steps)), float(np.median(steps))
        if steps[longest] > HOLE * usual:
            notes.append(
                f"nothing was measured from t = {found.time[longest]:g} to "
                f"{found.time[longest + 1]:g}"
            )
    return notes


def _bands(
    reference: Reference,
    chosen: list[int],
    inside: np.ndarray,
    factors: np.ndarray,
    found: Measured,
) -> np.ndarray:
    """How far values may be off (nt, nc)."""
    bands = np.zeros_like(found.values)
    for k, column in enumerate(chosen):
        allowed = reference.tolerance_of(reference.table.names[column])
        if allowed is None:
            continue
        values = np.nan_to_num(reference.table.values[:, column])  # in the units of the file
        rounded = allowed.hidden(values) / sqrt(3.0)
        bands[:, k] = (np.hypot(allowed.allowed(values), rounded) * abs(factors[k]))[inside]
        empty = np.flatnonzero((bands[:, k] <= 0.0) & found.known[:, k])
        if empty.size:
            raise UsageError(
                f"{found.name}: the band of '{found.channels[k]}' is zero at "
                f"t = {found.time[empty[0]]:g}; add 'abs A' to its tolerance"
            )
    return bands


def amplitudes(found: Measured) -> np.ndarray:
    """How far the values of each channel spread (nc,): the standard deviation, else the size."""

    def amplitude(values: np.ndarray) -> float:
        spread, size = float(np.std(values)), float(np.abs(values).max())
        return spread if spread > 1e-12 * size else size or 1.0

    return _per_channel(found, amplitude)


def _per_channel(found: Measured, measure: Callable[[np.ndarray], float]) -> np.ndarray:
    columns = zip(found.values.T, found.known.T, strict=True)
    return np.array([measure(values[known]) for values, known in columns])


def _listed(names: Sequence[str]) -> str:
    more = f" and {len(names) - MOST_NAMED} more" if len(names) > MOST_NAMED else ""
    return ", ".join(names[:MOST_NAMED]) + more
