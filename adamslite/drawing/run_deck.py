"""The deck that results belong to."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from pathlib import Path

from adamslite.deck.deck import ANALYSES, Deck
from adamslite.deck.redefinition import Command
from adamslite.elements.part import Part
from adamslite.elements.point_mass import PointMass
from adamslite.errors import FormatError
from adamslite.language.diagnostics import DeckError
from adamslite.language.file_name import leads_out
from adamslite.language.text import MOST, contents, decoded, text_of
from adamslite.results.results import Results

HASH = "deck hash"


def deck_of(results: Results) -> Deck:
    """The deck that results carry along, as it was when their run began.

    Raises
    ------
    FormatError
        When they carry none.
    DeckError
        When it cannot be read.
    """
    if results.source is None:
        raise FormatError("the results carry no deck, and nothing can be drawn without one")
    try:
        return at_start(*results.source.read())
    except DeckError as fault:
        # It has run; what it lacks now are tables, which are not drawn.
        if fault.deck is None or fault.deck.incomplete:
            raise
        return fault.deck


def at_start(deck: Deck, commands: Iterable[Command]) -> Deck:
    """The deck after the commands that precede the first analysis."""
    for command in commands:
        if command.keyword in ANALYSES:
            break
        deck = deck.after(command)
    return deck


def need_its_bodies(deck: Deck, results: Results, file: str) -> None:
    """Reject a deck that has none of the bodies whose motion the results hold.

    Raises
    ------
    FormatError
        In one sentence.
    """
    labels = [each.label for each in moving(deck)]
    if not labels or any(f"{label}.{word}" in results for label in labels for word in "xyz"):
        return
    if results.meta.get(HASH) == deck.hash and len(results.time):
        raise FormatError(f"{file} has no position of a body, and nothing would move")
    what = "no output time" if not len(results.time) else f"no column like {labels[0]}.x"
    raise FormatError(
        f"{file} is no result of {deck.path or deck.title}: it has {what}, and nothing would move"
    )


def moving(deck: Deck) -> Iterator[Part | PointMass]:
    """The bodies of a deck but the ground."""
    yield from (part for part in deck.of(Part) if not part.ground)
    yield from deck.of(PointMass)


def difference(deck: Deck, results: Results) -> str:
    """What to know where the deck is not, letter by letter, the one of the results; else empty."""
    known = results.meta.get(HASH)
    if not known or known == deck.hash:
        return ""
    return (
        "the deck is not the one of these results: its text has changed since, or it is another one"
    )


def beside(path: Path, results: Results) -> Path | None:
    """The deck that lies beside a result file or in the current folder, by its name or its hash."""
    folders = dict.fromkeys((path.parent, Path()))
    named = [folder / f"{path.stem}.adm" for folder in folders]
    others = [each for folder in folders for each in sorted(folder.glob("*.adm"))]
    known = results.meta.get(HASH)
    for each in (*named, *others):
        if _is_there(each) and known and hash_of(each) == known:
            return each
    return next(filter(_is_there, named), None)


def _is_there(path: Path) -> bool:
    return path.is_file() and not leads_out(path)


def hash_of(path: Path) -> str:
    """SHA-256 of the text of a deck, as results name it; empty where it cannot be read."""
    from hashlib import sha256

    try:
        text = text_of(decoded(contents(path, MOST)))
    except OSError:
        return ""
    return sha256(text.encode()).hexdigest()
