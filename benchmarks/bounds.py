"""How often the bounds of `solve --confirm` contain the exact value.

    python -m benchmarks.bounds --decks 300 --seed 1         all families in turn, random parameters
    python -m benchmarks.bounds --deck 17 --seed 1           one deck, what it is and what was found

Every deck runs with a random method and ERROR; a channel is a *hit* when every output time lies
within its bound of the closed form.  A deck is a hit when all of its known channels are.
"""

from __future__ import annotations

import argparse
import sys
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from functools import partial
from multiprocessing import get_context

import numpy as np

from adamslite import read, simulate
from adamslite.errors import UsageError
from adamslite.results.outcomes import Outcome
from adamslite.results.results import Results
from benchmarks.closed_forms import FAMILIES, Known

METHODS = ("GSTIFF", "GSTIFF", "RADAU", "HHT", "NEWMARK", "ABAM", "VERLET", "GSTIFF I3")
ERRORS = (1e-3, 1e-4, 1e-5, 1e-6, 1e-8)
# The closed forms themselves are good to this share of their largest value.
ROUND_OFF = 1e-12
# Share of hits that is wanted.
WANTED = 0.99


@dataclass(frozen=True)
class Found:
    """What became of one deck: names of missed channels with error and bound."""

    number: int
    name: str
    how: str
    verdict: str
    channels: int
    missed: tuple[str, ...]


def known(number: int, seed: int) -> tuple[str, str, float, Known]:
    """Family, method, ERROR and deck of a number."""
    rng = np.random.default_rng([seed, number])
    make = FAMILIES[number % len(FAMILIES)]
    made = make(rng)
    return make.__name__, str(rng.choice(METHODS)), float(rng.choice(ERRORS)), made


def confirmed_run(method: str, error: float, made: Known) -> Results:
    """The deck with its witnesses; by GSTIFF where the method cannot run it."""
    name, _, form = method.partition(" ")
    options = {"end": made.end, "steps": made.steps, "error": error, "confirm": True}
    deck = read(made.deck)
    try:
        return simulate(deck, integrator=name, **options, **({"formulation": form} if form else {}))
    except UsageError:
        return simulate(deck, integrator="GSTIFF", **options)


def judge(number: int, seed: int) -> Found:
    """Run one deck and hold its bounds against the closed form."""
    name, method, error, made = known(number, seed)
    how = f"{method} {error:g}"
    results = confirmed_run(method, error, made)
    if results.outcome is not Outcome.DONE:
        return Found(number, name, how, results.outcome.name, 0, ())
    missed = []
    for channel, exact in made.exact.items():
        true = np.array([exact(t) for t in results.time])
        bound = results.confirmation[channel].bound + ROUND_OFF * np.abs(true).max()
        off = float(np.abs(results[channel] - true).max())
        if not off <= bound:
            missed.append(f"{channel} off by {off:.3g}, bound {bound:.3g}")
    told = "confirmed" if results.confirmation.confirmed else "not confirmed"
    return Found(number, name, how, told, len(made.exact), tuple(missed))


def judged(numbers: range, seed: int, processes: int) -> Iterator[Found]:
    """All of them, in several processes."""
    if processes == 1:
        yield from map(partial(judge, seed=seed), numbers)
        return
    with get_context("spawn").Pool(processes) as pool:
        yield from pool.imap(partial(judge, seed=seed), numbers)


def main() -> int:
    """Count the hits; 1 when there are too few."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--decks", type=int, default=300)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--deck", type=int)
    parser.add_argument("--processes", type=int, default=2)
    given = parser.parse_args()
    if given.deck is not None:
        sys.stdout.write(known(given.deck, given.seed)[3].deck)
        sys.stdout.write(f"{judge(given.deck, given.seed)}\n")
        return 0
    verdicts: Counter[str] = Counter()
    channels = missed = decks = 0
    for found in judged(range(given.decks), given.seed, given.processes):
        verdicts[found.verdict] += 1
        channels, missed = channels + found.channels, missed + len(found.missed)
        decks += bool(found.missed)
        for text in found.missed:
            sys.stdout.write(f"{found.number} {found.name} {found.how}, {found.verdict}: {text}\n")
    hits = 1.0 - decks / given.decks
    told = ", ".join(f"{count} {verdict}" for verdict, count in sorted(verdicts.items()))
    sys.stdout.write(f"{given.decks} decks: {told}\n")
    sys.stdout.write(f"bounds contain the exact value in {hits:.2%} of the decks, ")
    sys.stdout.write(f"{channels - missed} of {channels} channels\n")
    return 0 if hits >= WANTED else 1


if __name__ == "__main__":
    sys.exit(main())
