"""Cases whose decks `adamslite cable` writes: NAME.toml in a folder, NAME.adm beside it."""

from collections.abc import Callable, Mapping
from pathlib import Path

from adamslite.cables.deck.scene import deck


def write(folder: Path, references: Mapping[str, Callable[[], str]]) -> None:
    """Write the deck of every description, and the reference that its function returns."""
    for name, reference in references.items():
        text, _ = deck((folder / f"{name}.toml").read_text(encoding="utf-8"))
        (folder / f"{name}.adm").write_text(text, encoding="utf-8")
        (folder / f"{name}.reference.csv").write_text(reference(), encoding="utf-8")
