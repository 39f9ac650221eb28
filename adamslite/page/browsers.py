"""Browsers that are installed here and can draw pages without a window."""

from __future__ import annotations

import os
import shutil
import sys
from collections.abc import Iterator
from pathlib import Path

VARIABLE = "ADAMSLITE_BROWSER"
"""Of the environment: the program to use."""
NAMES = (
    "chromium", "chromium-browser", "google-chrome", "google-chrome-stable", "chrome",
    "microsoft-edge", "microsoft-edge-stable", "msedge", "brave-browser",
)  # fmt: skip
APPLICATIONS = ("Google Chrome", "Chromium", "Microsoft Edge", "Brave Browser")
PROGRAMS = (r"Google\Chrome\Application\chrome.exe", r"Microsoft\Edge\Application\msedge.exe")
FOLDERS = ("PROGRAMFILES", "PROGRAMFILES(X86)", "LOCALAPPDATA")
FLAGS = (
    "--headless", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
    "--no-first-run", "--disable-background-networking", "--disable-component-update",
    "--disable-sync", "--hide-scrollbars", "--force-device-scale-factor=1",
)  # fmt: skip
"""A browser without a window, that draws without a graphics card and asks the network nothing."""


def find_browser() -> str | None:
    """The program of a browser of the Chromium family, if one is installed."""
    asked = os.environ.get(VARIABLE)
    if asked:
        return shutil.which(asked)
    return next(filter(None, map(shutil.which, _candidates())), None)


def flags() -> list[str]:
    """Flags for :data:`FLAGS`; a sandbox cannot be had by the superuser of Unix."""
    superuser = hasattr(os, "geteuid") and os.geteuid() == 0
    return [*FLAGS, *(["--no-sandbox"] if superuser else [])]


def _candidates() -> Iterator[str]:
    yield from NAMES
    if sys.platform == "darwin":
        yield from (f"/Applications/{name}.app/Contents/MacOS/{name}" for name in APPLICATIONS)
    for folder in filter(None, map(os.environ.get, FOLDERS)):
        yield from (str(Path(folder) / program) for program in PROGRAMS)
