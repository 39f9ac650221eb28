"""Columns of results chosen by patterns: ``REQUEST/*``, ``PART/2.v?``, ``PART/2`` for all of it."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING

from adamslite.errors import UsageError
from adamslite.results.comparison import fits

if TYPE_CHECKING:
    from adamslite.results.results import Results


def selected(names: Sequence[str], patterns: Iterable[str]) -> list[int]:
    """The columns that any of the patterns means, in their order.

    Raises
    ------
    UsageError
        When a pattern means none.
    """
    found: set[int] = set()
    for pattern in patterns:
        meant = [k for k, name in enumerate(names) if means(pattern, name)]
        if not meant:
            raise UsageError(f"no result is called '{pattern}'{near(pattern, names)}")
        found.update(meant)
    return sorted(found)


def limited(results: Results, patterns: Iterable[str]) -> Results:
    """The results with these columns alone; patterns that mean none are passed over."""
    return results.limited(meant(results.names, tuple(patterns)))


def meant(names: Sequence[str], patterns: Sequence[str]) -> list[int]:
    """The columns that any of the patterns means; patterns may mean none."""
    return [k for k, name in enumerate(names) if any(means(each, name) for each in patterns)]


def means(pattern: str, name: str) -> bool:
    """Whether a pattern means a column, or the statement that it belongs to."""
    return fits(pattern, name) or fits(pattern, name.rpartition(".")[0])


def near(pattern: str, names: Sequence[str]) -> str:
    """What may have been meant: columns, or statements with all of theirs."""
    from difflib import get_close_matches

    known = {name.casefold(): name for name in names}
    known |= {label.casefold(): f"{label}.*" for label in (n.rpartition(".")[0] for n in names)}
    known.pop("", None)
    close = get_close_matches(pattern.casefold(), known, n=2)
    if close:
        return f"; did you mean {' or '.join(known[each] for each in close)}?"
    return f"; there are {', '.join(names[:3])}, ..." if names else ": the deck has no results"
