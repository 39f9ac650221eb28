"""Names of statements, and the constants of the language."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from adamslite.language.expression import MODE, TIME, Num
from adamslite.language.spelling import spelled
from adamslite.language.traced import WRITTEN, Traced

if TYPE_CHECKING:
    from adamslite.language.expression import Node
    from adamslite.language.interfaces import Key

RESERVED: dict[str, Node] = {
    "TIME": TIME,
    "MODE": MODE,
    "PI": Num(math.pi),
    "DTOR": Num(math.pi / 180),
    "RTOD": Num(180 / math.pi),
}
MEANINGS = {
    "TIME": "the time of the analysis",
    "MODE": "5 in statics, 4 otherwise",
    "PI": "3.14159265358979",
    "DTOR": "pi/180, radians in a degree",
    "RTOD": "180/pi, degrees in a radian",
}
"""What these names mean, for the manual."""


class Names:
    """The ids and view names of all statements, by keyword."""

    def __init__(self) -> None:
        self.ids: dict[str, dict[Key, int]] = {}
        self.views: dict[str, dict[str, list[Key]]] = {}
        self.delays = False
        """Whether an expression takes values of the past."""

    def add(self, kind: str, key: Key, view: str | None, start: int) -> bool:
        """Enter the statement at offset ``start`` of the text; False when its id is taken."""
        ids = self.ids.setdefault(kind, {})
        if view:
            self.views.setdefault(kind, {}).setdefault(spelled(view).upper(), []).append(key)
        if key in ids:
            return False
        ids[key] = start
        return True

    def find(self, kind: str, word: Key) -> Key | list[Key] | None:
        """The id that ``word`` (a number or a name in capitals) means; a list when several do."""
        if word in self.ids.get(kind, ()):
            return word
        found = self.views.get(kind, {}).get(word, []) if isinstance(word, str) else []
        return found[0] if len(found) == 1 else found or None

    def used(self, kind: str, key: Key, start: int, end: int) -> None:
        """Told of each place that refers to a statement; an index of places may be made of it."""

    def known(self, kind: str) -> list[str]:
        """Everything that may be written for a statement of this kind."""
        return [*map(str, self.ids.get(kind, ())), *self.views.get(kind, ())]


class Marked(str):
    """The text of a number token that remembers where it is, and whether it was taken as a number
    and not as an id.
    """

    __slots__ = ("at", "taken")
    at: int
    taken: bool

    @classmethod
    def of(cls, text: str, at: int) -> Marked:
        """The text at an offset."""
        made = cls(text)
        made.at, made.taken = at, False
        return made


def to_number(text: str) -> float:
    """The value of a number token: exponents with E or D, a bare D at the end means degrees."""
    if type(text) is Marked:
        text.taken = True
        return Traced(to_number(str(text)), (WRITTEN, text.at))
    try:
        return float(text)
    except ValueError:
        if text[-1] in "dD":
            return math.radians(to_number(text[:-1]))
        return float(text.upper().replace("D", "E"))
