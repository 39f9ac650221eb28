"""A linker for object code: places it in this process without LLVM.

Compiled for x86-64 under Linux it is ELF in the large code model: code, constants, functions of the
C library and those linked before may lie anywhere, so an instruction holds each address as a whole
word and one kind of relocation is left,

    word = S + A,      S: address of the symbol,  A: number to add

which takes no compiler's library, only this module.  All other object code is :class:`Foreign`.

References: System V Application Binary Interface, chapter 4 (header, sections, symbol table,
relocation); its AMD64 supplement, table 4.9 (``R_X86_64_64``).
"""

from __future__ import annotations

import ctypes
import mmap
import sys
from collections.abc import Iterator, Mapping, Sequence
from functools import cache

import numpy as np

#: 64 bit, little end first, version 1; machine x86-64.
IDENTITY, MACHINE = b"\x7fELF\x02\x01\x01", 62
HEADER = np.dtype(
    [("identity", "S16"), ("type", "<u2"), ("machine", "<u2"), ("version", "<u4"),
     ("entry", "<u8"), ("segments", "<u8"), ("sections", "<u8"), ("flags", "<u4"),
     ("size", "<u2"), ("segment_size", "<u2"), ("n_segments", "<u2"), ("section_size", "<u2"),
     ("n_sections", "<u2"), ("name_section", "<u2")]
)  # fmt: skip
SECTION = np.dtype(
    [("name", "<u4"), ("type", "<u4"), ("flags", "<u8"), ("address", "<u8"), ("offset", "<u8"),
     ("size", "<u8"), ("link", "<u4"), ("info", "<u4"), ("align", "<u8"), ("entry", "<u8")]
)  # fmt: skip
SYMBOL = np.dtype(
    [("name", "<u4"), ("info", "u1"), ("other", "u1"), ("section", "<u2"), ("value", "<u8"),
     ("size", "<u8")]
)  # fmt: skip
RELOCATION = np.dtype([("offset", "<u8"), ("type", "<u4"), ("symbol", "<u4"), ("add", "<u8")])

PROGBITS, SYMTAB, RELA = 1, 2, 4
WRITTEN, LOADED = 1, 2
UNDEFINED, GLOBAL, WORD = 0, 1, 1


class Foreign(Exception):
    """Object code that this module does not link; the argument says why."""


def link(codes: Sequence[bytes], linked: Mapping[str, int]) -> dict[str, int]:
    """Addresses of the global functions in object files, valid as long as the process lives; they
    may call each other's, and those of files ``linked`` before, by their addresses.

    Raises
    ------
    Foreign
        When one is for another machine or system, or needs what is not done here.
    """
    images = [_Image(code) for code in codes]
    found = {name: address for each in images for name, address in each.public()}
    for each in images:
        each.relocate({**linked, **found})
    return found


class _Image:
    """An object file in memory; ``at``: where its sections begin."""

    def __init__(self, code: bytes) -> None:
        self.code, self.sections = code, sections_of(code)
        _without_variables(self.sections)
        self.at, size = _places(self.sections)
        memory = mmap.mmap(-1, size, mmap.MAP_PRIVATE | mmap.MAP_ANONYMOUS)
        self.image = np.frombuffer(memory, np.uint8)
        for number, start in self.at.items():
            part = self.sections[number]
            self.image[start : start + int(part["size"])] = _table(code, part, np.uint8)
        self.symbols, self.names = _symbols(code, self.sections)

    def public(self) -> Iterator[tuple[str, int]]:
        """The global functions that are here, and their addresses."""
        for symbol, name in zip(self.symbols.tolist(), self.names, strict=True):
            if symbol[3] in self.at and symbol[1] >> 4 == GLOBAL:
                yield name, self._value(symbol, name, {})

    def relocate(self, known: Mapping[str, int]) -> None:
        """Fill in addresses, and let the code be run and no longer be written."""
        named = zip(self.symbols.tolist(), self.names, strict=True)
        values = np.array([self._value(*each, known) for each in named], dtype=np.uint64)
        _relocate(self.code, self.sections, self.at, self.image, values)
        _make_executable(self.image)

    def _value(self, symbol: tuple[int, ...], name: str, known: Mapping[str, int]) -> int:
        """Address of a symbol: here, of a known function or one of the C library; else 0."""
        section, value = symbol[3], symbol[4]
        if section in self.at:
            return self.image.ctypes.data + self.at[section] + value
        if name in known:
            return known[name]
        return _from_library(name) if section == UNDEFINED and name else 0


def sections_of(code: bytes) -> np.ndarray:
    """The table of the sections of an object file; raises :class:`Foreign`."""
    known = sys.platform == "linux" and code.startswith(IDENTITY) and len(code) > HEADER.itemsize
    header = np.frombuffer(code, HEADER, 1)[0] if known else None
    if header is None or header["machine"] != MACHINE:
        raise Foreign("not ELF for x86-64 under Linux")
    return np.frombuffer(code, SECTION, header["n_sections"], int(header["sections"]))


def _without_variables(sections: np.ndarray) -> None:
    loaded = sections["flags"] & LOADED != 0
    if (loaded & (sections["type"] != PROGBITS) | (sections["flags"] & WRITTEN != 0)).any():
        raise Foreign("has variables")


def _places(sections: np.ndarray) -> tuple[dict[int, int], int]:
    """Offset of each section that is loaded, and the size of all of them in whole pages."""
    at, end = {}, 0
    for number in np.flatnonzero(sections["flags"] & LOADED).tolist():
        align = max(1, int(sections["align"][number]))
        at[number] = -(-end // align) * align
        end = at[number] + int(sections["size"][number])
    return at, -(-max(end, 1) // mmap.PAGESIZE) * mmap.PAGESIZE


def _table(code: bytes, section: np.void, kind: np.dtype | type[np.uint8]) -> np.ndarray:
    """The entries of a section."""
    entries = int(section["size"]) // np.dtype(kind).itemsize
    return np.frombuffer(code, kind, entries, int(section["offset"]))


def _symbols(code: bytes, sections: np.ndarray) -> tuple[np.ndarray, list[str]]:
    table = sections[sections["type"] == SYMTAB][0]
    symbols = _table(code, table, SYMBOL)
    start = int(sections["offset"][table["link"]])
    firsts = [start + name for name in symbols["name"].tolist()]
    return symbols, [code[first : code.index(b"\0", first)].decode() for first in firsts]


@cache
def _from_library(name: str) -> int:
    for library in (None, "libm.so.6"):
        try:
            function = getattr(ctypes.CDLL(library), name)
        except (AttributeError, OSError):
            continue
        return ctypes.cast(function, ctypes.c_void_p).value or 0
    raise Foreign(f"calls {name}, which is not known")


def _relocate(
    code: bytes, sections: np.ndarray, at: dict[int, int], image: np.ndarray, values: np.ndarray
) -> None:
    for part in sections[sections["type"] == RELA]:
        if int(part["info"]) not in at:
            continue
        entries = _table(code, part, RELOCATION)
        words = values[entries["symbol"]]
        if (entries["type"] != WORD).any() or not words.all():
            raise Foreign("has relocations other than whole words")
        first = entries["offset"].astype(np.int64) + at[int(part["info"])]
        filled = (words + entries["add"]).view(np.uint8).reshape(-1, 8)
        image[first[:, None] + np.arange(8)] = filled


def _make_executable(image: np.ndarray) -> None:
    """Let memory be run and no longer be written."""
    protect = ctypes.CDLL(None).mprotect
    place = ctypes.c_void_p(image.ctypes.data), ctypes.c_size_t(image.size)
    if protect(*place, mmap.PROT_READ | mmap.PROT_EXEC):
        raise Foreign("the system allows no new code")
    _kept.append(image)


_kept: list[np.ndarray] = []
