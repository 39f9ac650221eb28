"""Names of files in decks and command files, and what they lead to.

Decks come from others. What they write has a plain name and lies beside the results; what they read
lies in the folder of the deck or below, or in one that the user has opened (`--allow-path`).
"""

from __future__ import annotations

import os
import re
from collections.abc import Iterable
from pathlib import Path

# Without a folder, a drive or a stream; one with a dot in front is for the system or hidden, one
# with a dash would be an option. Windows leaves off dots and blanks at the end.
PLAIN = re.compile(r"""[^./\\:<>"|?*\s-]([^/\\:<>"|?*]*[^./\\:<>"|?*\s])?""")
# Devices of Windows, whatever follows the first dot.
DEVICE = re.compile(r"(con|prn|aux|nul|conin\$|conout\$|(com|lpt)[0-9¹²³])\s*(\..*)?", re.I)

OPENED = "ADAMSLITE_ALLOW_PATH"
"""Of the environment, which processes of workers inherit: folders besides that of the deck."""


def is_file_name(word: str | None) -> bool:
    """Whether a word is the plain name of a file, on any system, which lies beside the results."""
    plain = word and PLAIN.fullmatch(word) and word.isprintable()
    return bool(word and plain and not DEVICE.fullmatch(word))


def open_folders(folders: Iterable[str | Path]) -> None:
    """Let decks read files from these folders, too."""
    known = [*filter(None, os.environ.get(OPENED, "").split(os.pathsep))]
    os.environ[OPENED] = os.pathsep.join([*known, *(os.path.realpath(each) for each in folders)])


def inside(folder: Path, name: str) -> Path | None:
    """The file ``name`` of a deck in ``folder``; None where that is not in a folder it may read.

    Nothing outside is looked at: asking Windows for a file of another machine tells it who asks.
    """
    base = Path(os.path.abspath(folder))
    path = Path(os.path.normpath(base / name))
    if not _is_in_one(path, (base, *_opened())):
        return None
    real = path.resolve()
    return real if _is_in_one(real, (base.resolve(), *_opened())) else None


def leads_out(path: Path) -> bool:
    """Whether a file beside others is a link to a file elsewhere, where nothing may be read."""
    real = path.resolve()
    return not _is_in_one(real, (path.parent.resolve(), *_opened()))


def _opened() -> list[Path]:
    return [Path(each) for each in filter(None, os.environ.get(OPENED, "").split(os.pathsep))]


def _is_in_one(path: Path, folders: Iterable[Path]) -> bool:
    return any(path.is_relative_to(folder) for folder in folders)
