"""Compiled modules between runs: what runs is what the sources say."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from replacing import replaced

import adamslite
from adamslite import resources
from adamslite.caching import contents, modules
from adamslite.caching.modules import Finder, Loader, kept_modules
from adamslite.caching.program import PACKAGE

DECK = """a mass at rest
PART/1, GROUND
MARKER/1, PART=1
POINT_MASS/2, MASS=2
END
"""
LOADED = """\
import sys
from adamslite.caching.modules import Loader
from adamslite.cli.main import main
sys.argv = ["adamslite", "check", "rest.adm"]
main()
loaders = [m.__spec__.loader for n, m in sys.modules.items() if n.startswith("adamslite.")]
found = [each for each in loaders if type(each) is Loader]
print(len(found), len(found[0].finder.fresh) if found else 0)
"""


@pytest.fixture
def package(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A copy of the program, a deck, and a cache of its own."""
    source, copy = Path(PACKAGE), tmp_path / "lib" / "adamslite"
    shutil.copytree(source, copy, ignore=shutil.ignore_patterns("__pycache__", "decks", "page"))
    shutil.copytree(resources.find("grammar"), tmp_path / "lib" / "grammar")
    (tmp_path / "rest.adm").write_text(DECK)
    monkeypatch.chdir(tmp_path)
    return copy


def run(package: Path, code: str, **environment: str) -> str:
    """What a process with that copy prints."""
    env = {name: text for name, text in os.environ.items() if name != "PYTHONDONTWRITEBYTECODE"}
    env |= {"PYTHONPATH": str(package.parent), "ADAMSLITE_CACHE": str(package.parents[1] / "kept")}
    ran = subprocess.run(
        [sys.executable, "-c", code], env=env | environment, capture_output=True, text=True
    )
    assert ran.returncode == 0, ran.stderr
    return ran.stdout + ran.stderr


def counts(printed: str) -> list[int]:
    """Modules that came by the loader, and those of them that it compiled."""
    return [int(word) for word in printed.splitlines()[-1].split()]


@pytest.mark.parametrize("written", ("", "1"))
def test_a_second_run_compiles_nothing_and_a_changed_source_is_seen(package, written) -> None:
    """Whether Python writes its own files or not; these it takes for current by size and time."""
    first = run(package, LOADED, PYTHONDONTWRITEBYTECODE=written)
    again = run(package, LOADED, PYTHONDONTWRITEBYTECODE=written)
    some, fresh = counts(first)
    assert some == fresh > 100 and "1 POINT_MASS" in first
    # The text of the check is kept by now, so that less is imported.
    some, fresh = counts(again)
    assert fresh == 0 and again.splitlines()[:-1] == first.splitlines()[:-1]
    replaced(package / "api" / "checks.py", "'degree'", "'DEGREE'")
    third = run(package, LOADED, PYTHONDONTWRITEBYTECODE=written)
    assert "3 DEGREEs of freedom" in third and counts(third)[1] > 100


def test_a_damaged_entry_is_rebuilt(package) -> None:
    run(package, LOADED)
    (file,) = (package.parents[1] / "kept").glob("modules*")
    content = file.read_bytes()
    file.write_bytes(content[:-100])
    assert f"{file} is rebuilt" in run(package, LOADED)
    assert "is rebuilt" not in run(package, LOADED)


def test_tracebacks_and_sources_are_those_of_the_files(package) -> None:
    code = LOADED + (
        "import inspect, adamslite.api.checks as module\n"
        "try:\n"
        "    module.many(None, None)\n"
        "except TypeError:\n"
        "    import traceback; print(traceback.format_exc())\n"
        "print(inspect.getsource(module.many)[:9], module.__file__, module.__package__)\n"
    )
    for _ in range(2):
        (package.parent.parent / "rest.adm").write_text(DECK + f"! {_}\n")  # checked anew
        printed = run(package, code)
        assert "several or one + 's'" in printed
        assert f"def many( {package / 'api' / 'checks.py'} adamslite.api" in printed


def test_commands_have_entries_of_their_own(cache, monkeypatch) -> None:
    names = {modules._entry("a", command) for command in ("check", "solve")}
    names |= {modules._entry("b", "check")}
    monkeypatch.setattr(sys.implementation, "cache_tag", "other")
    names |= {modules._entry("a", "check")}
    assert len(names) == 4
    assert all(contents.ENTRY.fullmatch(name) for name in names)


def test_nothing_is_left_behind(cache, monkeypatch) -> None:
    before = [*sys.meta_path]
    with pytest.raises(KeyError), kept_modules("check"):
        assert isinstance(sys.meta_path[0], Finder)
        raise KeyError
    assert sys.meta_path == before and not [*cache.glob("modules*")]
    monkeypatch.setattr(adamslite, "STARTED", 0.0)
    modules.program.cache_clear()
    with kept_modules("check"):  # of a program that has changed since: as if it were not there
        assert sys.meta_path == before
    modules.program.cache_clear()


def test_other_modules_are_left_alone(cache) -> None:
    finder = Finder("modules" + "0" * 32 + ".kept")
    assert finder.find_spec("json", None) is None
    assert finder.find_spec("adamslite.none", [PACKAGE]) is None
    spec = finder.find_spec("adamslite.errors", [PACKAGE])
    assert spec is not None and type(spec.loader) is Loader
