"""what a statement, a function or a message means

Without a name it lists what there is; `integrators` and `formats` print those there are.
"""

import argparse
import sys

from adamslite.cli.commands.codes import DONE


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments of `adamslite help`."""
    parser.add_argument("name", metavar="NAME", nargs="?", help="as in SFORCE, STEP5, no-ground")


def run(args: argparse.Namespace) -> int:
    """Print the pages of a name, or the names."""
    from adamslite import manual

    sys.stdout.write(manual.pages(args.name) if args.name else manual.contents())
    return DONE
