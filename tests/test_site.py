"""Tables of contents of the site: `python -m sphinx -W` in .ci/run builds it."""

import re
from pathlib import Path

import pytest

DOCS = Path(__file__).parent.parent / "docs"
TOCTREE = re.compile(r"^```\{toctree\}\n(.*?)^```", re.M | re.S)
ELSEWHERE = {"index", "decisions"}
"""The page itself, and one that the contents of background list."""
INDEXES = sorted(DOCS.glob("**/index.md"))


@pytest.mark.parametrize("index", INDEXES, ids=lambda index: str(index.parent.relative_to(DOCS)))
def test_every_page_of_a_folder_is_in_its_contents(index: Path) -> None:
    text = index.read_text(encoding="utf-8")
    listed = {line for tree in TOCTREE.findall(text) for line in tree.splitlines()}
    pages = {page.stem for kind in ("md", "ipynb") for page in index.parent.glob(f"*.{kind}")}
    assert ":glob:" in listed or pages <= listed | ELSEWHERE
