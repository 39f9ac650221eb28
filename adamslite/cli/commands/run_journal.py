"""Where `adamslite solve` keeps a run that takes long, and what it says of one that can go on."""

import argparse
import os
import sys
from collections.abc import Mapping
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any

from adamslite.notation import STDOUT

if TYPE_CHECKING:
    from adamslite.analyses.dynamics.history import Journal
    from adamslite.outputs.part_file import PartFile
    from adamslite.results.results import Results
    from adamslite.scene import Scene

#: Outcomes of runs that can go on: the flag, and how it goes on with it.
LARGER = "goes on with it, where N is larger than before"
GOING_ON = {
    "INTERRUPTED": ("", "goes on with it"),
    "CPU_LIMIT": ("", "goes on with it, for as much CPU once more; or give another --cpu-limit"),
    "STEP_LIMIT": (" --max-steps N", LARGER),
    "CREEPING": (" --max-steps N", "goes on with it up to so many steps, however short"),
    "MEMORY_LIMIT": (" --memory-limit SIZE", "goes on with it in more memory"),
}


def resumed_part(args: argparse.Namespace) -> "PartFile | None":
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


def journal_of(
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


def close_journal(journal: "Journal", results: "Results") -> None:
    """The file of the run stays when it was interrupted, or has reached a limit, and can go on."""
    if journal.unkept:
        journal.close(keep=False)
    elif results.outcome.name in GOING_ON:
        keep_journal(journal, results.outcome.name)
    elif journal.interrupted and results.confirmation:  # in one of its witnesses
        keep_journal(journal)
    else:
        journal.close(keep=False)


def keep_journal(journal: "Journal", outcome: str = "INTERRUPTED") -> None:
    """Leave the file of the run, if it has one, and say how it goes on after that outcome."""
    flag, how = GOING_ON[outcome]
    journal.close(keep=True)
    if journal.part and not journal.unkept:
        command = f"adamslite solve --resume {journal.path}{flag}"
        sys.stderr.write(f"adamslite: `{command}` {how}\n")
