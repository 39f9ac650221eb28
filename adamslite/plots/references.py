"""A reference beside the curves of a plot: its line, the band of its tolerance, the difference."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from math import ceil
from pathlib import Path

import numpy as np

from adamslite.errors import UsageError
from adamslite.plots.selection import Curve
from adamslite.results.common_terms import deck_of, of_deck
from adamslite.results.comparison import USUAL, Mismatch, Tolerance, sampler
from adamslite.results.results import Results
from adamslite.verification.reference_file import Reference, read_reference

OTHER_DECK = "{name} is of another deck"


@dataclass(frozen=True, eq=False)
class Compared:
    """A channel of the reference, at its times within those of the results.

    time, values : (nt,), of the reference
    allowed : (nt,), half the height of the band of its tolerance
    share : (nt,), difference of the results as a part of what is allowed
    across : (nt,), the channel of the horizontal axis, None where the reference has none
    """

    time: np.ndarray
    values: np.ndarray
    allowed: np.ndarray
    share: np.ndarray
    across: np.ndarray | None


@dataclass(frozen=True, eq=False)
class Beside:
    """The channels of a plot that a reference has; ``notes`` are sentences about it."""

    name: str
    compared: dict[str, Compared]
    notes: tuple[str, ...]

    @property
    def verdict(self) -> str:
        """Whether the curves are inside of their tolerances."""
        worst = {
            name: float(np.max(np.where(np.isfinite(c.share), np.abs(c.share), np.inf)))
            for name, c in self.compared.items() if c.time.size
        }  # fmt: skip
        name = max(worst, key=lambda each: worst[each])
        if worst[name] <= 1.0:
            return f"within {_percent(worst[name])} of the tolerance of {self.name}"
        shares = self.compared[name].share
        first = self.compared[name].time[~(np.abs(shares) <= 1.0)][0]
        return f"outside the tolerance of {self.name}: {name} from t = {first:.4g}"


def _percent(share: float) -> str:
    """A share, rounded up."""
    return f"{ceil(100.0 * share - 1e-6):d} %" if share > 1e-3 else "0.1 %"


def reference_of(given: Reference | Results | str | Path) -> Reference:
    """A reference from what a user may give: a file, results, or a reference as it was read."""
    if isinstance(given, Results):
        return Reference(path=Path("the reference"), table=given)
    return given if isinstance(given, Reference) else read_reference(given)


def beside(results: Results, curves: Sequence[Curve], reference: Reference, x: str) -> Beside:
    """What a reference has to say about curves over the channel ``x``.

    Raises
    ------
    UsageError
        When it has none of the channels, or none of the times.
    """
    (table, notes), name = of_deck(reference.table, deck_of(results)), reference.path.name
    shared = [each.channel.name for each in curves if each.channel.name in table]
    if not shared:
        listed = ", ".join(table.names[:3]) + (", ..." if len(table.names) > 3 else "")
        raise UsageError(f"{name} has none of these channels; it has {listed or 'none at all'}")
    inside = _within(results.time, table.time)
    if not inside.any():
        raise UsageError(f"{name} and the results have no time in common")
    hashes = [each.meta.get("deck hash", "") for each in (results, table)]
    if all(hashes) and hashes[0] != hashes[1]:
        notes.append(OTHER_DECK.format(name=name))
    if len(shared) < len(curves):
        notes.append(f"{name} has {len(shared)} of the {len(curves)} channels")
    times = table.time[inside]
    how = reference.interpolate
    try:
        sampler(results, times, how)
    except Mismatch:
        how = "linear"
        notes.append(f"interpolated linearly to the times of {name}")
    sample, across = _sampled(results, times, how, name), table[x][inside] if x in table else None
    found = {
        each: _compared(
            times, sample(results[each]), table[each][inside],
            reference.tolerance_of(each) or USUAL, across,
        )
        for each in shared
    }  # fmt: skip
    return Beside(name, found, tuple(notes))


def _sampled(
    results: Results, times: np.ndarray, how: str | None, name: str
) -> Callable[[np.ndarray], np.ndarray]:
    try:
        return sampler(results, times, how)
    except Mismatch as fault:
        raise UsageError(f"{name} cannot be drawn beside the results: {fault}") from None


def _within(covered: np.ndarray, times: np.ndarray) -> np.ndarray:
    slack = 1e-9 * max(float(np.ptp(covered)), abs(float(covered[-1])))
    return (times >= covered[0] - slack) & (times <= covered[-1] + slack)


def _compared(
    times: np.ndarray,
    values: np.ndarray,
    reference: np.ndarray,
    tolerance: Tolerance,
    across: np.ndarray | None,
) -> Compared:
    allowed = tolerance.allowed(reference)
    off = tolerance.off(values, reference)  # beyond what rounding of the reference hides
    with np.errstate(divide="ignore", invalid="ignore"):
        share = np.sign(values - reference) * np.where(off == 0.0, 0.0, off / allowed)
    band = allowed + tolerance.hidden(reference)
    return Compared(times, reference, band, share, across)
