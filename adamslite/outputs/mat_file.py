"""Variables of MATLAB files (version 5), read without native code: files may come from others.

::

    header      128 bytes; the last two say in which order bytes are, "IM" or "MI"
    element     type and size (two uint32; sizes of 1 to 4 bytes share the first with the type),
                data, room up to the next multiple of 8
    matrix      an element of elements: flags and class, dimensions, name, content
    content     numbers: one element;  text: one;  cells: a matrix each;
                struct: length of names, names of fields, a matrix for each

A compressed element is another one behind zlib.  Numbers are in the order of columns.

Source: MAT-File Format (The MathWorks, R2024a).
"""

from __future__ import annotations

import struct
from collections.abc import Iterator
from dataclasses import dataclass
from math import prod
from typing import NamedTuple

import numpy as np

from adamslite.results.untrusted import inflated, plausible

HEADER = 128
ORDERS = {b"IM": "<", b"MI": ">"}
#: Types of elements.
MATRIX, COMPRESSED, INTEGERS = 14, 15, (5, 6)
NUMBERS = {1: "i1", 2: "u1", 3: "i2", 4: "u2", 5: "i4", 6: "u4", 7: "f4", 9: "f8", 12: "i8",
           13: "u8"}  # fmt: skip
TEXTS = {1: "latin-1", 2: "latin-1", 4: "utf-16", 16: "utf-8", 17: "utf-16", 18: "utf-32"}
#: Classes of matrices.
CELLS, STRUCT, TEXT, NUMERIC = 1, 2, 4, range(6, 16)
COMPLEX = 0x800
#: Bytes of the dimensions of a matrix.
MOST_SIZES = 128
ENDS_EARLY = "it ends early"


class Element(NamedTuple):
    """A type and the bytes of that type."""

    type: int
    data: memoryview


NONE = Element(9, memoryview(b""))


@dataclass(frozen=True)
class Matrix:
    """A variable, a cell or a field: its head, and the elements of its content, not yet read."""

    name: str
    type: int
    shape: tuple[int, ...]
    is_complex: bool
    content: memoryview
    order: str

    @property
    def size(self) -> int:
        """How many numbers, characters or cells it says to have."""
        return prod(self.shape)

    def numbers(self) -> np.ndarray:
        """Its numbers, as floats in the order of the file.

        Raises
        ------
        ValueError
            When it has no real numbers, or not as many as it says.
        """
        if self.type not in NUMERIC or self.is_complex:
            raise ValueError(f"'{self.name}' is no full matrix of real numbers")
        element = self._first()
        found = np.frombuffer(element.data, self.order + NUMBERS[element.type])
        if found.size != self.size:
            raise ValueError(f"'{self.name}' has {found.size} numbers where {self.size} belong")
        return found.astype(float)

    def texts(self) -> list[str]:
        """The texts of its cells, or of its rows."""
        if self.type == CELLS:
            return [each.text() for each in self._cells(self.size)]
        text = self._characters()
        rows = self.shape[0]
        if rows < 2:
            return [text] if text else []
        if len(text) != self.size:
            raise ValueError(f"'{self.name}' has {len(text)} characters where {self.size} belong")
        return [text[row::rows].rstrip() for row in range(rows)]

    def text(self) -> str:
        """The text, or the first number; of cells that of the first one; empty where none is."""
        found = self
        while found.type == CELLS and found.size:
            found = next(found._cells(1))
        if found.type == TEXT:
            return found._characters()
        return str(found.numbers()[0]) if found.type in NUMERIC and found.size else ""

    def fields(self) -> dict[str, Matrix]:
        """The fields of the first struct in it."""
        if self.type != STRUCT or not self.size:
            return {}
        (width, *more), rest = _whole(self.content, self.order)
        names, rest = _split(rest, self.order)
        if more or width < 1 or len(names.data) % width:
            raise ValueError("the names of its fields are damaged")
        words = [bytes(names.data[k : k + width]) for k in range(0, len(names.data), width)]
        fields = [each.rstrip(b"\0").decode("latin-1") for each in words]
        return dict(zip(fields, _matrices(rest, self.order, len(fields)), strict=True))

    def _cells(self, count: int) -> Iterator[Matrix]:
        return _matrices(self.content, self.order, count)

    def _first(self) -> Element:
        return next(_elements(self.content, self.order), NONE)

    def _characters(self) -> str:
        found = self._first()
        if self.type != TEXT or not found.data:
            return ""
        code = TEXTS[found.type]
        wide = {"<": "-le", ">": "-be"}[self.order] if code in ("utf-16", "utf-32") else ""
        return str(found.data, code + wide)


def variables(data: bytes) -> dict[str, Matrix]:
    """The variables of a file, by their names.

    Raises
    ------
    ValueError, KeyError, zlib.error
        When it is none, or is damaged.
    """
    order = ORDERS.get(data[HEADER - 2 : HEADER])
    if order is None:
        raise ValueError("it has no header of version 5; write it in MATLAB with save -v7")
    room = plausible(len(data))
    found = {}
    for element in _elements(memoryview(data)[HEADER:], order):
        if element.type == COMPRESSED:
            content = inflated(element.data, room)
            room -= len(content)
            element = next(_elements(memoryview(content), order), NONE)
        if element.type == MATRIX:
            matrix = _matrix(element.data, order)
            found[matrix.name] = matrix
    return found


def _elements(data: memoryview, order: str) -> Iterator[Element]:
    """One behind the other, to the end."""
    while data:
        element, data = _split(data, order)
        yield element


def _split(data: memoryview, order: str) -> tuple[Element, memoryview]:
    """The first element, and what is behind it."""
    if len(data) < 8:
        raise ValueError(ENDS_EARLY)
    type_, size = struct.unpack_from(f"{order}II", data)
    first = 8
    if type_ >> 16:  # both in one word
        type_, size, first = type_ & 0xFFFF, type_ >> 16, 4
        if size > 4:
            raise ValueError(f"a short element has {size} bytes")
    end = first + size
    if end > len(data):
        raise ValueError(ENDS_EARLY)
    behind = end if type_ == COMPRESSED else end + -end % 8
    return Element(type_, data[first:end]), data[behind:]


def _matrices(data: memoryview, order: str, count: int) -> Iterator[Matrix]:
    """So many matrices behind each other."""
    elements = _elements(data, order)
    for _ in range(count):
        each = next(elements, NONE)
        if each.type != MATRIX:
            raise ValueError(ENDS_EARLY)
        yield _matrix(each.data, order)


def _matrix(data: memoryview, order: str) -> Matrix:
    """The head of a matrix; one without anything is an empty one."""
    if not data:
        return NOTHING
    flags, data = _whole(data, order)
    shape, data = _whole(data, order)
    name, data = _split(data, order)
    if len(flags) != 2 or len(shape) < 2 or min(shape) < 0:
        raise ValueError("the head of a variable is damaged")
    return Matrix(
        str(name.data, "latin-1"), flags[0] & 0xFF, shape, bool(flags[0] & COMPLEX), data, order
    )


def _whole(data: memoryview, order: str) -> tuple[tuple[int, ...], memoryview]:
    """Whole numbers of 4 bytes, and what is behind them."""
    element, rest = _split(data, order)
    if element.type not in INTEGERS or len(element.data) % 4 or len(element.data) > MOST_SIZES:
        raise ValueError("the head of a variable is damaged")
    return struct.unpack(f"{order}{len(element.data) // 4}i", element.data), rest


NOTHING = Matrix("", 6, (0, 0), False, memoryview(b""), "<")
