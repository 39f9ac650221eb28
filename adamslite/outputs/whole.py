"""Files are written whole or not at all: a half-written result never replaces a good one."""

import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from adamslite.faults import UsageError


@contextmanager
def whole_file(path: str | Path, binary: bool = False) -> Iterator[Any]:
    """Open `path` for writing text or bytes; it changes only when the block succeeds.

    The content goes to a file beside it first, so the final rename stays on one disk and is atomic.
    What is not a regular file (`/dev/null`, a pipe) is written directly.
    """
    target = Path(os.path.realpath(path))
    how = {"mode": "wb"} if binary else {"mode": "w", "encoding": "utf-8", "newline": "\n"}
    if target.exists() and not target.is_file():
        with open(target, **how) as stream:
            yield stream
        return
    draft = target.with_name(f".{target.name}.{os.getpid()}.part")
    try:
        with open(draft, **how) as stream:
            yield stream
        os.replace(draft, target)
    finally:
        draft.unlink(missing_ok=True)


def need_writable(path: str | Path, *read: Path | None) -> None:
    """Fail now rather than after a long run; never write over what is `read`.

    Raises
    ------
    OSError
        When `path` cannot be written.
    UsageError
        When it is one of the files that are read.
    """
    for each in read:
        if each and each.exists() and Path(path).exists() and each.samefile(path):
            raise UsageError(f"'{path}' is read, and would be written over; give -o another name")
    folder = Path(path).absolute().parent
    if not folder.is_dir():
        raise FileNotFoundError(
            2, "the results cannot be written there: no such folder", str(folder)
        )
    if Path(path).is_dir():
        raise IsADirectoryError(
            21, "the results cannot be written there: it is a folder", str(path)
        )
    if not os.access(folder, os.W_OK):
        raise PermissionError(13, "the results cannot be written there: no permission", str(folder))
