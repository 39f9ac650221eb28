"""Typed records: fields at fixed slots, for native code and for plain Python.

A record is a row of slots of eight bytes.  Its annotations are its fields, in order::

    class Control(Record):
        now: float                  # int, float, bool: one slot
        search: Search              # another record: its slots are inside
        ends: Reals = array(6)      # array of fixed size: its numbers are inside
        history: Reals              # array by reference: its address and its length
        body: Rows[Body]            # records behind each other, by reference

    C = Control.zeros()             C.now, C.search.low, C.ends[2], C.history.size, C.body[3].first
    C = Control(room)               the slots of an array, seen as this record
    C.search[:] = other             all numbers of a record; C.search[:] = 0 clears it

A record may extend another one, whose fields then come first.
"""

from __future__ import annotations

import ctypes
import inspect
import operator
import sys
from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING, Any, ClassVar, Generic, Self, TypeAlias, TypeGuard, TypeVar

import numpy as np

SLOT = 8
Kind: TypeAlias = Any
"""What a value is: ``i64 double i1 Ints Reals void``, a class of records, or :class:`RowsOf` one.
The translator branches on the words, which no type checker follows."""


if TYPE_CHECKING:  # what these annotations stand for
    Ints: TypeAlias = np.ndarray[Any, np.dtype[np.int64]]
    Reals: TypeAlias = np.ndarray[Any, np.dtype[np.float64]]
    Alone: TypeAlias = Reals

else:

    class Ints(np.ndarray):
        """Annotation of an array of integers."""

    class Reals(np.ndarray):
        """Annotation of an array of reals."""

    class Alone(Reals):
        """Annotation of an array of reals that no other argument reaches."""


class Length:
    """How many numbers a field of type ``Ints`` or ``Reals`` has inside of its record."""

    def __init__(self, length: int) -> None:
        self.length = length


def array(length: int) -> Any:
    """In the body of a record, what makes a field an array of fixed size inside of it."""
    return Length(length)


Numbers: TypeAlias = np.ndarray
"""An array of either."""


SCALARS = {"int": "i64", "float": "double", "bool": "i1"}
ARRAYS = {"Ints": "i64", "Reals": "double"}
TYPES = {"i64": np.int64, "double": np.float64}


def address_of(numbers: np.ndarray) -> int:
    """Where the numbers of an array begin; ``numbers.ctypes`` takes five times as long."""
    if numbers.size and numbers.flags.writeable:
        return ctypes.addressof(ctypes.c_char.from_buffer(numbers.data))
    return int(numbers.ctypes.data)


class RecordField:
    """One field: its kind, its first slot and how many it takes; what Python reads and sets."""

    slots = 1

    def __init__(self, kind: Kind, at: int) -> None:
        self.kind = kind
        self.at = at

    def empty(self) -> Any:
        """What a field that refers to numbers holds when there are none."""
        raise NotImplementedError


class Scalar(RecordField):
    """An ``int``, ``float`` or ``bool``."""

    def __get__(self, record: Record | None, owner: object = None) -> Any:
        if record is None:
            return self
        if self.kind == "double":
            return record._reals[self.at]
        number = int(record._ints[self.at])
        return number != 0 if self.kind == "i1" else number

    def __set__(self, record: Record, value: Any) -> None:
        if self.kind == "double":
            record._reals[self.at] = value
        else:
            record._ints[self.at] = bool(value) if self.kind == "i1" else operator.index(value)


class Nested(RecordField):
    """Another record inside of this one."""

    def __init__(self, kind: type[Record], at: int) -> None:
        super().__init__(kind, at)
        self.slots = kind.slots

    def __get__(self, record: Record | None, owner: object = None) -> Any:
        if record is None:
            return self
        if self.at not in record._kept:
            record._kept[self.at] = self.kind(record._ints[self.at : self.at + self.slots])
        return record._kept[self.at]

    def __set__(self, record: Record, value: Any) -> None:
        self.__get__(record)[:] = value


class Inside(RecordField):
    """An array of fixed size inside of a record."""

    def __init__(self, kind: str, at: int, length: int) -> None:
        super().__init__(kind, at)
        self.slots = length

    def __get__(self, record: Record | None, owner: object = None) -> Any:
        if record is None:
            return self
        numbers = record._reals if self.kind == "Reals" else record._ints
        return numbers[self.at : self.at + self.slots]

    def __set__(self, record: Record, value: Any) -> None:
        self.__get__(record)[:] = value


class ByReference(RecordField):
    """An array, or rows, by address and length; the record keeps it alive."""

    slots = 2

    def empty(self) -> Any:
        """An array, or rows, of no length."""
        if isinstance(self.kind, RowsOf):
            return Rows(self.kind.record, 0)
        return np.zeros(0, TYPES[ARRAYS[self.kind]])

    def __get__(self, record: Record | None, owner: object = None) -> Any:
        if record is None:
            return self
        return record._kept[self.at]

    def __set__(self, record: Record, value: Any) -> None:
        numbers = value
        if record._kept.get(self.at) is value:
            return
        if isinstance(self.kind, RowsOf):
            if not (isinstance(value, Rows) and value.kind is self.kind.record):
                raise TypeError(f"rows of {self.kind.record.__name__} are needed, not {value!r}")
            numbers = value.numbers
        elif numbers.dtype != TYPES[ARRAYS[self.kind]] or not numbers.flags.c_contiguous:
            raise TypeError(f"{self.kind} must be dense and of 64 bits, not {numbers.dtype}")
        record._kept[self.at] = value
        record._ints[self.at], record._ints[self.at + 1] = address_of(numbers), value.size


class Record:
    """Fields at fixed places of memory; see above."""

    fields: ClassVar[dict[str, RecordField]] = {}
    slots: ClassVar[int] = 0
    #: Names of the arrays and rows that it holds by reference.
    references: ClassVar[tuple[str, ...]] = ()
    #: Found when first asked for.
    _address = 0
    #: Of a record all of whose arrays are empty: its numbers, and what it keeps.
    _blank: ClassVar[tuple[np.ndarray, dict[int, Any]]]
    #: Whether it holds addresses: such a record is not copied or cleared as a whole.
    refers: ClassVar[bool] = False

    def __init_subclass__(cls) -> None:
        cls.fields, at = dict(cls.fields), cls.slots
        names = vars(sys.modules[cls.__module__])
        for name, hint in inspect.get_annotations(cls).items():
            if str(hint).startswith("ClassVar"):
                continue
            if hasattr(Record, name) or name in cls.fields:
                raise TypeError(f"{cls.__name__}: a field cannot be called {name}")
            field = _field(resolve(hint, names), at, cls.__dict__.get(name))
            if field is None:
                raise TypeError(f"{cls.__name__}.{name}: {hint} is no type of a field")
            cls.fields[name], at = field, at + field.slots
            setattr(cls, name, field)
        cls.slots = at
        cls.references = tuple(n for n, f in cls.fields.items() if isinstance(f, ByReference))
        inside = (f.kind for f in cls.fields.values() if isinstance(f, Nested))
        cls.refers = bool(cls.references) or any(record.refers for record in inside)

    def __init__(self, room: np.ndarray) -> None:
        """The first slots of an array of 64-bit numbers (``slots``,) or more."""
        if room.size < self.slots:
            raise ValueError(f"{type(self).__name__} takes {self.slots} slots, not {room.size}")
        self._ints = room[: self.slots].view(np.int64)
        self._reals = self._ints.view(np.float64)
        self._kept: dict[int, Any] = {}

    @classmethod
    def zeros(cls) -> Self:
        """A record of its own, all numbers zero, all arrays empty."""
        record = cls(np.zeros(cls.slots, np.int64))
        record._empty()
        return record

    def _empty(self) -> None:
        """Refer to empty arrays, which all records of a class share."""
        kind = type(self)
        if "_blank" not in vars(kind):
            for name in self.references:
                setattr(self, name, self.fields[name].empty())
            kept = {self.fields[name].at: getattr(self, name) for name in self.references}
            kind._blank = self._ints.copy(), kept
        numbers, arrays = kind._blank
        self._ints[:] = numbers
        self._kept.update(arrays)
        for name, field in self.fields.items():
            if isinstance(field, Nested) and field.kind.refers:
                getattr(self, name)._empty()

    def __setattr__(self, name: str, value: object) -> None:
        if name not in self.fields and not name.startswith("_"):
            raise AttributeError(f"{type(self).__name__} has no field {name}")
        object.__setattr__(self, name, value)

    def __setitem__(self, everything: slice, value: Self | int) -> None:
        """Copy all numbers of another such record, or clear them with 0."""
        if everything != slice(None) or self.refers:
            raise TypeError(f"{type(self).__name__} is not set like this")
        if isinstance(value, Record):
            if type(value) is not type(self):
                raise TypeError(f"{type(value).__name__} is no {type(self).__name__}")
            self._ints[:] = value._ints
        elif value == 0:
            self._ints[:] = 0
        else:
            raise TypeError("a record is set to another one, or to 0")

    def refer(self, arrays: Iterable[Any]) -> None:
        """Hold these arrays and rows, in the order of ``references``: most are there already."""
        kept = self._kept
        for name, value in zip(self.references, arrays, strict=True):
            if kept[self.fields[name].at] is not value:
                setattr(self, name, value)

    def copy(self) -> Self:
        """Another record with the same numbers."""
        other = self.zeros()
        other[:] = self
        return other

    def values(self) -> dict[str, Any]:
        """What every field holds, by its name."""
        return {name: getattr(self, name) for name in self.fields}

    def __repr__(self) -> str:
        return f"{type(self).__name__}({', '.join(f'{k}={v}' for k, v in self.values().items())})"

    @property
    def address(self) -> int:
        """Where it begins, as native code takes it."""
        if not self._address:
            self._address = int(self._ints.ctypes.data)
        return self._address


R = TypeVar("R", bound=Record)


class Rows(Generic[R]):
    """Records of one kind behind each other: ``size`` of them."""

    def __init__(self, kind: type[R], numbers: int | np.ndarray) -> None:
        """``numbers``: how many cleared ones, or what all of them hold (size, slots) as 64-bit
        numbers, which are not copied.
        """
        self.kind = kind
        if isinstance(numbers, int):
            self.numbers = np.zeros(numbers * kind.slots, np.int64)
        else:
            self.numbers = numbers.reshape(-1)
        self.size = self.numbers.size // kind.slots

    def __len__(self) -> int:
        return self.size

    def __getitem__(self, k: int) -> R:
        if not 0 <= k < self.size:
            raise IndexError(f"{k} of {self.size} rows")
        return self.kind(self.numbers[k * self.kind.slots : (k + 1) * self.kind.slots])

    def __iter__(self) -> Iterator[R]:
        return (self[k] for k in range(self.size))

    def __repr__(self) -> str:
        return repr(list(self))


class RowsOf:
    """The kind of a value that is an array of records."""

    def __init__(self, record: type[Record]) -> None:
        self.record = record

    def __eq__(self, other: object) -> bool:
        return isinstance(other, RowsOf) and other.record is self.record

    def __hash__(self) -> int:
        return hash(self.record)


def resolve(hint: Any, names: dict[str, Any]) -> Kind | None:
    """The kind that an annotation means where ``names`` are known: i64, double, i1, Ints, Reals, a
    record, rows of records; None for anything else.
    """
    word = hint if isinstance(hint, str) else getattr(hint, "__name__", str(hint))
    if getattr(hint, "__args__", ()):
        hint = word = f"Rows[{hint.__args__[0].__name__}]"
    if word.startswith("Rows[") and word.endswith("]"):
        record = resolve(word[5:-1], names)
        return RowsOf(record) if is_record(record) else None
    if word in ("Ints", "Reals", "Alone"):
        return "Ints" if word == "Ints" else "Reals"
    if word in SCALARS:
        return SCALARS[word]
    found = names.get(word) if isinstance(hint, str) else hint
    return found if is_record(found) else None


def is_record(kind: object) -> TypeGuard[type[Record]]:
    """Whether a kind is that of a record."""
    return isinstance(kind, type) and issubclass(kind, Record)


def _field(kind: Kind, at: int, given: Any) -> RecordField | None:
    """The field of a kind at a slot; ``given``: what its annotation was set to."""
    if kind is None:
        return None
    if isinstance(given, Length):
        return Inside(kind, at, given.length) if kind in ARRAYS else None
    if kind in ARRAYS or isinstance(kind, RowsOf):
        return ByReference(kind, at)
    return Nested(kind, at) if is_record(kind) else Scalar(kind, at)
