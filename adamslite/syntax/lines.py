"""Splits a text into statements: continuation lines, ends and keywords."""

from __future__ import annotations

from collections.abc import Generator, Iterable, Iterator
from itertools import chain
from typing import NamedTuple

from adamslite.syntax.tokens import CLOSES, MANY, OPERATORS, Lexeme, Lexemes, Tokens

_JOINTS = {"LINE_END", "SEMICOLON", "AMPERSAND", "COMMENT", *CLOSES, *CLOSES.values()}
# No statement begins with a number: a semicolon before one stands in a list, for a comma.
NUMBERS = ("NUMBER", "PLUS", "MINUS")

KEPT = 8
"""Last tokens of a long statement that what follows may still change."""


class Logical(NamedTuple):
    """The tokens of one statement, joined from its lines; ``name`` is its adams_view_name."""

    tokens: Tokens
    name: str | None


class _Joiner:
    """Collects the tokens of a statement until it ends."""

    def __init__(self, ampersand: bool) -> None:
        self.ampersand = ampersand
        self.tokens: list[Lexeme] = []
        self.behind: list[Lexeme] = []
        """The stretch after this one, which decides what its last tokens mean."""
        self.current: list[Lexeme] = []
        self.before: Lexemes | None = None
        """The tokens of a long statement before the current ones, which are some in any case."""
        self.depth = 0
        self.name: str | None = None

    def statements(self, stretches: Iterable[list[Lexeme]]) -> Iterator[Logical]:
        following = iter(stretches)
        self.tokens = next(following, [])
        done = 0
        for self.behind in chain(following, ([],)):
            done = yield from self._ended(done)
            self.tokens = self.behind
        if self.current:
            yield self._finished()

    def _ended(self, done: int) -> Generator[Logical, None, int]:
        """The statements that end in the present stretch, from token ``done`` on; returns how many
        tokens of the next stretch belong to them.
        """
        tokens = self.tokens
        for at in [n for n, token in enumerate(tokens) if token[0] in _JOINTS]:
            if at < done:
                continue
            self.current += tokens[done:at]
            kind, text, place = tokens[at]
            done = at + 1
            if kind == "LINE_END" and self.current and self._kind(done) == "COMMA":
                self._leading_comma(done)
                done += 1
            elif kind == "SEMICOLON" and self.current and self._kind(done) in NUMBERS:
                self.current.append(("OTHER", text, place))
            elif kind == "LINE_END" or kind == "SEMICOLON":
                if self.current:
                    yield self._finished()
                self.name = view_name(text) if len(text) > 1 else None
            else:
                done = self._joint(tokens[at], done)
        self.current += tokens[done:]
        if len(self.current) > MANY:
            self.before = self.before or Lexemes()
            self.before.extend(self.current[:-KEPT])
            del self.current[:-KEPT]
        return max(0, done - len(tokens))

    def _token(self, position: int) -> Lexeme | None:
        """A token of this stretch or of the next one."""
        if position < len(self.tokens):
            return self.tokens[position]
        position -= len(self.tokens)
        return self.behind[position] if position < len(self.behind) else None

    def _kind(self, position: int) -> str:
        token = self._token(position)
        return token[0] if token else ""

    def _joint(self, token: Lexeme, position: int) -> int:
        """A bracket, an ampersand or a last comment; returns where to continue."""
        kind = token[0]
        if kind == "AMPERSAND" and self.ampersand and self._kind(position) == "LINE_END":
            position += 1
            if self.current and self._kind(position) == "COMMA":
                self._leading_comma(position)
                position += 1
        elif kind != "COMMENT":
            self.depth = max(0, self.depth + (kind in CLOSES) - (kind in CLOSES.values()))
            self.current.append(token)
        return position

    def _leading_comma(self, position: int) -> None:
        """The comma that begins a continuation line: a separator, or nothing but a mark."""
        current, last = self.current, self.current[-1]
        argument = self._kind(position + 1) == "NAME" and self._kind(position + 2) == "EQUAL"
        if last[0] == "SLASH" and len(current) > 2 and argument:
            current[-1] = ("BACKSLASH", *last[1:])
        elif last[0] == "COMMA":
            if len(current) > 1 and (current[-2][0] in OPERATORS or current[-2][0] in CLOSES):
                current.pop()
        elif last[0] != "EQUAL" and (self.depth == 0 or argument):
            comma = self._token(position)
            assert comma is not None
            current.append(comma)
        if argument:
            self.depth = 0

    def _finished(self) -> Logical:
        """What is collected, which is a statement."""
        current, before, name = self.current, self.before, self.name
        if len(current) > 2 and current[-1][0] == "SLASH":
            current.pop()
        self.current, self.before, self.depth, self.name = [], None, 0, None
        if before:
            before.extend(current)
        return Logical(before or current, name)


def join(stretches: Iterable[list[Lexeme]], ampersand: bool = False) -> Iterator[Logical]:
    """The statements in stretches of tokens.

    A line that begins with a comma continues the statement above it.  In a list of arguments that
    comma separates; inside brackets, and after a comma or an equal sign, it only marks the
    continuation.  A comma at the end of a line vanishes too after an operator or an opening
    bracket.  A slash at the end of a line that an argument or nothing follows is the old form of
    the backslash.

    Parameters
    ----------
    stretches : iterable of list of Lexeme
        As :func:`scan` gives them.
    ampersand : bool
        Whether ``&`` at the end of a line continues it, as in command files.
    """
    return _Joiner(ampersand).statements(stretches)


def view_name(comments: str) -> str | None:
    """The name given by an ``! adams_view_name='...'`` comment on the lines before a statement."""
    if "adams_view_name" not in comments.lower():
        return None
    for line in reversed(comments.splitlines()):
        word, _, rest = line.strip("! \t").partition("=")
        if word.strip().lower() == "adams_view_name" and rest.count("'") >= 2:
            return rest.split("'")[1].strip() or None
        if word and not word.lower().startswith("adams_view"):
            return None
    return None
