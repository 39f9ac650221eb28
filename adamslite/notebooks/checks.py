"""A deck in a notebook: its messages with their places, their counts, what it contains."""

from __future__ import annotations

from html import escape

from adamslite.api.checks import Check
from adamslite.language.diagnostics import Diagnostic
from adamslite.notebooks.markup import folded, marked

#: More messages than this are counted only.
MOST = 20


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
        text = f"<pre>{escape(found.deck.source.text)}</pre>"
        parts.append(folded("the text of the deck", text))
    return f"<div>{''.join(parts)}</div>"


def _message(each: Diagnostic) -> str:
    """As the command line prints it: place and sentence, the line with a mark below, the hint."""
    first, *others = each.render().split("\n")
    rest = "".join(f"\n{line}" for line in others)
    severity, sentence = f"{each.severity}: ", f"{each.message} [{each.code}]"
    place = first.removesuffix(f"{severity}{sentence}")
    head = f"{escape(place)}{marked(each.severity, each.severity)}: {escape(sentence)}"
    return f'<pre style="margin:0 0 .6em">{head}{escape(rest)}</pre>'
