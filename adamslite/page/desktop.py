"""Opens a page in the browser of the desktop."""

from __future__ import annotations

import os
import sys
from pathlib import Path


def open_page(page: Path) -> bool:
    """Whether a browser has opened it."""
    import webbrowser

    return _has_desktop() and webbrowser.open(page.resolve().as_uri())


def _has_desktop() -> bool:
    """Whether a window can open: elsewhere a browser for text would take the terminal."""
    unix = sys.platform not in ("win32", "darwin")
    return not unix or any(map(os.environ.get, ("DISPLAY", "WAYLAND_DISPLAY", "BROWSER")))
