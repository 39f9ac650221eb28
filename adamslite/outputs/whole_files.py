"""Files are written whole or not at all: a partial result never replaces a complete one."""

import os
from collections.abc import Iterable, Iterator
from contextlib import AbstractContextManager, contextmanager, suppress
from pathlib import Path
from typing import IO, Any, Literal, overload

from adamslite.errors import UsageError
from adamslite.notation import STDOUT
from adamslite.outputs.drafts import WINDOWS, begun, draft_of, lock, over, remove_drafts

#: How matrices for MATLAB begin, which have no room for a word: no reader of numbers minds blanks.
PLAIN = " \t "
#: How files begin that this program writes: tables, what LINEAR and SAVE leave.
STARTS = (
    b"# adamslite", b"mode,frequency,", b'{\n "coordinates"', b'{\n "saved by adamslite"',
    PLAIN.encode(),
)  # fmt: skip
#: What is in the head of a page, of files .res and .req, and of a fitted deck.
MARKS = (
    b'name="generator" content="adamslite"',
    b'<File URI="-unknown-"',
    b" 2000-01-01 00:00:00 ",
    b"Fitted by adamslite to ",
)
HEAD = 500


@overload
def whole_file(path: str | Path) -> AbstractContextManager[IO[str]]: ...
@overload
def whole_file(path: str | Path, binary: Literal[True]) -> AbstractContextManager[IO[bytes]]: ...
@contextmanager
def whole_file(path: str | Path, binary: bool = False) -> Iterator[IO[Any]]:
    """Open `path` for writing text or bytes; it changes only when the block succeeds.

    The content goes to a file beside it first, and to the disk, before the final rename, which
    stays on one disk and is atomic: neither a disk that fills nor a loss of power leaves a part.
    What is not a regular file (`/dev/null`, a pipe) is written directly.

    Raises
    ------
    OSError
        As the system reports it, with `path` as its file.
    """
    target = Path(os.path.realpath(path))
    kind = "b" if binary else ""
    encoding, newline = (None, None) if binary else ("utf-8", "\n")
    if target.exists() and not target.is_file():
        with _named(path), open(target, f"w{kind}", encoding=encoding, newline=newline) as stream:
            yield stream
        return
    draft = draft_of(target)
    begun(draft)
    try:
        with _named(path, draft):
            with open(draft, f"x{kind}", encoding=encoding, newline=newline) as stream:
                lock(stream)
                yield stream
                stream.flush()
                os.fsync(stream.fileno())  # some disks are known to be full only now
                if not WINDOWS:
                    os.replace(draft, target)  # as long as it is locked, nobody removes it
            if WINDOWS:  # where no file that is open gets another name
                os.replace(draft, target)
    finally:
        with suppress(OSError):
            draft.unlink(missing_ok=True)
            over(draft)


@contextmanager
def _named(path: str | Path, draft: Path | None = None) -> Iterator[None]:
    """A fault of the system names the file that was asked for: not its draft, and not nothing."""
    try:
        yield
    except OSError as fault:
        if fault.errno is not None and fault.filename in (None, str(draft)):
            raise OSError(fault.errno, fault.strerror, str(path)) from None
        raise


def same_file(path: str | Path, other: str | Path) -> bool:
    """Whether two names mean one file; of two that are not there yet letters count as equal."""
    there = os.path.exists(path), os.path.exists(other)
    if all(there):
        return os.path.samefile(path, other)
    return not any(there) and _folded(path) == _folded(other)


def _folded(path: str | Path) -> str:
    return os.path.realpath(path).casefold()


def need_file(path: str | Path) -> None:
    """Reject the name of standard output where a file has to be written.

    Raises
    ------
    UsageError
        In one sentence.
    """
    if str(path) == STDOUT:
        raise UsageError(
            f"'{path}' is standard output, which takes results of runs and decks of cables alone; "
            "give -o another name"
        )


def need_writable(path: str | Path, read: Iterable[Path], named: bool = True) -> None:
    """Fail now rather than after a long run; never write over what is ``read``; take away what a
    killed program has left of the file.

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
    need_file(path)
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
        os.lstat(draft_of(Path(path)))  # fails when the name is too long for the system
    remove_drafts(path)


def _need_confined(path: Path) -> None:
    if os.path.realpath(path.parent) != os.path.dirname(os.path.realpath(path)):
        raise UsageError(
            f"'{path}' is a link that leads out of its folder; remove it or give -o another name"
        )
    if path.exists() and not path.is_file():
        raise UsageError(f"'{path}' is not a plain file; remove it or give -o another name")
    if path.is_file() and not _is_own(path):
        raise UsageError(
            f"'{path}' is there and is no file of results: it is not written over; remove it or "
            "give -o another name"
        )


def _is_own(path: Path) -> bool:
    """Whether a file begins as those of this program do: decks may name any other one, too."""
    with open(path, "rb") as stream:
        head = stream.read(HEAD)
    marked = any(mark in head for mark in MARKS)
    return not head or marked or head.startswith(STARTS)
