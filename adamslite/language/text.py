"""The text of a file, whatever its encoding and its line ends, and what its comments ask for."""

from __future__ import annotations

import re
from codecs import BOM_UTF16_BE, BOM_UTF16_LE
from collections.abc import Iterator
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from adamslite.language.diagnostics import Source

IGNORES = "adamslite:"
COMMENT = re.compile(rf"{IGNORES}[ \t]*ignore\b([^\n]*)", re.IGNORECASE)
CODES = re.compile(r"[ \t]*[\w-]+(?:[ \t]*,[ \t]*[\w-]+)*")
CODE = re.compile(r"[\w-]+")


def decoded(data: bytes) -> str:
    """The text of a file: UTF-16 where it begins as such, else UTF-8, else Latin-1."""
    wide = data[:2] in (BOM_UTF16_LE, BOM_UTF16_BE)
    try:
        return data.decode("utf-16" if wide else "utf-8-sig")
    except UnicodeDecodeError:
        return data.decode("latin-1")


def text_of(source: str) -> str:
    """A text with ``\\n`` line ends."""
    return source.replace("\r\n", "\n").replace("\r", "\n")


class Ignored(NamedTuple):
    """A code on a line of the source, and where the comment names it."""

    code: str
    line: int
    start: int
    end: int


def ignored(source: Source) -> Iterator[Ignored]:
    """The codes that comments of a source name; text after the list of codes is a reason.

    The code is empty where a comment names none.
    """
    if IGNORES not in source.text.lower():  # faster than the pattern
        return
    for comment in COMMENT.finditer(source.text):
        before = source.text[source.text.rfind("\n", 0, comment.start()) + 1 : comment.start()]
        if "!" not in before or not before.rstrip().endswith(("!", "#")):
            continue
        start, end = comment.span(1)
        line, _ = source.place(start)
        codes = CODES.match(source.text, start, end)
        if not codes:
            yield Ignored("", line, *comment.span())
        for word in CODE.finditer(source.text, start, codes.end()) if codes else ():
            yield Ignored(word[0].lower(), line, *word.span())
