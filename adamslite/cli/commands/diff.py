"""compare two result files

A is the result, B the reference: its columns may be a few of A's, its times must be output times
of A unless --interpolate is given. Tolerances come from --tol, else from B's '# tolerance:' lines
(decks/README.md), else they are 1e-6, that is 'abs 1e-6 peak 1e-6'.
"""

import argparse
import sys
from pathlib import Path
from typing import TYPE_CHECKING

from adamslite.cli.commands.codes import DONE, OUTSIDE_TOLERANCE

if TYPE_CHECKING:
    from adamslite.results.comparison import Comparison, Difference, Tolerance


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
    try:
        comparison = reference.judge(results, usual=USUAL)
    except Mismatch as fault:
        sys.stdout.write(f"different: {fault}\n")
        return OUTSIDE_TOLERANCE
    sys.stdout.write(_table(comparison))
    return DONE if comparison.inside else OUTSIDE_TOLERANCE


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


def _table(comparison: "Comparison") -> str:
    rows = [("channel", "worst", "allowed", "at t", "outside from"), *map(_row, comparison)]
    width = max(len(row[0]) for row in rows)
    lines = [
        f"{name:{width}}  {worst:>10}  {allowed:>10}  {time:>10}  {leaves}".rstrip()
        for name, worst, allowed, time, leaves in rows
    ]
    outside = sum(not difference.inside for difference in comparison)
    verdict = f"{outside} outside its tolerance" if outside else "all within their tolerances"
    return "\n".join([*lines, f"{len(comparison.differences)} compared, {verdict}", ""])


def _row(difference: "Difference") -> tuple[str, ...]:
    time = "" if difference.time is None else f"{difference.time:.6g}"
    leaves = "" if difference.leaves is None else f"{difference.leaves:.6g}"
    if not difference.inside and difference.leaves is None:
        leaves = "outside"
    worst, allowed = f"{difference.worst:.3e}", f"{difference.allowed:.3e}"
    return difference.name, worst, allowed, time, leaves
