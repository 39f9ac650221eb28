"""Comments `! adamslite: ignore CODE`: on their line, for warnings and notes, never for errors."""

from __future__ import annotations

import pytest
from decklets import told
from test_messages import BROKEN, USER, whole

from adamslite.language.diagnostics import ERROR
from adamslite.language.messages import MESSAGES, START
from adamslite.reading.read import read, read_commands

PART = "PART/4, MASS=1, CM=4"
MARKER = "\nMARKER/4, PART=4\n"


def codes(statements: str) -> list[str]:
    return [each.code for each in told(START + statements + "\n")]


@pytest.mark.parametrize(
    "comment",
    [
        "! adamslite: ignore no-inertia",
        "!adamslite:ignore no-inertia",
        "! # adamslite: ignore no-inertia",
        "! a point would do # adamslite: ignore no-inertia",
        "! ADAMSLITE: Ignore NO-INERTIA because it never turns",
    ],
)
def test_a_comment_ignores_a_warning_on_its_line(comment: str) -> None:
    assert codes(PART + MARKER) == ["no-inertia"]
    assert codes(f"{PART} {comment}{MARKER}") == []


def test_a_comment_works_on_its_line_only() -> None:
    comment = "! adamslite: ignore no-inertia"
    assert codes(f"{PART}{MARKER}{comment}") == ["no-inertia", "ignores-nothing"]
    assert codes(f"{comment}\n{PART}{MARKER}") == ["ignores-nothing", "no-inertia"]


def test_a_comment_on_any_line_of_a_statement_is_on_its_line() -> None:
    assert codes(f"PART/4, MASS=1\n, CM=4 ! adamslite: ignore no-inertia{MARKER}") == []


def test_only_the_named_codes_are_ignored() -> None:
    comment = "! adamslite: ignore no-effect, no-inertia"
    assert codes(f"{PART} {comment}{MARKER}") == ["ignores-nothing"]
    assert codes(f"{PART} ! adamslite: ignore no-effect{MARKER}") == [
        "no-inertia",
        "ignores-nothing",
    ]


def test_an_error_is_never_ignored() -> None:
    text = "PART/4 ! adamslite: ignore no-mass"
    found = told(f"{START}{text}\n")
    assert [(each.code, each.severity) for each in found] == [
        ("no-mass", "error"),
        ("ignored-error", "warning"),
    ]
    assert "errors cannot be ignored" in found[1].message
    start = text.index("no-mass")
    assert (found[1].span.column, found[1].span.end_column) == (start + 1, len(text) + 1)


def test_a_deck_with_errors_keeps_quiet_about_comments_that_ignore_nothing() -> None:
    """What the rules for sound decks would have said is not known."""
    assert codes("PART/4\nPART/5, GROUND ! adamslite: ignore effective-mass") == [
        "no-mass",
        "two-grounds",
    ]


def test_an_unknown_code_is_answered_with_one_that_is_like_it() -> None:
    (note,) = told(f"{START}! adamslite: ignore no-inertias\n")
    assert note.severity == "note" and "no-inertia" in note.hint


def test_a_comment_without_a_code_is_answered_with_the_form() -> None:
    text = "MARKER/4, PART=1 ! adamslite: ignore"
    (note,) = told(f"{START}{text}\n")
    assert note.code == "ignores-nothing" and "ignore CODE" in note.hint
    assert (note.span.column, note.span.end_column) == (text.index("adams") + 1, len(text) + 1)


def test_a_message_of_several_places_keeps_those_that_are_not_ignored() -> None:
    comment = " ! adamslite: ignore passed-over"
    first, second = "STRING/1, STRING=a", "MATERIAL/1, YOUNGS_MODULUS=1"
    line = START.count("\n") + 1
    (both,) = told(f"{START}{first}\n{second}\n")
    assert [place.line for place in both.places] == [line, line + 1]
    (left,) = told(f"{START}{second}{comment}\n{second.replace('/1', '/2')}\n")
    assert (left.span.line, left.source_line[:10]) == (line + 1, "MATERIAL/2")
    assert left.places == (left.span,)
    assert codes(f"{second}{comment}\n{second.replace('/1', '/2')}{comment}") == []


def test_words_that_are_no_comment_ignore_nothing() -> None:
    """The title, and a comment that speaks of the word."""
    assert told("adamslite: ignore no-mass\n" + START.partition("\n")[2]) == []
    assert codes("! write adamslite: ignore CODE") == []


def test_a_command_file_has_comments_of_its_own() -> None:
    deck = read(START)
    words = "PREFERENCES/SOLVER=FORTRAN ! adamslite: ignore {}\nSIMULATE/DYNAMIC, END=1, STEPS=1\n"
    told_of = {
        code: [each.code for each in read_commands(words.format(code), deck).warnings]
        for code in ("passed-over", "no-inertia")
    }
    assert told_of["no-inertia"][-1] == "ignores-nothing"
    assert "ignores-nothing" not in told_of["passed-over"]


def test_a_comment_of_the_deck_about_an_error_is_reported_once() -> None:
    deck = read(START + "MARKER/4, PART=1 ! adamslite: ignore no-mass\n")
    commands = read_commands("PART/2, MASS=2\nSIMULATE/DYNAMIC, END=1, STEPS=1\n", deck)
    assert commands.warnings == ()


QUIET = [(code, broken) for code, broken in BROKEN if MESSAGES[code].severity != ERROR]


@pytest.mark.parametrize(("code", "broken"), QUIET)
def test_every_warning_and_note_can_be_ignored_on_its_line(code: str, broken: str) -> None:
    user = USER.get((code, broken))
    lines = whole(code, broken).split("\n")
    if code in ("ignored-error", "ignores-nothing"):
        return
    for each in told("\n".join(lines), user):
        for place in each.everywhere:
            lines[place.line - 1] += f" ! adamslite: ignore {code}"
    assert told("\n".join(lines), user) == []
