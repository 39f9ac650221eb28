"""run a deck and write the results

How long to run: --end, else SIMULATE in COMMANDS.acf, else in the .acf of the deck's name beside
the deck, else in the deck itself. The results go to DECK's name with .csv in the current directory,
or to the output prefix that COMMANDS.acf names, or to OUT, in the format of its suffix (`adamslite
help formats` lists them); `-o -` writes a table to standard output. What a run of more than some
seconds has so far is in OUT.part: --resume goes on from there. Beside the results LINEAR/EIGENSOL
writes OUT.modes.csv, with COORDS and KENERGY OUT.shapes.csv and OUT.kinetic.csv, LINEAR/STATEMAT
its FILE or OUT.states.json (matrices A, B, C, D), SAVE its FILE; --page an HTML file that shows how
it moves. All the command says goes to standard error. DECK may be `-`, standard input: its results
are called stdin.csv, and it reads tables from the current directory and below.
"""

import argparse
import sys
from collections.abc import Mapping, Sequence
from contextlib import closing, suppress
from math import prod
from pathlib import Path
from typing import TYPE_CHECKING

from adamslite.cli.commands.codes import DONE, OUTSIDE_TOLERANCE, STOPPED_EARLY
from adamslite.notation import STDOUT
from adamslite.run_flags import add_deck, add_run_flags, run_options

if TYPE_CHECKING:
    import numpy as np

    from adamslite.analyses.dynamics.history import Journal
    from adamslite.outputs.part_file import PartFile
    from adamslite.outputs.row_by_row import Growing
    from adamslite.results.results import Results
    from adamslite.scene import Scene

#: What a file beside the results is, and its path.
Written = tuple[str, Path]
LINEARISED, PAGE = "linearised model", "page"

#: Numbers of an interrupted run that a page is drawn of, and what is said where there are more.
MOST_DRAWN = 2**22
NOT_DRAWN = "the run was interrupted, and it takes long to draw so many rows"

#: What becomes of LINEAR commands then.
UNWRITTEN = "not written: it goes beside the results, and they went to no file"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments of `adamslite solve`."""
    add_deck(parser, required=False)
    parser.add_argument("-o", "--output", metavar="OUT", help="result file, or - for stdout")
    parser.add_argument(
        "--outputs", metavar="PATTERN", nargs="+", default=[],
        help="write these columns alone: 'REQUEST/*', 'PART/2.v?', PART/2; after DECK",
    )  # fmt: skip
    parser.add_argument(
        "--page", metavar="FILE", nargs="?", const="",
        help="write a page that shows how it moves, too: FILE.html, or that of OUT",
    )  # fmt: skip
    parser.add_argument(
        "--resume", metavar="OUT.part", type=Path,
        help="go on with a run that was ended, as it was requested; limits alone may be given anew",
    )  # fmt: skip
    parser.add_argument(
        "--trust", action="store_true",
        help="resume it although it was not written with this cache; it can run any code",
    )  # fmt: skip
    add_run_flags(parser)
    talk = parser.add_argument_group("talk")
    talk.add_argument(
        "--quiet", action="store_true", help="print nothing unless something is wrong"
    )
    talk.add_argument(
        "--summary",
        choices=("text", "json"),
        default="text",
        help="summary as text to standard error (default) or as JSON, notes included, to standard "
        "output",
    )


def run(args: argparse.Namespace) -> int:
    """Solve and write; return the exit code."""
    from adamslite.cli.commands.run_journal import keep_journal, resumed_part
    from adamslite.errors import OutOfMemory

    part, journal = resumed_part(args), None
    try:
        scene, output, files, page, journal = _prepared(args, part)
        return _solved(args, scene, output, files, page, journal)
    except (KeyboardInterrupt, OutOfMemory) as fault:
        if journal:
            full = isinstance(fault, OutOfMemory)
            keep_journal(journal, "MEMORY_LIMIT" if full else "INTERRUPTED")
        raise
    finally:
        for each in (part, journal and journal.part):
            with suppress(OSError):  # of a full disk, which has been reported
                if each:
                    each.close()


def _prepared(
    args: argparse.Namespace, part: "PartFile | None"
) -> "tuple[Scene, str, Sequence[Path], Path | None, Journal]":
    """What is solved, the files that will be written, the page, where the run is kept."""
    from adamslite.cli.commands.run_journal import journal_of
    from adamslite.errors import UsageError
    from adamslite.result_files import growing_files, plan
    from adamslite.results.formats import format_of
    from adamslite.scene import load_scene

    if args.output == STDOUT and args.summary == "json":
        raise UsageError(
            "'-o -' and '--summary json' both want standard output; give -o a file name"
        )
    scene = load_scene(args.deck, args.commands, args.user, args.values)
    output = args.output or f"{scene.stem}.csv"
    files = []
    if output != STDOUT:
        files = plan(scene, output, bool(args.output))
        format_of(output).require_library()
    page = _page(args, scene, output)
    if not args.quiet:
        _tell_warnings(scene)
    journal = journal_of(args, scene, output, part)
    journal.drawn = page is not None
    if output != STDOUT:
        journal.growing = growing_files(scene, Path(output), args.outputs)
    return scene, output, files, page, journal


def _solved(
    args: argparse.Namespace,
    scene: "Scene",
    output: str,
    files: Sequence[Path],
    page: Path | None,
    journal: "Journal",
) -> int:
    """Solve and write what was planned; return the exit code."""
    from adamslite.cli.commands.run_journal import close_journal
    from adamslite.progress import Progress, TalkingProgress
    from adamslite.result_files import adams_files
    from adamslite.scene import run_scene

    progress, growing = Progress() if args.quiet else TalkingProgress(), journal.growing
    path = None if output == STDOUT else Path(output)
    try:
        with closing(progress):
            folder, chosen = path and path.parent, {"outputs": args.outputs} if args.outputs else {}
            options = {**run_options(args), **chosen}
            results = run_scene(scene, options, progress, folder, journal, path)
        written = _write(results, output, files, growing)
        if output != STDOUT:
            written += _write_adams(results, adams_files(scene, output), growing)
    finally:
        for each in growing.values():
            each.close()
    if page and _write_page(scene, results, page):
        written.insert(0, (PAGE, page))
    _summarize(scene, args, results, output, written)
    close_journal(journal, results)
    found = results.confirmation
    if not results.outcome.is_requested or (found and found.interrupted):
        return STOPPED_EARLY
    return DONE if found is None or found.confirmed else OUTSIDE_TOLERANCE


def _page(args: argparse.Namespace, scene: "Scene", output: str) -> Path | None:
    """The page to be written, if one is."""
    from adamslite.errors import UsageError
    from adamslite.outputs.whole_files import need_writable, same_file

    if args.page is None:
        return None
    beside = Path(f"{scene.stem}.html" if output == STDOUT else output).with_suffix(".html")
    page = Path(args.page) if args.page else beside
    if page.suffix.lower() not in (".html", ".htm"):
        raise UsageError(f"--page {page}: the name of a page ends in .html")
    need_writable(page, scene.read, bool(args.page))
    if output != STDOUT and same_file(page, output):
        raise UsageError(f"--page {page}: the results are written there")
    return page


def _write_page(scene: "Scene", results: "Results", path: Path) -> bool:
    """Write the page; not of a long run that was interrupted, which is to end at once."""
    from adamslite.drawing.run_deck import at_start
    from adamslite.page.page import page, write_page
    from adamslite.results.outcomes import Outcome

    if results.outcome is Outcome.INTERRUPTED and prod(results.shape) > MOST_DRAWN:
        sys.stderr.write(f"adamslite: {path} is not written: {NOT_DRAWN}\n")
        return False
    write_page(page(results, at_start(scene.deck, scene.commands)), path)
    return True


def _write_adams(
    results: "Results", paths: Sequence[Path], growing: "Mapping[Path, Growing]"
) -> list[Written]:
    """The files .req and .res that the deck requests."""
    from adamslite.errors import UsageError
    from adamslite.result_files import save

    written = []
    for path in paths:
        try:
            save(results, path, growing)
            written.append((f"{path.suffix.removeprefix('.')} of ADAMS", path))
        except UsageError as fault:  # --outputs has left out what it takes
            sys.stderr.write(f"adamslite: {fault}\n")
    return written


def _write(
    results: "Results", output: str, files: Sequence[Path], growing: "Mapping[Path, Growing]"
) -> list[Written]:
    """Write the time histories, and the files of LINEAR commands, whose names are returned."""
    from adamslite.result_files import save

    if output == STDOUT:
        from adamslite.outputs.csv import write_to

        write_to(results, sys.stdout)
        return []
    save(results, Path(output), growing)
    if not results.linearizations:
        return []
    from adamslite.outputs.modes import save_command

    found = zip(results.linearizations, files, strict=False)  # a run may stop before all
    written = (path for each, place in found for path in save_command(each, place))
    return [(LINEARISED, path) for path in written]


def _tell_warnings(scene: "Scene") -> None:
    from adamslite.language.diagnostics import render

    if scene.warnings:
        sys.stderr.write(render(scene.warnings) + "\n\n")


def _summarize(
    scene: "Scene",
    args: argparse.Namespace,
    results: "Results",
    output: str,
    files: list[Written],
) -> None:
    from adamslite.results.summary import UNDETERMINED, notes

    if args.summary == "json":
        drawn = {what: str(path) for what, path in files if what == PAGE}
        told = {**results.summary, **_files(scene, output), **drawn, "notes": dict(notes(results))}
        sys.stdout.write(_as_json(told) + "\n")
    elif args.quiet:
        off = results.meta.get("accuracy", "")
        sys.stderr.write(f"{scene.title}: {off}\n" if UNDETERMINED in off else "")
    else:
        _tell_summary(scene, results, output, files)
    _tell_trust(scene, args, results)
    if not results.outcome.is_requested:
        sys.stderr.write(f"adamslite: {results.message or results.outcome.sentence}\n")


def _tell_summary(scene: "Scene", results: "Results", output: str, files: list[Written]) -> None:
    from adamslite.results.summary import ending, figures, notes

    shown = "standard output" if output == STDOUT else output
    unwritten = [(LINEARISED, UNWRITTEN)] if results.linearizations and output == STDOUT else []
    beside = [*((what, str(path)) for what, path in files), *unwritten]
    rows = [*figures(results), ("results", shown), *beside, *notes(results)]
    lines = [f"{scene.title}: {ending(results)}", *(f"  {what:<20} {text}" for what, text in rows)]
    sys.stderr.write("".join(f"{line}\n" for line in lines))


def _tell_trust(scene: "Scene", args: argparse.Namespace, results: "Results") -> None:
    """What the run knows of its own errors; only what is wrong where nothing else is reported."""
    silent, found = args.quiet or args.summary == "json", results.confirmation
    if silent and any(not each.closes for each in results.balances):
        sys.stderr.write(f"{scene.title}: {results.meta['energy']}\n")
    if found is not None and not (silent and found.confirmed):
        sys.stderr.write("" if silent else f"{found.table()}\n")
        sys.stderr.write(f"{scene.title}: {found.verdict}\n")


def _files(scene: "Scene", output: str) -> dict[str, str | None]:
    """The files of a run: the deck, the commands it took from a file, the results."""
    commands = str(scene.commands_path) if scene.commands_path else None
    return {"deck": str(scene.deck_path), "commands": commands, "output": output}


def _as_json(summary: dict[str, object]) -> str:
    """JSON knows neither infinity nor not-a-number: both become null."""
    import json
    from math import isfinite

    plain = {
        key: None if isinstance(value, float) and not isfinite(value) else value
        for key, value in summary.items()
    }
    return json.dumps(plain, allow_nan=False, default=_plain_number)


def _plain_number(number: "np.generic") -> float:
    """A numpy number as one of Python."""
    return number.item()
