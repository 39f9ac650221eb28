"""Pages written by hand: their links lead somewhere, and they name the stages of the package."""

import re
from pathlib import Path

import pytest

import adamslite

ROOT = Path(__file__).parent.parent
PAGES = sorted(
    page
    for pattern in ("*.md", "docs/**/*.md", "decks/**/*.md", "benchmarks/*.md")
    for page in ROOT.glob(pattern)
)


def anchors(page: Path) -> set[str]:
    """The anchors of the headings of a page."""
    heads = re.findall(r"^#+ (.*)$", page.read_text(encoding="utf-8"), re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", head.lower()).replace(" ", "-") for head in heads}


@pytest.mark.parametrize("page", PAGES, ids=lambda page: str(page.relative_to(ROOT)))
def test_links_of_a_page_lead_somewhere(page: Path) -> None:
    for link in re.findall(r"\]\(([^)\s]{3,})\)", page.read_text(encoding="utf-8")):
        if link.startswith("http"):
            continue
        file, _, anchor = link.partition("#")
        target = page.parent / file if file else page
        assert target.exists(), link
        assert not anchor or anchor in anchors(target), link


NAMED = re.compile(r"(?<![\w/])docs/[\w./-]*\w")
SOURCES = sorted(
    file
    for pattern in ("adamslite/**/*.py", "benchmarks/*.py", "decks/**/*.py", "docs/**/*.py",
                    "decks/**/*.adm", "tests/test_*.py", "*.md", "docs/**/*.md", ".ci/*")
    for file in ROOT.glob(pattern)
)  # fmt: skip


def test_pages_that_a_text_names_exist() -> None:
    """Docstrings, messages and comments name pages as docs/reference/messages.md."""
    dead = [
        f"{file.relative_to(ROOT)}: {name}"
        for file in SOURCES
        for name in NAMED.findall(file.read_text(encoding="utf-8", errors="replace"))
        if not (ROOT / name).exists()
    ]
    assert dead == []


def test_every_stage_is_described_for_contributors() -> None:
    text = (ROOT / "docs" / "contributing.md").read_text(encoding="utf-8")
    _, _, after = text.partition("The folders of `adamslite/`")
    stages = {
        folder.parent.name for folder in Path(adamslite.__file__).parent.glob("*/__init__.py")
    }
    assert stages == set(re.findall(r"^\| `(\w+)` \|", after, re.MULTILINE))
