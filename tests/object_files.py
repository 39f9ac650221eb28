"""The symbols that an object file does not hold itself, of ELF, Mach-O and COFF, 64 bit.

References: System V ABI, chapter 4; "Mach-O Programming Topics" and `mach-o/nlist.h`; Microsoft PE
and COFF specification, sections 3 and 5.4.
"""

from __future__ import annotations

import struct
from collections.abc import Iterator


def foreign(code: bytes) -> set[str]:
    """Names of undefined symbols, as C has them."""
    if code.startswith(b"\x7fELF"):
        return {*_elf(code)}
    if code.startswith(b"\xcf\xfa\xed\xfe"):  # names of C begin with an underscore
        return {name.removeprefix("_") for name in _mach_o(code)}
    return {*_coff(code)}


def _text(code: bytes, start: int) -> str:
    return code[start : code.index(b"\0", start)].decode()


def _elf(code: bytes) -> Iterator[str]:
    sections, size, count = struct.unpack_from("<Q10xHH", code, 40)
    heads = [struct.unpack_from("<4xI16xQQI", code, sections + k * size) for k in range(count)]
    ((_, start, length, link),) = (head for head in heads if head[0] == 2)
    names = heads[link][1]
    for at in range(start + 24, start + length, 24):
        name, _, _, section = struct.unpack_from("<IBBH", code, at)
        if section == 0:
            yield _text(code, names + name)


def _mach_o(code: bytes) -> Iterator[str]:
    (count,), at = struct.unpack_from("<I", code, 16), 32
    for _ in range(count):
        command, size = struct.unpack_from("<II", code, at)
        if command == 2:
            start, number, names, _ = struct.unpack_from("<4I", code, at + 8)
            for k in range(number):
                name, kind, _, _, _ = struct.unpack_from("<IBBHQ", code, start + 16 * k)
                if kind & 0x0E == 0 and kind & 0x01:
                    yield _text(code, names + name)
        at += size


def _coff(code: bytes) -> Iterator[str]:
    start, number = struct.unpack_from("<II", code, 8)
    names, k = start + 18 * number, 0
    while k < number:
        at = start + 18 * k
        short, _, section, _, storage, more = struct.unpack_from("<8sIhHBB", code, at)
        if section == 0 and storage == 2:
            long = struct.unpack("<II", short)
            yield short.rstrip(b"\0").decode() if long[0] else _text(code, names + long[1])
        k += 1 + more
