"""A bar on a terminal, drawn by rich, which honours NO_COLOR and the width of the terminal."""

from __future__ import annotations

from typing import TYPE_CHECKING, TextIO

from rich.console import Console
from rich.live import Live
from rich.progress_bar import ProgressBar
from rich.table import Table
from rich.text import Text

if TYPE_CHECKING:
    from adamslite.progress.meter import Look

WIDTH = 24


class Bar:
    """One line: a bar and the figures, short steps in another colour."""

    def __init__(self, stream: TextIO) -> None:
        console = Console(file=stream)
        self._live = Live(console=console, auto_refresh=False, transient=True)
        self._live.start()

    def draw(self, look: Look) -> None:
        """Draw the line again."""
        style = "yellow" if look.limit else ""
        line = Table.grid(padding=(0, 1))
        bar = ProgressBar(total=1.0, completed=look.state.share, width=WIDTH)
        line.add_row(bar, Text(look.text, style, no_wrap=True, overflow="ellipsis"))
        self._live.update(line, refresh=True)

    def clear(self) -> None:
        """Remove the line."""
        self._live.stop()
