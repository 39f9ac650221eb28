"""Sobol indices of a sweep: which number is behind the variance of a measure

RUNS is the file of `adamslite sweep ... --sample saltelli:N`. For each measure a table has the
part of its variance that each number is behind by itself (first) and together with others (total),
with intervals of 95 % from resampling the runs. All runs must have reached their end.
"""

import argparse
import sys
from pathlib import Path

from adamslite.cli.commands.codes import DONE


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments of `adamslite indices`."""
    parser.add_argument("runs", metavar="RUNS", type=Path, help="file of a sweep (.nc)")
    parser.add_argument(
        "measures", metavar="MEASURE", nargs="*", help="'max REQUEST/1.F2', 'max *'; all by default"
    )
    parser.add_argument("-o", "--output", metavar="OUT", type=Path, help="a table as well (.csv)")


def run(args: argparse.Namespace) -> int:
    """Print the tables."""
    from adamslite.api.sweeps import indices
    from adamslite.errors import UsageError
    from adamslite.outputs.whole_files import need_writable, whole_file

    if args.output:
        if args.output.suffix.lower() != ".csv":
            raise UsageError(f"-o {args.output}: the table ends in .csv")
        need_writable(args.output, [args.runs])
    found = indices(args.runs, args.measures)
    sys.stdout.write(str(found))
    if args.output:
        with whole_file(args.output) as stream:
            stream.write(found.csv())
    return DONE
