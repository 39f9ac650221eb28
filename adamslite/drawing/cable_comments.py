"""Comments that make an OUTLINE a cable: cables/statements/graphics.py has their words."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, field

from adamslite.deck.deck import Deck
from adamslite.elements.graphics import Graphics
from adamslite.elements.marker import Marker
from adamslite.language.interfaces import Key, key_of

COMMENT = re.compile(r"[ \t]*!.*?\badamslite:[ \t]*cable\b[ \t]*(.*)", re.IGNORECASE)
RANGE = re.compile(r"(-?)(\w+/)(\d+)\.\.(\d+)(.*)")
NONE = "none"


@dataclass
class CableComment:
    """Signed radii of wheels by the key of their marker, signed result columns of the spans, and
    words that mean nothing."""

    wheels: dict[Key, float] = field(default_factory=dict)
    tensions: list[tuple[float, str]] = field(default_factory=list)
    unknown: list[str] = field(default_factory=list)


def cable_comment(deck: Deck, statement: Graphics) -> CableComment | None:
    """What the comments on and directly after the last line of a statement say; None without."""
    found: CableComment | None = None
    for words in _comments(deck, statement):
        found = found or CableComment()
        for item in filter(None, map(str.strip, words.split(","))):
            _read(deck, found, item)
    return found


def _comments(deck: Deck, statement: Graphics) -> Iterator[str]:
    lines, last = deck.lines, statement.span.end_line
    for number in range(last - 1, len(lines)):
        comment = COMMENT.match(_after_statement(lines[number], number == last - 1))
        if comment:
            yield comment[1]
        elif number >= last:
            return


def _after_statement(line: str, own: bool) -> str:
    """The line; of the statement's own last line its comment."""
    return line[line.find("!") :] if own and "!" in line else "" if own else line


def _read(deck: Deck, found: CableComment, item: str) -> None:
    word, *values = item.split()
    if word.lower() == "wheel" and len(values) == 2 and _is_number(values[1]):
        named: Key = key_of(values[0])
        marker = deck.find(Marker, named)
        if marker is not None and float(values[1]):
            found.wheels[marker.key] = float(values[1])
            return
    elif word.lower() == "tension" and values:
        for value in values:
            found.tensions += list(_columns(value))
        return
    found.unknown.append(item)


def _columns(text: str) -> Iterator[tuple[float, str]]:
    """Sign and name of every column that a text means; no name for `none`."""
    spread = RANGE.fullmatch(text)
    if spread:
        sign, label, start, end, suffix = spread.groups()
        first, last = int(start), int(end)
        step = 1 if last >= first else -1
        for number in range(first, last + step, step):
            yield (-1.0 if sign else 1.0), f"{label}{number}{suffix}"
    elif text.lower() == NONE:
        yield 1.0, ""
    else:
        yield (-1.0 if text.startswith("-") else 1.0), text.removeprefix("-")


def _is_number(text: str) -> bool:
    try:
        return abs(float(text)) < float("inf")
    except ValueError:
        return False
