"""Statements between the two passes: keyword, id and syntax."""

from __future__ import annotations

from typing import NamedTuple

from adamslite.language.interfaces import Key
from adamslite.language.statement import Statement
from adamslite.syntax.syntax_errors import Waiting

Body = tuple[str, Key | None]
"""Keyword and id of a body; the id is None where it could not be read."""


class Entry(NamedTuple):
    """A statement after the first pass; ``body`` is the nearest body before it."""

    cls: type[Statement]
    syntax: Waiting
    id: Key
    body: Body | None
    again: bool = False
    """Another one has its id already."""
    changes: bool = False
    """It is a command that changes the statement of this id."""

    @property
    def label(self) -> str:
        return self.cls.keyword if self.cls.singleton else f"{self.cls.keyword}/{self.id}"


def canonical(id: Key) -> Key:
    """The id as references hold it: names in capitals."""
    return id.upper() if isinstance(id, str) else id


def gives_values(cls: type[Statement]) -> bool:
    """Whether expressions take values of such a statement when they are read."""
    own = cls.constants, cls.numbered
    return own != (Statement.constants, Statement.numbered)
