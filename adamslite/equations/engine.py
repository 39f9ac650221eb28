"""The native engine: built once per version and processor, called with tables of addresses."""

from __future__ import annotations

import ctypes
from typing import Any

import numpy as np

from adamslite.caching.entries import recall
from adamslite.caching.sources import version_of
from adamslite.integrators.contract import BDF, EXPLICIT, HHT, RADAU, VERLET
from adamslite.native import compiler

#: The integrators, each compiled by itself when a run first needs it; the rest is one piece.
INTEGRATORS = {BDF: "bdf", HHT: "hht", RADAU: "radau", EXPLICIT: "explicit", VERLET: "verlet"}
OPERATIONS = "run"
WHAT = {name: "the integrator" for name in INTEGRATORS.values()} | {OPERATIONS: "the equations"}


def engine(operation: int, progress: Any = None) -> Any:
    """The native entry of an operation, built once per version and processor: ``f(P, L)`` of an
    integrator, ``run(P, L, operation, phases)`` of the others.
    """
    name = INTEGRATORS.get(operation, OPERATIONS)
    if name not in _built:
        _built[name] = _build(name, progress)
    return _built[name]


_built: dict[str, Any] = {}


def _build(name: str, progress: Any) -> Any:
    key = name + compiler.digest(version_of("equations.engine"))

    def compiled() -> bytes:
        if progress is not None:
            progress.say(f"compiling {WHAT[name]}, once after installing: takes a few seconds")
        from adamslite.equations.operations import engine_text

        return compiler.object_code(engine_text(name))

    address = compiler.addresses([(recall(f"{key}.o", compiled), [name])])[name]
    integers = [] if name != OPERATIONS else [ctypes.c_int64, ctypes.c_int64]
    return ctypes.CFUNCTYPE(ctypes.c_int64, ctypes.c_void_p, ctypes.c_void_p, *integers)(address)


def ints(values: list[int]) -> np.ndarray:
    """An array of integers as native code reads it."""
    return np.array(values, dtype=np.int64)


def reals(values: list[float]) -> np.ndarray:
    """An array of reals as native code reads it."""
    return np.array(values, dtype=float)
