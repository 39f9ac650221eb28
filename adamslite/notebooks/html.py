"""`html`: what a notebook shows of an object of this package."""

from __future__ import annotations

from collections.abc import Callable
from html import escape
from typing import Any

from adamslite.api.checks import Check, check
from adamslite.deck.deck import Deck
from adamslite.language.diagnostics import Diagnostic
from adamslite.notebooks.markup import folded, marked, number_table, paragraph
from adamslite.outputs import modes
from adamslite.results.comparison import HEAD, Comparison
from adamslite.results.linearization import Linearization
from adamslite.results.results import Results
from adamslite.verification.work_precision import Chart

#: More channels of a comparison, and messages of a deck, than this are counted only.
MOST_COMPARED, MOST_MESSAGES = 200, 20
#: Lines of a deck that are shown.
MOST_LINES = 1000


def html(shown: Deck | Check | Results | Linearization | Comparison | Chart) -> str:
    """HTML of a deck (its check), results (with the page that moves), a linearised model, a
    comparison or a chart, as notebooks show it.

    Raises
    ------
    TypeError
        For anything else.
    """
    for kind, write in WRITERS.items():
        if isinstance(shown, kind):
            return write(shown)
    raise TypeError(f"nothing shows a {type(shown).__name__}")


def _deck(shown: Deck) -> str:
    return check_html(check(shown))


def _results(shown: Results) -> str:
    from adamslite.notebooks.results import results_html

    return results_html(shown)


def _chart(shown: Chart) -> str:
    from adamslite.notebooks.chart import chart_html

    return chart_html(shown)


def comparison_html(found: Comparison) -> str:
    """Those outside their tolerance first."""
    mark = marked("done" if found.inside else "error", found.verdict)
    count = len(found.differences)
    more = f"<p>and {count - MOST_COMPARED} more</p>" if count > MOST_COMPARED else ""
    table = number_table(HEAD, [each.cells for each in found.outside_first[:MOST_COMPARED]])
    return f"<div><p>{mark}</p>{table}{more}</div>"


def linearization_html(found: Linearization) -> str:
    """Number, frequency, damping ratio and eigenvalue of every mode, and what to know of them."""
    rows = [
        (
            str(row.number), f"{row.frequency:.6g}", f"{row.damping:.4g}", f"{row.real:.6g}",
            f"{'± ' if row.pair else ''}{row.imaginary:.6g}",
        )
        for row in modes.mode_rows(found)
    ]  # fmt: skip
    note = paragraph(found.note) if found.note else ""
    return f"<div>{paragraph(found.sizes)}{number_table(modes.HEAD, rows)}{note}</div>"


def check_html(found: Check) -> str:
    """Title and counts, the messages, the contents."""
    kind = "error" if found.errors else "warning" if found else "done"
    parts = [f"<p><b>{escape(found.title)}</b>: {marked(kind, found.counts)}</p>"]
    parts += [_message(each) for each in found[:MOST_MESSAGES]]
    if len(found) > MOST_MESSAGES:
        parts.append(f"<p>and {len(found) - MOST_MESSAGES} more</p>")
    if contents := found.contents:
        listed = "".join(f"<li>{escape(line)}</li>" for line in contents)
        parts.append(f"<ul>{listed}</ul>")
    if found.deck is not None:
        parts.append(folded("the text of the deck", f"<pre>{escape(_text(found.deck))}</pre>"))
    return f"<div>{''.join(parts)}</div>"


def _text(deck: Deck) -> str:
    """As far as anybody reads it in a notebook."""
    text, more = deck.source.text, len(deck.lines) - MOST_LINES
    return "\n".join([*deck.lines[:MOST_LINES], f"... {more} more lines"]) if more > 0 else text


def _message(each: Diagnostic) -> str:
    """As the command line prints it: place and sentence, the line with a mark below, the hint."""
    first, *others = each.render().split("\n")
    rest = "".join(f"\n{line}" for line in others)
    severity, sentence = f"{each.severity}: ", f"{each.message} [{each.code}]"
    place = first.removesuffix(f"{severity}{sentence}")
    head = f"{escape(place)}{marked(each.severity, each.severity)}: {escape(sentence)}"
    return f'<pre style="margin:0 0 .6em">{head}{escape(rest)}</pre>'


WRITERS: dict[type, Callable[[Any], str]] = {
    Check: check_html,
    Deck: _deck,
    Results: _results,
    Linearization: linearization_html,
    Comparison: comparison_html,
    Chart: _chart,
}
