"""plot channels of results, or the runs of a sweep

RESULT is a result file, the file of a sweep, or a deck, which is solved first as `adamslite solve`
does. A CHANNEL is a column of the results or a pattern (`"PART/2.*"`, in quotes); each quantity has
an axis of its own above a common time axis. With --against the figure shows the reference, the band
of its tolerance and the difference. The figure goes to RESULT's name with -plot.png in the current
directory, or to OUT (.png, .svg, .pdf); drawing needs matplotlib.

Of a sweep a CHANNEL is a measure (`"max REQUEST/1.F2"`) or a column whose history was kept; without
any all measures are drawn. Those of a grid are curves over the number with most values, coloured by
another one; of a sample points over each number. Histories are a line for each run. Runs that
failed are marked.
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
    parser.add_argument(
        "--x", metavar="NAME",
        help="a channel in place of the time; of a sweep a number that varies, or a measure",
    )  # fmt: skip
    parser.add_argument("--dark", action="store_true", help="on a dark ground")
    sweep = parser.add_argument_group("of a sweep")
    sweep.add_argument("--by", metavar="NUMBER", help="the number whose values are colours")
    sweep.add_argument(
        "--band", metavar="LOW:HIGH", type=_band,
        help="median and a band of percentiles in place of each run: 5:95, or 0:100 for all",
    )  # fmt: skip
    sweep.add_argument(
        "--pairs", action="store_true", help="measures and numbers, each over each other"
    )
    sweep.add_argument(
        "--indices", action="store_true", help="Sobol indices, of a sample saltelli:N"
    )


def _band(text: str) -> tuple[float, float]:
    low, _, high = text.partition(":")
    try:
        return float(low), float(high)
    except ValueError:
        raise argparse.ArgumentTypeError(f"'{text}' is not like 5:95") from None


def run(args: argparse.Namespace) -> int:
    """Draw and write; return the exit code."""
    from adamslite.errors import UsageError
    from adamslite.outputs.whole_files import need_writable
    from adamslite.plots.selection import curve, select, without_numbers
    from adamslite.plots.style import need_matplotlib, need_suffix, save
    from adamslite.plots.time_histories import plot
    from adamslite.results.results import UnknownChannel
    from adamslite.sweeps.recognition import holds_sweep
    from adamslite.verification.reference_file import read_reference

    need_matplotlib()
    output = args.output or f"{args.result.stem}-plot.png"
    need_suffix(output)
    if holds_sweep(args.result):
        return _sweep(args, output)
    if args.by or args.band or args.pairs or args.indices:
        raise UsageError("--by, --band, --pairs and --indices belong to the file of a sweep")
    reference = read_reference(args.against) if args.against else None
    results, read = given_results(args)
    need_writable(output, [*read, *([args.against] if args.against else [])], bool(args.output))
    try:
        names = select(results, args.channel)
        figure = plot(results, names, reference, args.x or "time", args.dark)
    except UnknownChannel as unknown:
        raise UsageError(str(unknown)) from None
    if gaps := without_numbers([curve(results, name) for name in names]):
        sys.stderr.write(f"adamslite: {gaps}\n")
    save(figure, output)
    sys.stderr.write(f"{output}: {len(names)} of {len(results.names)} channels\n")
    return DONE if results.outcome.is_requested else STOPPED_EARLY


def _sweep(args: argparse.Namespace, output: str) -> int:
    """Draw the runs of a sweep."""
    from adamslite.errors import UsageError
    from adamslite.outputs.whole_files import need_writable
    from adamslite.plots.style import save
    from adamslite.plots.sweep_figures import sweep_figure
    from adamslite.plots.sweep_selection import Wanted
    from adamslite.run_flags import run_options
    from adamslite.sweeps.netcdf import read

    if args.deck or args.commands or args.user or args.values or run_options(args):
        raise UsageError(f"{args.result} holds a sweep: there is nothing to solve")
    if args.against:
        raise UsageError("--against belongs to results, and this is the file of a sweep")
    need_writable(output, [args.result], bool(args.output))
    found = read(args.result)
    wanted = Wanted(
        names=args.channel, x=args.x, by=args.by, band=args.band, pairs=args.pairs,
        indices=args.indices,
    )  # fmt: skip
    save(sweep_figure(found, wanted, args.dark), output)
    done = len(found) - len(found.failed) - len(found.ahead)
    sys.stderr.write(f"{output}: {done} of {len(found)} runs\n")
    return DONE if done == len(found) else STOPPED_EARLY
