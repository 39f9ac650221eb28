"""A change of a file that its size and its times do not show."""

from __future__ import annotations

import os
from pathlib import Path


def replaced(path: Path, old: str, new: str) -> None:
    """Change a file, keep its size and its times."""
    facts, text = path.stat(), path.read_text(encoding="utf-8")
    assert old in text and len(old) == len(new)
    path.write_text(text.replace(old, new), encoding="utf-8")
    os.utime(path, ns=(facts.st_atime_ns, facts.st_mtime_ns))
