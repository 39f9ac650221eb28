"""Kinds of cases: how one is made from a random sequence, and how the program meets it.

A meeting returns a word for what became of the case. Whatever it raises is a fault of the program,
and so is exit code 70.
"""

from __future__ import annotations

import signal
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from random import Random

import adamslite
from adamslite.language.diagnostics import DeckError, Diagnostic
from adamslite.language.method import declared
from adamslite.reading.read import read_commands as read_command_file

from . import (
    byte_changes,
    command_lines,
    grammar,
    kept_files,
    lsp_messages,
    material,
    registered,
    swapped_expressions,
    text_changes,
)
from .calls import call
from .cases import Case

#: CPU after which a run is interrupted as by Ctrl-C [s].
PATIENCE = 2.0
DECK, COMMANDS, SPEC, OUTPUT = "deck.adm", "deck.acf", "scene.toml", "results.csv"


@dataclass(frozen=True)
class Kind:
    """``what`` it is; ``make`` makes the case of a seed and a number, always the same; ``meet``
    lets the program meet its files.
    """

    what: str
    make: Callable[[int, int], Case]
    meet: Callable[[Case, Path], str]
    sample: int
    """Cases among the tests."""


def at_random(make: Callable[[Random], Case]) -> Callable[[int, int], Case]:
    """Makes cases from a random sequence of their own."""

    def case(seed: int, number: int) -> Case:
        return make(Random(f"{seed} {number}"))

    return case


def encoded(text: str) -> bytes:
    """A text as a file; halves of surrogate pairs stay what they are."""
    return text.encode("utf-8", "surrogatepass")


def has_place(each: Diagnostic) -> bool:
    """Whether a message names a line, which that about messages that are left out does not."""
    return each.span.line >= 1 or each.code == "more-messages"


# ---- decks ---------------------------------------------------------------------------------------


@at_random
def changed_deck(random: Random) -> Case:
    """A deck of the project with some changes."""
    decks = material.decks()
    text = text_changes.changed(random, decks.any(random), decks.texts)
    return Case({DECK: _file(random, text)})


def _file(random: Random, text: str) -> bytes:
    """The text, now and then in another code or damaged."""
    form = random.random()
    if form < 0.02:
        return text.encode("utf-16", "surrogatepass")
    if form < 0.04:
        return text.encode("latin-1", "replace")
    return byte_changes.changed(random, encoded(text), 1) if form < 0.07 else encoded(text)


def read(case: Case, folder: Path) -> str:
    """A deck is read, and its messages are written."""
    case.put_into(folder)
    try:
        adamslite.read(folder / DECK)
    except DeckError as fault:
        assert str(fault) and all(map(has_place, fault.errors))
        return "errors"
    return "read"


def check(case: Case, folder: Path) -> str:
    """`adamslite check` with the command file beside the deck."""
    case.put_into(folder)
    return call("check", str(folder / DECK))


def grammatical(seed: int, number: int) -> Case:
    """A deck from the grammar."""
    return Case({DECK: encoded(grammar.drawn(seed, number))})


@at_random
def changed_commands(random: Random) -> Case:
    """A deck with a command file that is changed."""
    deck, commands = random.choice(material.commanded())
    text = text_changes.changed(random, commands, material.command_files().texts)
    files = {DECK: encoded(deck), COMMANDS: _file(random, text)}
    return Case(files, ("check",) if random.random() < 0.05 else ())


def read_commands(case: Case, folder: Path) -> str:
    """A command file is read for its deck; some are checked by the command."""
    case.put_into(folder)
    if case.arguments:
        return call("check", str(folder / DECK))
    try:
        read_command_file(folder / COMMANDS, _deck(case.files[DECK]))
    except DeckError as fault:
        assert str(fault) and all(map(has_place, fault.errors))
        return "errors"
    return "read"


@lru_cache(100)
def _deck(data: bytes) -> adamslite.Deck:
    return adamslite.read(data.decode())


def fmt(case: Case, folder: Path) -> str:
    """`adamslite fmt`"""
    case.put_into(folder)
    return call("fmt", str(folder / DECK))


@at_random
def registered_statements(random: Random) -> Case:
    """A deck of any registered statements, and now and then any commands."""
    files = {DECK: encoded(registered.deck(random))}
    if random.random() < 0.4:
        files[COMMANDS] = encoded(registered.commands(random))
    return Case(files)


@at_random
def swapped(random: Random) -> Case:
    """Functions of each other in all places; some are solved."""
    deck = encoded(swapped_expressions.deck(random))
    return Case({DECK: deck}, _flags(random) if random.random() < 0.15 else ())


def check_or_solve(case: Case, folder: Path) -> str:
    """A deck is checked, or solved where flags are given."""
    return solve(case, folder) if case.arguments else check(case, folder)


# ---- descriptions --------------------------------------------------------------------------------


@at_random
def changed_description(random: Random) -> Case:
    """A description of a cable scene with some changes."""
    known = material.descriptions()
    text = text_changes.changed(random, known.any(random), known.texts)
    return Case({SPEC: _file(random, text)}, ("deck",) if random.random() < 0.05 else ())


def cable(case: Case, folder: Path) -> str:
    """A description is read; the deck is written for some."""
    from adamslite.cables.deck.scene import setting
    from adamslite.cables.description.spec import read_scene

    case.put_into(folder)
    if case.arguments:
        return call("cable", str(folder / SPEC), "--no-trial", "-o", str(folder / DECK))
    try:
        text = case.files[SPEC].decode("utf-8-sig")
    except UnicodeDecodeError:
        return call("cable", str(folder / SPEC))
    try:
        given = read_scene(text, SPEC)
        if not given.is_several:
            setting(text, SPEC)
    except DeckError as fault:
        assert str(fault)
        return "errors"
    return "read"


# ---- results -------------------------------------------------------------------------------------


def changed_results(suffix: str) -> Callable[[int, int], Case]:
    """Makes two files of results, of which one is changed, and how they are compared."""

    @at_random
    def make(random: Random) -> Case:
        plain, other = (random.choice(material.result_files(suffix)) for _ in "ab")
        if suffix in (".csv", ".req", ".res") and random.random() < 0.7:
            text = text_changes.changed(random, other.decode(), [plain.decode()])
            new = encoded(text)
        else:
            new = byte_changes.changed(random, other)
        files = {f"a{suffix}": new, f"b{suffix}": other}
        names = sorted(files, reverse=random.random() < 0.5)
        flags = random.choice([(), (), ("--interpolate", "linear"), ("--interpolate", "cubic")])
        if random.random() < 0.2:
            flags += ("--tol", text_changes.changed(random, "abs 1e-6 rel 1E-3 digits 6", ["1"]))
        return Case(files, (*names, *flags))

    return make


def diff(case: Case, folder: Path) -> str:
    """`adamslite diff`"""
    case.put_into(folder)
    names = (str(folder / each) for each in case.arguments[:2])
    flags = case.arguments[2:]
    joined = (f"--tol={flags[-1]}",) if "--tol" in flags else ()
    return call("diff", *names, *flags[: -2 if joined else None], *joined)


# ---- runs ----------------------------------------------------------------------------------------


@at_random
def changed_run(random: Random) -> Case:
    """A deck with few changes, most of them of numbers, and how it is run."""
    decks = material.decks()
    text = decks.any(random)
    for _ in range(random.randint(1, 2)):
        change = random.choice(
            text_changes.NUMERIC if random.random() < 0.95 else text_changes.CHANGES
        )
        text = change(random, text, decks.texts)
    return Case({DECK: encoded(text)}, _flags(random))


@at_random
def registered_run(random: Random) -> Case:
    """A deck of any registered statements, and how it is run: by any commands, or without."""
    files = {DECK: encoded(registered.deck(random))}
    if random.random() < 0.5:
        files[COMMANDS] = encoded(registered.commands(random))
        return Case(files, ("--cpu-limit", "0.5"))
    return Case(files, _flags(random))


def _flags(random: Random) -> tuple[str, ...]:
    """Some output steps with any method."""
    method = random.choice(declared())
    flags = ["--integrator", method.name, "--steps", random.choice(["1", "3", "20"])]
    if random.random() < 0.9:
        flags += ["--end", random.choice(["1e-9", "0.01", "0.1", "1", "1e6"])]
    if random.random() < 0.3:
        flags += ["--error", random.choice(["1e-300", "1e-10", "1e-3", "1", "1e300"])]
    if random.random() < 0.2:
        flags += ["--hmax", random.choice(["1e-300", "1e-6", "0.01", "1e300"])]
    flags += ["--cpu-limit", "0.5"] if random.random() < 0.5 else []
    flags += ["--audit"] if random.random() < 0.1 else []
    flags += ["--page"] if random.random() < 0.05 else []
    return tuple(flags)


def solve(case: Case, folder: Path) -> str:
    """`adamslite solve`, interrupted as by Ctrl-C after some CPU."""
    case.put_into(folder)
    signal.signal(signal.SIGPROF, signal.default_int_handler)
    signal.setitimer(signal.ITIMER_PROF, PATIENCE)
    try:
        word = call("solve", str(folder / DECK), "-o", str(folder / OUTPUT), *case.arguments)
    except KeyboardInterrupt:  # where no run is under way
        return "interrupted"
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0.0)
    assert (folder / OUTPUT).exists() == (word in ("done", "stopped")) or word == "stopped"
    return word


KINDS: Mapping[str, Kind] = {
    "read": Kind("decks are read", changed_deck, read, 3000),
    "check": Kind("decks are checked by the command", changed_deck, check, 300),
    "grammar": Kind("decks drawn from the grammar", grammatical, read, 400),
    "registered": Kind(
        "decks of all registered statements, functions and commands",
        registered_statements,
        check,
        150,
    ),
    "swapped": Kind("functions of each other, of constants and TIME", swapped, check_or_solve, 60),
    "commands": Kind("command files are read", changed_commands, read_commands, 800),
    "fmt": Kind("decks are laid out", changed_deck, fmt, 200),
    "cables": Kind("decks of cables are checked", at_random(kept_files.cabled), check, 30),
    "toml": Kind("descriptions of cable scenes", changed_description, cable, 800),
    **{
        each: Kind(f"files .{each} are read and compared", changed_results(f".{each}"), diff, 600)
        for each in ("csv", "nc", "res", "req", "parquet", "mat")
    },
    "part": Kind("unfinished runs are resumed", at_random(kept_files.part), kept_files.resume, 200),
    "save": Kind(
        "saved states are gone on from", at_random(kept_files.save), kept_files.reload, 100
    ),
    "store": Kind("files of sweeps are loaded", at_random(kept_files.store), kept_files.load, 300),
    "words": Kind("command lines", at_random(command_lines.line), command_lines.typed, 150),
    "fit": Kind("measurements to fit to", at_random(kept_files.measurement), kept_files.fit, 300),
    "lsp": Kind("sessions of an editor", at_random(lsp_messages.session), lsp_messages.serve, 100),
    "solve": Kind("short runs with every method", changed_run, solve, 60),
    "any": Kind("short runs of all registered statements and commands", registered_run, solve, 40),
}
