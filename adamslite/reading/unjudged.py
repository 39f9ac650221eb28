"""The deck that a reading yields, before rules about several statements judge it."""

from __future__ import annotations

from pathlib import Path

from adamslite.deck.deck import Deck
from adamslite.deck.redefinition import Command
from adamslite.deck.user_bindings import Bindings
from adamslite.language.statement import Statement
from adamslite.reading.statement_reader import Reading
from adamslite.reading.user_routines import RoutineBinder


def unjudged(reading: Reading, path: Path | None, given: Bindings) -> Deck:
    """The deck, whatever there is to say about it."""
    title, start = reading.title()
    read = bound(reading.statements(start), reading, given)
    statements = tuple(each for each in read if isinstance(each, Statement))  # all of them
    deck = Deck(reading.log.source, title, statements, reading.names, path)
    deck.user = given
    return deck


def bound(
    commands: tuple[Command, ...], reading: Reading, given: Bindings, deck: Deck | None = None
) -> tuple[Command, ...]:
    """The statements with routines of the user bound; reading passes over decks without any."""
    if not (reading.resolver.calls_user or given.statements):
        return commands
    binder = RoutineBinder(reading.resolver, given, deck)
    commands = binder.commands(commands)
    for each in binder.diagnostics:
        reading.log.take(each)
    return commands
