"""The text of a file, whatever its encoding and its line ends, without control characters, and what
its comments ask for.
"""

from __future__ import annotations

import errno
import os
import re
import stat
import sys
from codecs import BOM_UTF16_BE, BOM_UTF16_LE
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

from adamslite.notation import OBEYED, picture

if TYPE_CHECKING:
    from adamslite.language.diagnostics import Source

IGNORES = "adamslite:"
COMMENT = re.compile(rf"{IGNORES}[ \t]*ignore\b([^\n]*)", re.IGNORECASE)
CODES = re.compile(r"[ \t]*[\w-]+(?:[ \t]*,[ \t]*[\w-]+)*")
CODE = re.compile(r"[\w-]+")

#: Larger decks and descriptions are not read [bytes].
MOST = 1 << 28
#: Nor more than that of a pipe, and of a device, which may have no end [bytes].
OF_PIPE, OF_DEVICE = 200_000_000, 1 << 24
#: What is asked for at once, of what has no size [bytes].
PIECE = 1 << 22


def decoded(data: bytes) -> str:
    """The text of a file: UTF-16 where it begins as such, else UTF-8, else Latin-1."""
    wide = data[:2] in (BOM_UTF16_LE, BOM_UTF16_BE)
    try:
        return data.decode("utf-16" if wide else "utf-8-sig")
    except UnicodeDecodeError:
        return data.decode("latin-1")


def contents(path: str | Path, most: int = 0) -> bytes:
    """The bytes of a file that may come from others.

    Parameters
    ----------
    path : str or Path
    most : int
        How many at most [bytes]; half of what this machine has of memory unless given.

    Raises
    ------
    OSError
        When there are more. A pipe gives ``OF_PIPE`` at most, a device ``OF_DEVICE``.
    """
    with open(path, "rb") as file:
        facts = os.fstat(file.fileno())
        plain = stat.S_ISREG(facts.st_mode)
        if plain:
            most = most or _half_of_memory()
            if facts.st_size <= most:
                return file.read()
        else:
            rest = OF_DEVICE if stat.S_ISCHR(facts.st_mode) else OF_PIPE
            most = min(most or rest, rest)
            pieces, size = list[bytes](), 0
            while size <= most and (more := file.read(PIECE)):
                pieces.append(more)
                size += len(more)
            if size <= most:
                return b"".join(pieces)
    raise OSError(errno.EFBIG, f"more than {most / 1e6:.0f} MB are not read", str(path))


class NamedText(str):
    """A text with the name that messages give its places."""

    name: str

    @classmethod
    def of(cls, text: str, name: str) -> NamedText:
        """A text of at least one whole line, which no name of a file is."""
        found = cls(text if "\n" in text else f"{text}\n")
        found.name = name
        return found


#: The name of a file that means standard input, and the name of that in messages.
PIPED, STDIN = "-", "<stdin>"


def is_piped(path: object) -> bool:
    """Whether a file is standard input."""
    return str(path) == PIPED


def piped() -> NamedText:
    """The text of a deck that comes from standard input; see :func:`piped_bytes`."""
    return NamedText.of(decoded(piped_bytes()), STDIN)


def piped_bytes() -> bytes:
    """What comes from standard input.

    Raises
    ------
    OSError
        When there is more of it than is read of a file.
    """
    stream = getattr(sys.stdin, "buffer", None)
    found = stream.read(MOST + 1) if stream else b""
    if len(found) > MOST:
        raise OSError(errno.EFBIG, f"more than {MOST / 1e6:.0f} MB are not read", STDIN)
    return bytes(found)


@cache
def _half_of_memory() -> int:
    try:
        return os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE") // 2
    except (AttributeError, ValueError, OSError):  # Windows has no such question
        return 1 << 33


def text_of(source: str) -> str:
    """A text with ``\\n`` line ends, and nothing in it that a terminal or a page would obey.

    Every character keeps its place; one that separates words is a blank.
    """
    text = source.replace("\r\n", "\n").replace("\r", "\n")
    return OBEYED.sub(_blank_or_picture, text) if OBEYED.search(text) else text


def _blank_or_picture(found: re.Match[str]) -> str:
    return " " if found[0].isspace() else picture(found)


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
