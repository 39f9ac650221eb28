"""Every word of the language works, is passed over with a note, or is rejected with what to write.

The tables are in tests/spec: one file for statements, one for functions, one for commands.
"""

from __future__ import annotations

import re
import tomllib
from collections.abc import Iterator
from pathlib import Path

import pytest
from decklets import told

import adamslite
from adamslite.checks.rules import check
from adamslite.functions.integration import NUMBERS
from adamslite.language.diagnostics import ERROR, DeckError, Diagnostic
from adamslite.language.messages import START
from adamslite.language.not_supported import COMMANDS, FUNCTIONS, INSTEAD
from adamslite.language.not_supported import STATEMENTS as REJECTED
from adamslite.language.routines import USUAL_NAMES
from adamslite.language.statement import STATEMENTS, Statement
from adamslite.manual import lookup
from adamslite.reading.read import read

SPEC = Path(__file__).parent / "spec"
TABLES = {path.stem: tomllib.loads(path.read_text()) for path in SPEC.glob("*.toml")}
PACKAGE = Path(adamslite.__file__).parent
SOURCES = "\n".join(path.read_text() for path in PACKAGE.rglob("*.py"))
POINTS = "x,y,z\n0,1,2\n1,2,3\n2,3,4\n3,4,5\n"
NOT_SUPPORTED = {
    "planned-statement", "planned-argument", "planned-choice", "planned-function",
    "discontinued-choice",
}  # fmt: skip
BOUND = {name: 0.0 for name in (*USUAL_NAMES.values(), "a::b")} | {
    "CURSUB": (0, 0, 0, 1, 0, 0),
    "c::d": (0, 0, 0, 1, 0, 0),
}
"""Routines of the user, without which a deck that calls them cannot be run."""
Row = tuple[str, str, str, str]


def deck_of(deck: str, written: str = "") -> str:
    """The deck of a row: that of the statement, with an addition, or another one."""
    return f"{deck}{written}" if written.startswith(",") else written or deck


def rows() -> Iterator[Row]:
    """Statement, argument (empty for the statement itself), status and deck."""
    for keyword, entry in TABLES["statements"].items():
        deck = entry["deck"]
        yield keyword, "", entry.get("is", "works"), deck
        for argument, (status, *written) in entry.items():
            if argument not in ("deck", "is"):
                yield keyword, argument, status, deck_of(deck, *written)


ROWS = list(rows())
CALLS = TABLES["functions"]
WORDS = {(keyword, argument.rpartition("=")[2]) for keyword, argument, *_ in ROWS}


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with a table, for decks that read one."""
    made = tmp_path_factory.mktemp("spec")
    (made / "points.csv").write_text(POINTS)
    return made


def reported(deck: str, folder: Path) -> list[Diagnostic]:
    """Everything reported about these statements."""
    text = deck if deck.startswith("title") else START + deck + "\n"
    if "FILE=" not in deck:
        return told(text, BOUND)
    path = folder / "deck.adm"
    path.write_text(text)
    try:
        return check(read(path))
    except DeckError as error:
        return list(error.diagnostics)


@pytest.mark.parametrize("row", ROWS, ids=[" ".join(row[:2]).strip() for row in ROWS])
def test_every_word_of_a_statement_works_or_is_reported(row: Row, folder: Path) -> None:
    keyword, argument, status, deck = row
    found = reported(deck, folder)
    errors = [each for each in found if each.severity == ERROR]
    if status == "refused":
        assert errors and {each.code for each in errors} <= NOT_SUPPORTED
        assert all(each.hint for each in errors)
        return
    assert not errors
    cls = STATEMENTS[keyword]
    whole = cls.inert and not (argument and getattr(cls, "acting", ()))
    word = keyword if whole else f"{keyword} {argument}".strip()
    passed = [each.message for each in found if each.code == "passed-over"]
    assert any(word in message for message in passed) == (status == "inert")


@pytest.mark.parametrize("name", CALLS)
def test_every_function_has_a_value_or_is_rejected_with_what_to_write(name: str) -> None:
    status, expression, *needed = CALLS[name]
    place = "REQUEST/999, F2" if name in NUMBERS else "VARIABLE/999, FUNCTION"
    deck = "\n".join([*needed, f"{place}={expression}"])
    errors = [each for each in told(START + deck + "\n", BOUND) if each.severity == ERROR]
    assert [each.code for each in errors] == ["planned-function"] * (status == "refused")
    assert all(each.hint == INSTEAD[name] for each in errors)


@pytest.mark.parametrize("cls", STATEMENTS.values(), ids=STATEMENTS)
def test_every_argument_of_the_program_is_in_the_table(cls: type[Statement]) -> None:
    if cls.place == "command" or cls.keyword not in TABLES["statements"]:
        return
    words = {word for key, word in WORDS if key == cls.keyword}
    for argument in cls.arguments.values():
        assert words & {*argument.keys, *argument.options}, argument.key


@pytest.mark.parametrize("cls", STATEMENTS.values(), ids=STATEMENTS)
def test_no_argument_is_read_and_forgotten(cls: type[Statement]) -> None:
    idle = {word for key, word, status, _ in ROWS if key == cls.keyword and status != "works"}
    for argument in cls.arguments.values():
        if cls.place == "command" or cls.inert or argument.inert or argument.fills:
            continue
        if not idle & {*argument.keys}:
            used = rf"\.{argument.name}\b(?!\()|[\"']{argument.name}[\"']"
            assert re.search(used, SOURCES), argument.key


NAMES = sorted({*TABLES["statements"], *CALLS, *COMMANDS, *REJECTED, *FUNCTIONS})


@pytest.mark.parametrize("name", NAMES)
def test_help_has_a_page_for_every_name(name: str) -> None:
    assert name in lookup.pages(name)


def test_what_is_rejected_is_known_by_what_to_write_instead() -> None:
    arguments = {f"{key} {word}" for key, cls in STATEMENTS.items() for word in cls.planned}
    assert arguments | REJECTED | FUNCTIONS | COMMANDS <= INSTEAD.keys()


def rejected() -> list[str]:
    """Every statement, argument, function and command of the tables that is rejected."""
    found = [f"{key} {word}".strip() for key, word, status, _ in ROWS if status == "refused"]
    found += [name for name, (status, *_) in CALLS.items() if status == "refused"]
    for command, section in TABLES["commands"].items():
        rows = ((word, row) for word, row in section.items() if word not in ("deck", "without"))
        found += [f"{command} {word}" for word, (status, *_) in rows if status == "refused"]
    return found


def test_little_is_rejected() -> None:
    """What is left: meanings that are not published, and programs of other makers."""
    assert sorted(rejected()) == [
        "AO",
        "BEAM FORMULATION=NONLINEAR",
        "CONTACT FRICTION_FUNCTION",
        "CONTACT NORMAL_FUNCTION",
        "CONTROL CONTROL",
        "FILE COMMAND",
        "FRICTION LUGRE SMOOTH",
        "GSE IMPLICIT",
        "GSE STATICS_ONLY",
        "INVPSD",
        "LINEAR NASTRAN",
        "LINEAR STATEMAT, PSTATE",
        "LSSMATRIX",
        "PFORCE",
        "SYSVAR",
    ]
