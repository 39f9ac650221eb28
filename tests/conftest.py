"""What all tests share: one folder of compiled code, so that a shape is compiled only once, and the
closed forms and decks of cables, which are modules in decks/cables.
"""

import os
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from adamslite.caching import entries, folder
from adamslite.places import find

sys.path.append(str(find("decks") / "cables"))


@pytest.fixture(scope="session", autouse=True)
def compiled_code(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Path]:
    """The cache folder of this session; the user's own is neither read nor written."""
    given = os.environ.get("ADAMSLITE_CACHE")
    folder = Path(given) if given else tmp_path_factory.mktemp("compiled")
    os.environ["ADAMSLITE_CACHE"] = str(folder)
    yield folder
    if given is None:
        del os.environ["ADAMSLITE_CACHE"]


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
