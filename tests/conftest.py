"""What all tests share: one folder of compiled code, so that a shape is compiled only once."""

import os
from collections.abc import Iterator
from pathlib import Path

import pytest


@pytest.fixture(scope="session", autouse=True)
def compiled_code(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Path]:
    """The cache folder of this session; the user's own is neither read nor written."""
    given = os.environ.get("ADAMSLITE_CACHE")
    folder = Path(given) if given else tmp_path_factory.mktemp("compiled")
    os.environ["ADAMSLITE_CACHE"] = str(folder)
    yield folder
    if given is None:
        del os.environ["ADAMSLITE_CACHE"]
