"""Keywords and their abbreviations: any beginning that fits only one keyword, and some more."""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple, TypeVar

from adamslite.language.spelling import spelled
from adamslite.language.statement import Argument, Statement

V = TypeVar("V")
PREFERRED = {"M": "MARKER", "P": "PART", "RE": "REQUEST"}
"""Abbreviations of statements that ADAMS reads although they fit several; those of arguments are
among the keywords of the argument."""


class Ambiguous(NamedTuple):
    """A word that begins several keywords."""

    choices: tuple[str, ...]


def match(word: str, table: Mapping[str, V]) -> V | Ambiguous | None:
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
        self.required = [each for each in cls.arguments.values() if each.required]
        self._keyed: dict[str, Argument | str | Ambiguous | None] = {}
        self._flags: dict[str, tuple[Argument, str] | Ambiguous | None] = {}
        for argument in cls.arguments.values():
            if argument.kind == "flag" or argument.bare:
                for option in argument.keys or argument.options:
                    self.bare[option] = (argument, option)
            else:
                self.valued.update(dict.fromkeys(argument.keys, argument))

    def keyed(self, word: str) -> Argument | str | Ambiguous | None:
        """The argument (or planned key) of ``WORD=``."""
        if word not in self._keyed:
            self._keyed[word] = match(spelled(word).upper(), self.valued)
        return self._keyed[word]

    def flag(self, word: str) -> tuple[Argument, str] | Ambiguous | None:
        """The argument and the option of a bare word."""
        if word not in self._flags:
            self._flags[word] = match(spelled(word).upper(), self.bare)
        return self._flags[word]

    @property
    def known(self) -> list[str]:
        shown = [a.key for a in dict.fromkeys(self.valued.values()) if isinstance(a, Argument)]
        return [*shown, *self.bare]


_KNOWN: dict[type[Statement], Vocabulary] = {}


def vocabulary(cls: type[Statement]) -> Vocabulary:
    """The keywords of a statement class, collected once."""
    found = _KNOWN.get(cls)
    if found is None:
        found = _KNOWN[cls] = Vocabulary(cls)
    return found


def forget_vocabularies() -> None:
    """Collect keywords again: the words that an argument may take have changed."""
    _KNOWN.clear()
