"""Results in a notebook: how the run ended, its counters, and the page that moves, in a frame."""

from __future__ import annotations

from html import escape

from adamslite.drawing.run_deck import deck_of, need_its_bodies
from adamslite.errors import FormatError
from adamslite.language.diagnostics import DeckError
from adamslite.notebooks.markup import folded, marked, paragraph, rows_table
from adamslite.page.page import framed, page
from adamslite.results.results import Results
from adamslite.results.summary import ending, figures, notes

#: Names of channels that are listed.
LISTED = 400


def results_html(results: Results) -> str:
    """Outcome, table, channels and page."""
    kind = "done" if results.outcome.is_requested else "error"
    title = results.meta.get("deck", "results")
    parts = [f"<p><b>{escape(title)}</b>: {marked(kind, ending(results))}</p>"]
    parts += [] if results.outcome.is_requested else [paragraph(results.message)]
    parts.append(rows_table([*_files(results), *figures(results), *notes(results)]))
    if results.confirmation is not None:
        parts.append(paragraph(results.confirmation.verdict))
    parts += [_channels(results), _frame(results)]
    return f"<div>{''.join(parts)}</div>"


def _files(results: Results) -> list[tuple[str, str]]:
    """The files that were run: a command file may have been taken because it lies beside."""
    source = results.source
    if source is None:
        return []
    names = {"deck": source.name, "commands": source.commands_name}
    return [(what, name) for what, name in names.items() if name and not name.startswith("<")]


def _channels(results: Results) -> str:
    count, times = len(results.names), len(results.time)
    title = f"{count} channels at {times} times"
    if not count:
        return paragraph(title)
    more = f" and {count - LISTED} more" if count > LISTED else ""
    return folded(title, paragraph(", ".join(results.names[:LISTED]) + more))


def _frame(results: Results) -> str:
    """The page that moves; a sentence where nothing can be drawn."""
    try:
        deck = deck_of(results)
        need_its_bodies(deck, results, "the table")
        return framed(page(results, deck))
    except (FormatError, DeckError) as fault:
        return paragraph(f"Nothing is drawn: {str(fault).splitlines()[0]}")
