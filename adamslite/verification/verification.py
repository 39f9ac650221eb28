"""Solves every deck that has a reference, and compares.

A case is one reference file and the deck it belongs to: `reference*.csv` in a folder with one deck,
`<deck>.reference*.csv` in a folder with several. decks/README.md is the manual.
"""

import re
from collections.abc import Callable, Iterable, Iterator, Mapping
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from functools import partial
from itertools import chain, groupby
from pathlib import Path
from typing import Any

from adamslite import notation
from adamslite.errors import FormatError, OutOfMemory, UsageError
from adamslite.language.diagnostics import DeckError
from adamslite.language.file_name import leads_out
from adamslite.progress import Progress
from adamslite.results.comparison import Comparison, Mismatch
from adamslite.results.outcomes import Outcome
from adamslite.results.results import Results
from adamslite.scene import load_scene, run_scene
from adamslite.verification.reference_file import Reference, read_reference

#: Of a reference file.
_NAME = re.compile(r"(.+\.)?reference(-.+)?\.csv")

Run = Callable[[Path, Mapping[str, Any]], Results]


@dataclass(frozen=True)
class Case:
    """A reference file and the deck it is for (None when there is no such deck)."""

    reference: Path
    deck: Path | None

    @property
    def name(self) -> str:
        """Folder, deck if it is called otherwise, and what follows `reference` in the file name."""
        folder = self.reference.resolve().parent.name
        tag = self.reference.stem.rpartition("reference")[2].lstrip("-")
        deck = f"/{self.deck.stem}" if self.deck and self.deck.stem != folder else ""
        return f"{folder}{deck}{f' ({tag})' if tag else ''}"


@dataclass(frozen=True)
class Verdict:
    """Whether a case passed, and one line on how.

    Parameters
    ----------
    case : Case
        What was judged.
    passed : bool
        Whether the run is as close as the reference requires.
    text : str
        One line, without the name of the case.
    share : float or None
        Part of its band that the worst channel uses, error / allowed; None when nothing could be
        compared.
    """

    case: Case
    passed: bool
    text: str
    share: float | None = None


def find_cases(paths: Iterable[Path]) -> list[Case]:
    """Return the cases of decks (files) and of everything below folders, sorted by path."""
    cases: dict[Path, Case] = {}
    for path in paths:
        if path.is_dir():
            cases |= {file: Case(file, _deck_of(file)) for file in _references(path.rglob)}
        elif path.exists():
            beside = _references(path.parent.glob)
            cases |= {file: Case(file, path) for file in beside if _deck_of(file) == path}
        else:
            raise FileNotFoundError(2, "no such deck or folder", str(path))
    return list(cases.values())


def verify(cases: Iterable[Case], run: Run | None = None, jobs: int = 1) -> Iterator[Verdict]:
    """Solve and judge one case after the other, in their order.

    Parameters
    ----------
    cases : iterable of Case
        Those of one deck should follow each other: a run with the same flags is not repeated.
    run : function of a deck's path and run options, optional
        Returns Results; by default `solve_quietly`. With several jobs it must be one that another
        process can import.
    jobs : int, optional
        How many processes share the decks.
    """
    judge_deck = partial(_judge_deck, run=run or solve_quietly)
    decks = [list(group) for _, group in groupby(cases, key=lambda case: case.deck)]
    if min(jobs, len(decks)) < 2:
        for group in decks:
            yield from judge_deck(group)
        return
    from adamslite.sweeps.workers import end_now

    pool = ProcessPoolExecutor(
        min(jobs, len(decks)), initializer=_begin, initargs=(notation.current(),)
    )
    try:
        yield from chain.from_iterable(pool.map(judge_deck, decks))
    except BaseException:
        end_now(pool)
        raise
    pool.shutdown()


def _begin(words: str) -> None:
    """A process begins: messages are written as in the first one, also where it is no fork."""
    from adamslite.sweeps.workers import follow_the_first

    notation.use(words)
    follow_the_first()


def solve_quietly(
    deck: Path, options: Mapping[str, Any], progress: Progress | None = None
) -> Results:
    """Read, check and simulate a deck; unlike `solve`, an interruption is not a result."""
    given = dict(options)
    scene = load_scene(deck, user=given.pop("user", ()), values=given.pop("values", ()))
    results = run_scene(scene, given, progress)
    if results.outcome is Outcome.INTERRUPTED:
        raise KeyboardInterrupt
    return results


def _references(glob: Callable[[str], Iterable[Path]]) -> list[Path]:
    """The files called `[deck.]reference[-tag].csv`, deck by deck."""
    found = (file for file in glob("*reference*.csv") if _NAME.fullmatch(file.name))
    named = (file for file in found if not leads_out(file))
    return sorted(named, key=lambda file: (file.parent, file.stem))


def _deck_of(file: Path) -> Path | None:
    prefix = file.stem.rpartition(".")[0]
    if prefix:
        named = file.with_name(f"{prefix}.adm")
        return named if named.is_file() else None
    decks = list(file.parent.glob("*.adm"))
    return decks[0] if len(decks) == 1 else None


def _judge_deck(cases: Iterable[Case], run: Run) -> list[Verdict]:
    """Judge the cases of one deck; runs with the same flags are one run."""
    runs: dict[tuple[object, ...], Results] = {}

    def remembered(deck: Path, options: Mapping[str, Any]) -> Results:
        key = (deck, *sorted(options.items()))
        if key not in runs:
            runs[key] = run(deck, options)
        return runs[key]

    return [_judge_safely(case, remembered) for case in cases]


def _judge_safely(case: Case, run: Run) -> Verdict:
    try:
        return _judge(case, run)
    except DeckError as fault:
        first = fault.errors[0]
        return Verdict(case, False, f"the deck has errors: {first.span}: {first.message}")
    except (Mismatch, FormatError, UsageError, OutOfMemory) as fault:
        return Verdict(case, False, str(fault))


def _judge(case: Case, run: Run) -> Verdict:
    reference = read_reference(case.reference)
    if missing := reference.without_tolerance():
        raise FormatError(f"no '# tolerance:' line fits the column '{missing[0]}'")
    if case.deck is None:
        raise FormatError("its folder does not have exactly one deck for this reference file name")
    results = run(case.deck, reference.options)
    ending = _wrong_ending(reference, results)
    if ending:
        return Verdict(case, False, ending)
    comparison = reference.judge(results)
    sentence = _sentence(reference, results, comparison)
    return Verdict(case, comparison.inside, sentence, _share(reference, results, comparison))


def _wrong_ending(reference: Reference, results: Results) -> str:
    if results.outcome is not reference.outcome:
        cause = " ".join((results.message or results.outcome.sentence).split())
        return f"ended with {results.outcome.name}, not {reference.outcome.name}: {cause}"
    if reference.stop:
        time, slack = reference.stop
        if not abs(_end(results) - time) <= slack:
            return (
                f"{results.outcome.name} at t = {_end(results):.9g}, "
                f"expected at {time:g} within {slack:g}"
            )
    return ""


def _share(reference: Reference, results: Results, comparison: Comparison) -> float:
    """Part of its band that the worst channel uses; the time of a named end is a channel, too."""
    shares = [difference.severity for difference in comparison]
    if reference.stop:
        time, slack = reference.stop
        shares.append(abs(_end(results) - time) / slack)
    return max(shares, default=0.0)


def _end(results: Results) -> float:
    """The time the run reached, which need not be an output time."""
    return float(results.summary.get("t_end", results.time[-1] if results.time.size else 0.0))


def _sentence(reference: Reference, results: Results, comparison: Comparison) -> str:
    parts = []
    if reference.stop:
        parts.append(f"{results.outcome.name} at t = {_end(results):.9g}")
    if worst := comparison.worst:
        when = f" at t = {worst.time:g}" if worst.time is not None else ""
        parts.append(f"{worst.name} off by {worst.worst:.2e} of {worst.allowed:.2e} allowed{when}")
        if worst.leaves is not None:
            parts.append(f"outside from t = {worst.leaves:g}")
    outside = sum(not difference.inside for difference in comparison)
    if outside > 1:
        parts.append(f"{outside} of {len(comparison.differences)} outside")
    return "; ".join(parts)
