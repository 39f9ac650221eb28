"""A statement as pieces that lines are made of.

The rules: keywords in full and in capitals, ``KEY=value``; a comma and a blank between arguments, a
comma alone within them; blanks round plus and minus outside brackets; names as they are written.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import chain, islice
from typing import NamedTuple

from adamslite.deck.names import RESERVED
from adamslite.editing.outline import Given, Written
from adamslite.language.function import FUNCTIONS
from adamslite.syntax.tokens import CLOSES, OPERATORS, Lexeme, Tokens, end_of

NEVER = 99
"""Depth of a place where no line should break."""
_WORDS = frozenset(("NAME", "NUMBER", "QUOTED", "OTHER"))
_CLOSING = frozenset(CLOSES.values())
_ENDS = frozenset((*_WORDS, *_CLOSING))
_SIGNS = ("PLUS", "MINUS")
_END: Lexeme = ("", "", 0)


class Piece(NamedTuple):
    """A piece of a statement.

    Parameters
    ----------
    text : str
    glue : str
        What is before it within a line; a break replaces it.
    depth : int
        The smaller, the better a line may break before it.
    start, end : int
        Its place in the source.
    expression : bool
        It begins an argument that is an expression.
    """

    text: str
    glue: str
    depth: int
    start: int
    end: int
    expression: bool = False


def pieces(written: Written) -> list[Piece]:
    """The pieces of a statement whose arguments are known."""
    assert written.cls is not None and written.given is not None
    first = written.tokens[0]
    slash = "/" if len(written.tokens) > 1 else ""
    found = [Piece(written.cls.keyword + slash, "", NEVER, first[2], end_of(first))]
    glue, depth = "", NEVER
    for given in written.given:
        found += _argument(written.source, given, glue, depth)
        glue, depth = ", ", 0
        if given.closed:
            found[-1] = found[-1]._replace(text=found[-1].text + "\\")
            glue = " "
    return found


def _argument(source: str, given: Given, glue: str, depth: int) -> Iterator[Piece]:
    """The pieces of an argument; ``glue`` and ``depth`` are those before it."""
    expression, capitals = given.kind == "expression", given.kind in ("choice", "words")
    is_text = given.is_text
    if given.key:
        place = given.key[2], end_of(given.key)
        yield Piece(given.word + "=", glue, depth, *place, expression)
        glue, depth = "", NEVER
    elif given.argument:
        word = given.values[0][0]
        yield Piece(given.word, glue, depth, word[2], end_of(word))
        return
    for value in given.values:
        if is_text:
            start, end = value[0][2], end_of(value[-1])
            yield Piece(source[start:end], glue, depth, start, end)
        elif len(value) == 1 and value[0][0] != "NAME":
            _, text, start = value[0]
            yield Piece(text, glue, depth, start, start + len(text))
        else:
            yield from _tokens(value, glue, depth, expression, capitals)
        glue, depth = ",", 1


def _tokens(
    tokens: Tokens, glue: str, depth: int, expression: bool, capitals: bool
) -> Iterator[Piece]:
    """The pieces of one value; ``glue`` and ``depth`` are those before it."""
    brackets, earlier = 0, ""
    last: Lexeme | None = None
    for token, follower in zip(tokens, chain(islice(tokens, 1, None), (_END,)), strict=True):
        kind, _, start = token
        brackets -= kind in _CLOSING
        if last:
            spaced = expression and brackets == 0
            glue = _between(last, earlier, token, spaced)
            depth = _depth(last[0], kind, brackets) if expression else NEVER
            earlier = last[0]
        yield Piece(
            _text(token, follower[0], expression, capitals), glue, depth, start, end_of(token)
        )
        brackets += kind in CLOSES
        last = token


def _between(last: Lexeme, earlier: str, token: Lexeme, spaced: bool) -> str:
    """A blank between two tokens, or nothing; ``earlier`` is the kind of the token before both."""
    if last[0] in _WORDS and token[0] in _WORDS:
        return " "
    if token[0] in _SIGNS and last[0] in _ENDS:
        exponent = last[0] == "NUMBER" and last[1][-1] in "dD"  # 90D-3 would be a number
        return " " if spaced or exponent else ""
    return " " if spaced and last[0] in _SIGNS and earlier in _ENDS else ""


def _depth(before: str, kind: str, brackets: int) -> int:
    """How good a place for a break is inside an expression."""
    if before in ("COMMA", "COLON") or (kind in _SIGNS and before in _ENDS):
        return 2 + 2 * brackets
    if kind in ("STAR", "SLASH"):
        return 3 + 2 * brackets
    return NEVER


def _text(token: Lexeme, after: str, expression: bool, capitals: bool) -> str:
    kind, text, _ = token
    if kind in OPERATORS:
        return OPERATORS[kind]
    if kind != "NAME":
        return text
    if not text.isascii():  # no word of the language; Latin-1 has no capital of ÿ
        return text
    upper = text.upper()
    called = expression and after in CLOSES and upper in FUNCTIONS
    return upper if capitals or called or (expression and upper in RESERVED) else text
