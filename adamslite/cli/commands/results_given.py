"""Results that a command is given: a file of results, or a deck, which is solved first."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path
from typing import TYPE_CHECKING

from adamslite.run_flags import (
    add_folder_flag,
    add_run_flags,
    add_user_flag,
    add_values_flag,
    run_options,
)

if TYPE_CHECKING:
    from adamslite.deck.deck import Deck
    from adamslite.results.results import Results
    from adamslite.scene import Scene

DECK = ".adm"
#: Comments of results on how far they can be trusted.
DOUBTS = ("accuracy", "energy", "out of its law")


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
    add_folder_flag(parser)
    add_values_flag(parser)
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
        if args.commands or args.user or args.values or run_options(args):
            raise UsageError(f"{args.result} holds results: there is nothing to solve")
        return False
    if args.deck:
        raise UsageError(f"--deck belongs to a result file, and {args.result} is a deck itself")
    return True


def _solved(args: argparse.Namespace) -> tuple[Results, list[Path]]:
    from adamslite.scene import load_scene

    scene = load_scene(args.result, args.commands, args.user, args.values)
    return run_and_report(scene, args), list(scene.read)


def run_and_report(scene: Scene, args: argparse.Namespace) -> Results:
    """Solve a scene, by the flags of a run; what there is to say goes to standard error."""
    from adamslite.language.diagnostics import render
    from adamslite.progress import TalkingProgress
    from adamslite.scene import run_scene

    if scene.warnings:
        sys.stderr.write(render(scene.warnings) + "\n\n")
    progress = TalkingProgress()
    try:
        results = run_scene(scene, run_options(args), progress)
    finally:
        progress.close()
    for key in DOUBTS:
        if key in results.meta:
            sys.stderr.write(f"{key}: {results.meta[key]}\n")
    if results.confirmation:
        sys.stderr.write(f"{results.confirmation.verdict}\n")
    if not results.outcome.is_requested:
        sys.stderr.write(f"adamslite: {results.message or results.outcome.sentence}\n")
    return results


def _loaded(args: argparse.Namespace) -> tuple[Results, list[Path]]:
    from dataclasses import replace

    import adamslite
    from adamslite.drawing.run_deck import difference
    from adamslite.errors import FormatError
    from adamslite.results.results import Results
    from adamslite.results.source import source_of

    results = Results.load(args.result)
    if not len(results.time):
        raise FormatError(f"{args.result} holds no output time")
    path = args.deck or (None if results.source else _deck_beside(args.result, results))
    if path is None:
        return in_own_terms(results, None), [args.result]
    deck = adamslite.read(path)
    results = in_own_terms(results, deck)
    if warning := difference(deck, results):
        sys.stderr.write(f"{path}: {warning}\n")
    return replace(results, source=source_of(deck, ())), [args.result, path]


def in_own_terms(results: Results, deck: Deck | None) -> Results:
    """Those of ADAMS in the terms of this program."""
    from adamslite.results.common_terms import of_deck

    results, notes = of_deck(results, deck)
    for note in notes:
        sys.stderr.write(f"adamslite: {note}\n")
    return results


def _deck_beside(path: Path, results: Results) -> Path | None:
    """The deck that has the very text of these results, beside them or in the current folder."""
    from adamslite.drawing.run_deck import HASH, beside, hash_of

    found = beside(path, results)
    return found if found and hash_of(found) == results.meta.get(HASH) else None
