"""print the page of a name

Of a statement, an argument, a function, an integrator, a command, a name of the Python package, a
message or an outcome of a run. Without a name it lists what there is; `integrators` and `formats`
print those there are.
"""

import argparse
import sys

from adamslite.cli.commands.codes import DONE


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments of `adamslite help`."""
    parser.add_argument(
        "name", metavar="NAME", nargs="?", help="as in SFORCE, QP, STEP5, GSTIFF, solve, no-ground"
    )


def run(args: argparse.Namespace) -> int:
    """Print the pages of a name, or the names."""
    from adamslite.manual import lookup

    parsers = args.parsers()
    text = lookup.pages(args.name, parsers) if args.name else lookup.contents(parsers)
    sys.stdout.write(text)
    return DONE
