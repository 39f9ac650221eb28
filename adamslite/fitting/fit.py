"""A fit from a deck and a measurement to numbers and what is known of them.

Where the file gives no band of a channel, its noise is estimated from its own residual, and the fit
is made again with it until it stays::

    sigma_c^2 = sum over t of (y_c - m_c)^2 / n_c
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np

from adamslite.analyses.setup.run_options import budget_of, checked
from adamslite.deck.deck import Deck
from adamslite.deck.redefinition import Command
from adamslite.errors import RunFailed, UsageError
from adamslite.fitting.curves import Failed, Runs, Spent, prepared
from adamslite.fitting.derivatives import Derivatives
from adamslite.fitting.described import described
from adamslite.fitting.least_squares import STAGES, Search
from adamslite.fitting.measured import Measured, amplitudes, measured_of
from adamslite.fitting.parameters import Bounds, parameters_of
from adamslite.fitting.record import Fit
from adamslite.progress import Progress
from adamslite.results.outcomes import Outcome
from adamslite.variation.decks import variable_of
from adamslite.verification.reference_file import Reference

#: Rounds in which the noise of channels is estimated, and the change that ends them.
MOST_ROUNDS, SETTLED = 6, 0.01
#: Noise is never taken as less than this share of the amplitude of a channel.
LEAST_NOISE = 1e-7
#: A fit that leaves more of the measured spread than this is tried again by parts of the times.
POOR = 0.1

#: What a file may say of runs.
FLAGS = ("end", "steps", "integrator", "formulation", "error", "hmax")
MEASURES = "lines '# measure:' of the file are not fitted"


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
    own, asked = reference.options, options or {}
    own = {name: each for name, each in own.items() if name in FLAGS and name not in asked}
    asked = checked(asked)
    budget, memory = budget_of(asked)
    memory_limit = {} if memory is None else {"memory_limit": memory}
    runs = Runs(base, deck.values, found, commands, {**own, **asked, **memory_limit})
    runs.budget = budget
    runs.progress = progress or runs.progress
    start = [each.start for each in found]
    try:
        before = runs.results(start)
        measured = measured_of(reference, before, wanted.of, wanted.window)
        notes = [*_of_the_file(reference, own), prepared(runs, before, measured.time)]
        runs.curves(start, measured)
    except Failed as fault:
        raise RunFailed(f"the fit cannot start, its first run fails: {fault}") from None
    if measured.count < len(found):
        raise UsageError(
            f"{measured.name}: {measured.count} values do not determine {len(found)} numbers"
        )
    runs.best = np.zeros(len(found)), before
    derivatives = Derivatives(runs, measured)
    said = [*measured.notes, *notes]
    try:
        x, sigmas, stopped = _solved(derivatives)
        return described(Search(derivatives, sigmas), before, x, stopped, said)
    except (Spent, KeyboardInterrupt) as fault:
        x, best = runs.best
        search = Search(derivatives, _first_sigmas(measured))
        runs.take_up(search.values(x), best)
        return described(search, before, x, _ending(fault), said, limited=True)


def _ending(fault: BaseException) -> str:
    """What has ended the runs of a fit."""
    return Outcome.INTERRUPTED.sentence if isinstance(fault, KeyboardInterrupt) else str(fault)


def _first_sigmas(measured: Measured) -> np.ndarray:
    """What residuals are divided by before anything is known of the noise (nt, nc)."""
    return np.where(measured.bands > 0.0, measured.bands, amplitudes(measured))


def _of_the_file(reference: Reference, own: Mapping[str, Any]) -> list[str]:
    """Sentences on lines of a reference file that are for runs."""
    found = [f"runs have {name} = {each}, as the file says" for name, each in own.items()]
    return found + ([MEASURES] if reference.measures else [])


def _solved(derivatives: Derivatives) -> tuple[np.ndarray, np.ndarray, str]:
    """Coordinates of the best fit, what residuals are divided by, and why it ended early."""
    runs, measured = derivatives.runs, derivatives.measured
    spreads = amplitudes(measured)
    banded = measured.bands.any(axis=0)
    sigmas = _first_sigmas(measured)
    x, stopped = _searched(Search(derivatives, sigmas), spreads)
    noise = np.where(banded, 1.0, spreads)
    for _ in range(0 if banded.all() else MOST_ROUNDS):
        search = Search(derivatives, sigmas)
        values = search.values(x)
        rms = np.maximum(measured.rms(runs.curves(values, measured)), LEAST_NOISE * spreads)
        changed = np.abs(rms / noise - 1.0)[~banded].max()
        noise = np.where(banded, 1.0, rms)
        sigmas = np.where(measured.bands > 0.0, measured.bands, noise)
        if changed < SETTLED or banded.size == 1 or stopped:
            break
        x, stopped = Search(derivatives, sigmas).solve(x)
    return x, sigmas, stopped


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
