"""run reference decks and compare

Solves every deck below the given folders (or the given decks) that has a reference.csv and prints
one line each: the share of its tolerance that the worst channel uses, and which that is. Without
arguments: those that come with the program. A new deck folder joins by being there;
decks/README.md says what it holds.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Mapping, Sequence
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

from adamslite import machine
from adamslite.cli.commands.codes import DONE, OUTSIDE_TOLERANCE
from adamslite.run_flags import add_folder_flag, add_limit_flags, count, positive, run_options

if TYPE_CHECKING:
    from adamslite.results.results import Results
    from adamslite.verification.verification import Verdict


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments of `adamslite verify`."""
    parser.add_argument("paths", metavar="DIR|DECK", type=Path, nargs="*", help="folders and decks")
    parser.add_argument(
        "-j", "--jobs", metavar="N", type=count, default=machine.processors(),
        help="processes that share the decks (default: as many as there are processors)",
    )  # fmt: skip
    parser.add_argument(
        "--share", metavar="S", type=positive, default=1.0,
        help="largest share of a tolerance that may be used (default: 1, all of it)",
    )  # fmt: skip
    add_folder_flag(parser)
    add_limit_flags(parser, "a reference whose run reaches one is not met", "each run")


def run(args: argparse.Namespace) -> int:
    """Print one line per reference; return the exit code."""
    from adamslite.errors import UsageError
    from adamslite.resources import find
    from adamslite.verification.verification import find_cases, verify

    paths = args.paths or [find("decks")]
    cases = find_cases(paths)
    if not cases:
        raise UsageError(f"there is no deck with a reference.csv in {', '.join(map(str, paths))}")
    width = max(len(case.name) for case in cases)
    verdicts = []
    run = partial(solve_tellingly, limits=run_options(args))
    for verdict in verify(cases, run, args.jobs):
        verdicts.append(verdict)
        mark = "ok  " if _meets(verdict, args.share) else "FAIL"
        share = f"{'':5}" if verdict.share is None else f"{verdict.share:5.2f}"
        sys.stdout.write(f"{mark} {share}  {verdict.case.name:{width}}  {verdict.text}\n")
        sys.stdout.flush()
    sys.stdout.write(_summary(verdicts, args.share))
    met = all(_meets(verdict, args.share) for verdict in verdicts)
    return DONE if met else OUTSIDE_TOLERANCE


def solve_tellingly(
    deck: Path, options: Mapping[str, Any], limits: Mapping[str, Any] | None = None
) -> Results:
    """Solve a deck as `verify` does, within limits, and report what takes long."""
    from adamslite.progress import SentenceProgress
    from adamslite.verification.verification import solve_quietly

    return solve_quietly(deck, {**options, **(limits or {})}, SentenceProgress())


def _meets(verdict: Verdict, share: float) -> bool:
    """Whether a reference is met with this share of its tolerance."""
    return verdict.passed and (verdict.share or 0.0) <= share


def _summary(verdicts: Sequence[Verdict], share: float) -> str:
    """How many references are met, and which is met most narrowly."""
    met = sum(_meets(verdict, share) for verdict in verdicts)
    text = f"{met} of {len(verdicts)} references met"
    judged = [(each.share, each.case.name) for each in verdicts if each.share is not None]
    if judged:
        worst, name = max(judged, key=lambda each: each[0])
        text += f"; the largest share of a tolerance is {worst:.2f}, in {name}"
    return f"{text}\n"
