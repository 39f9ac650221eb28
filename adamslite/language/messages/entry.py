"""One row of the table of messages."""

from __future__ import annotations

from dataclasses import dataclass

from adamslite.language.diagnostics import ERROR


@dataclass(frozen=True)
class Message:
    """A message and the decks that provoke it.

    Parameters
    ----------
    sentence, hint : str
        With ``{words}`` to fill in.
    broken : tuple of str
        Each one provokes this message and no other.  Statements to append to
        :data:`adamslite.language.messages.START`, or a whole deck when it begins with ``title``.
    commands : tuple of str
        The same, as command files for that deck.
    deck : str
        What these command files need in the deck.
    user : tuple of str
        For each broken deck what ``--user`` binds.
    severity : str
        ``"error"``, ``"warning"`` or ``"note"``.
    """

    sentence: str
    hint: str = ""
    broken: tuple[str, ...] = ()
    commands: tuple[str, ...] = ()
    deck: str = ""
    user: tuple[str, ...] = ()
    severity: str = ERROR
