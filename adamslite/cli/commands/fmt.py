"""put decks and command files into the canonical layout

Keywords in full and in capitals, one blank behind the comma between arguments, lines of at most 80
columns, comments aligned (docs/how-to/editor.md). What a file says, its comments and its names
stay; a statement with a mistake stays as it is, and so does a file with more than 100 000 words
that cannot be read. `-` is a deck from standard input, which goes to standard output. Each file is
written whole or not at all. With --check nothing is written: the files that would change are
listed, and the exit code is 1 if there are any.
"""

import argparse
import sys
from pathlib import Path

from adamslite.cli.commands.codes import DONE, OUTSIDE_TOLERANCE


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments of `adamslite fmt`."""
    parser.add_argument("files", metavar="FILE", type=Path, nargs="+", help="deck or command file")
    parser.add_argument("--check", action="store_true", help="only list what would change")


def run(args: argparse.Namespace) -> int:
    """Write the files that are not in the canonical layout; return the exit code."""
    from adamslite.editing.layout import formatted
    from adamslite.editing.text_file import read_text
    from adamslite.language.text import is_piped

    if any(map(is_piped, args.files)):
        return _piped(args)
    files = [read_text(path) for path in args.files]
    layouts = [formatted(each.text, each.place) for each in files]
    changed = [
        (each, layout) for each, layout in zip(files, layouts, strict=True) if layout != each.text
    ]
    for each, layout in changed:
        sys.stdout.write(f"{each.path}{': not in the canonical layout' if args.check else ''}\n")
        if not args.check:
            each.replace(layout)
    return OUTSIDE_TOLERANCE if args.check and changed else DONE


def _piped(args: argparse.Namespace) -> int:
    """Standard input in the canonical layout, to standard output."""
    from adamslite.editing.layout import formatted
    from adamslite.errors import UsageError
    from adamslite.language.text import STDIN, decoded, piped_bytes

    if len(args.files) > 1:
        raise UsageError("fmt -: standard input is one deck; name no other file with it")
    given = decoded(piped_bytes()).replace("\r\n", "\n").replace("\r", "\n")
    layout = formatted(given, "deck")
    if not args.check:
        sys.stdout.write(layout)
    elif layout != given:
        sys.stdout.write(f"{STDIN}: not in the canonical layout\n")
        return OUTSIDE_TOLERANCE
    return DONE
