"""Sobol indices: how much of the variance of a measure each number is behind.

::

    first order   S_i = V[E(y | x_i)] / V[y]              what x_i does by itself
    total         T_i = 1 - V[E(y | all but x_i)] / V[y]  with what it does together with others

Numbers are independent and equally likely over their ranges. First indices sum up to 1 at most,
totals to 1 at least; both are equal where nothing works together.

Source: A. Saltelli et al., Variance based sensitivity analysis of model output, Computer Physics
Communications 181 (2010): N points A, N points B of a Sobol sequence of 2 d dimensions, and for
each number i the points A with that number from B, N (d + 2) runs in this order.
"""

from __future__ import annotations

import csv
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from io import StringIO

import numpy as np

from adamslite.errors import UsageError
from adamslite.results.selection import selected
from adamslite.sweeps.ranges import SALTELLI, stacked
from adamslite.sweeps.record import Sweep

#: Part of the resamples inside of an interval, and how many there are.
CONFIDENCE, RESAMPLES = 0.95, 999
#: A measure that changes by less, as part of its size, does not vary.
NOISE = 1e-12
MOST_NAMED = 3
HEAD = ("measure", "number", "first", "first_low", "first_high", "total", "total_low", "total_high")


@dataclass(frozen=True, eq=False)
class SobolIndices:
    """First and total indices of measures.

    Parameters
    ----------
    measures, names : tuple of str
        The measures, and the numbers that vary.
    first, total : (measure, number) array
        Not a number where a measure does not vary.
    first_interval, total_interval : (measure, number, 2) array
        Ends of the intervals in which 95 of 100 resamples of the points lie (bootstrap).
    mean, deviation : (measure,) array
        Of each measure, over all points.
    points : int
        N, of N (d + 2) runs.
    units : tuple of str
        Of the measures.
    """

    measures: tuple[str, ...]
    names: tuple[str, ...]
    first: np.ndarray
    total: np.ndarray
    first_interval: np.ndarray
    total_interval: np.ndarray
    mean: np.ndarray
    deviation: np.ndarray
    points: int
    units: tuple[str, ...]

    def __str__(self) -> str:
        return "".join(f"{line}\n" for line in self._lines())

    def _lines(self) -> Iterator[str]:
        runs = self.points * (len(self.names) + 2)
        yield f"Sobol indices of {runs} runs ({self.points} points), with intervals of 95 %"
        width = max(6, *map(len, self.names))
        for m, measure in enumerate(self.measures):
            unit = f" {self.units[m]}" if self.units[m] else ""
            yield ""
            if np.isnan(self.first[m]).all():
                yield f"{measure}: {self.mean[m]:.6g}{unit}, does not vary"
                continue
            spread = f"standard deviation {self.deviation[m]:.4g}{unit}"
            yield f"{measure}: mean {self.mean[m]:.4g}{unit}, {spread}"
            yield f"  {'number':<{width}}  {'first':>7}  {'interval':<16}  {'total':>7}  interval"
            for k, name in enumerate(self.names):
                first = _entry(self.first[m, k], self.first_interval[m, k])
                total = _entry(self.total[m, k], self.total_interval[m, k])
                yield f"  {name:<{width}}  {first}  {total}".rstrip()
            sums = f"{self.first[m].sum():>7.3f}  {'':<16}  {self.total[m].sum():>7.3f}"
            yield f"  {'sum':<{width}}  {sums}"

    def csv(self) -> str:
        """A table with a line for each measure and number."""
        stream = StringIO()
        writer = csv.writer(stream, lineterminator="\n")
        writer.writerow(HEAD)
        for m, measure in enumerate(self.measures):
            for k, name in enumerate(self.names):
                first = [self.first[m, k], *self.first_interval[m, k]]
                total = [self.total[m, k], *self.total_interval[m, k]]
                writer.writerow([measure, name, *(repr(float(each)) for each in first + total)])
        return stream.getvalue()


def _entry(value: float, interval: np.ndarray) -> str:
    ends = "{:.3f} to {:.3f}".format(*interval)
    return f"{value:>7.3f}  {ends:<16}"


def indices(sweep: Sweep, measures: Iterable[str] = ()) -> SobolIndices:
    """The indices of the measures that names or patterns mean; of all unless some are named.

    Raises
    ------
    UsageError
        When the runs are none of this design, are not all there, or have failed.
    """
    points = _points(sweep)
    _need_all_runs(sweep)
    if not sweep.measured:
        raise UsageError("the sweep kept no measure: run it with --measure 'max COLUMN'")
    wanted = [measures] if isinstance(measures, str) else [*measures]
    chosen = selected(sweep.measured, wanted) if wanted else [*range(len(sweep.measured))]
    names = tuple(sweep.measured[k] for k in chosen)
    values = sweep.measures[:, chosen].T
    _need_numbers(names, values)
    whole = values.reshape(len(names), -1, points)
    both = whole[:, :2].reshape(len(names), -1)
    first, total, intervals = _estimated(whole)
    still = np.ptp(values, axis=1) <= NOISE * np.abs(values).max(axis=1)
    for each in (first, total, *intervals):
        each[still] = np.nan
    return SobolIndices(
        names, sweep.names, first, total, *intervals, both.mean(axis=1), both.std(axis=1), points,
        tuple(sweep.units.get(name, "") for name in names),
    )  # fmt: skip


def _estimated(whole: np.ndarray) -> tuple[np.ndarray, np.ndarray, tuple[np.ndarray, np.ndarray]]:
    """First and total indices (measure, number), and their intervals (measure, number, 2), of
    values (measure, d + 2, point).
    """
    from scipy.stats import bootstrap, sobol_indices

    blocks = np.moveaxis(whole, 0, 1)

    def statistic(chosen: np.ndarray) -> np.ndarray:
        a, b, *mixed = blocks[..., chosen]
        found = sobol_indices(func={"f_A": a, "f_B": b, "f_AB": np.array(mixed)}, n=len(chosen))
        shape = len(a), len(mixed)
        return np.stack([each.reshape(shape) for each in (found.first_order, found.total_order)])

    every = np.arange(whole.shape[-1])
    first, total = statistic(every)
    spread = bootstrap(
        [every], statistic, n_resamples=RESAMPLES, confidence_level=CONFIDENCE, vectorized=False,
        method="percentile", random_state=np.random.default_rng(0),
    ).confidence_interval  # fmt: skip
    ends = np.stack([spread.low, spread.high], axis=-1)
    return first, total, (ends[0], ends[1])


def _points(sweep: Sweep) -> int:
    """N, of the design that the runs have."""
    word, _, count = sweep.meta.get("sample", "").partition(" ")[0].lower().partition(":")
    if word != SALTELLI or not count.isdecimal() or not int(count):
        raise UsageError(
            f"these runs ({sweep.meta.get('sample') or 'of no sample'}) have no Sobol indices: run "
            f"the sweep with --sample {SALTELLI}:256"
        )
    points, numbers = int(count), len(sweep.names)
    if len(sweep) != points * (numbers + 2) or not np.array_equal(
        sweep.values, stacked(np.hstack([sweep.values[:points], sweep.values[points : 2 * points]]))
    ):
        raise UsageError("the numbers of these runs are not those of their sample")
    return points


def _need_all_runs(sweep: Sweep) -> None:
    if sweep.failed:
        named = [f"run {k}: {sweep.outcomes[k]}" for k in sweep.failed[:MOST_NAMED]]
        more = [f"and {len(sweep.failed) - MOST_NAMED} more"] if sweep.failed[MOST_NAMED:] else []
        raise UsageError(
            f"{len(sweep.failed)} of {len(sweep)} runs failed ({', '.join([*named, *more])}), and "
            f"Sobol indices need all: narrow the ranges to where the model runs"
        )
    if sweep.ahead:
        raise UsageError(
            f"{len(sweep.ahead)} of {len(sweep)} runs are ahead, from run {sweep.ahead[0]} on: the "
            f"same command sweep goes on with them"
        )


def _need_numbers(names: Iterable[str], values: np.ndarray) -> None:
    for name, row in zip(names, values, strict=True):
        none = np.flatnonzero(~np.isfinite(row))
        if len(none):
            raise UsageError(f"{name} of run {none[0]} is not a number: it has no Sobol indices")
