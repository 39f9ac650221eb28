"""The manual is what the program says about itself, and the files in docs/ are up to date."""

import runpy
from pathlib import Path

import pytest

from adamslite import manual
from adamslite.cli import main
from adamslite.language.function import FUNCTIONS
from adamslite.language.messages import MESSAGES
from adamslite.language.statement import STATEMENTS

DOCS = Path(__file__).parent.parent / "docs"
PAGES = runpy.run_path(str(DOCS / "generate.py"))["PAGES"]


@pytest.mark.parametrize("name", PAGES)
def test_the_files_in_docs_are_up_to_date(name: str) -> None:
    written = (DOCS / name).read_text(encoding="utf-8")
    assert written == PAGES[name](), "run: python docs/generate.py"


@pytest.mark.parametrize("keyword", STATEMENTS)
def test_every_argument_of_a_statement_is_on_its_page(keyword: str) -> None:
    cls = STATEMENTS[keyword]
    page = manual.statement(cls)
    for argument in cls.arguments.values():
        assert argument.help in page
        assert all(key in page for key in argument.keys)


@pytest.mark.parametrize(
    "register", [STATEMENTS, FUNCTIONS, MESSAGES, manual.TOPICS], ids=["st", "fn", "msg", "topic"]
)
def test_help_knows_every_name(register: dict, capsys: pytest.CaptureFixture[str]) -> None:
    for name in register:
        assert main.main(["help", name.lower()]) == 0
        assert name.casefold() in capsys.readouterr().out.casefold()


def test_a_name_may_be_a_statement_and_a_function() -> None:
    page = manual.pages("sforce")
    assert "## SFORCE: " in page and "### `SFORCE(id, jflag, comp[, rm])`" in page


def test_help_suggests_a_name(capsys: pytest.CaptureFixture[str]) -> None:
    assert main.main(["help", "SPRINGDAMPR"]) == 2
    assert "did you mean SPRINGDAMPER?" in capsys.readouterr().err
    assert main.main(["help", "sim"]) == 2
    assert "did you mean SIMULATE?" in capsys.readouterr().err


def test_help_without_a_name_lists_them(capsys: pytest.CaptureFixture[str]) -> None:
    assert main.main(["help"]) == 0
    listed = capsys.readouterr().out
    assert all(name in listed for name in (*STATEMENTS, *FUNCTIONS))
