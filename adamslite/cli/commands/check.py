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

from adamslite.cli.commands.codes import DECK_ERRORS, DONE
from adamslite.run_flags import add_deck


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments of `adamslite check`."""
    add_deck(parser)
    parser.add_argument(
        "--format",
        choices=("text", "json", "sarif", "gcc"),
        default="text",
        help="text to read, or data for an editor or a pipeline (default: text)",
    )


def run(args: argparse.Namespace) -> int:
    """Print what there is to say; return the exit code."""
    from adamslite import kept_scene
    from adamslite.language.text import is_piped

    if is_piped(args.deck):
        return _of_standard_input(args)
    beside = None if args.commands else kept_scene.command_file_beside(args.deck)
    about = ("check", args.format, str(beside))
    origin = (
        None
        if args.user or args.values
        else kept_scene.origin_of(args.deck, args.commands or beside)
    )
    kept = origin and kept_scene.find_text(origin, *about)
    if kept:
        sys.stdout.write(kept)
        return DONE
    from adamslite.api.checks import check
    from adamslite.language.messages.formats import FORMATS

    found = check(args.deck, args.commands, args.user, args.values)
    text = str(found) if args.format == "text" else FORMATS[args.format](found)
    sys.stdout.write(text)
    if origin and found.deck and not found.errors:
        kept_scene.keep_text(origin, text, found.deck, found.commands, *about)
    return DECK_ERRORS if found.errors else DONE


def _of_standard_input(args: argparse.Namespace) -> int:
    """Of a deck that comes through a pipe nothing is kept."""
    from adamslite.api.checks import check
    from adamslite.language.messages.formats import FORMATS
    from adamslite.language.text import piped

    found = check(piped(), args.commands, args.user, args.values)
    sys.stdout.write(str(found) if args.format == "text" else FORMATS[args.format](found))
    return DECK_ERRORS if found.errors else DONE
