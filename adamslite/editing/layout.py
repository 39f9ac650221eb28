"""The canonical layout of a deck or a command file.

::

    text --outline--> statements --pieces--> pieces --filled--> lines, comments between them

Comments, names, numbers and the order of everything stay.  A statement that cannot be read stays
as it is written, and so does all that is not read: the title, names at the top of a command file,
what is behind END.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from itertools import accumulate, groupby, pairwise, zip_longest
from typing import NamedTuple

from adamslite.editing.outline import Written, head_end, outline
from adamslite.editing.pieces import NEVER, Piece, pieces
from adamslite.gc_pause import without_collection

COMMENT = re.compile(r"![^\n]*")
IGNORING = re.compile(r"adamslite:", re.IGNORECASE)
COMMENT_OR_SIGN = re.compile(r"![^\n]*|[^\s;]")
APART = "  "
"""What is at least between a statement and the comment behind it."""
MOST_UNREAD = 100_000
"""Words and signs of statements that cannot be read: a text with more is no deck."""


class Line(NamedTuple):
    """A line of the result."""

    code: str
    comment: str = ""


def formatted(text: str, place: str = "deck") -> str:
    """The canonical layout of a text with ``\\n`` as line ends.

    Parameters
    ----------
    text : str
    place : str
        ``"deck"`` or ``"command"``.

    Returns
    -------
    str
        The text itself where any other one would be read differently.
    """
    with without_collection():
        return _formatted(text, place)


def _formatted(text: str, place: str) -> str:
    said = _said(text, place)
    if not said or any(each.tokens[0][0] == "COMMA" for each in said):
        return text
    result = _laid_out(said, place)
    if result == text or _says_the_same(result, said, place):
        return result
    for each in said:
        if each.given is not None and not _is_safe(each, place):
            each.given = None
    result = _laid_out(said, place)
    return result if _says_the_same(result, said, place) else text


def _said(text: str, place: str) -> list[Written]:
    """The statements of a text; none where too much of it cannot be read."""
    said, unread = list[Written](), 0
    for each in outline(text, place):
        said.append(each)
        unread += len(each.tokens) if each.is_unread else 0
        if unread > MOST_UNREAD:
            return []
    return said


def _says_the_same(result: str, said: list[Written], place: str) -> bool:
    both = zip_longest(outline(result, place), said)
    return all(again and each and again.says(each) for again, each in both)


def _is_safe(each: Written, place: str) -> bool:
    """Whether a statement reads the same by itself once it is laid out."""
    lines = _statement_lines(each, "", place)
    text = "title\n" + "\n".join(f"{line.code}{APART}{line.comment}" for line in lines)
    return [again.meaning()[1:] for again in outline(text, place)][-1:] == [each.meaning()[1:]]


def _laid_out(said: list[Written], place: str) -> str:
    text = said[0].source
    if place == "command":  # blank lines at the top of a command file mean something
        rest = said[0].start
        head, lines = text[:rest].rstrip(" \t"), list[Line]()
    else:
        rest = head_end(text, place)
        head, lines = text[:rest], list(_between(text[rest : said[0].start]))
    together, comments = False, _Ignoring(text)
    for each, follower in pairwise([*said, None]):
        assert each is not None
        stop = follower.start if follower else len(text)
        rest = _real_end(text, each, stop)
        if text[each.end : rest].strip() not in ("", "/"):  # a slash is an old end of an expression
            each.given = None
        over = bool(each.cls and each.cls.ends)
        gap = "" if over else text[rest:stop]
        ignoring = comments.behind(rest)
        behind = _comment(gap.partition("\n")[0])
        found = _statement_lines(each, behind, place, rest, ignoring)
        if together:
            lines[-1] = Line(f"{lines[-1].code}; {found[0].code}", found.pop(0).comment)
        lines += [*found, *_between(gap)]
        together = ignoring and follower is not None and "\n" not in gap
        if over:
            return _text(head, lines) + text[rest:].rstrip() + "\n"
    return _text(head, lines).rstrip() + "\n"


def _text(head: str, lines: list[Line]) -> str:
    body = "\n".join(_aligned(lines))
    return f"{head}\n{body}" if head and not head.endswith("\n") else head + body


def _real_end(text: str, each: Written, stop: int) -> int:
    """Where a statement ends, with signs that reading passes over."""
    if each.cls and each.cls.ends:
        return each.end
    signs = [sign for sign in COMMENT_OR_SIGN.finditer(text, each.end, stop) if sign[0][0] != "!"]
    return signs[-1].end() if signs else each.end


class _Ignoring:
    """Which comments at ends of lines ignore messages; asked for in the order of the text."""

    def __init__(self, text: str) -> None:
        self._text, self._end, self._last = text, -1, -1

    def behind(self, start: int) -> bool:
        """Whether such a comment is behind an offset, in the same line."""
        text = self._text
        if start > self._end:
            end = text.find("\n", start)
            self._end = end if end >= 0 else len(text)
            words = [word.start() for word in IGNORING.finditer(text, start, self._end)]
            self._last = text.rfind("!", start, words[-1]) if words else -1
        return start <= self._last


def _comment(stretch: str) -> str:
    found = COMMENT.search(stretch)
    return found[0].rstrip() if found else ""


def _between(gap: str) -> Iterator[Line]:
    """The lines between two statements: comments, and one blank line where there are some."""
    lines = [_comment(line) for line in gap.split("\n")[1:-1]]
    for comment, same in groupby(lines):
        yield from (Line("", each) for each in ([*same] if comment else [""]))


def _statement_lines(
    each: Written, behind: str, place: str, end: int = 0, ignoring: bool = False
) -> list[Line]:
    """The lines of a statement; ``behind`` is the comment behind it."""
    text = each.source
    found = pieces(each) if each.given is not None else []
    if not found or any("\n" in piece.text for piece in found):
        return [Line(text[each.start : end or each.end], behind)]
    commented = "!" in text[each.start : each.end] and any(
        "!" in text[a.end : b.start] for a, b in pairwise(found)
    )
    rows = kept(found, text) if commented or ignoring else filled(found, text)
    lines = []
    for number, row in enumerate(rows):
        last = row is rows[-1]
        mark = " &" if place == "command" and not last else ""
        gap = "" if last else text[row[-1].end : rows[number + 1][0].start]
        comment = behind if last else _comment(gap.partition("\n")[0])
        lines.append(Line(joined(row, number > 0) + mark, comment))
        lines += [line for line in _between(gap) if line.comment]
    return lines


def _aligned(lines: Iterable[Line]) -> Iterator[str]:
    """The lines as text; comments behind statements on neighbouring lines begin in one column."""
    for both, group in groupby(lines, key=lambda line: bool(line.code and line.comment)):
        block = [*group]
        width = max(len(line.code.rpartition("\n")[2]) for line in block)
        for code, comment in block:
            last = code.rpartition("\n")[2]
            yield code + " " * (width - len(last)) + APART + comment if both else code + comment


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
