"""Pages of arguments by their name: which statements have it, and what it means there."""

from __future__ import annotations

from collections.abc import Iterator

from adamslite.language.statement import STATEMENTS
from adamslite.manual.markdown import Row, table
from adamslite.manual.statements import argument_row, keywords_of

HEAD = ("statement", "argument", "value", "unit", "default", "meaning")


def argument_names() -> list[str]:
    """Every keyword of an argument, once."""
    return [*dict.fromkeys(key for keyword in STATEMENTS for key in keywords_of(keyword))]


def argument_page(name: str) -> str:
    """One argument: the statements that have it, those with the same meaning in one row."""
    found: dict[tuple[str, ...], list[str]] = {}
    for keyword, row in _rows(name):
        found.setdefault(tuple(row), []).append(keyword)
    rows = ((", ".join(keywords), *row) for row, keywords in found.items())
    return f"## {name}: an argument\n\n{table(HEAD, rows)}"


def _rows(name: str) -> Iterator[tuple[str, Row]]:
    """Keyword of a statement and the row of the argument in its table."""
    for keyword, cls in sorted(STATEMENTS.items()):
        for each in cls.arguments.values():
            if name in each.keys and not each.bare:
                yield keyword, argument_row(each)
        for names, meaning in getattr(cls, "known", ()):
            if name in names.split(", "):
                yield keyword, (f"`{name}`", "", "", "", f"{meaning}; passed over")
