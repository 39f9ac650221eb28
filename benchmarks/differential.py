"""Methods against each other on random decks: who is right, who says so, who is silently wrong.

    python -m benchmarks.differential --decks 2000 --seed 1        all of them, an hour or so
    python -m benchmarks.differential --deck 17 --seed 1 --show    one deck and its verdicts
    python -m benchmarks.differential --decks 100 --only RADAU     some methods

The truth of a deck are two unrelated methods at tight ERROR and with short steps, where they agree.
A deck is *sensitive* when its motion amplifies a small change of its start by more than
``AMPLIFIED``: ERROR of 1e-6 then promises nothing, and the deck is counted apart.

=======  ===========================================================================
right    reached the end, no further from the truth than ``ALLOWED`` of the travel
warned   reached the end further off, and the results say that they are not to be trusted
stopped  refused or ended early, as a named outcome
slow     gave up after ``SECONDS``
silent   reached the end further off, and nothing says so
=======  ===========================================================================
"""

from __future__ import annotations

import argparse
import sys
from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass, field
from functools import partial
from multiprocessing import get_context
from pathlib import Path

from adamslite import assemble, compile_model, read, simulate
from adamslite.errors import UsageError
from adamslite.language.diagnostics import DeckError
from adamslite.language.method import AUTO
from adamslite.results.outcomes import Outcome
from adamslite.results.results import Results
from adamslite.results.run_error import error_of
from adamslite.verification.variants import Variant, patient, variants
from benchmarks.random_decks import RandomDeck, deck
from benchmarks.tables import table

#: ERROR of the methods that are judged, and what a run may be off, as a share of the travel.
ERROR, ALLOWED = 1e-6, 1e-3
#: CPU [s] that a judged run and a run for the truth may take.
SECONDS, PATIENCE = 10.0, 30.0
#: The truth: methods, ERROR, steps of the run and of the shortest thing in it, at least.
TRUTH = (("RADAU", 1e-10), ("ABAM", 1e-11))
LEAST_STEPS, WITHIN, MOST_STEPS = 1500, 2.0, 40000
#: Both runs for the truth agree within this; an ill-conditioned deck amplifies its start by more
#: than ``AMPLIFIED``.
AGREED, NUDGE, AMPLIFIED = 1e-4, 1e-7, 300.0

RIGHT, WARNED, STOPPED, SLOW, SILENT = "right", "warned", "stopped", "slow", "silent"
VERDICTS = (RIGHT, WARNED, STOPPED, SLOW, SILENT)
#: Notes of a run that say its numbers are not to be trusted as far as ERROR says.
WARNINGS = ("accuracy", "order", "energy", "audit", "warning")


@dataclass(frozen=True)
class Judged:
    """What a method made of a deck; ``false_alarm``: right, with a warning all the same."""

    method: str
    verdict: str
    error: float = 0.0
    said: str = ""
    false_alarm: bool = False


@dataclass(frozen=True)
class Report:
    """A deck and its verdicts; ``unknown``: why its truth is not known."""

    number: int
    title: str
    unknown: str = ""
    judged: tuple[Judged, ...] = field(default=())


def methods(only: Iterable[str]) -> list[Variant]:
    """Every integrator that ERROR steers, and AUTO; ``only`` those whose name holds a part."""
    known = [*variants(), Variant(AUTO)]
    parts = list(only)
    return [v for v in known if not parts or any(part in v.label for part in parts)]


def told(results: Results) -> str:
    """What the results say against themselves."""
    found = [results.meta[key] for key in WARNINGS if key in results.meta]
    return "; ".join(found)


class Scene:
    """A deck ready to run."""

    def __init__(self, drawn: RandomDeck) -> None:
        self.run = partial(simulate, compile_model(assemble(read(drawn.text))))
        steps = max(LEAST_STEPS, min(WITHIN * drawn.end / drawn.finest, MOST_STEPS))
        self.shortest = drawn.end / steps

    def tight(self, method: str, error: float) -> Results:
        """A run for the truth.

        Raises
        ------
        UsageError
            When the method refuses the deck or does not reach its end.
        """
        run = patient(self.run, PATIENCE)
        results = run(integrator=method, error=error, hmax=self.shortest)
        if results.outcome is not Outcome.DONE:
            raise UsageError(f"{method}: {results.outcome.name}")
        return results

    def judge(self, variant: Variant, truth: Results) -> Judged:
        """The verdict on one method."""
        try:
            results = patient(self.run, SECONDS)(error=ERROR, **variant.options)
        except UsageError as refusal:
            return Judged(variant.label, STOPPED, said=str(refusal))
        if results.outcome is Outcome.INTERRUPTED:
            return Judged(variant.label, SLOW)
        if results.outcome is not Outcome.DONE:
            return Judged(variant.label, STOPPED, said=results.outcome.name)
        error, said = error_of(results, truth), told(results)
        if error <= ALLOWED:
            return Judged(variant.label, RIGHT, error, said, bool(said))
        return Judged(variant.label, WARNED if said else SILENT, error, said)


def truth_of(scene: Scene, nudged: RandomDeck) -> Results:
    """The motion that two methods agree upon.

    Raises
    ------
    UsageError
        Why it is not known.
    """
    (first, tight), (second, tighter) = TRUTH
    truth, other = scene.tight(second, tighter), scene.tight(first, tight)
    apart = error_of(other, truth)
    if not apart <= AGREED:
        raise UsageError(f"{first} and {second} are {apart:.1e} apart")
    moved = Scene(nudged).tight(second, tighter)
    grown = error_of(moved, truth) / NUDGE
    if grown > AMPLIFIED:
        raise UsageError(f"sensitive: grows {grown:.1e} times")
    return truth


def attempt(number: int, seed: int, only: tuple[str, ...] = ()) -> Report:
    """Judge every method on one deck."""
    drawn = deck(number, seed)
    title = drawn.title
    try:
        scene = Scene(drawn)
        truth = truth_of(scene, deck(number, seed, NUDGE))
    except (UsageError, DeckError) as why:
        return Report(number, title, str(why))
    return Report(number, title, judged=tuple(scene.judge(v, truth) for v in methods(only)))


def summary(reports: Iterable[Report]) -> str:
    """How often each method got which verdict, as a table."""
    known = [report for report in reports if not report.unknown]
    counts: dict[str, Counter[str]] = {}
    alarms: Counter[str] = Counter()
    for judged in (j for report in known for j in report.judged):
        counts.setdefault(judged.method, Counter())[judged.verdict] += 1
        alarms[judged.method] += judged.false_alarm
    rows = [
        [method, *(str(count[v]) for v in VERDICTS), str(alarms[method])]
        for method, count in counts.items()
    ]
    return table(("method", *VERDICTS, "right, yet warned"), rows)


def misses_of_auto(reports: Iterable[Report]) -> list[int]:
    """Decks on which AUTO is not right though another method is."""
    found = []
    for report in reports:
        verdicts = {judged.method: judged.verdict for judged in report.judged}
        if verdicts.get(AUTO, RIGHT) != RIGHT and RIGHT in verdicts.values():
            found.append(report.number)
    return found


def run_all(numbers: Iterable[int], seed: int, only: tuple[str, ...], jobs: int) -> list[Report]:
    """Judge decks in parallel, saying on the way what is silent."""
    found = []
    with get_context("spawn").Pool(jobs, maxtasksperchild=100) as pool:
        work = partial(attempt, seed=seed, only=only)
        for report in pool.imap_unordered(work, numbers):
            found.append(report)
            for judged in report.judged:
                if judged.verdict in (SILENT, SLOW):
                    print(f"{report.title}: {judged.method} {judged.verdict} {judged.error:.1e}",
                          flush=True)  # fmt: skip
    return sorted(found, key=lambda report: report.number)


def show(report: Report) -> None:
    """Print the verdicts on one deck."""
    print(report.title, report.unknown)
    for judged in report.judged:
        print(f"  {judged.method:12} {judged.verdict:8} {judged.error:8.1e}  {judged.said}")


def why_unknown(report: Report) -> str:
    """Why a deck is not judged, without the numbers."""
    words = report.unknown.split(" are ")[0]
    return words.partition(": grows")[0]


def main(arguments: list[str] | None = None) -> int:
    """Judge what is asked for; 1 when a method is silently wrong."""
    parser = argparse.ArgumentParser(
        prog="python -m benchmarks.differential", description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )  # fmt: skip
    parser.add_argument("--decks", type=int, default=100, help="how many")
    parser.add_argument("--deck", type=int, nargs="+", help="only these numbers")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--only", nargs="+", default=(), metavar="PART")
    parser.add_argument("-j", "--jobs", type=int, default=1)
    parser.add_argument("--show", action="store_true", help="print every verdict")
    parser.add_argument("--keep", type=Path, help="write silent decks into this folder")
    args = parser.parse_args(arguments)
    numbers = args.deck or range(args.decks)
    reports = run_all(numbers, args.seed, tuple(args.only), args.jobs)
    if args.show:
        for report in reports:
            show(report)
    unknown = Counter(why_unknown(report) for report in reports if report.unknown)
    print(f"\n{len(reports)} decks; not judged: {sum(unknown.values())}")
    for why, count in unknown.most_common(12):
        print(f"  {count} {why}")
    print(summary(reports))
    print(f"AUTO missed what another method had: {misses_of_auto(reports)}")
    silent = [r for r in reports if any(j.verdict == SILENT for j in r.judged)]
    for report in silent if args.keep else ():
        args.keep.mkdir(parents=True, exist_ok=True)
        path = args.keep / f"random-{args.seed}-{report.number}.adm"
        path.write_text(deck(report.number, args.seed).text)
    return 1 if silent else 0


if __name__ == "__main__":
    sys.exit(main())
