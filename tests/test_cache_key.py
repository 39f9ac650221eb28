"""What the name of a kept piece of code covers: every source file that shapes it."""

from __future__ import annotations

import ast
import os
import shutil
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest
from tiers import every

import adamslite
from adamslite import resources
from adamslite.caching.sources import PACKAGE, covered, digest_of, version_of
from adamslite.equations.engine import HERE, OPERATIONS
from adamslite.language.method import declared
from adamslite.syntax.forms import _grammars

# Modules from whose import graph the digests of kernels and of the entries are worked out.
ENGINE = ("equations.engine", "equations.operations")
METHODS = sorted({method.entry for method in declared()})
ROOTS = {
    "kernels": ("kernels.compile",),
    "operations": ENGINE,
    **{entry: ("equations.engine", entry[len(HERE) :].rpartition(".")[0]) for entry in METHODS},
}
# Rooms whose work is done before code is shaped: the deck that they read is part of the key.
READ = tuple(
    str(Path(PACKAGE) / room)
    for room in ("syntax", "reading", "checks", "deck", "language", "resources.py")
)
ENGINE_NUMBERS = b"    ACCELERATIONS,\n    EQUILIBRIUM,\n    RECORD,\n"
SWAPPED = b"    EQUILIBRIUM,\n    ACCELERATIONS,\n    RECORD,\n"


@pytest.fixture(scope="module")
def copy(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Path]:
    """The sources of the package, to be changed; this process counts as begun after the copy."""
    folder = tmp_path_factory.mktemp("copy") / "adamslite"
    shutil.copytree(PACKAGE, folder, ignore=shutil.ignore_patterns("__pycache__", "decks"))
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(adamslite, "STARTED", float("inf"))
        yield folder


@pytest.mark.parametrize("root", every(len(ROOTS), reversed(ROOTS)))
def test_a_change_of_any_file_that_shapes_code_gives_a_new_key(root: str, copy: Path) -> None:
    package = str(copy)
    before = digest_of(package, *ROOTS[root])
    paths = [*covered(package, *ROOTS[root])]
    assert len(paths) > 20
    for path in paths:
        content = Path(path).read_bytes()
        Path(path).write_bytes(content + b"#")
        assert digest_of(package, *ROOTS[root]) != before, path
        Path(path).write_bytes(content)
    assert digest_of(package, *ROOTS[root]) == before


def test_swapped_numbers_of_two_operations_give_a_new_key(copy: Path) -> None:
    """The size of the file stays, and its time is put back, as some tools do that install."""
    file, before = copy / "integrators" / "contract.py", digest_of(str(copy), *ENGINE)
    content, facts = file.read_bytes(), file.stat()
    assert ENGINE_NUMBERS in content
    file.write_bytes(content.replace(ENGINE_NUMBERS, SWAPPED))
    os.utime(file, ns=(facts.st_atime_ns, facts.st_mtime_ns))
    assert digest_of(str(copy), *ENGINE) != before
    file.write_bytes(content)


def test_a_file_replaced_while_the_process_runs_gives_a_key_of_its_own(copy, caplog) -> None:
    """What runs may be the old file: neither its code nor the new one's is found under that key."""
    before = digest_of(str(copy), *ENGINE)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(
            adamslite, "STARTED", (copy / "integrators" / "contract.py").stat().st_ctime - 1.0
        )
        assert digest_of(str(copy), *ENGINE) != before
    assert len(caplog.messages) == 1 and "is newer than this process" in caplog.text


def imports(file: Path) -> set[str]:
    """Modules of the package that a file imports, by its syntax tree."""
    found = set()
    for node in ast.walk(ast.parse(file.read_text(encoding="utf-8"))):
        if isinstance(node, ast.ImportFrom):
            assert node.level == 0, f"{file}: imports name the package"
            parts = (node.module, *(f"{node.module}.{name.name}" for name in node.names))
        else:
            names = node.names if isinstance(node, ast.Import) else ()
            parts = tuple(name.name for name in names)
        found |= {part for part in map(str, parts) if part.startswith("adamslite.")}
    return {part for part in found if source(part)}


def source(module: str) -> Path | None:
    """The file of a module."""
    place = Path(PACKAGE).parent.joinpath(*module.split("."))
    files = (place.with_suffix(".py"), place / "__init__.py")
    return next((file for file in files if file.is_file()), None)


@pytest.mark.parametrize("root", every(3, ROOTS))
def test_the_graph_is_that_of_the_syntax_trees(root: str) -> None:
    files = [*map(Path, covered(PACKAGE, *ROOTS[root]))]
    for file in files:
        assert {source(module) for module in imports(file)} <= {*files}, file


SHAPE = """\
import sys
{work}
found = [getattr(m, "__file__", None) for n, m in sys.modules.items() if n.startswith("adamslite")]
print(*filter(None, found))
"""
DECK = "a\\nPART/1,GROUND\\nPOINT_MASS/2,MASS=1\\nACCGRAV/JGRAV=-9.81\\nEND\\n"
SHAPED = f"""
import adamslite as al
from adamslite.kernels.compile import compile_model
compile_model(al.assemble(al.read("{DECK}")))
"""
TRANSLATED = "from adamslite.equations.engine import engine_parts; engine_parts({entry!r})"


@pytest.mark.parametrize("root", every(3, ROOTS))
def test_all_that_is_loaded_while_code_is_shaped_is_covered(root: str, tmp_path: Path) -> None:
    """Imports that no import statement names would be missing from the graph."""
    entry = OPERATIONS if root == "operations" else root
    work = SHAPED if root == "kernels" else TRANSLATED.format(entry=entry)
    code = SHAPE.format(work=work)
    environment = {**os.environ, "ADAMSLITE_CACHE": str(tmp_path / "cache")}
    environment["PYTHONPATH"] = str(Path(PACKAGE).parent)
    ran = subprocess.run([sys.executable, "-c", code], capture_output=True, env=environment)
    loaded = {*ran.stdout.decode().split()}
    assert loaded, ran.stderr.decode()
    known = {*covered(PACKAGE, *ROOTS[root])}
    assert {file for file in loaded if not file.startswith(READ)} <= known


def test_a_change_of_any_grammar_gives_parser_tables_a_new_name(tmp_path: Path) -> None:
    """The grammars import each other."""
    shutil.copytree(resources.find("grammar"), tmp_path, dirs_exist_ok=True)
    seen = {_grammars(tmp_path)}
    for number, file in enumerate(sorted(tmp_path.glob("*.lark"))):
        file.write_bytes(file.read_bytes() + b"\n")
        _grammars.cache_clear()
        seen.add(_grammars(tmp_path))
        assert len(seen) == number + 2
    assert len(seen) > 2


def test_a_key_is_the_same_in_every_process() -> None:
    code = f"from adamslite.caching.sources import version_of; print(version_of(*{ENGINE}))"
    environment = {**os.environ, "PYTHONPATH": str(Path(PACKAGE).parent)}
    ran = subprocess.run([sys.executable, "-c", code], capture_output=True, env=environment)
    assert ran.stdout.decode().strip() == version_of(*ENGINE)
