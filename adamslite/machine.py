"""What the machine has left: memory and disk; and a limit of the memory of this process.

The limit is that of the system on the data of a process (``RLIMIT_DATA``), under which an
allocation fails.  Linux keeps it.  macOS does not count what is mapped, and Windows has no such
limit: there only what is estimated beforehand is held against it.
"""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

STATUS, MEMORY, GROUP = Path("/proc/self/status"), Path("/proc/meminfo"), Path("/proc/self/cgroup")
GROUPS = Path("/sys/fs/cgroup")
KIB = 1024
#: Linear algebra takes so much when it is loaded and first used [byte]; where it gets none it ends
#: the process, or waits for ever.
ALGEBRA, OF_ALGEBRA = "scipy.linalg", 100_000_000

_limit: int | None = None


@contextmanager
def memory_limited(limit: int | None) -> Iterator[None]:
    """Meanwhile allocations fail that would bring the data of the process above a limit [byte]."""
    global _limit
    if limit is None:
        yield
        return
    outer, before = _limit, _system_limit()
    _use_algebra()
    _limit = limit if outer is None else min(limit, outer)
    _set_system_limit(_limit)
    guard = _Guard()
    sys.meta_path.insert(0, guard)
    try:
        yield
    finally:
        sys.meta_path.remove(guard)
        _limit = outer
        _set_system_limit(before)


class _Guard:
    """Stands before the import of linear algebra, which needs memory that it must get."""

    def find_spec(self, name: str, path: object = None, target: object = None) -> None:
        if name == ALGEBRA:
            require_memory(OF_ALGEBRA)


def _use_algebra() -> None:
    """Let that of numpy, which is loaded, take what it needs: it ends the process otherwise."""
    import numpy as np

    np.linalg.solve(np.eye(2), np.ones(2))


def lift_memory_limit() -> None:
    """Allow more again: what is done when the limit is reached needs some itself."""
    if _limit is not None:
        with suppress(ImportError, OSError, ValueError):
            import resource

            _, hard = resource.getrlimit(resource.RLIMIT_DATA)
            resource.setrlimit(resource.RLIMIT_DATA, (hard, hard))


def _system_limit() -> int | None:
    """The limit that the system keeps now [byte], -1 for none; None where it has no such limit."""
    try:
        import resource
    except ImportError:
        return None
    return resource.getrlimit(resource.RLIMIT_DATA)[0]


def _set_system_limit(limit: int | None) -> None:
    if limit is None or (now := _system_limit()) is None:
        return
    import resource

    hard = resource.getrlimit(resource.RLIMIT_DATA)[1]
    if hard != resource.RLIM_INFINITY:
        limit = hard if limit == resource.RLIM_INFINITY else min(limit, hard)
    if limit != now:
        resource.setrlimit(resource.RLIMIT_DATA, (limit, hard))


def used_memory() -> int | None:
    """Data of this process [byte], as the limit counts them; None where the system is silent."""
    return _numbers(STATUS).get("VmData")


def left_of_limit() -> int | None:
    """What this process may still allocate within its limit [byte]; None without a limit."""
    if _limit is None:
        return None
    used = used_memory()
    return _limit if used is None else max(0, _limit - used)


def require_memory(need: int) -> None:
    """Raise MemoryError where the limit leaves less than ``need`` [byte]: for what would end the
    process when an allocation fails.
    """
    left = left_of_limit()
    if left is not None and left < need:
        raise MemoryError


def free_memory() -> int | None:
    """What this process may take without that others must go [byte]; None where nobody knows."""
    found = [_of_machine(), _of_group(), left_of_limit()]
    return min((each for each in found if each is not None), default=None)


def processors() -> int:
    """How many processors this process may use."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


def free_disk(folder: Path) -> int | None:
    """Room in a folder [byte]; None where nobody knows."""
    try:
        if hasattr(os, "statvfs"):
            found = os.statvfs(folder)
            return found.f_bavail * found.f_frsize
        import shutil

        return shutil.disk_usage(folder).free
    except OSError:
        return None


def _numbers(file: Path) -> dict[str, int]:
    """The sizes that a file of Linux lists as ``Name:  12 kB`` [byte]."""
    try:
        lines = file.read_text(encoding="utf-8").splitlines()
    except (OSError, UnicodeDecodeError):
        return {}
    rows = (line.split() for line in lines if line.endswith("kB"))
    return {row[0].rstrip(":"): KIB * int(row[1]) for row in rows if row[1].isdigit()}


def _of_machine() -> int | None:
    """Memory that is free, or would be for the asking."""
    if sys.platform == "win32":
        return _of_windows()
    found = _numbers(MEMORY).get("MemAvailable")
    if found is None and "SC_PHYS_PAGES" in os.sysconf_names:  # all that there is
        found = os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE")
    return found


def _of_windows() -> int | None:
    import ctypes

    class Status(ctypes.Structure):
        """MEMORYSTATUSEX"""

        _fields_ = [("length", ctypes.c_ulong), ("load", ctypes.c_ulong)] + [
            (name, ctypes.c_ulonglong)
            for name in (
                "total",
                "free",
                "total_page",
                "free_page",
                "total_own",
                "free_own",
                "more",
            )
        ]

    status = Status(length=ctypes.sizeof(Status))
    kernel = vars(ctypes)["windll"].kernel32
    return status.free if kernel.GlobalMemoryStatusEx(ctypes.byref(status)) else None


def _of_group() -> int | None:
    """What the control group of this process (a container, a job of a scheduler) has left, and each
    group around it; pages of files that it may drop do not count.
    """
    left: list[int] = []
    for folder in _groups():
        most, used = (
            _first(folder, "memory.max", "memory.limit_in_bytes"),
            _first(folder, "memory.current", "memory.usage_in_bytes"),
        )
        if most is not None and used is not None:
            left.append(max(0, most - used + _droppable(folder)))
    return min(left, default=None)


def _groups() -> Iterator[Path]:
    """The folders of the control groups, version 2 and 1."""
    try:
        lines = GROUP.read_text(encoding="utf-8").splitlines()
    except OSError:
        return
    for line in lines:
        _, kinds, name = line.split(":", 2)
        if kinds not in ("", "memory"):
            continue
        top = GROUPS / kinds
        folder = top / name.lstrip("/")
        while folder != top and top in folder.parents:
            yield folder
            folder = folder.parent
        yield top


def _first(folder: Path, *names: str) -> int | None:
    """The number in the first of these files; None for ``max``."""
    for name in names:
        with suppress(OSError, ValueError):
            return int((folder / name).read_text(encoding="utf-8"))
    return None


def _droppable(folder: Path) -> int:
    with suppress(OSError, ValueError):
        for line in (folder / "memory.stat").read_text(encoding="utf-8").splitlines():
            name, _, value = line.partition(" ")
            if name in ("inactive_file", "total_inactive_file"):
                return int(value)
    return 0
