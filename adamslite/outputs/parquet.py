"""Parquet: a column for the time and one for each result; needs pyarrow (extra ``parquet``).

The metadata of a column has its ``unit``; that of the table are the texts of the run, see
above.  Rows are in groups of 2^20 numbers; a file of more than one is written while its run lasts.
"""

from __future__ import annotations

from base64 import b64encode
from contextlib import suppress
from io import BytesIO
from pathlib import Path
from threading import Lock
from typing import IO, TYPE_CHECKING, Any

import numpy as np

from adamslite.errors import FormatError, UsageError
from adamslite.language.text import contents
from adamslite.native.worker import LOOK, Worker
from adamslite.outputs import row_by_row
from adamslite.outputs.whole_files import whole_file
from adamslite.results.channels import with_units
from adamslite.results.formats import register_format
from adamslite.results.results import Results, rows_of_block
from adamslite.results.run_texts import attributes, need_rows, restored
from adamslite.results.untrusted import need_plausible

if TYPE_CHECKING:
    from adamslite.results.filed import Rows

#: Where Arrow looks for its own description of a table, which has the metadata of columns.
SCHEMA = "ARROW:schema"
MISSING = "files .parquet need pyarrow: pip install 'adamslite[parquet]'"


def write(results: Results, path: str | Path) -> None:
    """Write `results` to the file `path`, whole or not at all."""
    need_rows(results)
    _library()  # what it takes is loaded before there is a draft
    with whole_file(path, binary=True) as stream:
        table = _Table(stream, results)
        _complete(table, results)


class _Table:
    """A table in a file, whose rows are added by groups.

    A group is added when it is in the list, whatever becomes of the call: several that write what
    is there do so in turn, each group once.
    """

    def __init__(self, stream: IO[bytes], results: Results) -> None:
        self.schema, self.group = _schema(results), rows_of_block(len(results.names))
        self._groups: list[np.ndarray | None] = []
        self._written, self._lock = 0, Lock()
        self._fault: Exception | None = None
        # Numbers that hardly come twice gain nothing by a dictionary, which takes time.
        self._writer = _library()[1].ParquetWriter(
            stream, self.schema, use_dictionary=False, store_schema=False
        )

    @property
    def rows(self) -> int:
        """How many there are in full groups."""
        return len(self._groups) * self.group

    @property
    def waits(self) -> bool:
        """Whether there are groups that are not written yet."""
        return self._written < len(self._groups)

    def add(self, time: np.ndarray, values: np.ndarray) -> None:
        """Times (n,) and values (n, nc) are the next group; only the last may be short."""
        self._groups.append(np.ascontiguousarray(np.vstack([time, values.T])))

    def write(self) -> None:
        """Write the groups that wait; a fault is one of all calls."""
        with self._lock:
            if self._fault:
                raise self._fault
            try:
                while self.waits:
                    self._write(self._groups[self._written])
                    self._groups[self._written] = None
                    self._written += 1
            except Exception as fault:
                self._fault = fault
                raise

    def _write(self, columns: Any) -> None:
        arrow = _library()[0]
        self._writer.write_table(arrow.table(list(map(arrow.array, columns)), schema=self.schema))

    def end(self, results: Results) -> None:
        """Write what the file says of the run, and where everything is in it."""
        texts = attributes(results)
        schema = self.schema.with_metadata(texts).serialize()
        self._writer.add_key_value_metadata({**texts, SCHEMA: b64encode(schema)})
        self._writer.close()

    def give_up(self) -> None:
        """Nothing of it is wanted: there may be no stream any more in which it would end."""
        self._writer.is_open = False


def _complete(table: _Table, results: Results) -> None:
    """Write all rows of the results that a table does not have, and its end."""
    try:
        for time, values in results.blocks(table.rows):
            table.add(time, values)
            table.write()
        table.end(results)
    except BaseException:
        table.give_up()
        raise


def _schema(results: Results) -> Any:
    arrow = _library()[0]
    return arrow.schema([
        arrow.field(name, arrow.float64(), metadata={"unit": results.channel(name).unit})
        for name in ("time", *results.names)
    ])  # fmt: skip


class GrowingTable(row_by_row.Growing):
    """A file that is written group by group while its run lasts.

    Groups are written in a thread of its own, which no interruption reaches: there would be no way
    to tell how much of one is written.
    """

    _table: _Table | None = None

    def _forget(self) -> None:
        super()._forget()
        self._drop()

    @property
    def count(self) -> int:
        return self._table.rows if self._table else 0

    def back_to(self, count: int) -> None:
        if self.count > count:
            self._drop()

    def finish(self, results: Results) -> bool:
        with suppress(OSError, MemoryError):
            self._settle()
        table, draft = self._table, self._draft
        if not (table and draft and self._goes_on(table, results)):
            self.close()
            return False
        self._draft = None
        with draft:
            _complete(table, results)
        return True

    def _goes_on(self, table: _Table, results: Results) -> bool:
        """Whether a table has the first rows of the results, and begins as theirs would."""
        long = row_by_row.is_long(results) and results.count >= table.rows and not table.waits
        return long and _schema(results).equals(table.schema, check_metadata=True)

    def _follow(self, rows: Rows) -> None:
        names = self._own_names()
        group = rows_of_block(len(names))
        if rows.count - self.count < group:
            return
        if self._table is None:
            super()._drop()
            assert self.begun is not None
            self._open()
            self._table = _Table(self._stream, self.begun(names))
        for time, values in rows.parts(group, self.count):
            if len(time) == group:
                self._table.add(time, self._own(values))
                self._settle()
                self._send(self._stream.tell())

    def _settle(self) -> None:
        """Wait until all groups are written."""
        while self._table and self._table.waits:
            writing = Worker(self._table.write)
            while writing.works:
                writing.wait(LOOK)
            writing.result()

    def _drop(self) -> None:
        table, self._table = self._table, None
        if table:
            table.give_up()
        super()._drop()


def read(path: str | Path) -> Results:
    """Read what :func:`write` wrote, or any table of numbers with a first column ``time``.

    Raises
    ------
    FormatError
        When it is no such file, or is cut off.
    UsageError
        When pyarrow is not installed.
    """
    arrow, parquet = _library()
    data = contents(path)
    try:
        facts = parquet.read_metadata(BytesIO(data))
        need_plausible(facts.num_rows * facts.num_columns, len(data))
        table = parquet.read_table(BytesIO(data))
    except FormatError as fault:
        raise FormatError(f"{path}: {fault}") from None
    except (arrow.ArrowException, OSError, ValueError) as fault:
        reason = " ".join(str(fault).split())
        raise FormatError(f"{path} is no Parquet file, or is damaged: {reason}") from None
    names = tuple(table.column_names[1:])
    if table.column_names[:1] != ["time"]:
        raise FormatError(f"{path}: its first column must be 'time'")
    try:
        columns = [table.column(n).to_numpy().astype(float) for n in range(table.num_columns)]
    except (ValueError, TypeError):
        raise FormatError(f"{path}: a column of it is not of numbers") from None
    values = np.column_stack(columns)
    metadata = {field.name: field.metadata or {} for field in table.schema}
    try:
        found = {key.decode(): text.decode() for key, text in (table.schema.metadata or {}).items()}
        units = {name: metadata[name].get(b"unit", b"").decode() for name in names}
        run = restored(found)
    except (UnicodeDecodeError, FormatError) as fault:
        raise FormatError(f"{path} is damaged: {fault}") from None
    channels = {} if run["source"] else with_units(units)
    time, values = values[:, 0].copy(), np.ascontiguousarray(values[:, 1:])
    return Results(time=time, names=names, values=values, channels=channels, **run)


def _library() -> tuple[Any, Any]:
    try:
        import pyarrow
        import pyarrow.parquet
    except ImportError:
        raise UsageError(MISSING) from None
    return pyarrow, pyarrow.parquet


register_format(
    ".parquet",
    "Parquet: a column of numbers for the time and for each result; needs pyarrow",
    write,
    read,
    library=_library,
    growing=GrowingTable,
)
