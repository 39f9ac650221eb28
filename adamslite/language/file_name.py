"""Plain names of files: what decks and command files may call the files of a run."""

from __future__ import annotations

import re

# Without a folder or a drive; one with a dot in front is for the system or hidden.
PLAIN = re.compile(r"[^./\\:][^/\\:]*")


def is_file_name(word: str | None) -> bool:
    """Whether a word is the plain name of a file, which lies beside the results."""
    return bool(word and PLAIN.fullmatch(word) and word.isprintable())
