"""Short decks for tests: a few bodies to hang statements on."""

from __future__ import annotations

from adamslite.checks.rules import check
from adamslite.deck.deck import Deck
from adamslite.language.diagnostics import DeckError, Diagnostic
from adamslite.language.expression import Node
from adamslite.language.messages import START
from adamslite.language.statement import Statement
from adamslite.reading.read import read


def deck_with(statements: str) -> Deck:
    """A deck of a ground (MARKER/1), a part (MARKER/2), a point mass (MARKER/3) and these."""
    return read(START + statements + "\n")


def last(statements: str) -> Statement:
    """The last of these statements."""
    return deck_with(statements).statements[-1]


def function(text: str, statements: str = "") -> Node:
    """What an expression is read as, in a deck that has these statements too."""
    return last(f"{statements}\nVARIABLE/999, FUNCTION={text}").function


def told(text: str, user: list[str] | dict[str, float] | None = None) -> list[Diagnostic]:
    """Everything said about a deck; ``user``: what is bound to routines."""
    try:
        return check(read(text, user))
    except DeckError as error:
        return list(error.diagnostics)


def codes(statements: str) -> list[str]:
    """The codes of everything said about these statements."""
    return [diagnostic.code for diagnostic in told(START + statements + "\n")]
