"""write a page that shows how it moves, and open it in the browser

SCENE is a deck, which is solved first as `adamslite solve` does, or a result file. A result file
that carries no deck (.csv) is drawn with the deck of --deck, else with the one beside it. The page
is one HTML file that needs nothing else: it goes to SCENE's name with .html in the current
directory and is opened, or to OUT. --glb writes an animated model in binary glTF instead.
"""

import argparse
import sys
from pathlib import Path
from typing import TYPE_CHECKING

from adamslite.cli.commands.codes import DONE, STOPPED_EARLY
from adamslite.run_flags import add_run_flags, add_user_flag, run_options

if TYPE_CHECKING:
    from adamslite.deck.deck import Deck
    from adamslite.results.results import Results

GLB = ".glb"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments of `adamslite view`."""
    parser.add_argument("scene", metavar="SCENE", type=Path, help="deck (.adm) or result file")
    parser.add_argument("commands", metavar="COMMANDS.acf", type=Path, nargs="?")
    parser.add_argument("--deck", metavar="DECK", type=Path, help="deck of the result file")
    parser.add_argument("-o", "--output", metavar="OUT", type=Path, help="page (.html) to write")
    parser.add_argument(
        "--against", metavar="RESULT", type=Path, help="other results, drawn beside these"
    )
    parser.add_argument("--glb", action="store_true", help="write an animated glTF (.glb) instead")
    parser.add_argument("--no-open", action="store_true", help="write the page only")
    add_user_flag(parser)
    add_run_flags(parser)


def run(args: argparse.Namespace) -> int:
    """Draw; return the exit code."""
    from adamslite.outputs.whole_files import need_writable
    from adamslite.results.results import Results

    deck, results, read = _solved(args) if _is_deck(args) else _loaded(args)
    other = Results.load(args.against) if args.against else None
    output = _output(args)
    need_writable(output, [*read, *([args.against] if args.against else [])])
    _write(args, output, deck, results, other)
    sys.stderr.write(f"{output}\n")
    if not (args.output or args.no_open or _is_model(args)):
        _open(output)
    return DONE if results.outcome.is_requested else STOPPED_EARLY


def _is_model(args: argparse.Namespace) -> bool:
    """Whether a model is to be written, no page."""
    return args.glb or (args.output is not None and args.output.suffix.lower() == GLB)


def _output(args: argparse.Namespace) -> Path:
    from adamslite.errors import UsageError

    suffix = GLB if _is_model(args) else ".html"
    output: Path = args.output or Path(args.scene.stem + suffix)
    if output.suffix.lower() not in (suffix, *([".htm"] if suffix == ".html" else [])):
        raise UsageError(f"-o {output}: the name must end in {suffix}")
    return output


def _is_deck(args: argparse.Namespace) -> bool:
    """Whether the first argument is a deck: anything that no format of results claims."""
    from adamslite.errors import UsageError
    from adamslite.results.formats import formats

    suffix = args.scene.suffix.lower()
    if suffix not in formats():
        if args.deck:
            raise UsageError("--deck belongs to a result file, and this is a deck itself")
        return True
    if args.commands or run_options(args):
        raise UsageError(f"{args.scene} is a result file: there is nothing to solve")
    return False


def _solved(args: argparse.Namespace) -> tuple["Deck", "Results", list[Path]]:
    """A deck, its results, and the files that were read."""
    from adamslite.drawing.run_deck import at_start
    from adamslite.language.diagnostics import render
    from adamslite.progress import TalkingProgress
    from adamslite.scene import load_scene, run_scene

    scene = load_scene(args.scene, args.commands, args.user)
    if scene.warnings:
        sys.stderr.write(render(scene.warnings) + "\n\n")
    progress = TalkingProgress()
    try:
        results = run_scene(scene, run_options(args), progress)
    finally:
        progress.close()
    if not results.outcome.is_requested:
        sys.stderr.write(f"adamslite: {results.message or results.outcome.sentence}\n")
    return at_start(scene.deck, scene.commands), results, list(scene.read)


def _loaded(args: argparse.Namespace) -> tuple["Deck", "Results", list[Path]]:
    """The same of a result file."""
    import adamslite
    from adamslite.drawing.run_deck import beside, deck_of, difference, need_its_bodies
    from adamslite.errors import UsageError
    from adamslite.results.results import Results

    results = Results.load(args.scene)
    path = args.deck or (None if results.source else beside(args.scene, results))
    if path is None and results.source is None:
        raise UsageError(f"{args.scene} carries no deck, and none lies beside it; give --deck")
    deck = deck_of(results) if path is None else adamslite.read(path, args.user)
    need_its_bodies(deck, results, str(args.scene))
    if path and (warning := difference(deck, results)):
        sys.stderr.write(f"{path}: {warning}\n")
    return deck, results, [args.scene, *([path] if path else [])]


def _write(
    args: argparse.Namespace,
    output: Path,
    deck: "Deck",
    results: "Results",
    other: "Results | None",
) -> None:
    if _is_model(args):
        from adamslite.drawing.gltf.model import model
        from adamslite.outputs.whole_files import whole_file

        content = model(deck, results)
        with whole_file(output, binary=True) as stream:
            stream.write(content)
        return
    from adamslite.page.page import page, write_page

    write_page(page(results, deck, other, args.against.name if args.against else ""), output)


def _open(page: Path) -> None:
    from adamslite.page.browser import open_page

    if not open_page(page):
        sys.stderr.write(f"adamslite: no browser could be opened; open {page} yourself\n")
