"""Places as clients of the language server count them: lines from 0, columns in units of code."""

from __future__ import annotations

from lsprotocol import types as lsp

from adamslite.editing.document import Content, same_lines
from adamslite.language.diagnostics import Span

UNITS = {"utf-8": ("utf-8", 1), "utf-16": ("utf-16-le", 2)}
"""How columns are counted: the bytes of an encoding, divided."""

HALVES = "surrogatepass"
"""Half of a pair of surrogates, which JSON can hold, counts as a letter."""


class Positions:
    """Places of one text.

    Parameters
    ----------
    content : Content
    encoding : str
        ``"utf-8"``, ``"utf-16"`` or ``"utf-32"``.
    """

    def __init__(self, content: Content, encoding: str) -> None:
        self.content = content
        self.encoding = encoding

    def offset(self, position: lsp.Position) -> int:
        """The offset of a position of the client."""
        line = self.content.source.line(position.line + 1)
        column = position.character
        if not line.isascii() and self.encoding in UNITS:
            encoding, size = UNITS[self.encoding]
            data = line.encode(encoding, HALVES)[: column * size]
            column = len(data.decode(encoding, "ignore"))
        return self.content.offset(position.line + 1, column + 1)

    def position(self, line: int, column: int) -> lsp.Position:
        """The position of a line and a column, both counted from 1."""
        before = self.content.source.line(line)[: column - 1]
        units = column - 1
        if not before.isascii() and self.encoding in UNITS:
            encoding, size = UNITS[self.encoding]
            units = len(before.encode(encoding, HALVES)) // size
        return lsp.Position(line - 1, units)

    def range_of(self, span: Span) -> lsp.Range:
        """The range of a span of this text; its beginning for a message about no place."""
        if not span.line:
            return self.plain(span)
        end = self.position(span.end_line, span.end_column)
        return lsp.Range(self.position(span.line, span.column), end)

    def plain(self, span: Span) -> lsp.Range:
        """The range of a span of another text, whose lines are not at hand."""
        start = lsp.Position(max(span.line - 1, 0), max(span.column - 1, 0))
        return lsp.Range(
            start, lsp.Position(max(span.end_line - 1, 0), max(span.end_column - 1, 0))
        )

    def range_between(self, start: int, end: int) -> lsp.Range:
        """The range between two offsets."""
        place = self.content.source.place
        return lsp.Range(self.position(*place(start)), self.position(*place(end)))


def changed_lines(old: str, new: str) -> tuple[int, int, str]:
    """The stretch of lines that differs: offsets in the old text, and the new text for it."""
    before, after = old.splitlines(keepends=True), new.splitlines(keepends=True)
    head, tail = same_lines(before, after)
    start = sum(map(len, before[:head]))
    end = start + sum(map(len, before[head : len(before) - tail]))
    return start, end, "".join(after[head : len(after) - tail])
