r"""Statements typeset in LaTeX, as in the source of a paper, become those of a deck.

::

    $$\text{SFORCE/0102, I=1, J=2, FUNCTION} = -\frac{EA}{L\_0 + \Delta L}
      * \left[\text{DM(1,2)} - (L\_0 + \Delta L)\right]$$

is ``SFORCE/0102, I=1, J=2, FUNCTION = -((EA)/(L_0 + DeltaL)) * [DM(1,2) - (L_0 + DeltaL)]``.
Between dollar signs the end of a line is a blank.  What has no meaning here stays, for the messages
of the parser; a text without LaTeX is left alone.
"""

from __future__ import annotations

import re
from array import array
from bisect import bisect_right

_FONTS = r"text(?:rm|it|bf|tt|sf)?|math(?:rm|it|bf|tt|sf)|operatorname|[mh]box"
_SIZES = r"left|right|[bB]igg?[lr]?"
_SPACES = r"qquad|quad|displaystyle|nonumber"
_FUNCTIONS = r"sqrt|sin|cos|tan|sinh|cosh|tanh|exp|max|min"
_END = r"(?![A-Za-z])"

TYPESET = re.compile(
    rf"\$|_\{{|\\(?:_|\[|[dt]?frac\b|sqrt\b|(?:{_FONTS})\s*\{{|(?:{_SIZES}){_END}|cdot\b|times\b)"
)
"""What a text has that is typeset in LaTeX; a Greek letter alone is a name of any deck."""

_WORD = re.compile(
    rf"""
    (?P<kept>"[^"\n]*"|(?<!\\)![^\n]*)
    | \\(?:{_FONTS})\s*(?P<group>\{{)
    | (?P<fraction>\\[dt]?frac\s*\{{)
    | (?P<argument>(?<=\\sqrt)\{{)
    | (?P<nothing>\\(?:{_SIZES}){_END}|\\(?:begin|end)\s*\{{[a-z]+\*?\}})
    | (?P<blank>\\(?:{_SPACES}){_END})
    | (?P<times>\\(?:cdot|times|ast){_END})
    | \\(?P<function>{_FUNCTIONS}){_END}
    | (?P<separator>\\backslash{_END})
    | (?P<underscore>\\_)
    | _\{{(?P<index>\w+)\}}
    | (?P<display>\$\$?|\\\[|\\\])
    | (?P<line>(?:\\\\|\n)(?=\s{{0,99}}\\text\{{[A-Za-z_]+/))
    | (?P<continued>\n(?=[ \t]*,))
    | (?P<space>\\\\|\\[,;:!\ ]|&|\n)
    | (?P<power>\^\{{)
    | (?P<caret>\^)
    | (?P<brace>\{{)
    | (?P<closed>\}})
    """,
    re.VERBOSE,
)
_MATHEMATICS = {"line", "space", "power", "caret", "brace"}
"""What means something between dollar signs only."""

_MEANINGS = {
    "nothing": "", "blank": " ", "times": "*", "separator": "\\", "underscore": "_",
    "line": ";", "space": " ", "caret": "**",
}  # fmt: skip
_OPENED = {
    "group": ("", ""), "fraction": ("((", ")/("), "argument": ("(", ")"), "power": ("**(", ")"),
    "brace": ("", ""),
}  # fmt: skip
"""What the begin and the end of a group mean."""

_CLOSES = {"$": "$", "$$": "$$", "\\[": "\\]"}
_DENOMINATOR = re.compile(r"\}\s*\{")


def is_typeset(text: str) -> bool:
    """Whether a text may hold LaTeX."""
    signs = "$" in text or "\\" in text or "_{" in text
    return signs and TYPESET.search(text) is not None


class Plain:
    """A text without its LaTeX, and where its characters were.

    Parameters
    ----------
    source : str
    start : int, optional
        From which offset on it is read.

    Attributes
    ----------
    text : str
    """

    def __init__(self, source: str, start: int = 0) -> None:
        self._source = source
        self._pieces: list[str] = []
        self._starts, self._origins = array("Q", [0]), array("Q", [start])
        self._length, self._read = 0, start
        self._closers: list[str] = []
        self._closes = ""
        """What ends the mathematics that is read, empty outside."""
        self._ends: dict[str, int] = {}
        """Where each sign was found last, -1 where there is no further one."""
        self._whole = False
        self._looked = source.rfind("\n", 0, start) + 1
        self._blank = True
        """Whether there are only blanks on the line before the place that was looked at last."""
        at = start
        while found := _WORD.search(source, at):
            kind, at = str(found.lastgroup), found.end()
            if kind == "kept" or (kind in _MATHEMATICS and not self._closes):
                continue  # copied with what follows
            self._copy(found.start())
            if (meaning := _MEANINGS.get(kind)) is not None:
                self._put(meaning, at)
            else:
                self._replace(kind, found)
                at = self._read
        self._copy(len(source))
        self.text = "".join(self._pieces)

    def written(self, token: tuple[str, str, int]) -> tuple[str, str, int]:
        """A token of :attr:`text` (kind, text, offset) in the source; names as they are there."""
        kind, word, at = token
        start = self._origin(at)
        if kind == "NAME":
            end = self._origin(at + len(word) - 1) + 1
            word = self._source[start:end]
            if "{" in word and self._source[end : end + 1] == "}":
                word += "}"
        return kind, word, start

    def _origin(self, offset: int) -> int:
        """Where a character of :attr:`text` stands in the source."""
        at = bisect_right(self._starts, offset) - 1
        return self._origins[at] + offset - self._starts[at]

    def _copy(self, end: int) -> None:
        """Copy the source as far as ``end``."""
        if end > self._read:
            self._put(self._source[self._read : end], end)

    def _put(self, piece: str, end: int) -> None:
        """Put ``piece`` for the source as far as ``end``."""
        if piece:
            self._pieces.append(piece)
            self._length += len(piece)
        if self._starts[-1] == self._length:  # of two places where one begins the last counts
            self._origins[-1] = end
        elif self._origins[-1] + self._length != self._starts[-1] + end:
            self._starts.append(self._length)
            self._origins.append(end)
        self._read = end

    def _replace(self, kind: str, found: re.Match[str]) -> None:
        end = found.end()
        if kind == "display":
            self._display(found)
        elif kind == "function":
            self._put("", found.start(kind))
            self._copy(end)
        elif kind in _OPENED:
            begin, closer = _OPENED[kind]
            self._closers.append(closer)
            self._put(begin, end)
        elif kind == "closed":
            self._close(found)
        elif kind == "index":
            self._put("_", found.start("index"))
            self._copy(found.end("index"))
            self._put("", end)
        else:
            self._put(found[kind], end)

    def _close(self, found: re.Match[str]) -> None:
        """The end of a group; behind that of a numerator a denominator begins."""
        end, meaning = found.end(), self._closers.pop() if self._closers else found[0]
        if meaning == ")/(":
            below = _DENOMINATOR.match(self._source, found.start())
            meaning, end = (meaning, below.end()) if below else ("))", end)
            if below:
                self._closers.append("))")
        self._put(meaning, end)

    def _display(self, found: re.Match[str]) -> None:
        """A sign between which mathematics stands; a stray one stays as it is."""
        word = found[0]
        meaning = word
        if self._closes == word:
            self._closes = ""
            meaning = ";" if self._whole else ""
        elif not self._closes and self._begins(found):
            self._closes = _CLOSES[word]
            meaning = ""
        self._put(meaning, found.end())

    def _begins(self, found: re.Match[str]) -> bool:
        """Whether mathematics begins here: it ends in the same line, or anywhere behind one that
        begins with it.
        """
        closes, start, end = _CLOSES.get(found[0]), *found.span()
        if closes is None or (at := self._next(closes, end)) < 0:
            return False
        self._whole = self._begins_line(start)
        return self._whole or not 0 <= self._next("\n", end) < at

    def _next(self, sign: str, start: int) -> int:
        """Where a sign is found next from an offset on, -1 where there is none; no text is looked
        at twice, however many such offsets there are.
        """
        at = self._ends.get(sign, start - 1)
        if 0 <= at < start:
            at = self._ends[sign] = self._source.find(sign, start)
        return at

    def _begins_line(self, start: int) -> bool:
        """Whether nothing but blanks stands before an offset on its line; no text is looked at
        twice, however many such places are on one line.
        """
        line = self._source.rfind("\n", self._looked, start) + 1
        if line:
            self._looked, self._blank = line, True
        self._blank = self._blank and not self._source[self._looked : start].strip()
        self._looked = start
        return self._blank
