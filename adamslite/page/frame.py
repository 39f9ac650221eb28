"""A page in a frame of a notebook."""

from __future__ import annotations

from html import escape

HEIGHT = 520


def framed(page: str) -> str:
    """The page in a frame of its own origin: its scripts run and reach nothing of the notebook."""
    return (
        f'<iframe srcdoc="{escape(page)}" sandbox="allow-scripts allow-downloads" '
        f'style="width:100%;height:{HEIGHT}px;border:1px solid #8888" title="the motion"></iframe>'
    )
