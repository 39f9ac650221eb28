"""The text of a deck with fitted numbers: those are replaced where they stand, a comment below the
title says what they are, and every other byte is that of the file.
"""

from __future__ import annotations

import re
from codecs import BOM_UTF8, BOM_UTF16_BE, BOM_UTF16_LE
from collections.abc import Mapping, Sequence
from textwrap import wrap
from typing import NamedTuple

from adamslite.deck.deck import Deck
from adamslite.language.text import text_of
from adamslite.variation.decks import variable_of

#: Letters in a line of the comment.
WIDTH = 100
LINE = re.compile(r"[^\r\n]*(?:\r\n|\r|\n|$)")


class Encoding(NamedTuple):
    """How a file is written; see :mod:`adamslite.language.text`."""

    mark: bytes
    name: str


def commented(deck: Deck, values: Mapping[str, float], comments: Sequence[str]) -> str:
    """The text with ``\\n`` line ends; parameters as for :func:`encoded`."""
    return _with_numbers((deck.base or deck).source.text, deck, values, comments)


def encoded(deck: Deck, values: Mapping[str, float], comments: Sequence[str]) -> bytes:
    """The bytes of a deck with other numbers.

    Parameters
    ----------
    deck : Deck
        Made by ``with_values`` of one that was read from a file or a text.
    values : mapping
        By full names; numbers that the deck has got before are put in, too.
    comments : sequence of str
        Sentences below the title.
    """
    base = deck.base or deck
    data = base.path.read_bytes() if base.path and base.path.is_file() else b""
    encoding = _encoding(data)
    text = data[len(encoding.mark) :].decode(encoding.name)
    if text_of(text) != base.source.text:
        text, encoding = base.source.text, Encoding(b"", "utf-8")  # the file is not what was read
    made = _with_numbers(text, deck, values, comments)
    return encoding.mark + made.encode(encoding.name, "backslashreplace")


def _encoding(data: bytes) -> Encoding:
    for mark, name in ((BOM_UTF16_LE, "utf-16-le"), (BOM_UTF16_BE, "utf-16-be")):
        if data.startswith(mark):
            return Encoding(mark, name)
    mark = BOM_UTF8 if data.startswith(BOM_UTF8) else b""
    try:
        data.decode("utf-8")
    except UnicodeDecodeError:
        return Encoding(b"", "latin-1")
    return Encoding(mark, "utf-8")


def _with_numbers(
    text: str, deck: Deck, values: Mapping[str, float], comments: Sequence[str]
) -> str:
    """A text whose line ends may be any; numbers are found by line and column."""
    numbers = variable_of(deck.base or deck).numbers
    source = numbers.deck.source
    lines = LINE.findall(text)
    edits = []
    for name, value in {**deck.values, **values}.items():
        number = numbers.named[name.upper()]
        if value != number.value:
            line, column = source.place(number.start)
            size = number.end - number.start
            edits.append((line - 1, column - 1, size, number.written(value)))
    for line, column, size, new in sorted(edits, reverse=True):
        lines[line] = lines[line][:column] + new + lines[line][column + size :]
    return "".join(_below_the_title(lines, comments))


def _below_the_title(lines: list[str], comments: Sequence[str]) -> list[str]:
    """The lines with a comment behind the first that is not blank."""
    title = next((n for n, line in enumerate(lines) if line.strip()), 0)
    end = lines[title][len(lines[title].rstrip("\r\n")) :] or "\n"
    said = [
        f"! {line}{end}"
        for each in comments
        for n, part in enumerate(wrap(each, WIDTH - 4, break_long_words=False) or [""])
        for line in [f"  {part}" if n else part]
    ]
    return [*lines[: title + 1], *said, *lines[title + 1 :]]
