"""What a caller names: a deck as a path, a text or an object, and the commands of its run."""

from __future__ import annotations

import os
import warnings
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple, TypeAlias

from adamslite.deck.commands import Commands
from adamslite.deck.deck import Deck
from adamslite.deck.redefinition import Command, Redefinition
from adamslite.deck.user_bindings import Given
from adamslite.errors import DeckWarning, UsageError
from adamslite.kept_scene import command_file_beside
from adamslite.language.diagnostics import WARNING, Diagnostic
from adamslite.language.statement import STATEMENTS, Statement
from adamslite.scene import read_together

if TYPE_CHECKING:  # numpy is not needed to check a deck
    from adamslite.analyses.setup.subject import Subject

CommandSource: TypeAlias = str | os.PathLike[str] | Iterable[str] | Iterable[Command] | None
"""A command file, the text of one, its statements, or None: the file beside the deck."""
Values: TypeAlias = Mapping[str, float] | Iterable[str]
User: TypeAlias = Mapping[str, Given] | Iterable[str] | None
FRAMES = 4
"""From :func:`_warn` up to the line of the caller of a public function."""


class Inputs(NamedTuple):
    """A deck or what was made from it, the commands of its run, and the messages about both."""

    subject: Subject
    commands: Sequence[Command]
    messages: tuple[Diagnostic, ...] = ()


class ReadInputs(NamedTuple):
    """The same as read from files or texts; ``beside``: a command file that nobody has named."""

    deck: Deck
    commands: Sequence[Command]
    messages: tuple[Diagnostic, ...] = ()
    beside: Path | None = None


def inputs(
    scene: Subject | str | os.PathLike[str], commands: CommandSource, user: User = None
) -> Inputs:
    """Read what has to be read; warnings of check about it are warnings of Python.

    Raises
    ------
    DeckError
        With everything that is wrong in deck and commands.
    UsageError
        When ``user`` is given for a deck that has been read.
    """
    if isinstance(scene, str | os.PathLike):
        found = Inputs(*read_inputs(scene, commands, user)[:3])
    else:
        need_subject(scene)
        if user is not None:
            raise UsageError(
                "user= is for reading: give it to adamslite.read, which made this deck"
            )
        found = with_commands(scene, commands)
    _warn(found.messages)
    return found


def given_options(**flags: object) -> dict[str, Any]:
    """The flags of a run that are given, as keyword arguments of a run."""
    return {name: each for name, each in flags.items() if each is not None}


def need_subject(scene: object) -> None:
    """Reject what no stage before a run returns.

    Raises
    ------
    UsageError
        In one sentence.
    """
    if not isinstance(scene, Deck):
        from adamslite.analyses.setup.subject import Kernels, Model

        if not isinstance(scene, Model | Kernels):
            kind = type(scene).__name__
            raise UsageError(f"a deck is a path, a text, or what adamslite.read returns, no {kind}")


def read_inputs(
    scene: str | os.PathLike[str], commands: CommandSource, user: User, values: Values = ()
) -> ReadInputs:
    """Deck and commands as they are read, checked and reported by the command line."""
    if not str(scene).strip():
        raise UsageError("a deck is a path or a text, and this is empty")
    source = scene if isinstance(scene, str) and "\n" in scene else Path(scene)
    given, beside = _source(commands), None
    if given is None and isinstance(source, Path):
        given = beside = command_file_beside(source)
    if given is None or isinstance(given, str | Path):
        return ReadInputs(*read_together(source, given, user, values), beside)
    deck, _, messages = read_together(source, None, user, values)
    return ReadInputs(deck, given, messages)


def with_commands(subject: Subject, commands: CommandSource) -> Inputs:
    """A deck takes the file beside it, like its path; a model and its kernels have no file."""
    given = _source(commands)
    if given is None and isinstance(subject, Deck) and subject.path:
        given = command_file_beside(subject.path)
    if given is None:
        return Inputs(subject, ())
    if not isinstance(given, str | Path):
        return Inputs(subject, given)
    from adamslite.analyses.setup.subject import deck_of
    from adamslite.reading.read import read_commands

    read = read_commands(given, deck_of(subject))
    return Inputs(subject, read, read.warnings)


def _source(commands: CommandSource) -> str | Path | Sequence[Command] | None:
    """A path, a text with line breaks, statements, or None."""
    if commands is None or isinstance(commands, Commands):
        return commands
    if isinstance(commands, str):
        return f"{commands}\n" if "\n" in commands or _is_statement(commands) else Path(commands)
    if isinstance(commands, os.PathLike):
        return Path(commands)
    listed = tuple(commands) if isinstance(commands, Iterable) else (commands,)
    if listed and all(isinstance(each, str) for each in listed):
        return "".join(f"{each}\n" for each in listed)
    statements = [each for each in listed if isinstance(each, Statement | Redefinition)]
    if len(statements) < len(listed):
        raise UsageError("commands= takes a file, a text, lines, or statements of read_commands")
    return Commands(statements)


def _is_statement(text: str) -> bool:
    """Whether one line is a command, not a file: it begins with a keyword and names no file."""
    from adamslite.language.abbreviations import match

    word = text.replace(",", "/").partition("/")[0].strip().upper()
    return bool(word) and match(word, STATEMENTS) is not None and not os.path.exists(text)


def _warn(messages: Iterable[Diagnostic]) -> None:
    for each in messages:
        if each.severity == WARNING:
            warnings.warn(each.render(), DeckWarning, stacklevel=FRAMES)
