"""Splits a text into statements: continuation lines, ends and keywords."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import NamedTuple

from adamslite.syntax.tokens import CLOSES, OPERATORS, Lexeme

_JOINTS = {"LINE_END", "SEMICOLON", "AMPERSAND", "COMMENT", *CLOSES, *CLOSES.values()}
# No statement begins with a number: a semicolon before one stands in a list, for a comma.
NUMBERS = ("NUMBER", "PLUS", "MINUS")


class Logical(NamedTuple):
    """The tokens of one statement, joined from its lines; ``name`` is its adams_view_name."""

    tokens: list[Lexeme]
    name: str | None


class _Joiner:
    """Collects the tokens of a statement until it ends."""

    def __init__(self, ampersand: bool) -> None:
        self.ampersand = ampersand
        self.tokens: list[Lexeme] = []
        self.current: list[Lexeme] = []
        self.depth = 0
        self.name: str | None = None

    def statements(self, stretches: Iterable[list[Lexeme]]) -> Iterator[Logical]:
        for self.tokens in stretches:
            yield from self._ended()
        yield from self._finish()

    def _ended(self) -> Iterator[Logical]:
        """The statements that end in the present stretch."""
        tokens, done = self.tokens, 0
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
                yield from self._finish()
                self.name = view_name(text)
            else:
                done = self._joint(tokens[at], done)
        self.current += tokens[done:]

    def _kind(self, position: int) -> str:
        return self.tokens[position][0] if position < len(self.tokens) else ""

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
            current.append(self.tokens[position])
        if argument:
            self.depth = 0

    def _finish(self) -> Iterator[Logical]:
        current, name = self.current, self.name
        if len(current) > 2 and current[-1][0] == "SLASH":
            current.pop()
        self.current, self.depth, self.name = [], 0, None
        if current:
            yield Logical(current, name)


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
