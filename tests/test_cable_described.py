"""Descriptions in decks/cables/described and docs/reference/cable-command.md, and their decks."""

import re
from pathlib import Path

import pytest
from tiers import fast
from written import assert_same_text

import adamslite
from adamslite.cables.deck.scene import deck
from adamslite.cables.description.messages import MESSAGES
from adamslite.resources import find

FOLDERS = ("described", "hoists", "sheaves", "water", "winches")
DESCRIBED = sorted(
    path
    for folder in FOLDERS
    for path in (find("decks") / "cables" / folder).glob("*.toml")
    if path.stem != "published"
)
PAGE = Path(__file__).parent.parent / "docs" / "reference" / "cable-command.md"


@pytest.mark.parametrize("path", DESCRIBED, ids=lambda path: path.stem)
def test_the_deck_beside_a_description_is_what_the_command_writes(path: Path) -> None:
    """Places too, though they are found by iteration."""
    written, warnings = deck(path.read_text(encoding="utf-8"))
    kept = path.with_suffix(".adm").read_text(encoding="utf-8")
    assert not warnings
    assert_same_text(written, kept)


def test_the_page_has_every_message() -> None:
    page = PAGE.read_text(encoding="utf-8")
    for code, message in MESSAGES.items():
        assert f"| `{code}`" in page
        assert f"| {message.sentence} | {message.hint} |" in page


def examples() -> list[str]:
    """The descriptions of the page."""
    return re.findall(r"```toml\n(.*?)```", PAGE.read_text(encoding="utf-8"), re.DOTALL)


@pytest.mark.parametrize("number", fast(range(len(examples())), *range(5), *range(7, 99)))
def test_an_example_of_the_page_is_a_scene(number: int) -> None:
    """Its deck has no mistakes, and runs for a while."""
    text, _ = deck(examples()[number])
    assert not any(each.is_error for each in adamslite.check(adamslite.read(text)))
    text = re.sub(r"SIMULATE/DYNAMIC, END=.*", "SIMULATE/DYNAMIC, END=0.01, STEPS=2", text)
    assert adamslite.simulate(adamslite.read(text)).outcome.name == "DONE"
