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
import os
import sys
from collections.abc import Mapping, Sequence
from contextlib import closing, suppress
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any

from adamslite.cli.commands.codes import DONE, OUTSIDE_TOLERANCE, STOPPED_EARLY
from adamslite.notation import STDOUT
from adamslite.run_flags import add_deck, add_run_flags, run_options

if TYPE_CHECKING:
    import numpy as np

    from adamslite.analyses.dynamics.history import Journal
    from adamslite.outputs.part_file import PartFile
    from adamslite.outputs.row_by_row import GrowingFile
    from adamslite.results.results import Results
    from adamslite.scene import Scene

#: What a file beside the results is, and its path.
Written = tuple[str, Path]
LINEARISED, PAGE = "linearised model", "page"

#: Outcomes of runs that can go on: the flag, and how it goes on with it.
LARGER = "goes on with it, where N is larger than before"
GOING_ON = {
    "INTERRUPTED": (),
    "CPU_LIMIT": ("", "goes on with it, for as much CPU once more; or give another --cpu-limit"),
    "STEP_LIMIT": (" --max-steps N", LARGER),
    "CREEPING": (" --max-steps N", "goes on with it up to so many steps, however short"),
    "MEMORY_LIMIT": (" --memory-limit SIZE", "goes on with it in more memory"),
}

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
        help="summary as text to standard error (default) or as JSON to standard output",
    )


def run(args: argparse.Namespace) -> int:
    """Solve and write; return the exit code."""
    from adamslite.errors import OutOfMemory

    part, journal = _resumed(args), None
    try:
        scene, output, files, page, journal = _prepared(args, part)
        return _solved(args, scene, output, files, page, journal)
    except (KeyboardInterrupt, OutOfMemory) as fault:
        if journal:
            _keep(journal, *(GOING_ON["MEMORY_LIMIT"] if isinstance(fault, OutOfMemory) else ()))
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
    journal = _journal(args, scene, output, part)
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
    if page:
        _write_page(scene, results, page)
        written.insert(0, (PAGE, page))
    _summarize(scene, args, results, output, written)
    _close(journal, results)
    found = results.confirmation
    if not results.outcome.is_requested or (found and found.interrupted):
        return STOPPED_EARLY
    return DONE if found is None or found.confirmed else OUTSIDE_TOLERANCE


def _resumed(args: argparse.Namespace) -> "PartFile | None":
    """The file of the run to go on with, whose arguments are put into `args`."""
    from adamslite.errors import UsageError
    from adamslite.language.text import is_piped

    if args.resume is None and args.deck is None:
        raise UsageError("give the name of a deck, or --resume OUT.part")
    if args.resume is None:
        if args.trust:
            raise UsageError("--trust goes with --resume OUT.part")
        return None
    if args.deck is not None and is_piped(args.deck):
        raise UsageError(
            "--resume reads the deck where the run had it; leave out '-', standard input"
        )
    from adamslite.cli.commands.unfinished import resumed

    return resumed(args)


def _journal(
    args: argparse.Namespace, scene: "Scene", output: str, found: "PartFile | None"
) -> "Journal":
    """Where the run is kept when it takes long."""
    from adamslite.analyses.dynamics.history import Journal
    from adamslite.errors import UsageError

    part = args.resume or Path(f"{output}.part")
    unkept = _unkept(scene, output, part)
    if unkept:
        if found:
            raise UsageError(f"{part} cannot be resumed: {unkept.unkept}")
        return unkept
    if os.path.lexists(part) and not found:
        from adamslite.cli.commands.unfinished import report

        report(part)

    saved = _reloaded(scene, output)

    @cache  # files may change while the run lasts
    def facts() -> Mapping[str, Any]:
        from adamslite.cli.commands.unfinished import facts_of

        return facts_of(args, scene, saved)

    if found:
        from adamslite.cli.commands.unfinished import compare

        compare(found, facts())
    return Journal(part, facts, found)


def _reloaded(scene: "Scene", output: str) -> Mapping[str, str]:
    """Digests of the files that RELOAD will read."""
    if not any(each.keyword == "RELOAD" for each in scene.commands):
        return {}
    from adamslite.command_files import reloaded

    return reloaded(scene, Path(output))


def _unkept(scene: "Scene", output: str, part: Path) -> "Journal | None":
    """What becomes of the rows of a run that cannot be resumed."""
    from adamslite.analyses.dynamics.history import Unkept
    from adamslite.language.text import STDIN
    from adamslite.outputs.whole_files import same_file

    written = Path(output)
    if str(scene.deck_path) == STDIN:
        return Unkept("its deck could not be read again", None)
    if output == STDOUT:
        return Unkept("its results go to standard output", None)
    if written.exists() and not written.is_file():
        return Unkept(f"{output} is no plain file", None)
    if scene.deck.user.calls_python:
        return Unkept("its routines of Python may remember anything", written.parent)
    if any(same_file(part, each) for each in scene.read):
        return Unkept(f"{part} is read", written.parent)
    return None


def _close(journal: "Journal", results: "Results") -> None:
    """The file of the run stays when it was interrupted, or has reached a limit, and can go on."""
    if journal.unkept:
        journal.close(keep=False)
    elif results.outcome.name in GOING_ON:
        _keep(journal, *GOING_ON[results.outcome.name])
    elif journal.interrupted and results.confirmation:  # in one of its witnesses
        _keep(journal)
    else:
        journal.close(keep=False)


def _keep(journal: "Journal", flag: str = "", how: str = "goes on with it") -> None:
    """Leave the file of the run, if it has one, and say so."""
    journal.close(keep=True)
    if journal.part and not journal.unkept:
        command = f"adamslite solve --resume {journal.path}{flag}"
        sys.stderr.write(f"adamslite: `{command}` {how}\n")


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


def _write_page(scene: "Scene", results: "Results", path: Path) -> None:
    from adamslite.drawing.run_deck import at_start
    from adamslite.page.page import page, write_page

    write_page(page(results, at_start(scene.deck, scene.commands)), path)


def _write_adams(
    results: "Results", paths: Sequence[Path], growing: "Mapping[Path, GrowingFile]"
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
    results: "Results", output: str, files: Sequence[Path], growing: "Mapping[Path, GrowingFile]"
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
    if args.summary == "json":
        drawn = {what: str(path) for what, path in files if what == PAGE}
        sys.stdout.write(_as_json({**results.summary, **_files(scene, output), **drawn}) + "\n")
    elif not args.quiet:
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
