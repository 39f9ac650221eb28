"""README.md: short, and every block of it does what it shows.

.ci/run runs the commands that install.
"""

from pathlib import Path

import pytest
from page_blocks import ROOT, Reader, blocks

README = ROOT / "README.md"
LONGEST = 250
# What is written here; tests/test_manual.py compares the pages that the program writes.
PAGES = [README, ROOT / "docs" / "background" / "vforce-sign.md"]


def test_it_is_short() -> None:
    assert len(README.read_text(encoding="utf-8").splitlines()) < LONGEST


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_every_block_prints_what_the_page_shows(page: Path, tmp_path: Path) -> None:
    Reader(page, tmp_path).follow()


def test_only_installations_and_the_diagram_are_not_run() -> None:
    left_out = [
        block for block in blocks(README.read_text(encoding="utf-8"))
        if block.word("not run") is not None
    ]  # fmt: skip
    assert [block.text.split()[0] for block in left_out] == ["python3", "text", "python3"]
    script = (ROOT / ".ci" / "run").read_text(encoding="utf-8")
    for needed, block in (("adamslite solve", left_out[0]), ("pytest", left_out[2])):
        assert f"$(readme '{needed}')" in script.replace("readme pytest", "readme 'pytest'")
        assert needed in block.text


def test_a_page_for_every_part_of_the_site_is_linked() -> None:
    text = README.read_text(encoding="utf-8")
    parts = {page.parent.name for page in (ROOT / "docs").glob("*/index.md")}
    assert parts and all(f"](docs/{part}/index.md)" in text for part in parts)
