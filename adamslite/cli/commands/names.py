"""numbers of a deck by name, with their values and places

One line for each: its name, its value, the unit of its argument and where it is written. `--set
NAME=VALUE` of solve, check, linear, view, plot and chart puts another one in. A VARIABLE that is
one number goes by its own name. With PATTERN only names that fit one: 'PART/2.*', K.
"""

import argparse
import sys
from pathlib import Path

from adamslite.cli.commands.codes import DONE
from adamslite.run_flags import add_folder_flag, add_user_flag


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments of `adamslite names`."""
    parser.add_argument("deck", metavar="DECK", type=Path, help="deck (.adm)")
    parser.add_argument("patterns", metavar="PATTERN", nargs="*", help="'SFORCE/*', 'PART/2.*'")
    add_user_flag(parser)
    add_folder_flag(parser)


def run(args: argparse.Namespace) -> int:
    """Print the table."""
    from adamslite.api.numbers import names

    sys.stdout.write(str(names(args.deck, args.patterns, args.user)))
    return DONE
