"""Habits of this code that a reader may rely on."""

import ast
from pathlib import Path

import pytest

import adamslite

PACKAGE = Path(adamslite.__file__).parent
#: Methods of a path that read or write a text.
TEXTS = ("read_text", "write_text")
FILES = sorted(path for path in PACKAGE.rglob("*.py") if "decks" not in path.parts)


@pytest.fixture(scope="module")
def trees() -> dict[str, list[ast.AST]]:
    """The nodes of the syntax tree of every file."""
    return {
        str(file.relative_to(PACKAGE)): [*ast.walk(ast.parse(file.read_text(encoding="utf-8")))]
        for file in FILES
    }


def test_no_text_is_ever_run_as_python(trees: dict[str, list[ast.AST]]) -> None:
    run = {"eval", "exec", "sympify", "parse_expr"}
    for file, nodes in trees.items():
        called = {
            node.func.id if isinstance(node.func, ast.Name) else getattr(node.func, "attr", "")
            for node in nodes
            if isinstance(node, ast.Call)
        }
        assert not called & run, file


def test_only_the_command_line_leaves_and_nothing_is_caught_unnamed(
    trees: dict[str, list[ast.AST]],
) -> None:
    for file, nodes in trees.items():
        handlers = [node for node in nodes if isinstance(node, ast.ExceptHandler)]
        assert all(node.type is not None for node in handlers), file
        if file != "__main__.py":
            names = {node.attr for node in nodes if isinstance(node, ast.Attribute)}
            assert "exit" not in names, file


def test_texts_are_read_and_written_in_a_named_code(trees: dict[str, list[ast.AST]]) -> None:
    """What is left out is the code of the system, another one on every second machine."""
    for file, nodes in trees.items():
        for call in (node for node in nodes if isinstance(node, ast.Call)):
            named = {keyword.arg for keyword in call.keywords}
            if isinstance(call.func, ast.Attribute) and call.func.attr in TEXTS:
                assert "encoding" in named, f"{file}:{call.lineno}"
            elif isinstance(call.func, ast.Name) and call.func.id == "open":
                binary = len(call.args) > 1 and "b" in ast.unparse(call.args[1])
                assert binary or "encoding" in named, f"{file}:{call.lineno}"


def test_a_file_has_at_most_400_lines() -> None:
    for file in [*FILES, *Path(__file__).parent.glob("*.py")]:
        assert len(file.read_text(encoding="utf-8").splitlines()) <= 400, file


def test_the_readme_opens_with_the_pipeline_of_the_package() -> None:
    diagram = adamslite.__doc__.strip().partition("\n\n")[0]
    readme = PACKAGE.parent / "README.md"
    assert diagram in readme.read_text()


def test_the_first_deck_of_the_readme_is_the_one_in_decks() -> None:
    deck = PACKAGE.parent / "decks" / "hanging-mass" / "hanging-mass.adm"
    readme = (PACKAGE.parent / "README.md").read_text(encoding="utf-8")
    assert f"```\n{deck.read_text(encoding='utf-8')}```\n" in readme
