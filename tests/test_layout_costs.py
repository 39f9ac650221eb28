"""What the canonical layout of a long text costs, in calls rather than time."""

from __future__ import annotations

from typing import Any

import pytest

from adamslite.editing import layout, outline
from adamslite.editing.layout import formatted
from adamslite.language.diagnostics import Source


def test_a_line_without_a_place_to_break_is_not_joined_for_each_piece(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """4000 signs in a row were 8 million pieces."""
    joined, pieces = layout.joined, [0]

    def counted(line: Any, continues: bool) -> str:
        pieces[0] += len(line)
        return joined(line, continues)

    monkeypatch.setattr(layout, "joined", counted)
    formatted(f"signs\nVARIABLE/1, FUNCTION={'+' * 4000}1\nEND\n", "deck")
    assert 4000 <= pieces[0] < 100_000


def test_a_keyword_is_looked_up_once_in_each_text(monkeypatch: pytest.MonkeyPatch) -> None:
    match, words = outline.match, []
    monkeypatch.setattr(
        outline, "match", lambda word, table: words.append(word) or match(word, table)
    )
    formatted("words\n" + "no\n" * 500 + "END\n", "deck")
    assert words.count("NO") <= 2  # the text, and what it has become


def test_lines_of_a_text_are_found_once_whatever_mistakes_it_has(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """40 000 statements with a mistake took 42 s: all lines were found for each."""
    made = []
    monkeypatch.setattr(outline, "Source", lambda text: made.append(text) or Source(text))
    text = "mistakes\n" + "MARKER/3, ZZZ=1\n" * 100 + "END\n"
    assert formatted(text, "deck") == text
    assert len(made) <= 4  # its head and its statements; those of what it has become


def test_statements_with_the_same_tokens_are_not_read_again(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    form, forms = outline.statement_form, []
    monkeypatch.setattr(outline, "statement_form", lambda kinds: forms.append(kinds) or form(kinds))
    text = "\n".join(f"MARKER/{n},PART=2" for n in range(100))
    assert "MARKER/99, PART=2\nMARKER/5, PART=2\n" in formatted(
        f"same\n{text}\nMARK/5,PART=2\nEND\n", "deck"
    )
    assert len(forms) == 102  # and once more what was written out


def test_blanks_in_a_text_are_part_of_what_it_says() -> None:
    """Words of a text without quotes are tokens of their own."""
    one, other = (
        next(outline.statements(f"REQUEST/1, {title}", 0, 99, "deck"))
        for title in ("TITLE=a  b", "TITLE=a b")
    )
    assert [token[:2] for token in one.tokens] == [token[:2] for token in other.tokens]
    assert not one.says(other)


def test_a_text_of_which_too_much_cannot_be_read_stays_as_it_is() -> None:
    good, bad = "PART/1,GROUND\n", "nothing at all\n"  # three words
    some, many = (f"mistakes\n{good}{bad * count}END\n" for count in (33_333, 33_334))
    assert formatted(some, "deck") == some.replace("1,G", "1, G")
    assert formatted(many, "deck") == many


def test_statements_that_are_passed_over_are_no_mistakes() -> None:
    text = "files\nPART/1,GROUND\n" + "FLEX_BODY/1, CM=2\n" * 15_000 + "END\n"
    assert "PART/1, GROUND" in formatted(text, "deck")


def test_an_expression_that_is_too_long_to_be_read_stays_as_it_is() -> None:
    for terms, laid_out in ((1000, True), (50_001, False)):
        text = f"sums\nVARIABLE/1,FUNCTION=1{'+1' * terms}\nEND\n"
        assert (formatted(text, "deck") != text) == laid_out


@pytest.mark.parametrize(
    ("line", "apart"),
    [
        ("PART/1,GROUND;PART/2,MASS=1 ! adamslite: ignore massless", False),
        ("PART/1,GROUND;PART/2,MASS=1 ! a comment", True),
        ("PART/1,GROUND\nPART/2,MASS=1;PART/3,MASS=1 ! adamslite: ignore massless", False),
        ('STRING/1,STRING="a!b";PART/2,MASS=1 ! adamslite: ignore massless', False),
        ("PART/1,GROUND ! adamslite: ignore massless\nPART/2,MASS=1;PART/3,MASS=1", True),
    ],
)
def test_statements_stay_in_a_line_whose_comment_ignores_messages(line: str, apart: bool) -> None:
    """60 000 statements in one line took 10 s: the end of the line was looked at for each."""
    found = formatted(f"lines\n{line}\nEND\n", "deck")
    assert (";" not in found) == apart
