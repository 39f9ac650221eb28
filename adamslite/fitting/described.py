"""The record of a fit: how sure its numbers are, and what there is to say about them."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from adamslite.fitting.certainty import Certainty, certainty, unknown
from adamslite.fitting.curves import Failed, Runs, error_of
from adamslite.fitting.derivatives import Curves, Derivatives
from adamslite.fitting.least_squares import Search
from adamslite.fitting.measured import Measured, amplitudes
from adamslite.fitting.record import Fit, Residual
from adamslite.notation import shown
from adamslite.results.results import Results
from adamslite.variation.decks import with_values

#: The last look at a fit has runs whose ERROR is smaller by this, with wider differences.
TIGHTER, WIDER = 0.1, 2.0
#: What is reported: numbers that the runs' own errors move by this part of a standard error,
MOVED = 0.1
#: residuals of neighbouring times that are so much alike, numbers that are so much smaller now.
ALIKE, VANISHED = 0.3, 1e-3
#: a deck that gives so many times what was measured, with curves that are so much alike.
MANIFOLD, SIMILAR = 5.0, 0.9
#: Residuals are looked at where there are so many, larger than this share of the amplitude.
FEWEST, ROUNDING = 20, 1e-8
COARSE = (
    "what ERROR={:g} leaves in the runs is more than the residuals: standard errors do not count it"
)


def described(
    search: Search,
    before: Results,
    x: np.ndarray,
    stopped: str,
    notes: list[str],
    limited: bool = False,
) -> Fit:
    """The record of a fit that has ended at ``x`` (np,); without another run where it is
    ``limited``.
    """
    runs, measured = search.runs, search.measured
    values = np.array(search.values(x))
    results = runs.results(values.tolist())
    curves = runs.sampled(results, measured)
    residuals = _residuals(curves, measured, results)
    found, said = unknown([each.name for each in runs.parameters]), list[str]()
    if not limited:
        found, said = _judged(search, values, results, stopped)
    numbers = dict(zip((each.name for each in runs.parameters), values.tolist(), strict=True))
    return Fit(
        parameters=tuple(runs.parameters), values=values,
        errors=_sizes(runs, values) * np.sqrt(np.diag(found.covariance)), certainty=found,
        residuals=tuple(residuals),
        deck=with_values(runs.deck, {**runs.given, **numbers}), results=results, before=before,
        measured=measured, curves=curves, sigmas=search.sigmas, runs=runs.count,
        derivatives=str(search.derivatives), stopped=stopped,
        limited=limited,
        notes=tuple(shown(each) for each in (
            *notes, *_poor(residuals, before, measured), *said, *_vanished(runs, values)
        ) if each),
    )  # fmt: skip


def _sizes(runs: Runs, values: np.ndarray) -> np.ndarray:
    """What relative changes of numbers are parts of (np,)."""
    pairs = zip(runs.parameters, values, strict=True)
    return np.array([abs(value) or each.scale for each, value in pairs])


def _judged(
    search: Search, values: np.ndarray, results: Results, stopped: str
) -> tuple[Certainty, list[str]]:
    """How sure the numbers are, and sentences on what stands against it."""
    runs, measured, sigmas = search.runs, search.measured, search.sigmas
    names, error = [each.name for each in runs.parameters], error_of(results)
    try:
        own = search.derivatives.at(values.tolist())
    except Failed as fault:
        return unknown(names), [] if stopped else [f"the standard errors are not known: {fault}"]
    tight, said = _tighter(search.derivatives, values, error)
    residuals, sizes = search.residuals(own.values), _sizes(runs, values)
    jacobian, other = (_relative(each, measured, sigmas, sizes) for each in (own, tight or own))
    free = ~np.array([p.at_bound(v) for p, v in zip(runs.parameters, values, strict=True)])
    found = certainty(jacobian, jacobian - other, residuals, names, free)
    moved = search.residuals(tight.values) - residuals if tight else np.zeros(len(residuals))
    shares = np.sqrt(np.diag(found.covariance))
    said += _moved(jacobian, moved, shares, names, error)
    if np.linalg.norm(moved) > np.linalg.norm(residuals):
        return found, [*said, COARSE.format(error)]
    said += _interpolated(runs, results, own.values, measured)
    return found, [*said, *_alike(residuals, own.values, measured)]


def _tighter(
    derivatives: Derivatives, values: np.ndarray, error: float
) -> tuple[Curves | None, list[str]]:
    """Curves and derivatives with a smaller ERROR and wider differences."""
    try:
        return derivatives.at(values.tolist(), WIDER, error=TIGHTER * error), []
    except Failed:
        pass
    said = ["runs with a smaller ERROR fail: how much ERROR moves the numbers is not known"]
    try:
        return derivatives.at(values.tolist(), WIDER), said
    except Failed:
        return None, said


def _relative(
    curves: Curves, measured: Measured, sigmas: np.ndarray, sizes: np.ndarray
) -> np.ndarray:
    """Derivatives of the residuals by relative changes (n, np)."""
    return np.asarray((curves.derivatives / sigmas[:, :, None] * sizes)[measured.known])


def _moved(
    jacobian: np.ndarray, moved: np.ndarray, errors: np.ndarray, names: list[str], error: float
) -> list[str]:
    """Numbers that a smaller ERROR would move, to first order."""
    known = np.isfinite(errors)
    if not known.any() or not moved.any():
        return []
    change = np.linalg.lstsq(jacobian[:, known], -moved, rcond=None)[0]
    with np.errstate(divide="ignore"):
        shares = np.abs(change) / errors[known]
    own = [name for name, is_known in zip(names, known, strict=True) if is_known]
    worst = int(np.argmax(shares))
    if not MOVED < shares[worst] < np.inf:
        return []
    return [
        f"ERROR={error:g} moves {own[worst]} by about {shares[worst]:.2g} standard errors; a "
        f"smaller --error keeps it out of the fit"
    ]


def _alike(residuals: np.ndarray, curves: np.ndarray, measured: Measured) -> list[str]:
    """Channels whose residuals (n,) at neighbouring times are alike, and more than rounding."""
    table = np.full(measured.values.shape, np.nan)
    table[measured.known] = residuals
    counts = measured.rms(curves) > ROUNDING * amplitudes(measured)
    notes = []
    for name, column, is_more in zip(measured.channels, table.T, counts, strict=True):
        own = column[np.isfinite(column)]
        if len(own) < FEWEST or not is_more:
            continue
        size = float(own @ own)
        share = float(own[1:] @ own[:-1]) / size
        if share > max(ALIKE, 3.0 / np.sqrt(len(own))):
            notes.append(
                f"{name}: residuals of neighbouring times are alike (correlation {share:.2f}): the "
                "deck leaves something out, or the noise is filtered, and standard errors are too "
                "small"
            )
    return notes


def _poor(residuals: list[Residual], before: Results, measured: Measured) -> list[str]:
    """Channels that the deck does not explain, and what may be wrong with them."""
    notes = []
    for each, values in zip(residuals, measured.values.T, strict=True):
        if each.poor:
            notes.append(
                f"{each.channel}: the residual is {each.poor}: the deck does not do what was "
                f"measured, or another start leads to better numbers"
            )
            started = np.interp(measured.time, before.time, before[each.channel])
            notes += _in_other_units(each.channel, started, values)
    return notes


def _in_other_units(channel: str, started: np.ndarray, values: np.ndarray) -> list[str]:
    """A sentence where curves from the start (nt,) are as those measured, but for a factor."""
    known = np.isfinite(values)
    started, values = started[known], values[known]
    sizes = float(np.linalg.norm(started)), float(np.linalg.norm(values))
    if not all(sizes) or started @ values < SIMILAR * sizes[0] * sizes[1]:
        return []
    times = sizes[0] / sizes[1]
    if 1.0 / MANIFOLD < times < MANIFOLD:
        return []
    return [
        f"{channel}: with the numbers that it starts with, the deck gives about "
        f"{float(f'{times:.1g}'):g} times what was measured: is the file in another unit?"
    ]


def _interpolated(
    runs: Runs, results: Results, curves: np.ndarray, measured: Measured
) -> list[str]:
    """Channels whose curves between output times are off by a share of the residuals.

    A spline through every second output is off by some sixteen times that.
    """
    if not runs.interpolate:
        return []
    every = np.union1d(np.arange(0, len(results.time), 2), [len(results.time) - 1])
    coarse = replace(results, time=results.time[every], values=results.values[every])
    off = np.sqrt(np.mean((runs.sampled(coarse, measured) - curves) ** 2, axis=0)) / 16.0
    return [
        f"{name}: interpolation between output times is off by {each:.2g}; more --steps help"
        for name, each, rms in zip(measured.channels, off, measured.rms(curves), strict=True)
        if each > MOVED * rms
    ]


def _vanished(runs: Runs, values: np.ndarray) -> list[str]:
    """Numbers that keep their sign and have gone to zero."""
    return [
        f"{p.name} has gone to {v:.3g}: it is zero, or a lower bound below zero lets it "
        "become negative"
        for p, v in zip(runs.parameters, values, strict=True)
        if p.is_log and v < VANISHED * p.start and not p.at_bound(v)
    ]


def _residuals(curves: np.ndarray, measured: Measured, results: Results) -> list[Residual]:
    found, table, rms = [], measured.apart(curves), measured.rms(curves)
    spreads = amplitudes(measured)
    for k, name in enumerate(measured.channels):
        known = measured.known[:, k]
        own, band = table[known, k], measured.bands[known, k]
        share = np.sqrt(np.mean((own / band) ** 2)) if band.all() else np.nan
        unit = results.channel(name).unit
        left = float(rms[k] / spreads[k])
        found.append(Residual(name, float(rms[k]), float(share), len(own), unit, left))
    return found
