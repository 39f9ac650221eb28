"""The native engine: built once per version and processor, called with tables of addresses."""

from __future__ import annotations

import ctypes
from typing import Any

import numpy as np

from adamslite import native
from adamslite.compiled import version_of

(
    RESIDUAL, JACOBIAN, ACCELERATIONS, EQUILIBRIUM, RECORD, BDF, HHT, RADAU, EXPLICIT, VERLET,
    SPECTRUM, CLOCK,
) = range(12)  # fmt: skip


def engine(progress: Any = None) -> Any:
    """The native entry ``run(P, L, operation, phases)``; built once per version and processor."""
    if not _engine:
        _engine.append(_load_engine(progress))
    return _engine[0]


_engine: list[Any] = []


def _load_engine(progress: Any) -> Any:
    key = "engine" + native.digest(version_of("integrators", "translate", "lowering"))

    def build() -> bytes:
        if progress is not None:
            progress.say("compiling the integrators, once after installing: takes a few seconds")
        from adamslite.integrators.entry import engine_text

        return native.object_code(engine_text())

    address = native.addresses([(native.recall(key, ".o", build), ["run"])])["run"]
    pointer, integer = ctypes.c_void_p, ctypes.c_int64
    return ctypes.CFUNCTYPE(integer, pointer, pointer, integer, integer)(address)


def ints(values: list[int]) -> np.ndarray:
    """An array of integers as native code reads it."""
    return np.array(values, dtype=np.int64)


def reals(values: list[float]) -> np.ndarray:
    """An array of reals as native code reads it."""
    return np.array(values, dtype=float)


def address_table(arrays: list[np.ndarray]) -> np.ndarray:
    """(address, length) of every array, in order."""
    return np.array([v for a in arrays for v in (a.ctypes.data, a.size)], dtype=np.int64)
