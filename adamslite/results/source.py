"""The texts that a run was made from, which its results carry along."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from adamslite.deck.deck import Deck
    from adamslite.deck.redefinition import Command
    from adamslite.reading.read import Commands


NO_FILE = "<text>"
"""The name of a deck that came from no file."""


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
    made : tuple or None
        Deck and commands as they were read for the run, where this process has run it.
    """

    deck: str
    name: str = NO_FILE
    commands: str = ""
    commands_name: str = ""
    user: tuple[str, ...] = ()
    folder: str = ""
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
            With every mistake; tables that the deck names are looked for in ``folder``.
        """
        from adamslite.deck.names import Names
        from adamslite.deck.user_bindings import bindings
        from adamslite.language.diagnostics import Source
        from adamslite.reading.read import Commands, commands_of, read_by
        from adamslite.reading.statement_reader import Reading

        if self.made:
            return self.made
        path = None if self.name == NO_FILE else Path(self.folder, self.name)
        reading = Reading(Source(self.deck, self.name), Names(), "deck")
        deck = read_by(reading, path, bindings(list(self.user)))
        if not self.commands:
            return deck, Commands()
        return deck, commands_of(Source(self.commands, self.commands_name), deck)


def source_of(deck: Deck, commands: Iterable[Command]) -> RunSource:
    """The texts that a deck and its commands were read from."""
    from adamslite.reading.read import Commands

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
