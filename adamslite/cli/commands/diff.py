"""compare two result files

A is the result, B the reference: its columns may be a few of A's, its times must be output times
of A unless --interpolate is given. Tolerances come from --tol, else from B's '# tolerance:' lines
(decks/README.md), else they are 1e-6, that is 'abs 1e-6 peak 1e-6'.

What is outside its tolerance comes first, the worst at the top. Of a long comparison the rest is
shown with --all.
"""

import argparse
import sys
from pathlib import Path
from typing import TYPE_CHECKING

from adamslite.cli.commands.codes import DONE, OUTSIDE_TOLERANCE

if TYPE_CHECKING:
    from adamslite.results.comparison import Comparison, Difference, Tolerance
    from adamslite.results.results import Results
    from adamslite.verification.reference_file import Reference

#: So many channels are a table to look at; of more, those outside are listed.
FEW = 20


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments of `adamslite diff`."""
    parser.add_argument("a", metavar="A", type=Path, help="results")
    parser.add_argument("b", metavar="B", type=Path, help="reference")
    parser.add_argument(
        "--tol",
        metavar="TOL",
        help="a number X for 'abs X peak X', or any of 'abs A rel R peak P digits N': "
        "A + R |reference| + P largest |reference|",
    )
    parser.add_argument(
        "--interpolate", choices=("linear", "cubic"), help="of A, to the times of B"
    )
    parser.add_argument(
        "--all", action="store_true", help=f"list every channel, also where there are over {FEW}"
    )


def run(args: argparse.Namespace) -> int:
    """Print one line per channel; return the exit code."""
    from adamslite.results.comparison import USUAL, Mismatch
    from adamslite.results.results import Results
    from adamslite.verification.reference_file import read_reference

    results = Results.load(args.a)
    reference = read_reference(args.b)
    if args.tol:
        reference.tolerances = [("*", _tolerance(args.tol))]
    if args.interpolate:
        reference.interpolate = args.interpolate
    _tell_other_deck(results, reference.table)
    try:
        _need_content(reference)
        comparison = reference.judge(results, usual=USUAL)
    except Mismatch as fault:
        sys.stdout.write(f"different: {fault}\n")
        return OUTSIDE_TOLERANCE
    sys.stdout.write(_table(comparison, args.all))
    return DONE if comparison.inside else OUTSIDE_TOLERANCE


def _need_content(reference: "Reference") -> None:
    """Raise Mismatch for a reference with which nothing could differ."""
    from adamslite.results.comparison import Mismatch

    if reference.measures:
        return
    if not reference.table.names:
        raise Mismatch("the reference has no channel at all")
    if not reference.table.time.size:
        raise Mismatch("the reference has no output time at all")


def _tell_other_deck(results: "Results", reference: "Results") -> None:
    """One sentence where the two are not of one deck."""
    hashes = [each.meta.get("deck hash") for each in (results, reference)]
    if all(hashes) and hashes[0] != hashes[1]:
        titles = [each.meta.get("deck", "") for each in (results, reference)]
        same = titles[0] == titles[1]
        what = f"both called '{titles[0]}'" if same else f"'{titles[0]}' and '{titles[1]}'"
        sys.stderr.write(f"adamslite: A and B are results of different decks, {what}\n")


def _tolerance(text: str) -> "Tolerance":
    from adamslite.errors import UsageError
    from adamslite.results.comparison import Tolerance
    from adamslite.verification.reference_file import parse_tolerance

    try:
        return Tolerance(abs=float(text), peak=float(text))
    except ValueError:
        pass  # not a lone number: a tolerance in words
    try:
        return parse_tolerance(text)
    except ValueError as fault:
        raise UsageError(f"--tol: {fault}") from None


def _table(comparison: "Comparison", everything: bool) -> str:
    """What is outside, then the rest unless there are too many of both."""
    outside = [each for each in comparison if not each.inside]
    inside = [each for each in comparison if each.inside]
    outside.sort(key=lambda each: -each.severity)
    hidden = len(comparison.differences) > FEW and not everything
    shown = outside if hidden else [*outside, *inside]
    rows = [("channel", "worst", "allowed", "at t", "outside from"), *map(_row, shown)]
    width = max(len(row[0]) for row in rows)
    lines = [
        f"{name:{width}}  {worst:>10}  {allowed:>10}  {time:>10}  {leaves}".rstrip()
        for name, worst, allowed, time, leaves in rows
    ]
    their = "its tolerance" if len(outside) == 1 else "their tolerances"
    verdict = f"{len(outside)} outside {their}" if outside else "all within their tolerances"
    rest = "; --all lists the others" if hidden and inside else ""
    if not shown:
        lines, rest = [], "; --all lists them"
    return "\n".join([*lines, f"{len(comparison.differences)} compared, {verdict}{rest}", ""])


def _row(difference: "Difference") -> tuple[str, ...]:
    time = "" if difference.time is None else f"{difference.time:.6g}"
    leaves = "" if difference.leaves is None else f"{difference.leaves:.6g}"
    if not difference.inside and difference.leaves is None:
        leaves = "outside"
    worst, allowed = f"{difference.worst:.3e}", f"{difference.allowed:.3e}"
    return difference.name, worst, allowed, time, leaves
