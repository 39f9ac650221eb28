"""The manual is what the program says about itself, and the files in docs/ are up to date."""

import runpy
from pathlib import Path

import pytest

from adamslite.cli import main
from adamslite.language.function import FUNCTIONS
from adamslite.language.messages import MESSAGES
from adamslite.language.method import methods
from adamslite.language.statement import STATEMENTS
from adamslite.manual.api import NAMES
from adamslite.manual.lookup import TOPICS, pages
from adamslite.manual.statements import statement
from adamslite.results.outcomes import Outcome

DOCS = Path(__file__).parent.parent / "docs"
PAGES = runpy.run_path(str(DOCS / "generate.py"))["PAGES"]


@pytest.mark.parametrize("name", PAGES)
def test_the_files_in_docs_are_up_to_date(name: str) -> None:
    written = (DOCS / name).read_text(encoding="utf-8")
    assert written == PAGES[name](), "run: python docs/generate.py"


@pytest.mark.parametrize("keyword", STATEMENTS)
def test_every_argument_of_a_statement_is_on_its_page(keyword: str) -> None:
    cls = STATEMENTS[keyword]
    page = statement(cls)
    for argument in cls.arguments.values():
        assert argument.help in page
        assert all(key in page for key in argument.keys)


REGISTERS = {
    "statements": STATEMENTS,
    "functions": FUNCTIONS,
    "integrators": methods(),
    "commands": main.command_parsers(),
    "Python": NAMES,
    "messages": MESSAGES,
    "outcomes": Outcome.__members__,
    "topics": TOPICS,
}


@pytest.mark.parametrize("register", REGISTERS)
def test_help_knows_every_name(register: str, capsys: pytest.CaptureFixture[str]) -> None:
    for name in REGISTERS[register]:
        assert main.main(["help", name.lower()]) == 0
        assert name.casefold() in capsys.readouterr().out.casefold()


@pytest.mark.parametrize("keyword", STATEMENTS)
def test_help_of_an_argument_names_its_statements_and_its_meaning(keyword: str) -> None:
    for argument in STATEMENTS[keyword].arguments.values():
        for key in () if argument.bare else argument.keys:
            assert any(
                keyword in line and argument.help.replace("|", "\\|") in line
                for line in pages(key).splitlines()
            ), key


def test_statements_share_a_row_where_an_argument_means_the_same() -> None:
    page = pages("reuler")
    assert page.startswith("## REULER: an argument")
    assert "| PART, POINT_MASS |" in page and page.count("body 3-1-3 angles") == 2
    assert "| MARKER " in pages("qp") and "PART" not in pages("qp")


def test_help_of_a_command_lists_its_flags() -> None:
    parsers = main.command_parsers()
    page = pages("solve", parsers)
    assert "adamslite solve [DECK] [COMMANDS.acf] [flags]" in page
    assert "| `--integrator NAME`" in page and "--debug" not in page
    assert "SIMULATE" not in pages("cache", parsers)


def test_a_command_is_also_found_as_a_statement() -> None:
    """`linear` is a command, LINEAR a statement of command files."""
    page = pages("linear", main.command_parsers())
    assert "## LINEAR: " in page and "## adamslite linear" in page


def test_a_name_may_be_a_statement_and_a_function() -> None:
    page = pages("sforce")
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


def test_help_in_python_takes_the_names_of_commands() -> None:
    assert pages("solve").startswith("## adamslite.simulate\n")
    assert "## adamslite.linearize" in pages("linear") and "## LINEAR: " in pages("linear")


def test_equations_are_blocks() -> None:
    """The module of ACCGRAV indents its equation, which Markdown takes as code."""
    page = pages("accgrav")
    assert "\n    force on each body at its centre of mass = mass *" in page


def test_help_takes_the_name_of_a_statement_in_a_deck() -> None:
    assert pages("vforce/2") == pages("VFORCE")
