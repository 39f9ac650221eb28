"""Random cases for the program: files that are changed, and the outcome of each.

    python tests/fuzz                                   a sample of every kind, as the tests run it
    python tests/fuzz --kind solve --cases 20000        so many of one kind
    python tests/fuzz --kind read csv --seed 7 --jobs 4 other cases, four at a time
    python tests/fuzz --kind read --first 17 --cases 1  one of them
    python tests/fuzz --kind csv --keep FOLDER          cases with a fault, minimised, in a folder
    python tests/fuzz --again tests/fuzz/cases          cases that were kept

A case is fixed by kind, seed and number, as long as the decks of the project stay what they are.
Exit code 1 when one ends in a traceback, in exit code 70 or by a signal, takes more than 5 s of
CPU, or more than 500 MB.  Of equal faults one is minimised.  What is kept is moved to
tests/fuzz/cases when it is mended: tests/test_fuzz.py meets those again.
"""

from __future__ import annotations

import argparse
import re
import sys
from collections import Counter
from collections.abc import Sequence
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.parent), str(HERE.parents[1])]

from fuzz import material  # noqa: E402
from fuzz.cases import FACTS, Case, keep, kept  # noqa: E402
from fuzz.guarded import FAULTS, Child, Verdict, verdicts  # noqa: E402
from fuzz.kinds import KINDS  # noqa: E402
from fuzz.minimise import minimised  # noqa: E402

#: Cases between two lines about how far it is.
SHOWN = 10_000


def arguments(words: Sequence[str] | None = None) -> argparse.Namespace:
    """What is run."""
    parser = argparse.ArgumentParser(
        prog="python tests/fuzz", description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )  # fmt: skip
    parser.add_argument("--kind", nargs="+", choices=KINDS, default=list(KINDS), metavar="KIND",
                        help=f"of {', '.join(KINDS)}; all unless given")  # fmt: skip
    parser.add_argument("--cases", type=int, help="of each kind; unless given those of the tests")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--first", type=int, default=0, help="number of the first case")
    parser.add_argument("--jobs", type=int, default=1, help="processes at a time")
    parser.add_argument("--more", type=Path, action="append", default=[], metavar="FOLDER",
                        help="change the decks, descriptions and tables below it, too")  # fmt: skip
    parser.add_argument("--keep", type=Path, metavar="FOLDER", help="minimised cases go there")
    parser.add_argument("--again", type=Path, metavar="FOLDER", help="meet cases that were kept")
    return parser.parse_args(words)


def bucket(verdict: Verdict) -> tuple[str, str]:
    """What equal faults have in common: the words, not the numbers and names in them."""
    return verdict.word, re.sub(r"\d+|'[^']*'|\"[^\"]*\"|0x\w+", "#", verdict.what)[:200]


def run(kind: str, args: argparse.Namespace) -> int:
    """Meet the cases of a kind; return how many have a fault."""
    count = args.cases or KINDS[kind].sample
    numbers = range(args.first, args.first + count)
    counts: Counter[str] = Counter()
    seen: Counter[tuple[str, str]] = Counter()
    for done, (number, verdict) in enumerate(verdicts(kind, args.seed, numbers, args.jobs), 1):
        counts[verdict.word] += 1
        if verdict.is_fault:
            seen[bucket(verdict)] += 1
            if seen[bucket(verdict)] == 1:
                say(f"{kind} {args.seed} {number}: {verdict.word}: {verdict.what}")
                if args.keep:
                    case = KINDS[kind].make(args.seed, number)
                    store(kind, case, verdict, args.keep / f"{kind}-{args.seed}-{number}")
        if done % SHOWN == 0:
            say(f"{kind}: {done} of {count}")
    for fault, many in seen.most_common():
        say(f"{kind}: {many} times {': '.join(fault)}")
    faults = ", ".join(f"{counts.pop(each, 0)} {each}" for each in FAULTS)
    words = ", ".join(f"{many} {word}" for word, many in counts.most_common())
    say(f"{kind}: {count} cases ({words}): {faults}")
    return sum(seen.values())


def store(kind: str, case: Case, verdict: Verdict, folder: Path) -> None:
    """Keep a case with the least that has its fault."""
    wanted = bucket(verdict)
    with Child(kind) as child:
        small = minimised(case, lambda each: bucket(child.verdict(each)) == wanted)
    keep(small, kind, folder, f"{verdict.word}: {verdict.what}")
    say(f"{folder}: {small.size} of {case.size} bytes")


def again(folder: Path) -> int:
    """Meet all cases in a folder; return how many have a fault."""
    faults = 0
    for facts in sorted(folder.rglob(FACTS)):
        kind, case = kept(facts.parent)
        with Child(kind) as child:
            verdict = child.verdict(case)
        faults += verdict.is_fault
        say(f"{facts.parent.name}: {verdict.word} {verdict.what}".rstrip())
    return faults


def say(line: str) -> None:
    """Print a line at once: a run takes hours."""
    sys.stdout.write(f"{line}\n")
    sys.stdout.flush()


def main() -> int:
    """Meet the cases that are named; return the exit code."""
    args = arguments()
    material.FOLDERS.extend(args.more)
    faults = again(args.again) if args.again else sum(run(kind, args) for kind in args.kind)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
