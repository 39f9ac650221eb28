"""Tokens: kind, text and offset of every word of a text, by the terminals of the deck grammar.

They carry their offset in the text, so that joining lines moves no column.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from functools import cache
from itertools import accumulate
from sys import intern

from adamslite.syntax.forms import terminals
from adamslite.syntax.typeset import Plain, is_typeset

Lexeme = tuple[str, str, int]
"""Kind, text and offset of a token."""

CLOSES = {"LPAR": "RPAR", "LSQB": "RSQB"}
OPERATORS = {"PLUS": "+", "MINUS": "-", "STAR": "*", "SLASH": "/", "POWER": "**"}
"""Kinds of tokens that are operators, and what these are called in an expression."""

STRETCH = 1 << 15
"""Characters that are scanned at once, at least."""

NEW_STATEMENT = re.compile(r"\n(?=[A-Za-z])")
"""Where a text may be cut: a line that begins with a letter continues no other."""


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
        kind = self[text] = str(found and found.lastgroup)
        return kind


def scan(text: str, start: int = 0) -> Iterator[list[Lexeme]]:
    """The tokens of ``text`` from offset ``start``; any character belongs to some token.

    They come in stretches that end where a statement ends, so that they need not all be in memory.
    """
    if is_typeset(text):
        plain = Plain(text, start)
        for stretch in _scan(plain.text, 0):
            yield [plain.written(token) for token in stretch]
    else:
        yield from _scan(text, start)


def _scan(text: str, start: int) -> Iterator[list[Lexeme]]:
    kinds = _Kinds()
    while start < len(text):
        cut = NEW_STATEMENT.search(text, start + STRETCH)
        end = cut.end() if cut else len(text)
        words = [*map(intern, _scanner().findall(text, start, end))]
        offsets = accumulate(map(len, words), initial=start)
        tokens = zip(map(kinds.__getitem__, words), words, offsets, strict=False)
        yield [token for token in tokens if token[0] != "BLANK"]
        start = end
