"""What all tests share: one folder of compiled code, so that a shape is compiled only once, and the
closed forms and decks of cables, which are modules in decks/cables.

Tests are in two tiers: those marked `numerical` may depend on how a processor rounds, and are run
for several; the others read, check and write texts.
"""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

from adamslite.caching import entries, folder
from adamslite.resources import find

if TYPE_CHECKING:
    from fakes import Pipeline

sys.path.append(str(find("decks") / "cables"))

#: Modules of tests in which no number is computed that a processor could round otherwise.
TEXTUAL = {
    "test_cable_messages", "test_chart", "test_commands", "test_compare", "test_deck",
    "test_doubts", "test_lexical", "test_lowering", "test_manual", "test_messages", "test_pages",
    "test_reference", "test_results", "test_statement", "test_style",
}  # fmt: skip


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Mark the tests that are run for several processors."""
    for item in items:
        if item.path.stem not in TEXTUAL:
            item.add_marker("numerical")


@pytest.fixture(scope="session", autouse=True)
def compiled_code(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Path]:
    """The cache folder of this session; the user's own is neither read nor written.

    Workers of one session share it: an entry is written whole and then renamed.
    """
    given = os.environ.get("ADAMSLITE_CACHE")
    folder = Path(given) if given else _own_folder(tmp_path_factory)
    os.environ["ADAMSLITE_CACHE"] = str(folder)
    yield folder
    if given is None:
        del os.environ["ADAMSLITE_CACHE"]


def _own_folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    base = tmp_path_factory.getbasetemp()
    session = base.parent if "PYTEST_XDIST_WORKER" in os.environ else base
    folder = session / "compiled"
    folder.mkdir(mode=0o700, exist_ok=True)
    return folder


@pytest.fixture
def cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """An empty cache folder for one test."""
    chosen = tmp_path / "cache"
    chosen.mkdir(mode=0o700)
    monkeypatch.setenv("ADAMSLITE_CACHE", str(chosen))
    folder._settled.cache_clear()
    folder._private.cache_clear()
    entries._totals.clear()
    yield chosen.resolve()
    folder._settled.cache_clear()
    folder._private.cache_clear()


@pytest.fixture
def pipeline(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> Pipeline:
    """An empty folder with cable.adm as current directory, and a pipeline that solves nothing."""
    import fakes

    monkeypatch.chdir(tmp_path)
    Path("cable.adm").write_text("a cable\nEND\n")
    parts = (fakes.Named("PART"), fakes.Named("PART"))
    fake = fakes.Pipeline(statements=(*parts, fakes.SIMULATE))
    fakes.install(monkeypatch, fake)
    return fake
