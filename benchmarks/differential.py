"""Methods on random decks: who is right, who says that it is not, who is silently wrong.

    python -m benchmarks.differential --decks 2000 --seed 1 -j 2     of all kinds, in turns
    python -m benchmarks.differential --kinds stiffness tables       some kinds
    python -m benchmarks.differential --error 1e-6 --only RADAU      one ERROR, some methods
    python -m benchmarks.differential --kinds tables --deck 17 --seed 1 --show
                                      one deck and its verdicts; --text: its text
    python -m benchmarks.differential --sample                       decks whose truths are kept
    python -m benchmarks.differential --renew-sample                 choose them, solve them again

==========  ==============================================================================
stiffness   STEP windows of the state; springs, contacts and rates that vanish or appear
tables      AKISPL, CUBSPL, INTERP of the state, with uneven knots: humps of roads, spikes
singular    walls of powers, logarithms and roots; charges that pass each other closely
bumps       bells and levels without a guard, narrow on a long way
rotating    drive trains, free bodies, torsion, universal joints
amplifying  orbits, chains of one to three bars, inverted pendulums
scales      a millimetre on a kilometre; lines that become taut
sensors     a SENSOR at 90 to 99.999 % of a peak, or above it
pulleys     weights on elastic cables over pulleys and drums
statics     several SIMULATE/STATIC: every analysis has its row
mixed       one to three bodies and the laws of ``random_laws``
==========  ==============================================================================

Decks have the program's default HMAX and few output steps; every one is run at each ERROR.  The
truth is a closed form or own equations of the kind, integrated by scipy (:mod:`benchmarks.posed`);
of mixed decks it is two methods at tight ERROR with short steps, where they agree, and *sensitive*
ones are left out.  Truths are kept in a folder of the cache, or in that of ADAMSLITE_TRUTHS.
Verdicts are those of :mod:`benchmarks.judging`.  Exit code 1: something is silently wrong.
"""

from __future__ import annotations

import argparse
import json
import sys
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import asdict, dataclass
from functools import partial
from multiprocessing import get_context
from pathlib import Path
from typing import Any

from adamslite.language.diagnostics import DeckError
from adamslite.language.method import AUTO
from adamslite.verification.variants import Variant, variants
from benchmarks.judging import RIGHT, SILENT, SLOW, VERDICTS, Bench, Judged, limit
from benchmarks.posed import UnknownTruth
from benchmarks.tables import table
from benchmarks.truths import MIXED, kinds, packed, posed, truth_of

#: ERROR of the methods that are judged, unless said otherwise.
ERRORS = (1e-3, 1e-4, 1e-6)
#: Statics have one method and no ERROR.
STATICS, AS_STATICS = "statics", "GSTIFF SI2"
#: Decks whose truths are kept beside this file; how many, of which seed.
SAMPLE = Path(__file__).parent / "differential.json"
SAMPLED, SAMPLE_SEED = 200, 31


@dataclass(frozen=True)
class Task:
    """Deck ``number`` of a kind and a seed."""

    kind: str
    number: int
    seed: int

    @property
    def command(self) -> str:
        """Shows the deck and its verdicts."""
        return (
            f"python -m benchmarks.differential --kinds {self.kind} --seed {self.seed} "
            f"--deck {self.number} --show"
        )


@dataclass(frozen=True)
class Report:
    """A deck and its verdicts; ``unknown``: why its truth is not known."""

    task: Task
    title: str
    unknown: str = ""
    judged: tuple[Judged, ...] = ()


def methods(only: Iterable[str] = ()) -> list[Variant]:
    """Every integrator that ERROR steers, and AUTO; ``only`` those whose name holds a part."""
    known = [*variants(), Variant(AUTO)]
    parts = list(only)
    return [v for v in known if not parts or any(part in v.label for part in parts)]


def attempt(
    task: Task, only: Sequence[str] = (), errors: Sequence[float] = ERRORS,
    kept: dict[str, Any] | None = None,
) -> Report:  # fmt: skip
    """Judge every method on one deck."""
    problem = posed(task.kind, task.number, task.seed)
    try:
        truth = truth_of(problem, kept)
        bench = Bench(problem)
    except (UnknownTruth, DeckError) as why:
        return Report(task, problem.title, str(why))
    tried = methods(only)
    if task.kind == STATICS:
        tried, errors = methods([AS_STATICS]), errors[:1]
    found = [bench.judge(variant, error, truth) for error in errors for variant in tried]
    return Report(task, problem.title, judged=tuple(found))


def run_all(
    tasks: Iterable[Task], only: Sequence[str], errors: Sequence[float], jobs: int,
    kept: dict[str, Any] | None = None, out: Path | None = None,
) -> list[Report]:  # fmt: skip
    """Judge decks in parallel, saying on the way what is silent; ``out`` gets a line for each."""
    found = []
    work = partial(attempt, only=only, errors=errors, kept=kept)
    with get_context("spawn").Pool(jobs, maxtasksperchild=100) as pool:
        for report in pool.imap_unordered(work, tasks):
            found.append(report)
            if out:
                with out.open("a", encoding="utf-8") as file:
                    file.write(json.dumps(asdict(report)) + "\n")
            for judged in report.judged:
                if judged.verdict in (SILENT, SLOW):
                    print(line_of(report, judged), flush=True)
    return sorted(found, key=lambda report: (report.task.kind, report.task.number))


def line_of(report: Report, judged: Judged) -> str:
    """A verdict in a line."""
    return (
        f"{report.title}: {judged.method} {judged.error:g} {judged.verdict} {judged.off:.1e} "
        f"{judged.kind} (limit {limit(judged.error):g})"
    )


def summary(reports: Iterable[Report], by: Sequence[str]) -> str:
    """How often each verdict was given, by some of kind, method, ERROR, channel, as a table."""
    counts: dict[tuple[str, ...], Counter[str]] = {}
    for report in reports:
        for judged in report.judged:
            names = {"kind": report.task.kind, "method": judged.method,
                     "ERROR": f"{judged.error:g}", "channel": judged.kind or "-"}  # fmt: skip
            count = counts.setdefault(tuple(names[each] for each in by), Counter())
            count[judged.verdict] += 1
            count["false alarm"] += judged.false_alarm
    rows = [
        [*named, *(str(count[v]) for v in VERDICTS), str(count["false alarm"])]
        for named, count in sorted(counts.items())
    ]
    return table((*by, *VERDICTS, "false alarm"), rows)


def misses_of_auto(reports: Iterable[Report]) -> Iterator[str]:
    """Decks on which AUTO is silently wrong, or not right though another method is."""
    for report in reports:
        for error in dict.fromkeys(judged.error for judged in report.judged):
            verdicts = {j.method: j.verdict for j in report.judged if j.error == error}
            if verdicts.get(AUTO, RIGHT) != RIGHT and RIGHT in verdicts.values():
                yield f"{report.title} at {error:g}"


def show(report: Report) -> None:
    """Print the verdicts on one deck."""
    print(report.title, report.unknown)
    for judged in report.judged:
        alarm = "false alarm" if judged.false_alarm else judged.verdict
        print(f"  {judged.method:11} {judged.error:5g} {alarm:11} {judged.off:8.1e} "
              f"{judged.kind:8}  {judged.said}")  # fmt: skip


def reports_of(files: Iterable[Path]) -> list[Report]:
    """Reports that ``--out`` wrote."""
    lines = [json.loads(line) for file in files for line in file.open(encoding="utf-8")]
    return [
        Report(Task(**each["task"]), each["title"], each["unknown"],
               tuple(Judged(**judged) for judged in each["judged"]))
        for each in lines
    ]  # fmt: skip


def why_unknown(report: Report) -> str:
    """Why a deck is not judged, without the numbers."""
    return report.unknown.split(" are ")[0].partition(": grows")[0]


def in_turns(names: Sequence[str], count: int, seed: int) -> list[Task]:
    """So many decks of some kinds in all."""
    return [Task(names[k % len(names)], k // len(names), seed) for k in range(count)]


def renew_sample(jobs: int) -> None:
    """Choose decks with a known truth of all kinds but the mixed, and keep their truths."""
    names = [kind for kind in kinds() if kind != MIXED]
    each = -(-SAMPLED // len(names))
    tasks = in_turns(names, SAMPLED + 3 * len(names), SAMPLE_SEED)
    with get_context("spawn").Pool(jobs) as pool:
        solved = pool.map(_solved, tasks, chunksize=1)
    count: Counter[str] = Counter()
    lines = []
    for task, found in zip(tasks, solved, strict=True):
        if found is None or count[task.kind] >= each or len(lines) >= SAMPLED:
            continue
        count[task.kind] += 1
        lines.append(json.dumps({"kind": task.kind, "number": task.number, **found}))
    SAMPLE.write_text("[\n" + ",\n".join(lines) + "\n]\n", encoding="utf-8")
    print(f"{len(lines)} decks: {dict(count)}")


def _solved(task: Task) -> dict[str, Any] | None:
    """The packed truth of a deck with its key; nothing where it is not known."""
    from benchmarks.truths import key

    problem = posed(task.kind, task.number, task.seed)
    try:
        return {"key": key(problem), "truth": packed(truth_of(problem))}
    except UnknownTruth:
        return None


def sample() -> tuple[list[Task], dict[str, Any]]:
    """Decks of the sample and their truths."""
    kept = json.loads(SAMPLE.read_text(encoding="utf-8"))
    tasks = [Task(each["kind"], each["number"], SAMPLE_SEED) for each in kept]
    return tasks, {each["key"]: each["truth"] for each in kept}


def arguments_of(arguments: list[str] | None) -> argparse.Namespace:
    """The command line."""
    parser = argparse.ArgumentParser(
        prog="python -m benchmarks.differential", description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )  # fmt: skip
    parser.add_argument("--decks", type=int, default=100, help="how many, of all kinds together")
    parser.add_argument("--deck", type=int, nargs="+", help="only these numbers, of each kind")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--kinds", nargs="+", default=kinds(), choices=kinds(), metavar="KIND")
    parser.add_argument("--error", type=float, nargs="+", default=ERRORS)
    parser.add_argument("--only", nargs="+", default=(), metavar="PART", help="of methods' names")
    parser.add_argument("-j", "--jobs", type=int, default=1)
    parser.add_argument("--show", action="store_true", help="print every verdict")
    parser.add_argument("--text", action="store_true", help="print the decks")
    parser.add_argument("--full", action="store_true", help="a table by kind, method and ERROR")
    parser.add_argument("--keep", type=Path, help="write silent decks into this folder")
    parser.add_argument("--out", type=Path, help="append a line of JSON for every deck")
    parser.add_argument("--tables", type=Path, nargs="+", help="only the tables of such files")
    parser.add_argument("--sample", action="store_true", help="decks whose truths are kept")
    parser.add_argument("--renew-sample", action="store_true")
    return parser.parse_args(arguments)


def main(arguments: list[str] | None = None) -> int:
    """Judge what is asked for; 1 when a method is silently wrong."""
    args = arguments_of(arguments)
    if args.renew_sample:
        renew_sample(args.jobs)
        return 0
    if args.tables:
        print_tables(reports_of(args.tables), args.full)
        return 0
    kept: dict[str, Any] = {}
    if args.sample:
        tasks, kept = sample()
        tasks = [task for task in tasks if task.kind in args.kinds]
    elif args.deck:
        tasks = [Task(kind, number, args.seed) for kind in args.kinds for number in args.deck]
    else:
        tasks = in_turns(args.kinds, args.decks, args.seed)
    for task in tasks if args.text else ():
        problem = posed(task.kind, task.number, task.seed)
        print("\n".join([problem.text, *problem.commands]))
    reports = run_all(tasks, args.only, args.error, args.jobs, kept, args.out)
    for report in reports if args.show else ():
        show(report)
    print_tables(reports, args.full)
    silent = [r for r in reports if any(j.verdict == SILENT for j in r.judged)]
    for report in silent:
        print(report.task.command)
        if args.keep:
            args.keep.mkdir(parents=True, exist_ok=True)
            task = report.task
            path = args.keep / f"{task.kind}-{task.seed}-{task.number}.adm"
            path.write_text(posed(task.kind, task.number, task.seed).text, encoding="utf-8")
    return 1 if silent else 0


def print_tables(reports: Sequence[Report], full: bool) -> None:
    """Counts of verdicts."""
    unknown = Counter((r.task.kind, why_unknown(r)) for r in reports if r.unknown)
    print(f"\n{len(reports)} decks; not judged: {sum(unknown.values())}")
    for (kind, why), count in unknown.most_common(20):
        print(f"  {count} {kind}: {why[:120]}")
    for by in (
        (("method", "ERROR"), ("kind", "ERROR")) if not full else (("kind", "method", "ERROR"),)
    ):
        print("\n" + summary(reports, by))
    wrong = [
        Report(r.task, r.title, judged=tuple(j for j in r.judged if j.verdict == SILENT))
        for r in reports
    ]
    if any(report.judged for report in wrong):
        print("\nsilent by kind of channel\n" + summary(wrong, ("channel", "method")))
    if missed := list(misses_of_auto(reports)):
        print(f"\nAUTO missed what another method had: {len(missed)}")
        print("\n".join(f"  {each}" for each in missed[:20]))


if __name__ == "__main__":
    sys.exit(main())
