"""What the canonical layout of a long text costs, in calls rather than time."""

from __future__ import annotations

from typing import Any

import pytest

from adamslite.editing import line_breaks, outline
from adamslite.editing.layout import formatted


def test_a_line_without_a_place_to_break_is_not_joined_for_each_piece(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """4000 signs in a row were 8 million pieces."""
    joined, pieces = line_breaks.joined, [0]

    def counted(line: Any, continues: bool) -> str:
        pieces[0] += len(line)
        return joined(line, continues)

    monkeypatch.setattr(line_breaks, "joined", counted)
    formatted(f"signs\nVARIABLE/1, FUNCTION={'+' * 4000}1\nEND\n", "deck")
    assert 4000 <= pieces[0] < 100_000


def test_a_keyword_is_looked_up_once_in_each_text(monkeypatch: pytest.MonkeyPatch) -> None:
    match, words = outline.match, []
    monkeypatch.setattr(
        outline, "match", lambda word, table: words.append(word) or match(word, table)
    )
    formatted("words\n" + "no\n" * 500 + "END\n", "deck")
    assert words.count("NO") <= 2  # the text, and what it has become
