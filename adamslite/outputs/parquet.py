"""Parquet: a column for the time and one for each result; needs pyarrow (extra ``parquet``).

The metadata of a column has its ``unit``; that of the table are the texts of the run, see
above.
"""

from __future__ import annotations

from io import BytesIO
from pathlib import Path
from typing import Any

import numpy as np

from adamslite.errors import FormatError, UsageError
from adamslite.language.text import contents
from adamslite.outputs.whole_files import whole_file
from adamslite.results.channels import with_units
from adamslite.results.formats import register_format
from adamslite.results.results import Results
from adamslite.results.run_texts import attributes, need_rows, restored
from adamslite.results.untrusted import need_plausible

MISSING = "files .parquet need pyarrow: pip install 'adamslite[parquet]'"


def write(results: Results, path: str | Path) -> None:
    """Write `results` to the file `path`, whole or not at all."""
    arrow, parquet = _library()
    need_rows(results)
    fields = [
        arrow.field(name, arrow.float64(), metadata={"unit": results.channel(name).unit})
        for name in ("time", *results.names)
    ]
    schema = arrow.schema(fields, metadata=attributes(results))
    with whole_file(path, binary=True) as stream:
        # Numbers that hardly come twice gain nothing by a dictionary, which takes time.
        writer = parquet.ParquetWriter(stream, schema, use_dictionary=False)
        for time, values in results.blocks():
            columns = np.ascontiguousarray(np.vstack([time, values.T]))
            writer.write_table(arrow.table(list(map(arrow.array, columns)), schema=schema))
        writer.close()


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
)
