"""Results as tables of other libraries, which are imported when they are needed."""

from __future__ import annotations

from importlib.util import find_spec
from typing import TYPE_CHECKING

from adamslite.errors import UsageError
from adamslite.results.results import Results

if TYPE_CHECKING:
    from pandas import DataFrame
    from xarray import Dataset


def to_pandas(results: Results) -> DataFrame:
    """A table with the times as index and a column for each channel; see ``Results.to_pandas``."""
    _need("pandas", "a table of pandas")
    from pandas import DataFrame, Index

    frame = DataFrame(results.values, Index(results.time, name="time"), list(results.names))
    frame.attrs = {
        **results.meta,
        "outcome": results.outcome.name,
        "channel units": {name: results.channel(name).unit for name in results.names},
    }
    return frame


def to_xarray(results: Results) -> Dataset:
    """The arrays of a NetCDF file of the results; see ``Results.to_xarray``."""
    _need("xarray", "a Dataset of xarray")
    from io import BytesIO

    from xarray import open_dataset

    from adamslite.outputs.netcdf import content

    with open_dataset(BytesIO(content(results)), engine="scipy") as dataset:
        return dataset.load()


def _need(library: str, what: str) -> None:
    if find_spec(library) is None:
        raise UsageError(
            f"{what} needs {library}, which is not installed: python -m pip install {library}"
        )
