"""Habits of this code that a reader may rely on."""

import ast
from collections.abc import Iterator
from pathlib import Path

import pytest

import adamslite

PACKAGE = Path(adamslite.__file__).parent
FILES = sorted(path for path in PACKAGE.rglob("*.py") if "decks" not in path.parts)


def nodes(file: Path) -> Iterator[ast.AST]:
    """Walk the syntax tree of a file."""
    return ast.walk(ast.parse(file.read_text()))


@pytest.mark.parametrize("file", FILES, ids=lambda file: str(file.relative_to(PACKAGE)))
def test_no_text_is_ever_run_as_python(file: Path) -> None:
    called = {
        node.func.id if isinstance(node.func, ast.Name) else getattr(node.func, "attr", "")
        for node in nodes(file)
        if isinstance(node, ast.Call)
    }
    assert not called & {"eval", "exec", "sympify", "parse_expr"}


@pytest.mark.parametrize("file", FILES, ids=lambda file: str(file.relative_to(PACKAGE)))
def test_only_the_command_line_leaves_and_nothing_is_caught_unnamed(file: Path) -> None:
    for node in nodes(file):
        assert not (isinstance(node, ast.ExceptHandler) and node.type is None)
        if file.name not in ("cli.py", "__main__.py"):
            assert not (isinstance(node, ast.Attribute) and node.attr == "exit")


def test_the_readme_opens_with_the_pipeline_of_the_package() -> None:
    diagram = adamslite.__doc__.strip().partition("\n\n")[0]
    readme = PACKAGE.parent / "README.md"
    assert diagram in readme.read_text()


def test_the_first_deck_of_the_readme_is_the_one_in_decks() -> None:
    deck = PACKAGE.parent / "decks" / "hanging-mass" / "hanging-mass.adm"
    readme = (PACKAGE.parent / "README.md").read_text(encoding="utf-8")
    assert f"```\n{deck.read_text(encoding='utf-8')}```\n" in readme
