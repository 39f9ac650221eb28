"""Writes what shows a motion, in the form of the suffix: page, model, picture or film."""

from __future__ import annotations

import os
import sys
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

from adamslite.deck.deck import Deck
from adamslite.drawing.gltf.model import model
from adamslite.errors import UsageError
from adamslite.outputs.whole_files import whole_file
from adamslite.page.page import page, write_page
from adamslite.page.pictures import SIZE, Size, draw
from adamslite.results.results import Results

PAGES = (".html", ".htm")
FORMS = (*PAGES, ".glb", ".png", ".gif", ".mp4")


@dataclass(frozen=True)
class Look:
    """How pictures look: the time of a single one, width and height in pixels, and what the address
    of a page may ask for besides.
    """

    time: float | None = None
    size: Size = SIZE
    asked: Mapping[str, str] = field(default_factory=dict)


def write_motion(
    path: Path,
    deck: Deck,
    results: Results,
    against: Results | None = None,
    name: str = "",
    look: Look | None = None,
) -> None:
    """Write the motion of a deck, and other results called `name` beside it.

    Raises
    ------
    UsageError
        When there is no such form, or what is requested does not belong to it.
    """
    suffix = path.suffix.lower()
    if suffix not in FORMS:
        raise UsageError(f"'{path}': the name ends in none of {', '.join(FORMS)}")
    if suffix == ".glb":
        if against is not None:
            raise UsageError("a model (.glb) shows one result; a page shows two")
        content = model(deck, results)
        with whole_file(path, binary=True) as stream:
            stream.write(content)
        return
    text = page(results, deck, against, name)
    if suffix in PAGES:
        write_page(text, path)
        return
    look = look or Look()
    if suffix == ".png" and look.time is None:
        raise UsageError(f"'{path}': a picture is of one time, and none is given")
    draw(text, path, deck, results, look.time, look.size, dict(look.asked))


def open_page(page: Path) -> bool:
    """Whether a browser has opened it."""
    import webbrowser

    return _has_desktop() and webbrowser.open(page.resolve().as_uri())


def _has_desktop() -> bool:
    """Whether a window can open: elsewhere a browser for text would take the terminal."""
    unix = sys.platform not in ("win32", "darwin")
    return not unix or any(map(os.environ.get, ("DISPLAY", "WAYLAND_DISPLAY", "BROWSER")))
