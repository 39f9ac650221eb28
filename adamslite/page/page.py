"""Puts a page together: template, style, licences, scene, arrays and the program that draws them.

Nothing in the file is fetched from elsewhere.
"""

from __future__ import annotations

import json
import re
from html import escape
from pathlib import Path

from adamslite.deck.deck import Deck
from adamslite.drawing.run_deck import deck_of
from adamslite.drawing.scene import Scene, scene
from adamslite.outputs.whole_files import whole_file
from adamslite.results.results import Results

FOLDER = Path(__file__).parent
PLACEHOLDER = re.compile(r"\{\{(\w+)\}\}")
FILES = {"style": "style.css", "bundle": "bundle.js", "licenses": "licenses.txt"}


def page(
    results: Results, deck: Deck | None = None, against: Results | None = None, name: str = ""
) -> str:
    """The text of the page of some results.

    Parameters
    ----------
    results : Results
    deck : Deck
        What they are results of; without it the deck that they carry along.
    against : Results
        Other results of the same deck, which are drawn beside them under `name`.

    Raises
    ------
    FormatError
        When they carry no deck, or have nothing in common with those beside them.
    """
    return page_of_scene(scene(deck_of(results) if deck is None else deck, results, against, name))


def page_of_scene(drawn: Scene) -> str:
    """The text of the page of a scene."""
    content = {
        "title": escape(drawn.plain["title"]),
        "scene": json_text(drawn.plain),
        "data": drawn.block,
        **{word: _file(name) for word, name in FILES.items()},
    }
    return PLACEHOLDER.sub(lambda found: content[found[1]], _file("template.html"))


def json_text(plain: object) -> str:
    """JSON that may be inside a script element."""
    text = json.dumps(plain, allow_nan=False, ensure_ascii=False, separators=(",", ":"))
    return text.replace("</", "<\\/").replace("<!--", "<\\u0021--")


def write_page(text: str, path: str | Path) -> None:
    """Write a page, whole or not at all."""
    with whole_file(path) as stream:
        stream.write(text)


def _file(name: str) -> str:
    return (FOLDER / name).read_text(encoding="utf-8")


HEIGHT = 520


def framed(page: str) -> str:
    """The page in a frame of its own origin: its scripts run and reach nothing of the notebook."""
    return (
        f'<iframe srcdoc="{escape(page)}" sandbox="allow-scripts allow-downloads" '
        f'style="width:100%;height:{HEIGHT}px;border:1px solid #8888" title="the motion"></iframe>'
    )
