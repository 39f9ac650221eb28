"""Tokens: kind, text and offset of every word of a text, by the terminals of the deck grammar.

They carry their offset in the text, so that joining lines moves no column.
"""

from __future__ import annotations

import re
from array import array
from collections.abc import Iterable, Iterator, MutableSequence
from functools import cache
from itertools import accumulate
from sys import intern
from typing import Any, TypeAlias

from adamslite.syntax.forms import terminals
from adamslite.syntax.typeset import Plain, is_typeset

Lexeme = tuple[str, str, int]
"""Kind, text and offset of a token."""

Tokens: TypeAlias = MutableSequence[Lexeme]
"""Tokens of a statement: a list, or columns where they are many."""

CLOSES = {"LPAR": "RPAR", "LSQB": "RSQB"}
OPERATORS = {"PLUS": "+", "MINUS": "-", "STAR": "*", "SLASH": "/", "POWER": "**"}
"""Kinds of tokens that are operators, and what these are called in an expression."""

STRETCH = 1 << 15
"""Characters that are scanned at once, at least."""
LEAST = 16
"""Words of a stretch that does not end with a line."""
AHEAD = 64
"""Characters behind a token that may decide what it is, where their number is bounded."""
MANY = 512
"""Tokens of a statement above which they are kept as columns."""
FEW = 4
"""Tokens that are added to columns one by one in less time."""

NEW_STATEMENT = re.compile(r"\n(?=[A-Za-z])")
"""Where a text may be cut: a line that begins with a letter continues no other."""
NEW_LINE = re.compile(r"\n(?=[^\s,!])")
"""Where the tokens in front do not depend on those behind."""
OPEN_ENDED = {"BLANK", "LINE_END", "COMMENT", "STAR"}
"""Kinds of tokens that what follows may make longer, however far away it is."""


def end_of(token: Lexeme) -> int:
    """Offset one past the last character of a token."""
    return token[2] + len(token[1])


@cache
def _scanner() -> re.Pattern[str]:
    """All terminals in one pattern, without groups, so that it finds whole tokens."""
    one = "|".join(f"(?:{regexp})" for regexp in terminals().values())
    return re.compile(re.sub(r"(?<!\\)\((?!\?)", "(?:", one))


@cache
def _classifier() -> re.Pattern[str]:
    return re.compile("|".join(f"(?P<{name}>{regexp})" for name, regexp in terminals().items()))


class _Kinds(dict[str, str]):
    """The kind of each token, which its text decides; found out once for equal texts."""

    def __missing__(self, text: str) -> str:
        found = _classifier().match(text)
        kind = str(found and found.lastgroup)
        if len(text) <= AHEAD:
            self[text] = kind
        return kind


KINDS, MOST_KINDS = _Kinds(), 10_000
"""Kinds of tokens of all texts, so that texts read piece by piece share them, and how many."""


class Lexemes(MutableSequence[Lexeme]):
    """Tokens column by column, a fifth of the memory of a list of them; short slices are lists."""

    __slots__ = ("kinds", "texts", "offsets")

    def __init__(self, tokens: Iterable[Lexeme] = ()) -> None:
        self.kinds: list[str] = []
        self.texts: list[str] = []
        self.offsets = array("I")
        self.extend(tokens)

    @classmethod
    def of(cls, kinds: Iterable[str], texts: Iterable[str], offsets: array[int]) -> Lexemes:
        """Columns as they are."""
        made = cls()
        made.kinds, made.texts, made.offsets = [*kinds], [*texts], offsets
        return made

    def extend(self, tokens: Iterable[Lexeme]) -> None:
        if isinstance(tokens, Lexemes):
            self.kinds += tokens.kinds
            self.texts += tokens.texts
            self.offsets.extend(tokens.offsets)
        else:
            listed = [*tokens]
            self.kinds += [token[0] for token in listed]
            self.texts += [token[1] for token in listed]
            self.offsets.extend([token[2] for token in listed])

    def append(self, token: Lexeme) -> None:
        kind, text, offset = token
        self.kinds.append(kind)
        self.texts.append(text)
        self.offsets.append(offset)

    def __len__(self) -> int:
        return len(self.kinds)

    def __iter__(self) -> Iterator[Lexeme]:
        return zip(self.kinds, self.texts, self.offsets, strict=True)

    def __getitem__(self, at: Any) -> Any:
        kinds, texts, offsets = self.kinds[at], self.texts[at], self.offsets[at]
        if not isinstance(at, slice):
            return kinds, texts, offsets
        if len(kinds) > MANY:
            return Lexemes.of(kinds, texts, offsets)
        return [*zip(kinds, texts, offsets, strict=True)]

    def __setitem__(self, at: Any, token: Any) -> None:
        self.kinds[at], self.texts[at], self.offsets[at] = token

    def __delitem__(self, at: Any) -> None:
        del self.kinds[at], self.texts[at], self.offsets[at]

    def insert(self, at: int, token: Lexeme) -> None:
        kind, text, offset = token
        self.kinds.insert(at, kind)
        self.texts.insert(at, text)
        self.offsets.insert(at, offset)


def lengthened(tokens: Tokens, more: Tokens) -> Tokens:
    """The same tokens and more of them, as columns as soon as they are many."""
    if type(tokens) is list and len(tokens) + len(more) > MANY:
        tokens = Lexemes(tokens)
    if len(more) <= FEW:
        for token in more:
            tokens.append(token)
    else:
        tokens.extend(more)
    return tokens


def shifted(tokens: Tokens, by: int) -> Tokens:
    """The same tokens in a text with so many more characters before them."""
    if isinstance(tokens, Lexemes):
        return Lexemes.of(
            tokens.kinds, tokens.texts, array("I", [at + by for at in tokens.offsets])
        )
    return [(kind, text, at + by) for kind, text, at in tokens]


def scan(text: str, start: int = 0) -> Iterator[list[Lexeme]]:
    """The tokens of ``text`` from offset ``start``; any character belongs to some token.

    They come in stretches, so that they need not all be in memory.  None but the last is short of
    tokens, and none ends inside of what ends a line.
    """
    if is_typeset(text):
        plain = Plain(text, start)
        for stretch in _scan(plain.text, 0):
            yield [plain.written(token) for token in stretch]
    else:
        yield from _scan(text, start)


def _scan(text: str, start: int) -> Iterator[list[Lexeme]]:
    kinds = KINDS
    size = STRETCH
    while start < len(text):
        if len(kinds) > MOST_KINDS:
            kinds.clear()
        cut = NEW_LINE.search(text, start + size, start + 2 * size)
        end = cut.end() if cut else min(start + 2 * size, len(text))
        words = [*map(intern, _scanner().findall(text, start, end))]
        if not cut and end < len(text):
            del words[_sure(words, kinds, text, end) :]
            if len(words) < LEAST:
                size *= 2
                continue
            end = start + sum(map(len, words))
        offsets = accumulate(map(len, words), initial=start)
        tokens = zip(map(kinds.__getitem__, words), words, offsets, strict=False)
        yield [token for token in tokens if token[0] != "BLANK"]
        start, size = end, STRETCH


def _sure(words: list[str], kinds: _Kinds, text: str, end: int) -> int:
    """How many words of a text are what they are whatever follows them at ``end``."""
    sure = _ahead(words, kinds, len(words))
    if '"' not in words:
        return sure
    last = len(words) - 1 - words[::-1].index('"')
    behind = sum(map(len, words[last + 1 :]))
    if text.find("\n", end - behind, end) >= 0:
        return sure
    line_end = text.find("\n", end)
    closes = text.find('"', end, line_end if line_end >= 0 else len(text)) >= 0
    return _ahead(words, kinds, min(sure, last)) if closes else sure


def _ahead(words: list[str], kinds: _Kinds, most: int) -> int:
    """The same where no quote is open."""
    left = AHEAD
    while most and left > 0:
        most -= 1
        left -= len(words[most])
    while most and (kinds[words[most - 1]] in OPEN_ENDED or words[most - 1][0] == "\\"):
        most -= 1
    return most
