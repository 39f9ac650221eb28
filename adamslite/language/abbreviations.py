"""Keywords and their abbreviations: any beginning that fits one keyword only."""

from __future__ import annotations

from functools import cache
from typing import Any, NamedTuple

from adamslite.language.spelling import spelled
from adamslite.language.statement import Argument, Statement


class Ambiguous(NamedTuple):
    """A word that begins several keywords."""

    choices: tuple[str, ...]


def match(word: str, table: dict[str, Any]) -> Any:
    """What ``word`` means in ``table``: exactly, as a unique prefix, or as a longer form of a key.

    Returns the value, :class:`Ambiguous` or None.
    """
    if word in table:
        return table[word]
    found = [key for key in table if key.startswith(word)]
    if not found:
        found = [k for k in table if len(k) > 3 and word.startswith(k) and len(word) <= len(k) + 2]
    meanings = {id(table[key]) for key in found}
    if len(meanings) > 1:
        return Ambiguous(tuple(sorted(found)))
    return table[found[0]] if found else None


class Vocabulary:
    """The keywords of a statement class; remembers what it looked up."""

    def __init__(self, cls: type[Statement]) -> None:
        self.valued: dict[str, Argument | str] = {key: key for key in cls.planned}
        self.bare: dict[str, tuple[Argument, str]] = {}
        self._seen: dict[bool, dict[str, Any]] = {True: {}, False: {}}
        for argument in cls.arguments.values():
            if argument.kind == "flag" or argument.bare:
                for option in argument.keys or argument.options:
                    self.bare[option] = (argument, option)
            else:
                self.valued.update(dict.fromkeys(argument.keys, argument))

    def look_up(self, word: str, valued: bool) -> Any:
        """The argument (or planned key) of ``WORD=``, or the (argument, option) of a bare word."""
        seen = self._seen[valued]
        if word not in seen:
            seen[word] = match(spelled(word).upper(), self.valued if valued else self.bare)
        return seen[word]

    @property
    def known(self) -> list[str]:
        shown = [a.key for a in dict.fromkeys(self.valued.values()) if isinstance(a, Argument)]
        return [*shown, *self.bare]


vocabulary = cache(Vocabulary)
