"""Truths of random decks, kept in a folder, and of the mixed decks, which two methods agree upon.

A file is named by a hash of the deck: it is found by every checkout, whoever solved it.
"""

from __future__ import annotations

import hashlib
import json
import os
from functools import cache, partial
from pathlib import Path
from typing import Any

import numpy as np

from adamslite import assemble, compile_model, read, simulate
from adamslite.caching.folder import cache_folder
from adamslite.errors import UsageError
from adamslite.language.diagnostics import DeckError
from adamslite.results.outcomes import Outcome
from adamslite.results.results import Results
from adamslite.results.run_error import attitude, error_of
from adamslite.verification.variants import patient
from benchmarks import kinds_of_events, kinds_of_forces, kinds_of_motions  # noqa: F401
from benchmarks.posed import ANGLE, KINDS, LENGTH, STATE, Channel, Posed, Truth, UnknownTruth, pose
from benchmarks.random_decks import RandomDeck, deck

#: Counts up when equations of a family are mended, so that older truths are not found.
EDITION = 1
#: Decks that have no equations of their own: methods of this program are their truth.
MIXED = "mixed"
#: CPU [s] of a run for the truth.
PATIENCE = 30.0
#: The truth of mixed decks: methods, ERROR, steps of the run and of the shortest thing in it.
TRUTH = (("RADAU", 1e-10), ("ABAM", 1e-11))
LEAST_STEPS, WITHIN, MOST_STEPS = 1500, 2.0, 40000
#: Both runs agree within this share; an ill-conditioned deck amplifies its start by more than
#: ``AMPLIFIED``.
AGREED, NUDGE, AMPLIFIED = 1e-4, 1e-7, 300.0
#: A coordinate of a mixed deck that goes less than this share of the largest counts as this.
SMALL = 1e-3
#: Written digits of a truth.
DIGITS = 10


def kinds() -> list[str]:
    """Names of all kinds."""
    return [*KINDS, MIXED]


def posed(kind: str, number: int, seed: int) -> Posed:
    """Deck ``number`` of a kind."""
    return mixed(number, seed) if kind == MIXED else pose(kind, number, seed)


@cache
def folder() -> Path:
    """Where truths are kept."""
    chosen = os.environ.get("ADAMSLITE_TRUTHS")
    found = Path(chosen) if chosen else cache_folder() / "truths"
    found.mkdir(parents=True, exist_ok=True)
    return found


def key(problem: Posed) -> str:
    """Name of the truth of a deck."""
    said = "\n".join([str(EDITION), problem.text, *problem.commands])
    return hashlib.sha256(said.encode()).hexdigest()[:20]


def truth_of(problem: Posed, kept: dict[str, Any] | None = None) -> Truth:
    """The truth, out of ``kept`` or the folder where it is there.

    Raises
    ------
    UnknownTruth
        When it is not known.
    """
    name = key(problem)
    if kept and name in kept:
        return unpacked(kept[name])
    file = folder() / f"{name}.json"
    if not file.exists():
        try:
            found = packed(problem.solve())
        except UnknownTruth as why:
            found = {"unknown": str(why)}
        part = file.with_suffix(f".{os.getpid()}")
        part.write_text(json.dumps(found), encoding="utf-8")
        part.replace(file)
    found = json.loads(file.read_text(encoding="utf-8"))
    if "unknown" in found:
        raise UnknownTruth(found["unknown"])
    return unpacked(found)


def packed(truth: Truth) -> dict[str, Any]:
    """A truth as JSON."""
    same = np.array_equal(truth.least, truth.most)
    each = {"ranges": truth.ranges, "least": truth.least, **({} if same else {"most": truth.most})}
    return {name: _short(values.tolist()) for name, values in each.items()}


def unpacked(kept: dict[str, Any]) -> Truth:
    """A truth from JSON."""
    least, ranges = np.array(kept["least"]), np.array(kept["ranges"])
    return Truth(least, np.array(kept["most"]) if "most" in kept else least, ranges)


def _short(values: Any) -> Any:
    if isinstance(values, list):
        return [_short(each) for each in values]
    return float(f"{values:.{DIGITS}g}")


def mixed(number: int, seed: int) -> Posed:
    """A deck of :mod:`benchmarks.random_decks`; its channels are those of :func:`channels_of`."""
    drawn, nudged = deck(number, seed), deck(number, seed, NUDGE)
    solve = partial(_by_two_methods, drawn, nudged)
    return Posed(drawn.title, drawn.text, drawn.end, drawn.steps, (), solve)


def channels_of(results: Results) -> list[Channel]:
    """Places and attitudes of all bodies and all DIFF states."""
    found = []
    for name in results.names:
        body, _, part = name.rpartition(".")
        if part in ("x", "y", "z") and f"{body}.az" in results:
            found.append(Channel(name, LENGTH))
        elif part == "psi":
            found += [Channel(f"{body}@{k}", ANGLE) for k in range(9)]
        elif name.startswith("DIFF/"):
            found.append(Channel(name, STATE))
    return found


def column(results: Results, channel: Channel) -> np.ndarray:
    """Values of a channel; PART/2@3 is an entry of the rotation matrix of PART/2."""
    body, at, entry = channel.column.partition("@")
    if not at:
        return np.asarray(results[channel.column])
    return attitude(results, body).reshape(-1, 9)[:, int(entry)]


def _by_two_methods(drawn: RandomDeck, nudged: RandomDeck) -> Truth:
    (first, tight), (second, tighter) = TRUTH
    truth, other = _tight_run(drawn, second, tighter), _tight_run(drawn, first, tight)
    apart = error_of(other, truth)
    if not apart <= AGREED:
        raise UnknownTruth(f"{first} and {second} are {apart:.1e} apart")
    grown = error_of(_tight_run(nudged, second, tighter), truth) / NUDGE
    if grown > AMPLIFIED:
        raise UnknownTruth(f"sensitive: grows {grown:.1e} times")
    channels = channels_of(truth)
    values = np.column_stack([column(truth, channel) for channel in channels])
    ranges, kinds_of = np.ptp(values, axis=0), np.array([c.kind for c in channels])
    for kind in (LENGTH, ANGLE):
        own = kinds_of == kind
        least = ranges[own].max(initial=0.0) * (SMALL if kind == LENGTH else 1.0)
        ranges[own] = np.maximum(ranges[own], least)
    return Truth(values, values, ranges)


def _tight_run(drawn: RandomDeck, method: str, error: float) -> Results:
    steps = max(LEAST_STEPS, min(WITHIN * drawn.end / drawn.finest, MOST_STEPS))
    try:
        run = patient(partial(simulate, compile_model(assemble(read(drawn.text)))), PATIENCE)
        results = run(integrator=method, error=error, hmax=drawn.end / steps)
    except (UsageError, DeckError) as why:
        raise UnknownTruth(f"{method}: {why}") from why
    if results.outcome is not Outcome.DONE:
        raise UnknownTruth(f"{method}: {results.outcome.name}")
    return results
