"""The scene of a page with many runs, of which its reader chooses one.

It is the scene of the first run that can be drawn, and what other runs have in place of it. Arrays
of all runs are in one block.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from adamslite.deck.deck import Deck
from adamslite.drawing.drawing import Drawing, Page
from adamslite.drawing.scene import Scene, described
from adamslite.errors import UsageError
from adamslite.results.results import Results


def scene_of_runs(
    cases: Iterable[tuple[Deck, Results] | None], page: Page, table: dict[str, Any]
) -> Scene:
    """The scene of all runs.

    Parameters
    ----------
    cases : iterable of (Deck, Results) or None
        Of each run, None where it has nothing to draw.
    page : Page
        How many there are, and which columns are plotted.
    table : dict
        What the page tells of the runs: plain data without numbers that are none.

    Raises
    ------
    UsageError
        When no run can be drawn.
    """
    first: dict[str, Any] | None = None
    scenes: list[dict[str, Any] | None] = []
    for case in cases:
        if case is None:
            scenes.append(None)
            continue
        deck, results = case
        plain = described(Drawing(deck, results, page), results)
        first = first or plain
        scenes.append({key: each for key, each in plain.items() if each != first[key]})
    if first is None:
        raise UsageError("none of the runs has a motion: there is nothing to show")
    return Scene({**first, "runs": page.block.json({**table, "scenes": scenes})}, page.block.text())
