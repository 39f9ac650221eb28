"""The cache folder: private to its user, and verified to be so.

Whoever can write an entry can have this program run what he likes, so a folder is used only when
the user (or the administrator) owns it and no one else may change it:

    ADAMSLITE_CACHE, else the user's cache folder
    else adamslite-<user number> in the folder for temporary files
    else a folder of this process alone, which goes when it ends
"""

from __future__ import annotations

import os
import stat
import sys
from functools import cache
from pathlib import Path

from adamslite.caching.contents import clear

OTHERS = stat.S_IWGRP | stat.S_IWOTH
ADMINISTRATOR = 0
#: Unix: elsewhere the folders of a user are closed by the system, and modes say nothing.
HAS_OWNERS = hasattr(os, "geteuid")


def cache_folder() -> Path:
    """The folder that holds what is kept; made when missing.

    One that was settled earlier is checked again: it may have been removed, and another put in
    its place.
    """
    chosen = os.environ.get("ADAMSLITE_CACHE")
    wanted = Path(chosen) if chosen else usual_folder(), bool(chosen)
    folder, facts = _settled(*wanted)
    if _identity(folder) != facts:
        _settled.cache_clear()
        _private.cache_clear()
        folder, _ = _settled(*wanted)
    return folder


def usual_folder() -> Path:
    """The folder of this program among the user's cache folders."""
    variable = "LOCALAPPDATA" if sys.platform == "win32" else "XDG_CACHE_HOME"
    return _usual_folder(sys.platform, os.environ.get(variable), os.environ.get("HOME"))


@cache
def _usual_folder(platform: str, given: str | None, home: str | None) -> Path:
    """The same from what it depends on: it is needed for every entry."""
    of_user = Path(home) if home else Path.home()
    # Empty or relative it would be in the current folder, which may have come with a deck.
    named = Path(given) if given and os.path.isabs(given) else None
    if platform == "win32":
        return (named or of_user) / "adamslite" / "cache"
    if platform == "darwin":
        return of_user / "Library" / "Caches" / "adamslite"
    return (named or of_user / ".cache") / "adamslite"


@cache
def _settled(folder: Path, chosen: bool) -> tuple[Path, tuple[int, ...]]:
    """A folder that can be created and trusted, ``folder`` if possible, and its reasons."""
    found = _found(folder, chosen)
    return found, _identity(found)


def _identity(folder: Path) -> tuple[int, ...]:
    """Device, number, owner and mode of a folder; nothing when it is not there."""
    try:
        facts = folder.lstat()
    except OSError:
        return ()
    return facts.st_dev, facts.st_ino, facts.st_uid, facts.st_mode


def _found(folder: Path, chosen: bool) -> Path:
    """``folder`` if it can be created and trusted, else another one, which is reported."""
    try:
        made = _made(folder)
    except OSError:
        return _temporary()
    doubt = _doubt(made)
    if not doubt:
        return made
    if not chosen and _taken_back(made):
        warn(f"the cache folder {made} could be written to by others: it was emptied and closed")
        return made
    other = _temporary()
    warn(f"the cache folder {made} {doubt}: {other} is used instead")
    return other


def _made(folder: Path) -> Path:
    """The folder with its links followed, so that turning one later changes nothing."""
    folder.mkdir(mode=0o700, parents=True, exist_ok=True)
    return folder.resolve()


def _doubt(folder: Path) -> str:
    """Why a folder cannot be trusted; empty when it can."""
    if not HAS_OWNERS:
        return ""
    facts = folder.lstat()
    if not stat.S_ISDIR(facts.st_mode):
        return "is not a folder"
    if not is_trusted(facts.st_uid):
        return "belongs to another user"
    if facts.st_mode & OTHERS:
        return f"can be written to by others (chmod go-w {folder})"
    for parent in folder.parents:
        facts = parent.stat()
        if not (is_trusted(facts.st_uid) or _is_unmapped(facts.st_uid)):
            return f"can be replaced by another user, to whom {parent} belongs"
        if facts.st_mode & OTHERS and not facts.st_mode & stat.S_ISVTX:
            return f"can be replaced by others, who may write to {parent}"
    return ""


def is_trusted(user: int) -> bool:
    """Whether a user may have this program run what he likes: this one, and the administrator."""
    return user in (os.geteuid(), ADMINISTRATOR)


@cache
def _is_unmapped(user: int) -> bool:
    """Whether that is how Linux shows users outside of a container, of whom none is in it."""
    try:
        nobody = int(Path("/proc/sys/kernel/overflowuid").read_text(encoding="utf-8"))
        mapped = Path("/proc/self/uid_map").read_text(encoding="utf-8").split()
    except (OSError, ValueError):
        return False
    ranges = zip(map(int, mapped[::3]), map(int, mapped[2::3]), strict=False)
    return user == nobody and not any(first <= user < first + count for first, count in ranges)


def _taken_back(folder: Path) -> bool:
    """Close a folder of our own that was open to others, and drop what they may have put there."""
    if folder.stat().st_uid != os.geteuid():
        return False
    folder.chmod(0o700)
    clear(folder)
    return not _doubt(folder)


def _temporary() -> Path:
    """A folder of this user among the temporary ones; where that is not safe, a private one."""
    from tempfile import gettempdir

    folder = Path(gettempdir()).resolve() / f"adamslite-{os.geteuid() if HAS_OWNERS else 'cache'}"
    try:
        folder.mkdir(mode=0o700, exist_ok=True)
        doubt = _doubt(folder)
    except OSError as fault:
        doubt = f"cannot be had ({fault.strerror})"
    if not doubt:
        return folder
    private = _private()
    warn(f"the cache folder {folder} {doubt}: what is compiled in {private} goes with this process")
    return private


@cache
def _private() -> Path:
    """A folder of this process alone, removed at its end."""
    import atexit
    import shutil
    import tempfile

    folder = tempfile.mkdtemp(prefix="adamslite-")
    atexit.register(shutil.rmtree, folder, ignore_errors=True)
    return Path(folder).resolve()


def warn(sentence: str) -> None:
    """One line on standard error, or wherever a program that uses this one sends warnings."""
    from logging import getLogger

    getLogger("adamslite").warning("adamslite: %s", sentence)
