"""A command that changes a statement of the deck: only the given arguments change."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar, Generic, TypeAlias

from adamslite.language.diagnostics import Spans
from adamslite.language.statement import S, Statement

if TYPE_CHECKING:
    from adamslite.language.diagnostics import Span
    from adamslite.language.interfaces import Key


class MergedSpans(Spans):
    """The places of a statement that a later one changed: each argument where it stands last.

    Parameters
    ----------
    older, newer : Spans
        The statement itself is where ``older`` has it, unless that is nowhere.
    dropped : collection of str
        Fields of ``older`` that no longer count.
    """

    __slots__ = ("parts",)
    kept: ClassVar[tuple[str, ...]] = (*Spans.kept, *__slots__)

    def __init__(self, older: Spans, newer: Spans, dropped: Collection[str]) -> None:
        whole = older if older.source else newer
        super().__init__(whole.source, whole.whole_range)
        kept = {field: older.home(field) for field in older if field not in dropped}
        self.parts = kept | {field: newer.home(field) for field in newer}

    def home(self, field: str) -> Spans:
        return self.parts.get(field, self)

    def __getitem__(self, field: str) -> Span:
        return self.parts[field][field]

    def __contains__(self, field: object) -> bool:
        return field in self.parts

    def __iter__(self) -> Iterator[str]:
        return iter(self.parts)

    def __len__(self) -> int:
        return len(self.parts)


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
