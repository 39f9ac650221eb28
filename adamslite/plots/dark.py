"""Figures on a dark ground: the same lines and texts in colours that stand out there."""

from __future__ import annotations

from contextlib import AbstractContextManager
from typing import TYPE_CHECKING, Any

from adamslite.plots import style

if TYPE_CHECKING:
    from matplotlib.figure import Figure

GROUND, INK, PALE, RULE = "#12161c", "#e6edf3", "#9198a1", "#303843"
#: In place of those of figures on white.
COLOURS = {
    style.BLACK: INK, style.DARK: "#c9d1d9", style.MUTED: PALE, style.FAINT: RULE,
    "#ffffff": GROUND, style.BAND: "#1f3b33", style.BLUE: "#3f9bdc", style.SKY: "#9bd5f5",
    style.RED: "#ff7a2e", style.GREEN: "#2cc295",
}  # fmt: skip
SETTINGS: Any = {
    **style.SETTINGS,
    "figure.facecolor": GROUND, "axes.facecolor": GROUND, "axes.edgecolor": PALE,
    "grid.color": RULE, "text.color": INK, "axes.labelcolor": INK, "axes.titlecolor": INK,
}  # fmt: skip


def themed(dark: bool) -> AbstractContextManager[None]:
    """The settings in which figures are made on white, or on a dark ground."""
    if not dark:
        return style.styled()
    style.need_matplotlib()
    from matplotlib.style import context

    return context(["default", SETTINGS])


def finished(figure: Figure, dark: bool) -> Figure:
    """A figure that was made in these settings; on a dark ground its own colours are changed."""
    if dark:
        for artist in figure.findobj():
            _recolour(artist)
    return figure


def _recolour(artist: Any) -> None:
    """Lines, texts, areas and points whose colour has another one on a dark ground."""
    from matplotlib.collections import Collection
    from matplotlib.lines import Line2D
    from matplotlib.patches import Patch
    from matplotlib.text import Text

    if isinstance(artist, Line2D):
        artist.set(
            color=_dark(artist.get_color()), markerfacecolor=_dark(artist.get_markerfacecolor()),
            markeredgecolor=_dark(artist.get_markeredgecolor()),
        )  # fmt: skip
    elif isinstance(artist, Text):
        artist.set_color(_dark(artist.get_color()))
    elif isinstance(artist, Patch):
        artist.set(facecolor=_dark(artist.get_facecolor()), edgecolor=_dark(artist.get_edgecolor()))
    elif isinstance(artist, Collection):
        artist.set_facecolor([_dark(each) for each in artist.get_facecolor()])
        artist.set_edgecolor([_dark(each) for each in artist.get_edgecolor()])


def _dark(colour: Any) -> Any:
    """A colour in place of another, as opaque; one that has none stays."""
    from matplotlib.colors import to_hex, to_rgba

    if isinstance(colour, str) and colour == "none":
        return colour
    red, green, blue, alpha = to_rgba(colour)
    known = {key.lower(): value for key, value in COLOURS.items()}
    found = known.get(to_hex((red, green, blue)))
    return colour if found is None else to_rgba(found, alpha)
