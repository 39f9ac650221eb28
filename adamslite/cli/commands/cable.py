"""write the deck of a cable scene from a short description

SPEC.toml says what the cable is, where it goes and how good the answer has to be; the deck is
written as plain statements that can be edited. What is not asked for by name is chosen: a linear
model proposes, and runs of some models show which of them is the cheapest that is good enough.
`-` is a description from standard input. docs/reference/cable-command.md has every key. Exit code 3
when the description has mistakes; warnings alone do not count.
"""

import argparse
import sys
from pathlib import Path

from adamslite.cli.commands.codes import DONE
from adamslite.notation import STDOUT
from adamslite.run_flags import instant


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments of `adamslite cable`."""
    parser.add_argument("spec", metavar="SPEC.toml", type=Path, help="description of the scene")
    parser.add_argument(
        "-o", "--output", metavar="DECK.adm",
        help="deck to write; without it, or with -, standard output",
    )  # fmt: skip
    trial = parser.add_mutually_exclusive_group()
    trial.add_argument(
        "--trial", type=instant, metavar="S",
        help="what runs that try models may cost, in seconds of a usual machine: steps are counted,"
        " so that the deck is the same on every machine (10, or trial in [model])",
    )  # fmt: skip
    trial.add_argument(
        "--no-trial", action="store_const", const=0.0, dest="trial",
        help="run nothing: the linear model chooses",
    )  # fmt: skip


def run(args: argparse.Namespace) -> int:
    """Write the deck; return the exit code."""
    from adamslite.errors import FormatError
    from adamslite.language.diagnostics import render
    from adamslite.outputs.whole_files import need_writable, whole_file
    from adamslite.progress import SentenceProgress

    output = None if args.output == STDOUT else args.output
    if output:
        need_writable(output, [args.spec])
    # It takes a while to load.
    from adamslite.api.trials import described
    from adamslite.language.text import MOST, STDIN, contents, is_piped, piped_bytes

    name = STDIN if is_piped(args.spec) else str(args.spec)
    try:
        data = piped_bytes() if is_piped(args.spec) else contents(args.spec, MOST)
        text = data.decode("utf-8-sig").replace("\r\n", "\n")
    except UnicodeDecodeError as fault:
        raise FormatError(f"{name} is not UTF-8 text: {fault.reason}") from None
    found = described(text, name, args.trial, SentenceProgress())
    written, warnings = found.deck.text, found.deck.messages
    if warnings:
        sys.stderr.write(render(warnings) + "\n\n")
    if summary := found.summary:
        sys.stderr.write(f"{name}: {summary}\n")
    if output:
        with whole_file(Path(output)) as stream:
            stream.write(written)
    else:
        sys.stdout.write(written)
    return DONE
