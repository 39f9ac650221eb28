"""The file ``OUT.part`` of an unfinished run: rows of its results, and a state to go on from.

::

    magic           "adamslite part 2\\n"
    64, 128         two records of 64 bytes: serial number, place, size, checksum and seal of a
                    state, checksum of the record; that with the larger number counts
    4096 ...        rows (time and values, float64) and states, wherever there is room
    a state         a line of JSON, then arrays behind each other; ``stretches`` says where rows are

A state is written, and with all rows before it brought to the disk, before the record that names it
replaces the older one of the two: whatever moment a run is killed at, one of them is complete.

A state is numbers of native code, such as where it writes next, and names of files.  So it is
sealed with a secret of the user (:mod:`adamslite.caching.secret`), and only the states of other
users, machines and caches that are said to be trusted are taken.
"""

from __future__ import annotations

import json
import os
import struct
import zlib
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, BinaryIO, Protocol, TypeAlias, cast

import numpy as np

from adamslite.caching.secret import seal
from adamslite.errors import FormatError, UsageError
from adamslite.outputs.drafts import SUFFIX, begun, draft_of, lock, over
from adamslite.results.untrusted import from_json

MAGIC = b"adamslite part 2\n"
RECORDS, FIRST = (64, 128), 4096
#: Times (n,) and values (n, nc) of some rows.
Part: TypeAlias = tuple[np.ndarray, np.ndarray]
#: Where a state is, its size, its checksum and its seal (hexadecimal).
Place: TypeAlias = tuple[int, int, int, str]
# Serial number, place, size, checksum and seal of the state; the checksum of these stands behind.
RECORD, CHECK = struct.Struct("<QQQI16s"), struct.Struct("<I")
#: Room for a state is taken so many times larger than the first one: later ones are longer.
SPARE = 1.5
#: Bytes that are read at once.
CHUNK = 1 << 24
OLD = ".old"
BINARY = getattr(os, "O_BINARY", 0)
DAMAGED = "{path} is damaged, or no unfinished run of adamslite: {why}"
FOREIGN = (
    "{path} was not written with this cache: whoever made it can have it run any code. If it is "
    "your own, of another machine or of an earlier cache, `solve --resume {path} --trust` takes it"
)
OTHER = "its first line is another, perhaps of another version"
BUSY = "another run is writing '{output}': {path} is in use; wait for it, or give -o another name"


class UnknownWriter(UsageError):
    """A file of an unfinished run that is not known to be the user's own."""


class Stretch(Protocol):
    """Rows with the same columns, in memory or in a file."""

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the columns."""

    @property
    def count(self) -> int:
        """How many rows there are."""

    def part(self, first: int, end: int) -> Part:
        """Times (n,) and values (n, nc) of some rows."""

    def until(self, end: int) -> Stretch:
        """The first rows alone."""


@dataclass(frozen=True, eq=False)
class Filed:
    """Rows in the file, ``count`` of them from the byte ``at`` on; ``sum``: their checksum, None
    where it is not known.
    """

    file: PartFile
    names: tuple[str, ...]
    at: int
    count: int
    sum: int | None

    @property
    def width(self) -> int:
        """Bytes of a row."""
        return 8 * (len(self.names) + 1)

    def part(self, first: int, end: int) -> Part:
        """Times and values of some rows."""
        end = min(end, self.count)
        data = self.file.read(self.at + first * self.width, (end - first) * self.width)
        table = np.frombuffer(data).reshape(end - first, len(self.names) + 1)
        return table[:, 0], table[:, 1:]

    def until(self, end: int) -> Filed:
        """The first rows alone."""
        return replace(self, count=end, sum=None)

    def check(self) -> None:
        """Raises FormatError when the rows are not those that were written."""
        if self.sum is None:
            return
        left, at, found = self.count * self.width, self.at, 0
        while left > 0:
            data = self.file.read(at, min(left, CHUNK))
            found, at, left = zlib.crc32(data, found), at + len(data), left - len(data)
        if found != self.sum:
            raise FormatError(DAMAGED.format(path=self.file.path, why="its rows were changed"))


class PartFile:
    """An open file of an unfinished run.

    Attributes
    ----------
    path : Path
    state : mapping
        What the state says that the file was opened with.
    arrays : mapping
        Its arrays, by their names.
    """

    def __init__(self, path: Path, stream: BinaryIO, trusted: bool = False) -> None:
        self.path, self._stream, self._trusted = path, stream, trusted
        self.state: Mapping[str, Any] = {}
        self.arrays: Mapping[str, np.ndarray] = {}
        self._serial, self._end, self._nameless = 0, FIRST, False
        # The states that the two records name, free room, and the room of each place.
        self._named: list[Place] = []
        self._free: list[tuple[int, int]] = []
        self._rooms: dict[int, int] = {}

    @staticmethod
    def create(path: Path, state: Mapping[str, Any]) -> PartFile:
        """A new file with a first state; one of that name that is there is kept under the name of
        an older one.

        Raises
        ------
        UsageError
            When another run is writing it.
        """
        if os.path.lexists(path):
            with suppress(OSError), open(path, "r+b") as stream:  # it may be a link to nothing
                _lock(path, stream)
            os.replace(path, f"{path}{OLD}")
        draft = draft_of(path)
        begun(draft)
        flags = os.O_RDWR | os.O_CREAT | os.O_EXCL | BINARY
        stream = os.fdopen(os.open(draft, flags, 0o666), "r+b")
        try:
            _lock(path, stream)
            stream.write(MAGIC.ljust(FIRST, b"\0"))
            found = PartFile(path, stream)
            found.commit(found.write_state(state, {}))
            os.replace(draft, path)
        except BaseException:
            stream.close()
            draft.unlink(missing_ok=True)
            raise
        finally:
            over(draft)
        return found

    @staticmethod
    def nameless(folder: Path | None) -> PartFile:
        """A file for rows alone, which goes with the process; without ``folder`` among temporary
        files.
        """
        from tempfile import TemporaryFile, gettempdir

        place = folder or Path(gettempdir())
        found = PartFile(place, cast(BinaryIO, TemporaryFile(dir=place)))
        found._nameless = True
        return found

    @staticmethod
    def open(path: Path, trusted: bool = False) -> PartFile:
        """An unfinished run to go on with, and its last state; ``trusted``: whoever wrote it.

        Raises
        ------
        UsageError
            When another run is writing it, or it was not written with this cache.
        FormatError
            When it is none, or is damaged.
        """
        stream = open(path, "r+b")  # noqa: SIM115 - it stays open
        try:
            _lock(path, stream)
            found = PartFile(path, stream, trusted)
            found._read_state()
        except BaseException:
            stream.close()
            raise
        return found

    def close(self) -> None:
        """Nothing more is written."""
        self._stream.close()

    def remove(self) -> None:
        """The run is over: close the file and take it away."""
        if not self._nameless:
            self.path.unlink(missing_ok=True)
        self.close()

    def read(self, at: int, size: int) -> bytes:
        """Bytes from a place on.

        Raises
        ------
        FormatError
            When the file ends before.
        """
        self._stream.flush()
        if not 0 <= at <= at + size <= os.fstat(self._stream.fileno()).st_size:
            raise FormatError(DAMAGED.format(path=self.path, why="it ends early"))
        self._stream.seek(at)
        return self._stream.read(size)

    # rows

    def continued(self, stretches: list[Stretch], rows: Stretch) -> list[Stretch]:
        """A list of stretches with further rows, which are written."""
        if isinstance(rows, Filed):
            return [*stretches, rows]
        if not rows.count:
            return [*stretches, Filed(self, rows.names, self._end, 0, 0)]
        times, values = rows.part(0, rows.count)
        data = np.column_stack([times, values]).tobytes()
        at = self._end
        self._write(at, data)
        self._end = at + len(data)
        last = stretches[-1] if stretches else None
        if (
            isinstance(last, Filed)
            and last.names == rows.names
            and (last.at + last.count * last.width == at)
        ):
            sum_ = None if last.sum is None else zlib.crc32(data, last.sum)
            return [*stretches[:-1], replace(last, count=last.count + rows.count, sum=sum_)]
        return [*stretches, Filed(self, rows.names, at, rows.count, zlib.crc32(data))]

    # states

    def write_state(
        self, state: Mapping[str, Any], arrays: Mapping[str, np.ndarray], kept: bool = False
    ) -> Place:
        """Write a state; its place.  One that is ``kept`` is not written over later."""
        listed = [[name, each.dtype.str, each.size] for name, each in arrays.items()]
        head = json.dumps({**state, "arrays": listed}).encode() + b"\n"
        data = b"".join([head, *(each.tobytes() for each in arrays.values())])
        at = self._place(len(data), kept)
        self._write(at, data)
        return at, len(data), zlib.crc32(data), seal(data).hex()

    def commit(self, place: Place) -> None:
        """Have a state count from now on: it is on the disk, and all rows too."""
        self._sync()
        self._serial += 1
        at, size, checksum, sealed = place
        record = RECORD.pack(self._serial, at, size, checksum, bytes.fromhex(sealed))
        self._write(RECORDS[self._serial % 2], record + CHECK.pack(zlib.crc32(record)))
        self._sync()
        self._named.append(place)
        if len(self._named) > 2:
            at = self._named.pop(0)[0]
            self._free.append((at, self._rooms.pop(at)))

    def load(self, place: Sequence[Any]) -> tuple[Mapping[str, Any], Mapping[str, np.ndarray]]:
        """The state at a place and its arrays.

        Raises
        ------
        UnknownWriter
            When it was not written with this cache, and is not trusted.
        FormatError
            When there is none.
        """
        try:
            at, size, checksum, sealed = place
            data = self.read(int(at), int(size))
            if zlib.crc32(data) != int(checksum):
                raise ValueError("a state was changed")
            if not self._trusted and seal(data).hex() != sealed:
                raise UnknownWriter(FOREIGN.format(path=self.path))
            head, found, rest = data.partition(b"\n")
            state, arrays, first = from_json(head), {}, 0
            for name, kind, count in state["arrays"]:
                dtype = np.dtype(kind)
                if dtype.str not in ("<f8", "<i8") or not found:
                    raise ValueError(f"an array of {kind}")
                arrays[str(name)] = np.frombuffer(rest, dtype, int(count), first)
                first += dtype.itemsize * count
        except UnknownWriter:
            raise
        except (ValueError, KeyError, TypeError, OverflowError) as fault:
            raise FormatError(DAMAGED.format(path=self.path, why=fault)) from None
        return state, arrays

    def _read_state(self) -> None:
        if self._stream.read(len(MAGIC)) != MAGIC:
            raise FormatError(DAMAGED.format(path=self.path, why=OTHER))
        found = sorted(filter(None, map(self._record, RECORDS)))
        for serial, place in reversed(found):
            with suppress(FormatError):
                self.state, self.arrays = self.load(place)
                at, size, _, _ = place
                self._serial, self._named, self._rooms = serial, [place], {at: size}
                self._end = os.fstat(self._stream.fileno()).st_size
                return
        raise FormatError(DAMAGED.format(path=self.path, why="it holds no complete state"))

    def _record(self, at: int) -> tuple[int, Place] | None:
        data = self.read(at, RECORD.size + CHECK.size)
        if CHECK.unpack(data[RECORD.size :])[0] != zlib.crc32(data[: RECORD.size]):
            return None
        serial, place, size, checksum, sealed = RECORD.unpack(data[: RECORD.size])
        return (serial, (place, size, checksum, sealed.hex())) if serial else None

    def _place(self, size: int, kept: bool) -> int:
        """Where so many bytes fit: where an older state was, or at the end."""
        for k, (at, room) in enumerate(self._free):
            if size <= room and not kept:
                del self._free[k]
                self._rooms[at] = room
                return at
        at, room = self._end, size if kept else int(SPARE * size)
        self._rooms[at], self._end = room, self._end + room
        return at

    def _write(self, at: int, data: bytes) -> None:
        with self._named_faults():
            self._stream.seek(at)
            self._stream.write(data)

    def _sync(self) -> None:
        with self._named_faults():
            self._stream.flush()
            os.fsync(self._stream.fileno())

    @contextmanager
    def _named_faults(self) -> Iterator[None]:
        try:
            yield
        except OSError as fault:
            goes_on = "; what there is goes on with `adamslite solve --resume`"
            reason = f"{fault.strerror}{'' if self._nameless else goes_on}"
            raise OSError(fault.errno, reason, str(self.path)) from None


def _lock(path: Path, stream: BinaryIO) -> None:
    """Have the file to oneself until it is closed, where the system can."""
    if lock(stream) is False:
        output = path.with_name(path.name.removesuffix(OLD).removesuffix(SUFFIX))
        raise UsageError(BUSY.format(output=output, path=path))
