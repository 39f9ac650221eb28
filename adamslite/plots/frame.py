"""A figure with its title, subtitle and small print, and what is between them left for axes."""

from __future__ import annotations

from collections.abc import Sequence
from textwrap import wrap
from typing import TYPE_CHECKING

from adamslite.plots import style

if TYPE_CHECKING:
    from matplotlib.figure import Figure

#: Heights of a line of the title, of the subtitle and of the small print [in].
HEAD, SUB, PRINT = 0.22, 0.17, 0.17
#: Characters for each inch of width, of the title and of the small print.
TITLE_LETTERS, PRINT_LETTERS = 10.0, 13.5


def framed(title: str, subtitle: str, notes: Sequence[str], width: float, height: float) -> Figure:
    """An empty figure.

    Parameters
    ----------
    title, subtitle : str
        The title is broken into lines, the subtitle cut at the end of its line.
    notes : sequence of str
        Small print below, each with lines of its own.
    width, height : float
        Of the whole figure, and of the part between [in].
    """
    from matplotlib.figure import Figure
    from matplotlib.layout_engine import ConstrainedLayoutEngine

    heads = balanced(title, int(TITLE_LETTERS * width))
    prints = [line for note in notes for line in wrap(note, int(PRINT_LETTERS * width))]
    above = HEAD * len(heads) + SUB + 0.14
    below = PRINT * len(prints) + (0.1 if prints else 0.0)
    whole = height + above + below
    strip = (0.0, below / whole, 1.0, height / whole)
    layout = ConstrainedLayoutEngine(rect=strip, h_pad=0.05, w_pad=0.08)
    figure = Figure(figsize=(width, whole), layout=layout)
    for k, line in enumerate(heads):
        top = 1.0 - (0.08 + HEAD * k) / whole
        figure.text(0.012, top, line, va="top", fontsize=11, fontweight="bold")
    top = 1.0 - (0.1 + HEAD * len(heads)) / whole
    under = wrap(subtitle, int(PRINT_LETTERS * width) - 8, max_lines=1, placeholder=" ...")
    figure.text(0.012, top, "".join(under), va="top", color=style.MUTED)
    for k, line in enumerate(reversed(prints)):
        figure.text(0.012, (0.06 + PRINT * k) / whole, line, va="bottom", fontsize=8)
    return figure


def balanced(text: str, longest: int) -> list[str]:
    """The fewest lines that a text can be broken into, of about equal length."""
    lines = wrap(text, longest)
    if len(lines) < 2:
        return lines
    shorter = (wrap(text, width) for width in range(len(text) // len(lines), longest))
    return next((found for found in shorter if len(found) == len(lines)), lines)
