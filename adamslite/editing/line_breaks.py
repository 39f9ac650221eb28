"""The lines of a statement: filled up to a width, or broken where they are broken already."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import accumulate, pairwise

from adamslite.editing.pieces import NEVER, Piece

WIDTH = 80
"""Columns of a line; ADAMS in Fortran reads no more of an argument."""
CONTINUED = ", "
INSIDE = ",     "
"""How a line begins that continues a statement, or an expression inside one."""

NARROW = WIDTH - len(INSIDE)
"""A line that is not wider fits, whatever it begins with."""


def filled(pieces: list[Piece], source: str) -> list[list[Piece]]:
    """The pieces of each line: one line if they fit, else each expression begins a line.

    Values of a list that stand in rows, as those of a matrix do, stay in them.
    """
    widths = accumulate(len(each.glue) + len(each.text) for each in pieces)
    if all(width <= WIDTH for width in widths):
        return [[*pieces]]
    lines: list[list[Piece]] = []
    line: list[Piece] = []
    width, breaks = 0, False  # of the line, without what it begins with
    for before, piece in zip(pieces[:1] + pieces, pieces, strict=False):
        row = piece.depth == 1 and "\n" in source[before.end : piece.start]
        if row or (piece.expression and piece.depth < NEVER):
            lines.append(line)
            line, width, breaks = [], 0, False
        breaks = breaks or bool(line and piece.depth < NEVER)
        line.append(piece)
        width += len(piece.glue) + len(piece.text)
        while breaks and width > NARROW and (at := _break(line, bool(lines))):
            if _closes_up(lines, line, at):
                lines[-1] = lines[-1] + line[:at]
            else:
                lines.append(line[:at])
            line = line[at:]
            width = sum(len(each.glue) + len(each.text) for each in line)
            breaks = any(each.depth < NEVER for each in line[1:])
    return [*lines, line]


def _closes_up(lines: Sequence[list[Piece]], line: Sequence[Piece], at: int) -> bool:
    """Whether the begin of a line, broken inside a list, has a place on the line before it.

    The next time that break is one between rows, which stays, and the line would be filled so.
    """
    if not lines or line[0].depth > 0 or line[0].expression or line[at].depth != 1:
        return False
    return len(joined([*lines[-1], *line[:at]], len(lines) > 1)) <= WIDTH


def _break(line: Sequence[Piece], continues: bool) -> int:
    """Before which piece a line is broken because it is too long; 0: nowhere."""
    if len(joined(line, continues)) <= WIDTH:
        return 0
    places = [number for number, piece in enumerate(line) if number and piece.depth < NEVER]
    return min(places, key=lambda number: (line[number].depth, -number), default=0)


def kept(pieces: Sequence[Piece], source: str) -> list[list[Piece]]:
    """The pieces of each line, with the breaks of the source."""
    lines = [[pieces[0]]]
    for before, piece in pairwise(pieces):
        if "\n" in source[before.end : piece.start]:
            lines.append([])
        lines[-1].append(piece)
    return lines


def joined(line: Sequence[Piece], continues: bool) -> str:
    """The text of a line; ``continues`` is whether it is not the first of its statement."""
    text = "".join((each.glue if number else "") + each.text for number, each in enumerate(line))
    if not continues:
        return text
    return (CONTINUED if line[0].depth < 2 else INSIDE) + text
