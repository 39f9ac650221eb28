"""run reference decks and compare

Solves every deck below the given folders (or the given decks) that has a reference.csv and prints
one line each, with the worst deviation against its tolerance. Without arguments: those that come
with the program. A new deck folder joins by being there; decks/README.md says what it holds.
"""

import argparse
import sys
from functools import partial
from pathlib import Path

from adamslite.commands.codes import DONE, OUTSIDE_TOLERANCE


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments of `adamslite verify`."""
    parser.add_argument("paths", metavar="DIR|DECK", type=Path, nargs="*")


def run(args: argparse.Namespace) -> int:
    """Print one line per reference; return the exit code."""
    from adamslite.faults import UsageError
    from adamslite.places import find
    from adamslite.progress import TalkingProgress
    from adamslite.verify import find_cases, solve_quietly, verify

    paths = args.paths or [find("decks")]
    cases = find_cases(paths)
    if not cases:
        raise UsageError(f"there is no deck with a reference.csv in {', '.join(map(str, paths))}")
    width = max(len(case.name) for case in cases)
    failed = 0
    progress = TalkingProgress()
    for verdict in verify(cases, partial(solve_quietly, progress=progress)):
        progress.close()
        failed += not verdict.passed
        mark = "ok  " if verdict.passed else "FAIL"
        sys.stdout.write(f"{mark}  {verdict.case.name:{width}}  {verdict.text}\n")
        sys.stdout.flush()
    sys.stdout.write(f"{len(cases) - failed} of {len(cases)} references met\n")
    return OUTSIDE_TOLERANCE if failed else DONE
