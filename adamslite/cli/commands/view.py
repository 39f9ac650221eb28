"""write a page that shows how it moves, and open it in the browser

SCENE is a deck, which is solved first as `adamslite solve` does, a result file, or the file of a
sweep. A result file
that carries no deck (.csv) is drawn with the deck of --deck, else with the one beside it. The page
is one HTML file that needs nothing else: it goes to SCENE's name with .html in the current
directory and is opened, or to OUT. --glb writes an animated model in binary glTF instead; --png
one picture, --gif and --mp4 a film, which an installed Chromium, Chrome or Edge draws (and FFmpeg
joins). So does a name of OUT that ends in .glb, .gif or .mp4.

Of the file of a sweep the page shows the run that sliders choose: runs are computed again from the
deck that the file carries.
"""

import argparse
import sys
from pathlib import Path
from typing import TYPE_CHECKING

from adamslite.cli.commands.codes import DONE, STOPPED_EARLY
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

PAGES = (".html", ".htm")
OTHERS = (".glb", ".png", ".gif", ".mp4")


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments of `adamslite view`."""
    parser.add_argument("scene", metavar="SCENE", type=Path, help="deck (.adm), result file, sweep")
    parser.add_argument("commands", metavar="COMMANDS.acf", type=Path, nargs="?")
    parser.add_argument("--deck", metavar="DECK", type=Path, help="deck of the result file")
    parser.add_argument("-o", "--output", metavar="OUT", type=Path, help="file to write")
    parser.add_argument(
        "--against", metavar="RESULT", type=Path, help="other results, drawn beside these"
    )
    kinds = parser.add_mutually_exclusive_group()
    kinds.add_argument("--glb", action="store_true", help="write an animated glTF (.glb) instead")
    kinds.add_argument(
        "--png", metavar="T", type=float, help="write a picture of this time instead"
    )
    kinds.add_argument("--gif", action="store_true", help="write a film of pictures instead")
    kinds.add_argument("--mp4", action="store_true", help="write a film in MPEG-4 instead")
    parser.add_argument(
        "--size", metavar="WxH", type=_size, help="of pictures, in pixels (default: 1280x720)"
    )
    parser.add_argument(
        "--along", choices=("x", "y", "z", "iso"), help="where pictures look from (default: front)"
    )
    parser.add_argument("--dark", action="store_true", help="pictures on a dark ground")
    parser.add_argument("--no-open", action="store_true", help="write the page only")
    sweep = parser.add_argument_group("of a sweep")
    sweep.add_argument(
        "--runs", metavar="RUNS", help="these runs alone: 0,5,7, or FROM:TO, or FROM:TO:STEP"
    )
    sweep.add_argument(
        "--channels", metavar="PATTERN", nargs="+", default=[],
        help="plot these columns alone: 'REQUEST/*'; all where they have room",
    )  # fmt: skip
    add_user_flag(parser)
    add_folder_flag(parser)
    add_values_flag(parser)
    add_run_flags(parser)


def run(args: argparse.Namespace) -> int:
    """Draw; return the exit code."""
    from adamslite.errors import UsageError
    from adamslite.outputs.whole_files import need_writable
    from adamslite.results.results import Results
    from adamslite.sweeps.recognition import holds_sweep

    kind = _kind(args)
    output = _output(args, kind)
    _need_programs(args, kind)
    if holds_sweep(args.scene):
        return _sweep(args, kind, output)
    if args.runs or args.channels:
        raise UsageError("--runs and --channels belong to the file of a sweep")
    other = Results.load(args.against) if args.against else None
    need_writable(output, [each for each in (args.scene, args.against, args.deck) if each])
    deck, results, code = _solved(args, output) if _is_deck(args) else _loaded(args, output)
    _write(args, output, deck, results, other)
    sys.stderr.write(f"{output}\n")
    if kind in PAGES and not (args.output or args.no_open):
        _open(output)
    return code


def _size(text: str) -> tuple[int, int]:
    """Width and height, both even: a film in MPEG-4 has no others."""
    width, _, height = text.partition("x")
    try:
        sides = int(width), int(height)
    except ValueError:
        raise argparse.ArgumentTypeError(f"{text} is not like 1280x720") from None
    if not all(100 <= side <= 8000 and side % 2 == 0 for side in sides):
        raise argparse.ArgumentTypeError(f"{text}: sides are even and from 100 to 8000")
    return sides


def _kind(args: argparse.Namespace) -> str:
    """The suffix of what is to be written: by a flag, by the name of OUT, or a page."""
    from adamslite.errors import UsageError

    flags = {".glb": args.glb, ".png": args.png is not None, ".gif": args.gif, ".mp4": args.mp4}
    suffix: str = args.output.suffix.lower() if args.output else ""
    kind = next((each for each, given in flags.items() if given), "")
    if suffix == ".png" and not kind:
        raise UsageError(f"-o {args.output}: a picture is of one time; give it with --png T")
    return kind or (suffix if suffix in OTHERS else ".html")


def _output(args: argparse.Namespace, kind: str) -> Path:
    from adamslite.errors import UsageError

    output: Path = args.output or Path(args.scene.stem + kind)
    if output.suffix.lower() not in (PAGES if kind in PAGES else (kind,)):
        raise UsageError(f"-o {output}: the name must end in {kind}")
    return output


def _need_programs(args: argparse.Namespace, kind: str) -> None:
    """Fail before solving when nothing can draw a picture."""
    from adamslite.errors import UsageError
    from adamslite.page.pictures import FILMS, need_browser, need_encoder

    if kind in (*FILMS, ".png"):
        need_browser()
    elif args.size or args.along or args.dark:
        raise UsageError("--size, --along and --dark belong to --png, --gif and --mp4")
    if kind in FILMS:
        need_encoder()
    if kind == ".glb" and args.against:
        raise UsageError("--against belongs to pages and pictures: a model shows one result")


def _is_deck(args: argparse.Namespace) -> bool:
    """Whether the first argument is a deck: anything that no format of results claims."""
    from adamslite.errors import UsageError
    from adamslite.results.formats import formats

    suffix = args.scene.suffix.lower()
    if suffix not in formats():
        if args.deck:
            raise UsageError("--deck belongs to a result file, and this is a deck itself")
        return True
    if args.commands or args.values or run_options(args):
        raise UsageError(f"{args.scene} is a result file: there is nothing to solve")
    return False


def _solved(args: argparse.Namespace, output: Path) -> tuple["Deck", "Results", int]:
    """A deck, its results, and the exit code."""
    from adamslite.cli.commands.results_given import run_and_report
    from adamslite.drawing.run_deck import at_start
    from adamslite.outputs.whole_files import need_writable
    from adamslite.scene import load_scene

    scene = load_scene(args.scene, args.commands, args.user, args.values)
    need_writable(output, scene.read)
    results = run_and_report(scene, args)
    code = DONE if results.outcome.is_requested else STOPPED_EARLY
    return at_start(scene.deck, scene.commands), results, code


def _loaded(args: argparse.Namespace, output: Path) -> tuple["Deck", "Results", int]:
    """The same of a result file."""
    import adamslite
    from adamslite.cli.commands.results_given import in_own_terms
    from adamslite.drawing.run_deck import beside, deck_of, difference, need_its_bodies
    from adamslite.errors import UsageError
    from adamslite.outputs.whole_files import need_writable
    from adamslite.results.results import Results

    results = Results.load(args.scene)
    path = args.deck or (None if results.source else beside(args.scene, results))
    if path is None and results.source is None:
        raise UsageError(f"{args.scene} carries no deck, and none lies beside it; give --deck")
    need_writable(output, [path] if path else [])
    deck = deck_of(results) if path is None else adamslite.read(path, args.user)
    results = in_own_terms(results, deck)
    need_its_bodies(deck, results, str(args.scene))
    if path and (warning := difference(deck, results)):
        sys.stderr.write(f"{path}: {warning}\n")
    return deck, results, DONE


def _write(
    args: argparse.Namespace,
    output: Path,
    deck: "Deck",
    results: "Results",
    other: "Results | None",
) -> None:
    from adamslite.cli.commands.results_given import in_own_terms
    from adamslite.page.pictures import SIZE
    from adamslite.page.showing import Look, write_motion

    if other is not None:
        other = in_own_terms(other, deck)
    asked = {
        "theme": "dark" if args.dark else "light",
        **({"view": args.along} if args.along else {}),
    }
    look = Look(args.png, args.size or SIZE, asked)
    write_motion(output, deck, results, other, args.against.name if args.against else "", look)


def _sweep(args: argparse.Namespace, kind: str, output: Path) -> int:
    """The page of the runs of a sweep."""
    import adamslite
    from adamslite.errors import UsageError
    from adamslite.outputs.whole_files import need_writable
    from adamslite.page.page import write_page
    from adamslite.progress import TalkingProgress
    from adamslite.sweeps.motions import bound_deck, numbers_of_runs, page_of_sweep
    from adamslite.sweeps.netcdf import read

    if args.commands or args.values or args.against or run_options(args):
        raise UsageError(f"{args.scene} holds a sweep: its runs are carried out as they were")
    if kind not in PAGES:
        raise UsageError(
            f"'{output}': a sweep is shown by a page; solve a deck with --set for one of its runs"
        )
    need_writable(output, [each for each in (args.scene, args.deck) if each])
    found = read(args.scene)
    numbers = numbers_of_runs(args.runs, len(found)) if args.runs else None
    deck = bound_deck(found, args.user) if args.user else None
    if args.deck:
        deck = adamslite.read(args.deck, args.user)
    progress = TalkingProgress()
    try:
        page, different = page_of_sweep(found, deck, numbers, args.channels, progress)
    finally:
        progress.close()
    if different:
        sys.stderr.write(f"adamslite: {different}\n")
    write_page(page, output)
    sys.stderr.write(f"{output}\n")
    if not (args.output or args.no_open):
        _open(output)
    return STOPPED_EARLY if found.failed or found.ahead else DONE


def _open(page: Path) -> None:
    from adamslite.page.showing import open_page

    if not open_page(page):
        sys.stderr.write(f"adamslite: no browser could be opened; open {page} yourself\n")
