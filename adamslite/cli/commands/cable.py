"""write the deck of a cable scene from a short description

SPEC.toml says what the cable is, where it goes and how good the answer has to be; the deck is
written as plain statements that can be edited. docs/reference/cable-command.md
has every key. Exit code 3 when the description has mistakes; warnings alone do not count.
"""

import argparse
import sys
from pathlib import Path

from adamslite.cli.commands.codes import DONE


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments of `adamslite cable`."""
    parser.add_argument("spec", metavar="SPEC.toml", type=Path, help="description of the scene")
    parser.add_argument(
        "-o", "--output", metavar="DECK.adm", help="deck to write; without it, standard output"
    )


def run(args: argparse.Namespace) -> int:
    """Write the deck; return the exit code."""
    from adamslite.cables.scene import deck
    from adamslite.errors import FormatError
    from adamslite.language.diagnostics import render
    from adamslite.outputs.whole_files import need_writable, whole_file

    if args.output:
        need_writable(args.output, [args.spec])
    try:
        text = args.spec.read_text(encoding="utf-8-sig")
    except UnicodeDecodeError as fault:
        raise FormatError(f"{args.spec} is not UTF-8 text: {fault.reason}") from None
    written, warnings = deck(text, str(args.spec))
    if warnings:
        sys.stderr.write(render(warnings) + "\n\n")
    if args.output:
        with whole_file(Path(args.output)) as stream:
            stream.write(written)
    else:
        sys.stdout.write(written)
    return DONE
