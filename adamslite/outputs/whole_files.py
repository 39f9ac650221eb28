"""Files are written whole or not at all: a partial result never replaces a complete one."""

import os
from collections.abc import Iterable, Iterator
from contextlib import AbstractContextManager, contextmanager, suppress
from pathlib import Path
from typing import IO, Any, Literal, overload

from adamslite.errors import UsageError


@overload
def whole_file(path: str | Path) -> AbstractContextManager[IO[str]]: ...
@overload
def whole_file(path: str | Path, binary: Literal[True]) -> AbstractContextManager[IO[bytes]]: ...
@contextmanager
def whole_file(path: str | Path, binary: bool = False) -> Iterator[IO[Any]]:
    """Open `path` for writing text or bytes; it changes only when the block succeeds.

    The content goes to a file beside it first, so the final rename stays on one disk and is atomic.
    What is not a regular file (`/dev/null`, a pipe) is written directly.
    """
    target = Path(os.path.realpath(path))
    kind = "b" if binary else ""
    encoding, newline = (None, None) if binary else ("utf-8", "\n")
    if target.exists() and not target.is_file():
        with open(target, f"w{kind}", encoding=encoding, newline=newline) as stream:
            yield stream
        return
    draft = _draft(target)
    draft.unlink(missing_ok=True)
    try:
        with open(draft, f"x{kind}", encoding=encoding, newline=newline) as stream:
            yield stream
        os.replace(draft, target)
    finally:
        draft.unlink(missing_ok=True)


def _draft(target: Path) -> Path:
    return target.with_name(f".{target.name}.{os.getpid()}.part")


def same_file(path: str | Path, other: str | Path) -> bool:
    """Whether two names mean one file; of two that are not there yet letters count as equal."""
    there = os.path.exists(path), os.path.exists(other)
    if all(there):
        return os.path.samefile(path, other)
    return not any(there) and _folded(path) == _folded(other)


def _folded(path: str | Path) -> str:
    return os.path.realpath(path).casefold()


def need_writable(path: str | Path, read: Iterable[Path], named: bool = True) -> None:
    """Fail now rather than after a long run; never write over what is ``read``.

    Parameters
    ----------
    path : str or Path
        A file that is going to be written.
    read : iterable of Path
        The files of the run.
    named : bool
        Whether the user gave this very name. A name that was made from others' leads nowhere but to
        a plain file in its own folder.

    Raises
    ------
    OSError
        When ``path`` cannot be written.
    UsageError
        When it is one of the files that are read, or leads elsewhere.
    """
    for each in read:
        if same_file(path, each):
            raise UsageError(f"'{path}' is read, and would be written over; give -o another name")
    if Path(path).is_dir():
        raise IsADirectoryError(
            21, "the results cannot be written there: it is a folder", str(path)
        )
    if not named:
        _need_confined(Path(path))
    folder = Path(os.path.realpath(path)).parent
    if not folder.is_dir():
        raise FileNotFoundError(
            2, "the results cannot be written there: no such folder", str(folder)
        )
    if not os.access(folder, os.W_OK):
        raise PermissionError(13, "the results cannot be written there: no permission", str(folder))
    with suppress(FileNotFoundError):
        os.lstat(_draft(Path(path)))  # fails when the name is too long for the system


def _need_confined(path: Path) -> None:
    if os.path.realpath(path.parent) != os.path.dirname(os.path.realpath(path)):
        raise UsageError(
            f"'{path}' is a link that leads out of its folder; remove it or give -o another name"
        )
    if path.exists() and not path.is_file():
        raise UsageError(f"'{path}' is not a plain file; remove it or give -o another name")
