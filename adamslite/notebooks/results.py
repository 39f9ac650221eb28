"""Results in a notebook: how the run ended, its counters, and the page that moves, in a frame."""

from __future__ import annotations

from html import escape

from adamslite.errors import FormatError
from adamslite.language.diagnostics import DeckError
from adamslite.notebooks.markup import folded, marked, paragraph, rows_table
from adamslite.page.page import page
from adamslite.results.results import Results
from adamslite.results.summary import ending, figures, notes

HEIGHT = 520
#: Names of channels that are listed.
LISTED = 400


def results_html(results: Results) -> str:
    """Outcome, table, channels and page."""
    kind = "done" if results.outcome.is_requested else "error"
    title = results.meta.get("deck", "results")
    parts = [f"<p><b>{escape(title)}</b>: {marked(kind, ending(results))}</p>"]
    parts += [] if results.outcome.is_requested else [paragraph(results.message)]
    parts.append(rows_table([*figures(results), *notes(results)]))
    if results.confirmation is not None:
        parts.append(paragraph(results.confirmation.verdict))
    parts += [_channels(results), frame(results)]
    return f"<div>{''.join(parts)}</div>"


def _channels(results: Results) -> str:
    count, times = len(results.names), len(results.time)
    title = f"{count} channels at {times} times"
    if not count:
        return paragraph(title)
    more = f" and {count - LISTED} more" if count > LISTED else ""
    return folded(title, paragraph(", ".join(results.names[:LISTED]) + more))


def frame(results: Results) -> str:
    """The page in a frame of its own, which can reach neither the notebook nor the network's data
    of its user; a sentence where nothing can be drawn.
    """
    try:
        text = page(results)
    except (FormatError, DeckError) as fault:
        return paragraph(f"Nothing is drawn: {str(fault).splitlines()[0]}")
    return (
        f'<iframe srcdoc="{escape(text)}" sandbox="allow-scripts allow-downloads" '
        f'style="width:100%;height:{HEIGHT}px;border:1px solid #8888" '
        f'title="the motion"></iframe>'
    )
