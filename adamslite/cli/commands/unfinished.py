"""Runs that did not end: what their file says of them, and going on with one."""

from __future__ import annotations

import argparse
import hashlib
import json
import os
import sys
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import adamslite
from adamslite.errors import FormatError, UsageError
from adamslite.outputs.drafts import SUFFIX
from adamslite.outputs.part_file import DAMAGED, PartFile, UnknownWriter
from adamslite.results.run_texts import NUMBERS
from adamslite.run_flags import run_options

if TYPE_CHECKING:
    from adamslite.scene import Scene

#: Arguments of `solve` that come from the file, with what they are when they are not given.
KEPT: Mapping[str, Any] = {"outputs": [], "page": None, "values": [], "user": []}
#: Those of the run itself, of which limits may be given anew.
LIMITS = ("cpu_limit", "max_steps", "memory_limit")
OPTIONS = (
    "end", "steps", "integrator", "formulation", "error", "hmax", "no_reduction", "audit",
    "confirm", *LIMITS,
)  # fmt: skip
#: What must be as it was, and what to say where it is not.
SAME = {
    "program": "it was begun by another version of adamslite, whose numbers may differ",
    "processor": "it was begun on another kind of processor, whose last digits may differ",
    "source": "deck, commands, tables or what RELOAD reads have changed since",
}

UNKNOWN = (
    "files of adamslite are newer, by the clock of this machine, than the process that began it or "
    "this one, so that its version is not known"
)


def facts_of(args: argparse.Namespace, scene: Scene, saved: Mapping[str, str]) -> Mapping[str, Any]:
    """What a run is of, and how it was requested; ``saved``: what it takes from RELOAD."""
    from adamslite.caching.program import program
    from adamslite.native import processor
    from adamslite.results.source import source_of

    source = source_of(scene.deck, scene.commands)
    texts = [source.deck, source.commands, list(source.user), source.table_texts(), saved]
    digest = hashlib.sha256(json.dumps(texts).encode(errors="surrogatepass")).hexdigest()
    return {
        "program": program(), "version": adamslite.__version__, "processor": processor.name(),
        "source": digest, "folder": os.getcwd(), "options": run_options(args),
        "deck": _kept_place(scene.deck_path, args),
        "commands": _kept_place(scene.commands_path, args),
        **{name: getattr(args, name) for name in KEPT},
        "page": args.page and _beside(Path(args.page), args),
    }  # fmt: skip


def _kept_place(path: Path | None, args: argparse.Namespace) -> list[str] | None:
    """A file as it was named, and as seen from the folder of the results."""
    if path is None:
        return None
    return [str(path), _beside(path, args)]


def _beside(path: Path, args: argparse.Namespace) -> str:
    """A file as seen from the folder of the results, which may be moved."""
    folder = os.path.dirname(os.path.abspath(args.output)) if args.output else os.getcwd()
    try:
        return os.path.relpath(path, folder)
    except ValueError:  # on another drive
        return os.path.abspath(path)


def _place(kept: Sequence[str] | None, folder: str, part: Path) -> Path | None:
    """Where a file is now: as it was named, or where it is beside the part, whose folder may have
    been moved.
    """
    if kept is None:
        return None
    named, beside = map(str, kept)
    here = Path(named)
    if os.path.abspath(folder) != os.getcwd():
        here = Path(folder) / named
    return here if here.exists() else part.parent / beside


def report(path: Path) -> None:
    """Say that a run of this name did not end.

    Raises
    ------
    UsageError
        When it is running, or the name is that of something else than a file.
    """
    if path.exists() and not path.is_file():
        raise UsageError(
            f"'{path}' is not a plain file, and the run would be kept there; remove it or give -o "
            "another name"
        )
    try:
        part = PartFile.open(path)
    except (FormatError, UnknownWriter, OSError) as fault:
        sys.stderr.write(f"adamslite: an earlier run has left {path} behind: {fault}\n")
        return
    reached = f"t = {float(part.state['time']):.6g} of {float(part.state['end']):g}"
    part.close()
    sys.stderr.write(
        f"adamslite: a run that did not end ({reached}) has left {path} behind: "
        f"`adamslite solve --resume {path}` goes on with it; if this run takes long, it moves it "
        f"to {path}.old\n"
    )


def resumed(args: argparse.Namespace) -> PartFile:
    """The file of the run to go on with, whose arguments are put into ``args``.

    Raises
    ------
    UsageError
        When other arguments are given with it.
    FormatError
        When it is damaged.
    """
    path: Path = args.resume
    name = path.name.removesuffix(".old")
    if not name.endswith(SUFFIX):
        raise UsageError(f"--resume {path}: the file of a run that did not end is OUT{SUFFIX}")
    limits = {name: each for name, each in run_options(args).items() if name in LIMITS}
    others = [*(name for name in run_options(args) if name not in limits), *_given(args)]
    given = [f"--{word.replace('_', '-')}" for word in others]
    if given or args.output:
        words = ", ".join([*given, *(["-o"] if args.output else [])])
        raise UsageError(f"--resume goes on with a run as it was requested; leave out {words}")
    part = PartFile.open(path, args.trust)
    try:
        facts = part.state["facts"]
        for option, value in {**_checked(facts["options"]), **limits, **_texts(facts)}.items():
            setattr(args, option, value)
        folder = str(facts["folder"])
        args.deck = args.deck or _place(facts["deck"], folder, path)
        args.commands = args.commands or _place(facts["commands"], folder, path)
        args.page = args.page and str(path.parent / args.page)
        args.output = str(path.with_name(name.removesuffix(SUFFIX)))
    except (KeyError, TypeError, ValueError, AttributeError) as fault:
        part.close()
        raise FormatError(DAMAGED.format(path=path, why=fault)) from None
    if not args.quiet:
        sys.stderr.write(f"going on at t = {float(part.state['time']):.6g}\n")
    return part


def _given(args: argparse.Namespace) -> list[str]:
    given = [name for name in KEPT if getattr(args, name) != KEPT[name]]
    return [{"values": "set"}.get(name, name) for name in given]


def _checked(options: Mapping[str, Any]) -> dict[str, Any]:
    """Options of a run; nothing else."""
    return {name: options[name] for name in OPTIONS if name in options}


def _texts(facts: Mapping[str, Any]) -> dict[str, Any]:
    lists = {name: [str(each) for each in facts[name]] for name in ("outputs", "values", "user")}
    lists["user"] = list(filter(NUMBERS.fullmatch, lists["user"]))  # it has no module loaded
    page = facts["page"]
    return {**lists, "page": None if page is None else str(page)}


def compare(part: PartFile, now: Mapping[str, Any]) -> None:
    """Raises UsageError when a run would not go on to the same numbers."""
    kept = part.state["facts"]
    known = all(facts.get("program") for facts in (kept, now))
    for name, sentence in SAME.items():
        if not known or kept.get(name) != now[name]:
            path = part.path
            part.close()
            raise UsageError(f"{path} cannot be resumed: {sentence if known else UNKNOWN}")
