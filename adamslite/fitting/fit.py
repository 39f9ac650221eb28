"""A fit from a deck and a measurement to numbers and what is known of them.

Where the file gives no band of a channel, its noise is estimated from its own residual, and the fit
is made again with it until it stays::

    sigma_c^2 = sum over t of (y_c - m_c)^2 / n_c
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np

from adamslite.deck.deck import Deck
from adamslite.deck.redefinition import Command
from adamslite.errors import RunFailed, UsageError
from adamslite.fitting.certainty import certainty
from adamslite.fitting.curves import Failed, Runs, error_of, prepared
from adamslite.fitting.derivatives import Curves, Derivatives
from adamslite.fitting.least_squares import STAGES, Search
from adamslite.fitting.measured import Measured, amplitudes, measured_of
from adamslite.fitting.parameters import Bounds, parameters_of
from adamslite.fitting.record import Fit, Residual
from adamslite.progress import Progress
from adamslite.results.results import Results
from adamslite.variation.decks import variable_of, with_values
from adamslite.verification.reference_file import Reference

#: Rounds in which the noise of channels is estimated, and the change that ends them.
MOST_ROUNDS, SETTLED = 6, 0.01
#: Noise is never taken as less than this share of the amplitude of a channel.
LEAST_NOISE = 1e-7
#: A fit that leaves more of the measured spread than this is tried again by parts of the times.
POOR = 0.1
#: The last look at a fit has runs whose ERROR is smaller by this, with wider differences.
TIGHTER, WIDER = 0.1, 2.0
#: What is told: numbers that the runs' own errors move by this part of a standard error,
MOVED = 0.1
#: residuals of neighbouring times that are so much alike, numbers that are so much smaller now.
ALIKE, VANISHED = 0.3, 1e-3


class Wanted(NamedTuple):
    """What to fit, as the user has written it."""

    by: Iterable[str]
    bounds: Bounds = ()
    of: Iterable[str] = ()
    window: tuple[float | None, float | None] = (None, None)


def fit(
    deck: Deck,
    reference: Reference,
    wanted: Wanted,
    commands: Sequence[Command] = (),
    options: Mapping[str, Any] | None = None,
    progress: Progress | None = None,
) -> Fit:
    """Fit numbers of a deck to a measurement.

    Parameters
    ----------
    deck : Deck
        Its numbers are the start.
    reference : Reference
        The measurement: a table with bands.
    options : mapping
        As ``simulate`` takes them; those that the file gives come before.

    Raises
    ------
    UsageError
        When names, bounds or the measurement are not what they have to be.
    RunFailed
        When the deck does not run with the numbers that it starts with.
    """
    base = deck.base or deck
    found = parameters_of(variable_of(base).numbers, wanted.by, wanted.bounds, deck.values)
    own = {name: each for name, each in reference.options.items() if name not in ("user", "values")}
    runs = Runs(base, deck.values, found, commands, {**own, **(options or {})})
    runs.progress = progress or runs.progress
    start = [each.start for each in found]
    try:
        before = runs.results(start)
        measured = measured_of(reference, before, wanted.of, wanted.window)
        notes = [prepared(runs, before, measured.time)]
        runs.curves(start, measured)
    except Failed as fault:
        raise RunFailed(f"the fit cannot start, its first run fails: {fault}") from None
    if measured.count < len(found):
        raise UsageError(
            f"{measured.name}: {measured.count} values do not determine {len(found)} numbers"
        )
    derivatives = Derivatives(runs, measured)
    x, sigmas, stopped = _solved(derivatives)
    search = Search(derivatives, sigmas)
    return _described(search, before, x, stopped, [*measured.notes, *notes])


def _solved(derivatives: Derivatives) -> tuple[np.ndarray, np.ndarray, str]:
    """Coordinates of the best fit, what residuals are divided by, and why it ended early."""
    runs, measured = derivatives.runs, derivatives.measured
    spreads = amplitudes(measured)
    banded = measured.bands.any(axis=0)
    sigmas = np.where(measured.bands > 0.0, measured.bands, spreads)
    x, stopped = _searched(Search(derivatives, sigmas), spreads)
    noise = np.where(banded, 1.0, spreads)
    for _ in range(0 if banded.all() else MOST_ROUNDS):
        search = Search(derivatives, sigmas)
        values = search.values(x)
        rms = np.maximum(_rms(runs.curves(values, measured), measured), LEAST_NOISE * spreads)
        changed = np.abs(rms / noise - 1.0)[~banded].max()
        noise = np.where(banded, 1.0, rms)
        sigmas = np.where(measured.bands > 0.0, measured.bands, noise)
        if changed < SETTLED or banded.size == 1 or stopped:
            break
        x, stopped = Search(derivatives, sigmas).solve(x)
    return x, sigmas, stopped


def _rms(curves: np.ndarray, measured: Measured) -> np.ndarray:
    """Root mean square of the residuals of each channel (nc,)."""
    return np.sqrt(np.nanmean(measured.apart(curves) ** 2, axis=0))


def _searched(search: Search, spreads: np.ndarray) -> tuple[np.ndarray, str]:
    """The first fit; where it leaves much, another one that takes in the times little by little."""
    zero = np.zeros(len(search.runs.parameters))
    x, stopped = search.solve(zero)
    if _left(search, x, spreads) < POOR:
        return x, stopped
    other, why = zero, ""
    for part in STAGES:
        other, why = search.solve(other, part)
    better = np.sum(search.at(other) ** 2) < np.sum(search.at(x) ** 2)
    return (other, why) if better else (x, stopped)


def _left(search: Search, x: np.ndarray, spreads: np.ndarray) -> float:
    """The squares that a fit leaves, as a share of those of the values about their mean."""
    spread = (np.broadcast_to(spreads, search.sigmas.shape) / search.sigmas)[search.measured.known]
    return float(np.sum(search.at(x) ** 2) / np.sum(spread**2))


def _described(
    search: Search, before: Results, x: np.ndarray, stopped: str, notes: list[str]
) -> Fit:
    """The record of a fit: how sure the numbers are, and what there is to say."""
    runs, measured, sigmas = search.runs, search.measured, search.sigmas
    names = [each.name for each in runs.parameters]
    values = np.array(search.values(x))
    sizes = np.array([abs(v) or p.scale for p, v in zip(runs.parameters, values, strict=True)])
    results = runs.results(values.tolist())
    curves, tight = _both(search.derivatives, values, error_of(results))
    residuals = search.residuals(curves.values)
    jacobian, other = (
        _relative(each, measured, sigmas, sizes) for each in (curves, tight or curves)
    )
    free = ~np.array([p.at_bound(v) for p, v in zip(runs.parameters, values, strict=True)])
    found = certainty(jacobian, jacobian - other, residuals, names, free)
    errors = sizes * np.sqrt(np.diag(found.covariance))
    if tight is None:
        notes.append(
            "runs with a smaller ERROR fail: how much ERROR moves the numbers is not known"
        )
    else:
        moved = search.residuals(tight.values) - residuals
        notes += _moved(jacobian, moved, errors / sizes, names, error_of(results))
    notes += _alike(residuals, measured) + _vanished(runs, values)
    fitted = with_values(
        runs.deck, {**runs.given, **dict(zip(names, values.tolist(), strict=True))}
    )
    return Fit(
        parameters=tuple(runs.parameters), values=values, errors=errors, certainty=found,
        residuals=tuple(_residuals(curves.values, measured, results)), deck=fitted,
        results=results, before=before, measured=measured, curves=curves.values, sigmas=sigmas,
        runs=runs.count, derivatives=str(search.derivatives), notes=tuple(filter(None, notes)),
        stopped=stopped,
    )  # fmt: skip


def _both(
    derivatives: Derivatives, values: np.ndarray, error: float
) -> tuple[Curves, Curves | None]:
    """Curves and derivatives at the end, and with a smaller ERROR; None where those runs fail."""
    own = derivatives.at(values.tolist())
    try:
        return own, derivatives.at(values.tolist(), WIDER, error=TIGHTER * error)
    except Failed:
        return own, None


def _relative(
    curves: Curves, measured: Measured, sigmas: np.ndarray, sizes: np.ndarray
) -> np.ndarray:
    """Derivatives of the residuals by relative changes (n, np)."""
    return np.asarray((curves.derivatives / sigmas[:, :, None] * sizes)[measured.known])


def _moved(
    jacobian: np.ndarray, moved: np.ndarray, errors: np.ndarray, names: list[str], error: float
) -> list[str]:
    """Numbers that a smaller ERROR would move, to first order."""
    told = np.isfinite(errors)
    if not told.any() or not moved.any():
        return []
    change = np.linalg.lstsq(jacobian[:, told], -moved, rcond=None)[0]
    with np.errstate(divide="ignore"):
        shares = np.abs(change) / errors[told]
    own = [name for name, is_told in zip(names, told, strict=True) if is_told]
    worst = int(np.argmax(shares))
    if not shares[worst] > MOVED:
        return []
    return [
        f"ERROR={error:g} moves {own[worst]} by about {shares[worst]:.2g} standard errors; a "
        f"smaller --error keeps it out of the fit"
    ]


def _alike(residuals: np.ndarray, measured: Measured) -> list[str]:
    """Channels whose residuals at neighbouring times are alike."""
    table = np.full(measured.values.shape, np.nan)
    table[measured.known] = residuals
    notes = []
    for name, column in zip(measured.channels, table.T, strict=True):
        own = column[np.isfinite(column)]
        size = float(own @ own)
        if len(own) < 20 or size == 0.0:
            continue
        share = float(own[1:] @ own[:-1]) / size
        if share > max(ALIKE, 3.0 / np.sqrt(len(own))):
            notes.append(
                f"{name}: residuals of neighbouring times are alike (correlation {share:.2f}): the "
                "deck leaves something out, or the noise is filtered, and standard errors are too "
                "small"
            )
    return notes


def _vanished(runs: Runs, values: np.ndarray) -> list[str]:
    """Numbers that keep their sign and have gone to zero."""
    return [
        f"{p.name} has gone to {v:.3g}: it is zero, or --bounds {p.name}=LOW:HIGH with LOW below "
        f"zero lets it become negative"
        for p, v in zip(runs.parameters, values, strict=True)
        if p.is_log and v < VANISHED * p.start and not p.at_bound(v)
    ]


def _residuals(curves: np.ndarray, measured: Measured, results: Results) -> list[Residual]:
    found, table, rms = [], measured.apart(curves), _rms(curves, measured)
    for k, name in enumerate(measured.channels):
        known = measured.known[:, k]
        own, band = table[known, k], measured.bands[known, k]
        share = np.sqrt(np.mean((own / band) ** 2)) if band.all() else np.nan
        unit = results.channel(name).unit
        found.append(Residual(name, float(rms[k]), float(share), len(own), unit))
    return found
