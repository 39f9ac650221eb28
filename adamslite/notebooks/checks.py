"""A deck in a notebook: its messages with their places, their counts, what it contains."""

from __future__ import annotations

from html import escape

from adamslite.api.checks import Check
from adamslite.deck.deck import Deck
from adamslite.language.diagnostics import Diagnostic
from adamslite.notebooks.markup import folded, marked

#: More messages than this are counted only.
MOST = 20
#: Lines of a deck that are shown.
MOST_LINES = 1000


def check_html(found: Check) -> str:
    """Title and counts, the messages, the contents."""
    kind = "error" if found.errors else "warning" if found else "done"
    parts = [f"<p><b>{escape(found.title)}</b>: {marked(kind, found.counts)}</p>"]
    parts += [_message(each) for each in found[:MOST]]
    if len(found) > MOST:
        parts.append(f"<p>and {len(found) - MOST} more</p>")
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
