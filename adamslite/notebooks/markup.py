"""Pieces of HTML that follow the colours of the notebook, light or dark."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from html import escape

CELL = "text-align:left;vertical-align:top;padding:1px 12px 1px 0"
NUMBER = "text-align:right;padding:1px 12px 1px 0;font-variant-numeric:tabular-nums"
#: Marks of severities and outcomes: a letter besides the colour, for those who see none.
COLOURS = {"error": "#c2410c", "warning": "#a16207", "note": "#0b6bcb", "done": "#15803d"}


def rows_table(rows: Iterable[tuple[str, str]]) -> str:
    """Two columns: what, and a text."""
    lines = (
        f'<tr><td style="{CELL}">{escape(what)}</td><td style="{CELL}">{escape(text)}</td></tr>'
        for what, text in rows
    )
    return f"<table>{''.join(lines)}</table>"


def number_table(head: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """A head, and rows whose first column is a text."""
    titles = "".join(f'<th style="{NUMBER}">{escape(each)}</th>' for each in head)
    lines = "".join(f"<tr>{_cells(row)}</tr>" for row in rows)
    return f"<table><thead><tr>{titles}</tr></thead><tbody>{lines}</tbody></table>"


def _cells(row: Sequence[str]) -> str:
    styles = (CELL, *(NUMBER for _ in row[1:]))
    return "".join(
        f'<td style="{style}">{escape(each)}</td>' for style, each in zip(styles, row, strict=True)
    )


def marked(kind: str, text: str) -> str:
    """A word in the colour of its kind."""
    return f'<b style="color:{COLOURS[kind]}">{escape(text)}</b>'


def paragraph(text: str) -> str:
    """A paragraph of plain text."""
    return f"<p>{escape(text)}</p>"


def folded(title: str, content: str) -> str:
    """Content that opens on a click."""
    return f"<details><summary>{escape(title)}</summary>{content}</details>"
