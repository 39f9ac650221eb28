"""Results that a command is given: a file of results, or a deck, which is solved first."""

from __future__ import annotations

import argparse
import sys
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from adamslite.run_flags import add_run_flags, add_user_flag, run_options

if TYPE_CHECKING:
    from adamslite.results.results import Results

DECK = ".adm"


def add_results_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare RESULT, and the flags of a run for where it is a deck."""
    parser.add_argument("result", metavar="RESULT", type=Path, help="result file, or a deck (.adm)")
    parser.add_argument(
        "--deck", metavar="DECK", type=Path,
        help="deck of a result file that does not carry it; found by itself beside the file",
    )  # fmt: skip
    parser.add_argument(
        "--commands", metavar="COMMANDS.acf", type=Path, help="commands of RESULT, where a deck"
    )
    add_user_flag(parser)
    add_run_flags(parser)


def given_results(args: argparse.Namespace) -> tuple[Results, list[Path]]:
    """The results, and the files that were read for them.

    A deck is solved, and what there is to say about it goes to standard error.

    Raises
    ------
    FormatError
        When the file is neither.
    UsageError
        When flags do not belong to it.
    """
    return _solved(args) if _is_deck(args) else _loaded(args)


def _is_deck(args: argparse.Namespace) -> bool:
    from adamslite.errors import FormatError, UsageError
    from adamslite.results.formats import format_of

    if args.result.suffix.lower() != DECK:
        try:
            format_of(args.result, to_read=True)
        except FormatError as fault:
            raise FormatError(f"{fault}, and a deck ends in {DECK}") from None
        if args.commands or args.user or run_options(args):
            raise UsageError(f"{args.result} holds results: there is nothing to solve")
        return False
    if args.deck:
        raise UsageError(f"--deck belongs to a result file, and {args.result} is a deck itself")
    return True


def _solved(args: argparse.Namespace) -> tuple[Results, list[Path]]:
    from adamslite.language.diagnostics import render
    from adamslite.progress import TalkingProgress
    from adamslite.scene import load_scene, run_scene

    scene = load_scene(args.result, args.commands, args.user)
    if scene.warnings:
        sys.stderr.write(render(scene.warnings) + "\n\n")
    progress = TalkingProgress()
    try:
        results = run_scene(scene, run_options(args), progress)
    finally:
        progress.close()
    if not results.outcome.is_requested:
        sys.stderr.write(f"adamslite: {results.message or results.outcome.value}\n")
    return results, list(scene.read)


def _loaded(args: argparse.Namespace) -> tuple[Results, list[Path]]:
    import adamslite
    from adamslite.errors import FormatError
    from adamslite.results.results import Results
    from adamslite.results.source import source_of

    results = Results.load(args.result)
    if not len(results.time):
        raise FormatError(f"{args.result} holds no output time")
    deck = adamslite.read(args.deck) if args.deck else None
    if deck is not None and results.meta.get("deck hash", deck.hash) != deck.hash:
        sys.stderr.write(f"adamslite: {args.result} is the result of another deck than {args.deck}\n")
    if deck is None and results.source is None:
        deck = _deck_beside(args.result, results)
    if deck is None:
        return results, [args.result]
    read = [args.result, *([deck.path] if deck.path else [])]
    return replace(results, source=source_of(deck, ())), read


def _deck_beside(path: Path, results: Results):
    """The deck of results, by its text, beside their file or in the current folder."""
    import adamslite
    from adamslite.language.diagnostics import DeckError

    for candidate in dict.fromkeys((path.with_suffix(DECK), Path(f"{path.stem}{DECK}"))):
        try:
            deck = adamslite.read(candidate)
        except (OSError, DeckError, ValueError):
            continue
        if deck.hash == results.meta.get("deck hash"):
            return deck
    return None
