"""compare two result files

A is the result, B the reference: its columns may be a few of A's, its times must be output times
of A unless --interpolate is given. Tolerances come from --tol, else from B's '# tolerance:' lines
(decks/README.md), else they are 1e-6, that is 'abs 1e-6 peak 1e-6'.

Files of ADAMS are compared as well (.res in XML, .req): positions of their parts, which are those
of origins, are taken to the centres of mass by the deck. Numbers in other units are converted.

What is outside its tolerance comes first, the worst at the top. Of a long comparison the rest is
shown with --all.
"""

import argparse
import sys
from pathlib import Path
from typing import TYPE_CHECKING

from adamslite.cli.commands.codes import DONE, OUTSIDE_TOLERANCE

if TYPE_CHECKING:
    from adamslite.results.comparison import Comparison

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
        "--deck", metavar="DECK", type=Path,
        help="where the centres of mass are, to compare with a .res of ADAMS; without it the deck "
        "that A or B knows",
    )  # fmt: skip
    parser.add_argument(
        "--all", action="store_true", help=f"list every channel, also where there are over {FEW}"
    )


def run(args: argparse.Namespace) -> int:
    """Print one line per channel; return the exit code."""
    import adamslite
    from adamslite.results.comparison import Mismatch
    from adamslite.results.results import Results
    from adamslite.verification.common_comparison import compared
    from adamslite.verification.reference_file import read_reference, tolerance_of

    results = Results.load(args.a)
    reference = read_reference(args.b)
    if args.tol:
        reference.tolerances = [("*", tolerance_of(args.tol))]
    if args.interpolate:
        reference.interpolate = args.interpolate
    deck = adamslite.read(args.deck) if args.deck else None
    try:
        comparison, notes = compared(results, reference, deck)
    except Mismatch as fault:
        sys.stdout.write(f"different: {fault}\n")
        return OUTSIDE_TOLERANCE
    for note in notes:
        sys.stderr.write(f"adamslite: {note}\n")
    sys.stdout.write(_table(comparison, args.all))
    return DONE if comparison.inside else OUTSIDE_TOLERANCE


def _table(comparison: "Comparison", everything: bool) -> str:
    """What is outside, then the rest unless there are too many of both."""
    from adamslite.results.comparison import table_lines

    outside, count = comparison.outside, len(comparison.differences)
    hidden = count > FEW and not everything
    lines = table_lines(outside if hidden else comparison.outside_first)
    rest = "; --all lists the others" if hidden and len(outside) < count else ""
    if hidden and not outside:
        lines, rest = [], "; --all lists them"
    return "\n".join([*lines, f"{comparison.verdict}{rest}", ""])
