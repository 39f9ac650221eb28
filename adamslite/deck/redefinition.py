"""A command that changes a statement of the deck: only the given arguments change."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Generic, TypeAlias

from adamslite.language.diagnostics import MergedSpans
from adamslite.language.statement import S, Statement

if TYPE_CHECKING:
    from adamslite.language.diagnostics import Span, Spans
    from adamslite.language.interfaces import Key


@dataclass(frozen=True, kw_only=True)
class Redefinition(Generic[S]):
    """New values for some arguments of a statement.

    Parameters
    ----------
    of : type of Statement
        What it changes.
    key : int or str
        Id of the statement as references hold it; 0 for statements without id.
    changes : mapping
        The new values by field name.
    spans : Spans
        Their places in the command file.
    """

    of: type[S]
    key: Key
    changes: Mapping[str, object]
    spans: Spans

    @property
    def keyword(self) -> str:
        """Keyword of the statement."""
        return self.of.keyword

    @property
    def label(self) -> str:
        """What messages call the statement: ``VARIABLE/5``."""
        return self.keyword if self.of.singleton else f"{self.keyword}/{self.key}"

    @property
    def span(self) -> Span:
        """The place of the command."""
        return self.spans.whole

    def applied_to(self, statement: S) -> S:
        """The statement with the changes made."""
        dropped = _excluded(self.of, self.changes)
        kept = {f: getattr(statement, f) for f in self.of.arguments if f not in dropped}
        return self.of(
            **kept | dict(self.changes), id=statement.id, name=statement.name,
            spans=MergedSpans(statement.spans, self.spans, dropped),
        )  # fmt: skip


Command: TypeAlias = Statement | Redefinition[Any]
"""What a command file holds."""


def _excluded(cls: type[Statement], changed: Iterable[str]) -> set[str]:
    """Fields that no longer count when others are given."""
    found: set[str] = set()
    for groups in cls.alternatives:
        given = [group for group in groups if set(group) & set(changed)]
        if given:
            found |= {field for group in groups if group not in given for field in group}
    return found


def settled(cls: type[S], statements: Iterable[Statement]) -> S:
    """The settings after several statements of a class that may stand more than once.

    Of each argument the last one given counts; DEFAULT takes back all that was given before.
    """
    result = cls()
    for each in statements:
        if each.keyword != cls.keyword:
            continue
        if each.given("default"):
            result = cls()
        changes = {field: getattr(each, field) for field in each.spans}
        result = Redefinition(of=cls, key=0, changes=changes, spans=each.spans).applied_to(result)
    return result
