"""Whether a file holds a sweep, without loading what reads it."""

from __future__ import annotations

import struct
from pathlib import Path

SUFFIX, KEY = ".nc", "sweep"
DAMAGED = (ValueError, TypeError, IndexError, KeyError, OverflowError, AttributeError, struct.error)


def holds_sweep(path: str | Path) -> bool:
    """Whether a file is there and is one of :mod:`adamslite.sweeps.netcdf`."""
    if Path(path).suffix.lower() != SUFFIX or not Path(path).is_file():
        return False
    from scipy.io import netcdf_file

    try:
        with netcdf_file(path, "r") as file:
            return KEY in file._attributes
    except (*DAMAGED, OSError):
        return False
