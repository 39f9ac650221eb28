"""The texts that a run was made from, which its results carry along."""

from __future__ import annotations

from collections.abc import Iterable
from contextlib import suppress
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from tempfile import TemporaryDirectory

    from adamslite.deck.commands import Commands
    from adamslite.deck.deck import Deck
    from adamslite.deck.redefinition import Command


NO_FILE = "<text>"
"""The name of a deck that came from no file."""
TABLE = ".csv"
"""The suffix of tables that a deck may name."""


@dataclass(frozen=True, kw_only=True)
class RunSource:
    """Deck and command file of a run, as texts.

    Parameters
    ----------
    deck : str
        Text of the deck, with ``\\n`` as the end of a line.
    name : str
        File name of the deck, without folder; ``<text>`` of a deck that came from no file.
    commands : str
        Text of the command file; empty without one.
    commands_name : str
        Its file name, without folder.
    user : tuple of str
        What was bound to routines that are no part of the deck, as ``VARIABLE/1=0``.
    folder : str
        Where the deck was, with the tables that it names; empty in results that were read from a
        file, which may be of another machine.
    tables : tuple of pairs
        Names and texts of these tables, in results that were read from a file.
    made : tuple or None
        Deck and commands as they were read for the run, where this process has run it.
    """

    deck: str
    name: str = NO_FILE
    commands: str = ""
    commands_name: str = ""
    user: tuple[str, ...] = ()
    folder: str = ""
    tables: tuple[tuple[str, str], ...] = field(default=(), compare=False, repr=False)
    made: tuple[Deck, Commands] | None = field(default=None, compare=False, repr=False)

    def __getstate__(self) -> dict[str, Any]:
        """The texts, from which everything is read again."""
        return {name: value for name, value in vars(self).items() if name != "made"}

    @property
    def stem(self) -> str:
        """The name without its suffix, for the names of files made from the results."""
        return Path(self.name).stem if self.name != NO_FILE else "results"

    def read(self) -> tuple[Deck, Commands]:
        """The statements of deck and command file.

        Raises
        ------
        DeckError
            With every mistake; tables that the deck names are those kept, or looked for in
            ``folder``.
        """
        from adamslite.deck.commands import Commands
        from adamslite.deck.names import Names
        from adamslite.deck.user_bindings import bindings
        from adamslite.language.diagnostics import Source
        from adamslite.language.text import text_of
        from adamslite.reading.read import commands_of, read_by
        from adamslite.reading.statement_reader import Reading

        if self.made:
            return self.made
        folder = unpacked(self.tables) if self.tables else self.folder
        path = None if self.name == NO_FILE and not self.tables else Path(folder, self.name)
        reading = Reading(Source(text_of(self.deck), self.name), Names(), "deck")
        deck = read_by(reading, path, bindings(list(self.user)))
        if not self.commands:
            return deck, Commands()
        return deck, commands_of(Source(text_of(self.commands), self.commands_name), deck)

    def table_texts(self) -> dict[str, str]:
        """The tables that SPLINE and MATRIX take from files, by name, as far as they are there and
        have not changed since they were read.
        """
        if self.tables or not (self.made or self.folder):
            return dict(self.tables)
        from adamslite.elements.bases.data_file import is_as_read, tables
        from adamslite.language.text import contents

        deck, commands = self.read()
        changes = (getattr(command, "changes", {}).get("file") for command in commands)
        named = {*(getattr(each, "file", None) for each in deck.statements), *changes}
        found = {}
        for name, path in tables(deck.folder, sorted(filter(None, named))).items():
            with suppress(OSError, UnicodeDecodeError):
                if is_as_read(path):
                    found[name] = contents(path).decode("utf-8-sig")
        return found


def unpacked(tables: Iterable[tuple[str, str]]) -> Path:
    """A folder of this process with these files; a name that leads out of it is left aside."""
    from hashlib import sha256

    folder = Path(_scratch().name, sha256(repr(tuple(tables)).encode()).hexdigest()[:16])
    for name, text in tables:
        path = (folder / name).resolve()
        if path.is_relative_to(folder.resolve()) and path.suffix.lower() == TABLE:
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text, encoding="utf-8")
    return folder


@cache
def _scratch() -> TemporaryDirectory[str]:
    """Removed when the process ends."""
    from tempfile import TemporaryDirectory

    return TemporaryDirectory(prefix="adamslite-")


def source_of(deck: Deck, commands: Iterable[Command]) -> RunSource:
    """The texts that a deck and its commands were read from."""
    from adamslite.deck.commands import Commands

    written = getattr(commands, "source", None)
    return RunSource(
        deck=deck.source.text,
        name=deck.path.name if deck.path else NO_FILE,
        commands=written.text if written else "",
        commands_name=Path(written.file).name if written else "",
        user=tuple(f"{label}={each.text}" for label, each in deck.user.used.items()),
        folder=str(deck.path.parent) if deck.path else "",
        made=(deck, Commands(commands)),
    )
