"""Tutorials and how-to guides: every block is run, in an empty folder, and prints what it shows."""

from pathlib import Path

import pytest
from page_blocks import ROOT, Reader, agree, blocks
from tiers import fast

from adamslite.language.not_supported import INSTEAD

GUIDES = sorted(
    page
    for room in ("tutorials", "how-to")
    for page in (ROOT / "docs" / room).glob("*.md")
    if page.name != "index.md"
)
name = pytest.mark.parametrize("page", GUIDES, ids=lambda page: f"{page.parent.name}/{page.stem}")
FOLLOWED = fast(
    GUIDES, *(page for page in GUIDES if page.stem in ("first-deck", "compare-results"))
)


@pytest.mark.parametrize(
    "page", FOLLOWED, ids=[f"{page.parent.name}/{page.stem}" for page in GUIDES]
)
def test_a_reader_who_follows_the_page_sees_what_it_shows(page: Path, tmp_path: Path) -> None:
    Reader(page, tmp_path).follow()


@name
def test_what_a_page_does_not_run_has_a_reason(page: Path) -> None:
    left_out = [block.word("not run") for block in blocks(page.read_text(encoding="utf-8"))]
    assert all(reason is None or len(reason) > 5 for reason in left_out)


@pytest.mark.parametrize(
    ("expected", "printed", "same"),
    [
        ("  reached   t = 2", "  reached              t = 2\n", True),
        ("t = 2", "t = 3", False),
        ("1.592 Hz", "1.593 Hz", True),
        ("1.592 Hz", "1.594 Hz", False),
        ("  steps  256 and 0 rejected", "  steps  262 and 1 rejected", True),
        ("  steps  256 and 0 rejected", "  steps  300 and 0 rejected", False),
        ("CPU 0.05 s to set up, 0.00 s to solve", "CPU 6.20 s to set up, 0.31 s to solve", True),
        ("4.972e-07", "4.99e-07", True),
        ("4.972e-07", "6.1e-07", False),
        ("5.551e-17", "3.1e-13", True),
        ("5.551e-17", "3.1e-08", False),
        ("a ... c", "a b c", True),
        ("a ... c", "a b d", False),
        ("RADAU ... 205 6.2e-06", "RADAU 0.793 207 6.21e-06", False),
        ("RADAU ... 205 6.2e-06", "RADAU 0.793 205 6.21e-06", True),
        ("a\n...\nd", "a\nb\nc\nd", True),
        ("a\n...\nd", "a\nb\nc", False),
        ("a", "compiling the equations, once\na", True),
        ("a", "a\nb", False),
        ("", "a", False),
    ],
)
def test_printed_text_agrees(expected: str, printed: str, same: bool) -> None:
    assert agree(expected, printed) == same


BROKEN = {
    "another output": "```console\n$ adamslite help UNITS\nnothing\n```\n",
    "an exit code": "```sh\nadamslite help NOSUCHNAME\n```\n",
    "a Python block": "```python\nprint(2)\n```\n\n```text\n3\n```\n",
    "a file": "<!-- file: hoist.toml -->\n```toml\na = 1\n```\n\n"
    "<!-- part of: hoist.toml -->\n```toml\na = 2\n```\n",
    "a language": "```fortran\nCALL X\n```\n",
}


@pytest.mark.parametrize("fault", BROKEN)
def test_a_page_that_is_wrong_is_noticed(fault: str, tmp_path: Path) -> None:
    page = tmp_path / "page.md"
    page.write_text(BROKEN[fault], encoding="utf-8")
    with pytest.raises(AssertionError, match="page.md:"):
        Reader(page, tmp_path).follow()


def test_what_is_refused_is_on_the_page_for_users_of_adams() -> None:
    page = (ROOT / "docs" / "tutorials" / "coming-from-adams.md").read_text(encoding="utf-8")
    rows = [line for line in page.partition("## Refused")[2].splitlines() if line.startswith("|")]
    for name in INSTEAD:
        words = name.split()
        assert any(all(word in row for word in words) for row in rows), name
