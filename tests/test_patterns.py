"""Statements read by a pattern are what the long way reads, messages and places included."""

from __future__ import annotations

from array import array
from pathlib import Path

import pytest

import adamslite as al
from adamslite.language.diagnostics import DeckError, Diagnostic, Source
from adamslite.language.statement import Statement
from adamslite.reading import patterns
from adamslite.reading.patterns import Pattern, Patterns
from adamslite.resources import find
from adamslite.syntax.syntax_errors import Waiting

HEAD = """masses in a row
UNITS/SYSTEM=MKS
PART/1, GROUND
MARKER/1, PART=1
VARIABLE/90, FUNCTION=TIME
SPLINE/7, X=0,1,2,3, Y=0,1,4,9
"""
MASS = """POINT_MASS/{i}, MASS={mass}, CM={i}, QG={i},0.5,-2
MARKER/{i}, POINT_MASS={i}
SFORCE/{i}, TRANSLATIONAL, I={i}, J={j}
, FUNCTION=-{k}*(DM({i},{j})-1)-2*VR({i},{j})+STEP(TIME, 0, 0, 1, {i})*AKISPL(TIME, 0, 7)
GFORCE/{i}, I={i}, JFLOAT={float}, RM=1, FX=VARVAL(90)\\ FY=0\\ FZ=-PI*{k}\\ TX=0\\ TY=0\\ TZ=0
MARKER/{float}, PART=1, FLOATING
REQUEST/{i}, F2=DX({i}, {j})\\ F3=5
"""
COUNT = 8


def deck(**changed: str) -> str:
    """A row of masses; ``changed``: what the words of the sixth are instead."""
    text = HEAD
    for i in range(2, COUNT + 2):
        words = {"i": str(i), "j": str(i - 1), "mass": f"0.{i}", "k": "1E4", "float": str(1000 + i)}
        text += MASS.format(**(words | changed if i == 7 else words))
    return text + "END\n"


def said(
    text: str | Path,
) -> tuple[list[tuple[object, ...]], list[Diagnostic]]:
    """All statements with the ranges of their arguments, and all messages."""
    try:
        read = al.read(text)
        messages = list(read.warnings)
    except DeckError as fault:
        assert fault.deck is not None
        read, messages = fault.deck, list(fault.diagnostics)
    return [_facts(each) for each in read.own], messages


def _facts(statement: Statement) -> tuple[object, ...]:
    values = {name: getattr(statement, name) for name in statement.arguments}
    return statement.label, repr(values), statement.spans.ranges, statement.spans.whole_range


def long_way(monkeypatch: pytest.MonkeyPatch, text: str | Path) -> object:
    with monkeypatch.context() as patch:
        patch.setattr(patterns, "COMMON", 10**9)
        return said(text)


def fitted_ones(monkeypatch: pytest.MonkeyPatch, text: str) -> int:
    """How many statements a pattern reads."""
    count = 0
    fitted = Patterns.fitted

    def counted(self: Patterns, *args: object) -> object:
        nonlocal count
        found = fitted(self, *args)
        count += found is not None
        return found

    with monkeypatch.context() as patch:
        patch.setattr(Patterns, "fitted", counted)
        said(text)
    return count


def test_most_statements_of_a_row_have_a_pattern(monkeypatch: pytest.MonkeyPatch) -> None:
    """Of seven statements of each mass all but the first three are read by a pattern, but for those
    with a rule for their numbers (STEP) and with vectors' markers that follow.
    """
    assert fitted_ones(monkeypatch, deck()) >= 5 * (COUNT - patterns.COMMON)
    assert said(deck()) == long_way(monkeypatch, deck())


@pytest.mark.parametrize("changed", [
    {"mass": "1E999"},
    {"mass": "3D"},
    {"mass": "-0.5"},
    {"mass": "2*3"},
    {"j": "4711"},
    {"j": "0"},
    {"j": "007"},
    {"j": "6.0"},
    {"k": "1E999"},
    {"k": "30D"},
    {"k": "0"},
    {"i": "6"},
    {"float": "99999999999999999999"},
], ids=str)  # fmt: skip
def test_what_does_not_fit_is_read_the_long_way(
    monkeypatch: pytest.MonkeyPatch, changed: dict[str, str]
) -> None:
    assert said(deck(**changed)) == long_way(monkeypatch, deck(**changed))


def test_a_name_of_several_words_is_no_number(monkeypatch: pytest.MonkeyPatch) -> None:
    """``VARVAL(d(5)/dt)`` is the VARIABLE of that name, where there is one."""
    text, numbers = "title\nPART/1, GROUND\n", range(2, COUNT + 2)
    for i in numbers:
        text += f"! adams_view_name='d({i})/dt'\nVARIABLE/{100 + i}, FUNCTION={i}\n"
    for i in numbers:
        text += f"VARIABLE/{i}, FUNCTION=VARVAL(d({i})/dt)\n"
    assert said(text + "END\n") == long_way(monkeypatch, text + "END\n")


def test_an_editor_is_told_of_every_place(monkeypatch: pytest.MonkeyPatch) -> None:
    """Who indexes the places that refer to a statement has all of them read the long way."""
    from adamslite.deck.names import Names

    class Index(Names):
        def used(self, kind: str, key: object, start: int, end: int) -> None: ...

    assert Patterns(Names(), Source("")).useful and not Patterns(Index(), Source("")).useful


@pytest.mark.slow
def test_all_decks_are_read_as_before(monkeypatch: pytest.MonkeyPatch) -> None:
    for path in sorted(find("decks").rglob("*.adm")):
        with monkeypatch.context() as patch:
            patch.setattr(patterns, "COMMON", 1)
            found = said(path)
        assert found == long_way(monkeypatch, path), path


def test_a_pattern_is_made_of_plain_values() -> None:
    source = Source("END")
    waiting = Waiting(("NAME",), ("END",), array("I", [0]), ((), None, True, ()))
    values, spans, _ = Pattern((), (), ()).read(source, waiting)
    assert values == {} and [*spans] == [] and spans.whole_range == (0, 3)
