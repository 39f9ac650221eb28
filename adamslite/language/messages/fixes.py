"""Corrections of a text, for the messages whose hint is one."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator

from adamslite.language.diagnostics import Edit, Fix, Source

GUESS = "did you mean "
PRODUCT = "a product is written "
REPLACED = frozenset(
    """ignores-nothing missing-reference unknown-argument unknown-choice unknown-function
    unknown-name unknown-statement""".split()
)
"""Codes of messages about a word that is replaced by the one that may have been meant."""
NEEDLESS = frozenset("floating-placed ground-with-data no-effect".split())
"""Codes of messages about an argument that may be left out."""
SEPARATOR = re.compile(r"(,[ \t]*\n)?[ \t]*,\s*$")
FARTHEST = 200
"""Characters before an argument in which its comma is looked for."""
INSTEAD = {"^": "**", "÷": "/", "{": "(", "}": ")"}
"""What is written for a character of other languages."""

Change = tuple[int, int, str]
"""Offsets of what is replaced, and the text in its place."""


def fixes(code: str, source: Source, start: int, end: int, hint: str) -> tuple[Fix, ...]:
    """What may be done about a message with the place from ``start`` to ``end``."""
    if code in REPLACED and hint.startswith(GUESS) and "/" not in source.text[start:end]:
        words = hint.removeprefix(GUESS).removesuffix("?").split(" or ")
        return tuple(fix(source, f"write {word}", (start, end, word)) for word in words)
    make = CORRECTIONS.get(code)
    found = make(source.text, start, end, hint) if make else iter(())
    return tuple(fix(source, title, change) for title, change in found)


def left_out(source: Source, start: int, end: int) -> Fix | None:
    """The argument at these offsets left out, with the comma before it; None where that is not
    all there is to do.
    """
    text = source.text
    comma = SEPARATOR.search(text, max(0, start - FARTHEST), start)
    if comma is None or text[end:].lstrip()[:1] == "\\":
        return None
    above = text[: comma.start()].rstrip().rpartition("\n")[2].partition("!")[0]
    if above.rstrip().endswith(","):
        return None
    word = " ".join(text[start:end].split())
    return fix(source, f"leave out {word}", (comma.start(), end, ""))


def fix(source: Source, title: str, *changes: Change) -> Fix:
    """A correction of one source."""
    edits = (Edit(source.span(start, end), text) for start, end, text in changes)
    return Fix(title, tuple(edits))


Titled = Iterator[tuple[str, Change]]


def _continued(text: str, start: int, end: int, hint: str) -> Titled:
    yield "continue the statement above", (start, start, ", ")


def _without(text: str, start: int, end: int, hint: str) -> Titled:
    yield f"leave out {text[start:end]}", (start, end, "")


def _without_degrees(text: str, start: int, end: int, hint: str) -> Titled:
    yield "leave out D", (end - 1, end, "")


def _product(text: str, start: int, end: int, hint: str) -> Titled:
    found = re.match(r"[-\d.eEdD+]*[\d.]", text[start:end])
    if hint.startswith(PRODUCT) and found:
        at = start + found.end()
        yield "write a product", (at, at, "*")


def _character(text: str, start: int, end: int, hint: str) -> Titled:
    if word := INSTEAD.get(text[start:end]):
        yield f"write {word}", (start, end, word)


def _instead(text: str, start: int, end: int, hint: str) -> Titled:
    if re.fullmatch(r"write \w+", hint):
        yield hint, (start, end, hint.removeprefix("write "))


def _titled(text: str, start: int, end: int, hint: str) -> Titled:
    yield "put a title line above it", (0, 0, "untitled\n")


CORRECTIONS: dict[str, Callable[[str, int, int, str], Titled]] = {
    "degrees-of-no-angle": _without_degrees,
    "discontinued-choice": _instead,
    "missing-leading-comma": _continued,
    "missing-operator": _product,
    "missing-title": _titled,
    "stray-character": _character,
    "trailing-comma": _without,
    "unopened-bracket": _without,
}
