"""Sweeps made of numbers, without a run."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from adamslite.sweeps.job import SUMMARY, Run
from adamslite.sweeps.ranges import ranges_of, sampled
from adamslite.sweeps.record import Sweep

UNITS = {"K": "N/m", "M": "kg", "min y": "m", "max F": "N", "y": "m", "time": "s"}


def made(
    sample: str,
    measures: Mapping[str, np.ndarray],
    values: np.ndarray,
    names: Sequence[str] = ("K", "M", "C"),
    failed: Mapping[int, str] | None = None,
    histories: Mapping[int, tuple[np.ndarray, np.ndarray]] | None = None,
) -> Sweep:
    """Runs with these measures, and histories of y; those of `failed` have that outcome."""
    sweep = Sweep(
        names=tuple(names[: values.shape[1]]), values=values, measured=tuple(measures),
        channels=("y",) if histories else (), meta={"sample": sample, "deck": "a test"},
        units=UNITS, key="made",
    )  # fmt: skip
    for k in range(len(values)):
        row = tuple(each[k] for each in measures.values())
        outcome = (failed or {}).get(k, "DONE")
        time, history = (histories or {}).get(k, (np.empty(0), np.empty(0)))
        columns = history[:, None] if histories else np.empty((len(time), 0))
        sweep.enter(Run(k, outcome, "", (1.0,) * len(SUMMARY), row, time, columns))
    return sweep


def design(sample: str, *ranges: str, seed: int = 0) -> np.ndarray:
    """The numbers of a sample (run, number)."""
    return sampled(ranges_of(ranges), sample, seed)


def measures(values: np.ndarray) -> dict[str, np.ndarray]:
    """min y = -M/K and max F = M + K of runs (run, number)."""
    return {"min y": -values[:, 1] / values[:, 0], "max F": values[:, 0] + values[:, 1]}
