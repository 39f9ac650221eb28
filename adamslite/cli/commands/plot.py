"""plot channels of results

RESULT is a result file, or a deck, which is solved first as `adamslite solve` does. A CHANNEL is a
column of the results or a pattern (`"PART/2.*"`, in quotes); each quantity has an axis of its own
above a common time axis. With --against the figure shows the reference, the band of its tolerance
and the difference. The figure goes to RESULT's name with -plot.png in the current directory, or to
OUT (.png, .svg, .pdf); drawing needs matplotlib.
"""

import argparse
import sys
from pathlib import Path

from adamslite.cli.commands.codes import DONE, STOPPED_EARLY
from adamslite.cli.commands.results_given import add_results_arguments, given_results


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments of `adamslite plot`."""
    add_results_arguments(parser)
    parser.add_argument("channel", metavar="CHANNEL", nargs="*", help="PART/2.x, REQUEST/1.F2, ...")
    parser.add_argument("-o", "--output", metavar="OUT", help="file of the figure")
    parser.add_argument(
        "--against", metavar="REFERENCE", type=Path, help="a reference, or other results"
    )
    parser.add_argument("--x", metavar="CHANNEL", default="time", help="in place of the time")


def run(args: argparse.Namespace) -> int:
    """Draw and write; return the exit code."""
    from adamslite.errors import UsageError
    from adamslite.outputs.whole_files import need_writable
    from adamslite.plots.selection import curve, select, without_numbers
    from adamslite.plots.style import need_matplotlib, need_suffix, save
    from adamslite.plots.time_histories import plot
    from adamslite.results.results import UnknownChannel
    from adamslite.verification.reference_file import read_reference

    need_matplotlib()
    output = args.output or f"{args.result.stem}-plot.png"
    need_suffix(output)
    reference = read_reference(args.against) if args.against else None
    results, read = given_results(args)
    need_writable(output, [*read, *([args.against] if args.against else [])], bool(args.output))
    try:
        names = select(results, args.channel)
        figure = plot(results, names, reference, args.x)
    except UnknownChannel as unknown:
        raise UsageError(str(unknown)) from None
    if gaps := without_numbers([curve(results, name) for name in names]):
        sys.stderr.write(f"adamslite: {gaps}\n")
    save(figure, output)
    sys.stderr.write(f"{output}: {len(names)} of {len(results.names)} channels\n")
    return DONE if results.outcome.is_requested else STOPPED_EARLY
