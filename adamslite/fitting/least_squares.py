"""Weighted least squares by scipy: the numbers with which curves come closest to a measurement.

Equation::

    minimise  sum over times t and channels c of  ((y_c(t; p) - m_c(t)) / sigma_c(t))^2

by the trust-region reflective method, in the coordinates of :mod:`adamslite.fitting.parameters`.
A run that fails makes the region smaller.  The squares of e x are added, with e a millionth of the
largest singular value: what the measurement does not determine at all stays where it began.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any, NamedTuple

import numpy as np

from adamslite.fitting.curves import Failed, Runs
from adamslite.fitting.derivatives import Curves, Derivatives
from adamslite.fitting.measured import Measured

#: Changes of the sum of squares, and of coordinates, below which nothing is gained any more.
LEAST_GAIN, LEAST_STEP = 1e-8, 1e-8
#: A search has not come to its end where a step would take away this share of the squares.
MUCH = 1e-3
#: So many trial points at most.
MOST_TRIALS = 100
#: What coordinates are held to their start with, as a share of the largest singular value.
LEASH = 1e-6
#: Parts of the times that are fitted one after the other, where all at once lead nowhere.
STAGES = (1.0 / 32.0, 1.0 / 8.0, 0.5, 1.0)


class Solved(NamedTuple):
    """Where the search ended.

    ``x`` (np,), ``values`` of the numbers, ``curves`` there, ``why``: empty, or a sentence on what
    stopped it before its end.
    """

    x: np.ndarray
    values: tuple[float, ...]
    curves: Curves
    why: str = ""


@dataclass
class Search:
    """The least squares of one measurement.

    Parameters
    ----------
    derivatives : Derivatives
        Of the runs of the fit.
    sigmas : (nt, nc) array
        What residuals are divided by.
    """

    derivatives: Derivatives
    sigmas: np.ndarray
    known: dict[tuple[float, ...], Any] = field(default_factory=dict)
    """Curves by values, or the :class:`Failed` of a run."""
    least: float = np.inf
    """The sum of squares of the best run so far."""
    last: tuple[tuple[float, ...], np.ndarray] | None = None
    """The last Jacobian, and its values."""

    @property
    def runs(self) -> Runs:
        """The runs of the fit."""
        return self.derivatives.runs

    @property
    def measured(self) -> Measured:
        """What is fitted."""
        return self.derivatives.measured

    def values(self, x: np.ndarray) -> tuple[float, ...]:
        """The numbers of coordinates."""
        pairs = zip(self.runs.parameters, x, strict=True)
        return tuple(parameter.value(each) for parameter, each in pairs)

    def residuals(self, curves: np.ndarray) -> np.ndarray:
        """Differences as parts of sigma, where something was measured (n,)."""
        return weighted(curves, self.measured, self.sigmas)

    def jacobian(self, x: np.ndarray, curves: Curves) -> np.ndarray:
        """Derivatives of the residuals by the coordinates (n, np)."""
        slopes = np.array([p.slope(each) for p, each in zip(self.runs.parameters, x, strict=True)])
        found = curves.derivatives / self.sigmas[:, :, None] * slopes
        return np.asarray(found[self.measured.known])

    def at(self, x: np.ndarray) -> np.ndarray:
        """Residuals (n,); not numbers where the run fails."""
        values = self.values(x)
        if values not in self.known:
            try:
                self.known[values] = self.runs.curves(values, self.measured)
                self._weigh(x, values)
            except Failed as fault:
                self.known[values] = fault
        found = self.known[values]
        if isinstance(found, Failed):
            return np.full(self.measured.count, np.nan)
        return self.residuals(found)

    def _weigh(self, x: np.ndarray, values: tuple[float, ...]) -> None:
        """Remember the run that has just been made, if it comes closest."""
        cost = float(np.sum(self.residuals(self.known[values]) ** 2))
        if cost < self.least:
            self.least, self.runs.best = cost, (x.copy(), self.runs.results(values))

    def slopes(self, x: np.ndarray) -> np.ndarray:
        """The Jacobian (n, np)."""
        values = self.values(x)
        if self.last is None or self.last[0] != values:
            curves = self.derivatives.at(values)
            self.last = values, self.jacobian(x, curves)
        return self.last[1]

    def solve(self, start: np.ndarray, part: float = 1.0) -> tuple[np.ndarray, str]:
        """Coordinates of the least squares, and why it ended early, which may be empty.

        ``part``: of the times, from the first on.
        """
        from scipy.optimize import least_squares

        rows, tried = self._rows(part), [start]

        def residuals(x: np.ndarray) -> np.ndarray:
            tried.append(x.copy())
            return np.append(self.at(x)[rows], leash * x)

        def slopes(x: np.ndarray) -> np.ndarray:
            return np.vstack([self.slopes(x)[rows], leash * np.eye(len(x))])

        try:
            leash = LEASH * float(np.linalg.norm(self.slopes(start)[rows], 2))
            found = least_squares(
                residuals, start, slopes, bounds=self._bounds(), method="trf", ftol=LEAST_GAIN,
                xtol=LEAST_STEP, gtol=1e-12, x_scale=1.0, max_nfev=MOST_TRIALS,
            )  # fmt: skip
        except Failed as fault:  # of all runs for derivatives
            best = self._best(tried, rows)
            return best, f"no derivatives at {self._told(best)}: {fault}"
        if found.status == 0:
            return found.x, f"not settled after {MOST_TRIALS} trials"
        return found.x, self._barred(tried, found)

    def _barred(self, tried: Sequence[np.ndarray], found: Any) -> str:
        """What has kept a search from its end: runs that fail, where a step would gain more."""
        failed = [x for x in tried if isinstance(self.known.get(self.values(x)), Failed)]
        if not failed:
            return ""
        free = found.jac[:, found.active_mask == 0]
        step = np.linalg.lstsq(free, -found.fun, rcond=None)[0]
        if np.sum((free @ step) ** 2) < MUCH * np.sum(found.fun**2):
            return ""
        fault = self.known[self.values(failed[-1])]
        return f"stopped beside {self._told(failed[-1])}, where runs fail: {fault}"

    def _bounds(self) -> tuple[np.ndarray, np.ndarray]:
        """Lowest and highest coordinates (np,)."""
        found = [(p.coordinate(p.low), p.coordinate(p.high)) for p in self.runs.parameters]
        low, high = np.array(found).T
        return low, high

    def _rows(self, part: float) -> np.ndarray:
        """The residuals of the first part of the times (n,)."""
        time = self.measured.time
        until = time[0] + part * (time[-1] - time[0])
        inside = np.broadcast_to((time <= until)[:, None], self.measured.known.shape)
        return np.asarray(inside[self.measured.known])

    def _best(self, tried: Sequence[np.ndarray], rows: np.ndarray) -> np.ndarray:
        """The best of the points that were tried."""
        costs = [np.sum(self.at(x)[rows] ** 2) for x in tried]
        finite = [k for k, cost in enumerate(costs) if np.isfinite(cost)]
        return tried[min(finite, key=lambda k: costs[k])] if finite else tried[0]

    def _told(self, x: np.ndarray) -> str:
        pairs = zip(self.runs.parameters, self.values(x), strict=True)
        return ", ".join(f"{parameter.name}={value:.6g}" for parameter, value in pairs)


def weighted(curves: np.ndarray, measured: Measured, sigmas: np.ndarray) -> np.ndarray:
    """Differences of curves from a measurement as parts of sigma (n,)."""
    return np.asarray((measured.apart(curves) / sigmas)[measured.known])
