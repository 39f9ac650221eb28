"""what is wrong with a deck, and what it contains

Prints every error and warning with its place, then what the deck consists of and, for cables, how
fast waves are in them and what model they need (docs/background/cables.md). Exit code 3
when there are errors; warnings alone do not count.

For other programs --format writes the messages alone: gcc (one line FILE:LINE:COLUMN: SEVERITY:
MESSAGE [CODE] for each place), json (a list of objects) or sarif (SARIF 2.1.0).

A comment `! adamslite: ignore CODE` takes warnings and notes with that code away from its line.
"""

import argparse
import sys
from pathlib import Path

from adamslite.cli.commands.codes import DECK_ERRORS, DONE
from adamslite.run_flags import add_user_flag


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments of `adamslite check`."""
    parser.add_argument("deck", metavar="DECK", type=Path, help="deck (.adm)")
    parser.add_argument(
        "commands", metavar="COMMANDS.acf", type=Path, nargs="?",
        help="command file; without it the .acf beside the deck",
    )  # fmt: skip
    add_user_flag(parser)
    parser.add_argument(
        "--format",
        choices=("text", "json", "sarif", "gcc"),
        default="text",
        help="text to read, or data for an editor or a pipeline (default: text)",
    )


def run(args: argparse.Namespace) -> int:
    """Print what there is to say; return the exit code."""
    from adamslite.api.checks import check
    from adamslite.language.messages.formats import FORMATS

    found = check(args.deck, args.commands, args.user)
    sys.stdout.write(str(found) if args.format == "text" else FORMATS[args.format](found))
    return DECK_ERRORS if found.errors else DONE
