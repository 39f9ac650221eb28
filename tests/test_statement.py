"""The register of statements: every one is documented, and none is known twice."""

from __future__ import annotations

import inspect
import sys
from pathlib import Path

import pytest

import adamslite as al
import adamslite.elements
from adamslite import functions, resources
from adamslite.elements.passed_over import TABLE
from adamslite.language import not_supported
from adamslite.language.function import FUNCTIONS
from adamslite.language.statement import STATEMENTS, Statement

CLASSES = [pytest.param(cls, id=keyword) for keyword, cls in STATEMENTS.items()]
NUMERIC = ("number", "vector", "vectors", "expression")


def test_there_is_one_file_for_each_statement() -> None:
    files = {Path(inspect.getfile(cls)).name for cls in STATEMENTS.values()}
    folder = Path(adamslite.elements.__file__).parent
    assert files == {path.name for path in folder.glob("*.py")} - {"__init__.py"}
    assert len(files - {"passed_over.py"}) == len(STATEMENTS.keys() - TABLE.keys())


@pytest.mark.parametrize("cls", CLASSES)
def test_a_statement_says_what_it_is(cls: type[Statement]) -> None:
    assert cls.__doc__
    assert "Equation" in sys.modules[cls.__module__].__doc__ or cls.keyword in ("REQUEST", "INFO")
    for argument in cls.arguments.values():
        assert argument.help and not argument.help.endswith(".")
        assert argument.unit or argument.kind not in NUMERIC
        assert set(argument.supported) <= set(argument.options)


@pytest.mark.parametrize("cls", CLASSES)
def test_keywords_of_a_statement_are_distinct(cls: type[Statement]) -> None:
    keys = [key for a in cls.arguments.values() for key in a.keys or a.options]
    assert len(keys) == len(set(keys))
    assert not set(keys) & set(cls.planned)
    assert all(key == key.upper() for key in keys)


def test_what_is_supported_is_not_listed_as_missing() -> None:
    assert not set(STATEMENTS) & (not_supported.STATEMENTS | not_supported.COMMANDS)
    assert functions and not set(FUNCTIONS) & not_supported.FUNCTIONS


def test_the_grammar_knows_form_and_no_vocabulary() -> None:
    words = {*STATEMENTS, *FUNCTIONS, *not_supported.STATEMENTS}
    for path in resources.find("grammar").glob("*.lark"):
        rules = "\n".join(line.partition("//")[0] for line in path.read_text().splitlines())
        assert not words & set(rules.replace("|", " ").split())


@pytest.mark.parametrize("name", ["cam", "friction", "hanging-mass"])
def test_every_statement_of_a_deck_has_a_text(name: str) -> None:
    """A CVCV and a FRICTION write statements of other kinds, which point at their places."""
    deck = al.read(Path(f"decks/{name}/{name}.adm"))
    for each in deck.statements:
        assert repr(each).startswith(f"<{each.label} ")
