"""Formats of result files, found by the suffix of a name.

A module of :mod:`adamslite.outputs` registers one with a call at its end::

    register_format(".csv", "what such a file holds, in a sentence", write, read)

with ``write(results, path)``, and ``read(path)`` that returns results if the format can be read.
``write`` leaves the results as they are, and writes whole files or none
(:mod:`adamslite.outputs.whole_files`); tests/test_formats.py checks every format that is
registered.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cache
from importlib import import_module
from pathlib import Path
from typing import Any, TypeAlias

from adamslite.errors import FormatError, UsageError

Written: TypeAlias = Any
Growing: TypeAlias = Any
"""``Results`` and ``Growing``, whose modules find formats here and cannot be imported from here."""
DEFAULT = ".csv"
"""What a name without a suffix gets; the null device has none."""


@dataclass(frozen=True)
class Format:
    """How files of one suffix are written and read, and a sentence about what they hold.

    ``library``: loads what they need beyond the dependencies of the package, or raises a
    UsageError that says what to install.  ``exact``: names, times and numbers come back to the
    bit.  ``growing(path, patterns)``: a file that can be written while its run lasts, as
    :mod:`adamslite.outputs.row_by_row` has it.  ``need_room(rows, columns)`` raises a UsageError
    where the format does not hold so many.
    """

    suffix: str
    what: str
    write: Callable[[Written, str | Path], None]
    read: Callable[[str | Path], Written] | None = None
    library: Callable[[], object] | None = None
    exact: bool = True
    growing: Callable[[Path, Sequence[str]], Growing] | None = None
    need_room: Callable[[int, int], None] | None = None

    def require_library(self) -> None:
        """Raise UsageError where a library is missing, before a run rather than after it."""
        if self.library is not None:
            self.library()


_FORMATS: dict[str, Format] = {}


def register_format(
    suffix: str,
    what: str,
    write: Callable[[Written, str | Path], None],
    read: Callable[[str | Path], Written] | None = None,
    library: Callable[[], object] | None = None,
    exact: bool = True,
    growing: Callable[[Path, Sequence[str]], Growing] | None = None,
    need_room: Callable[[int, int], None] | None = None,
) -> None:
    """Enter the format of a suffix, which begins with a dot and is in lower case."""
    if suffix in _FORMATS:
        raise ValueError(f"format {suffix} is registered twice")
    _FORMATS[suffix] = Format(suffix, what, write, read, library, exact, growing, need_room)


@cache
def formats() -> dict[str, Format]:
    """Every format by its suffix."""
    for module in import_module("adamslite.outputs").modules():
        import_module(module)
    return _FORMATS


def format_of(path: str | Path, to_read: bool = False) -> Format:
    """The format of a file name.

    Raises
    ------
    UsageError, FormatError
        When no format has its suffix: to write in, or to read from.
    """
    suffix = Path(path).suffix.lower() or DEFAULT
    if suffix == DEFAULT:  # most runs need no other
        import_module("adamslite.outputs.csv")
        return _FORMATS[suffix]
    usable = {s: f for s, f in formats().items() if f.read or not to_read}
    if suffix in usable:
        return usable[suffix]
    none_of = f"{path}: '{suffix}' is none of {', '.join(sorted(usable))}"
    if to_read:
        raise FormatError(f"results cannot be read from {none_of}")
    raise UsageError(f"results cannot be written to {none_of}")
