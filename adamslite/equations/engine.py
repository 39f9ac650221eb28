"""Native code of integrators and equations, built once per version and processor.

An entry is a native function that takes tables of addresses, by module and name: ``f(P, L)`` of a
method of integration, ``run(P, L, operation, phases)`` of the rest.  Each is compiled by itself
when a run first needs it.
"""

from __future__ import annotations

import ctypes
from collections.abc import Callable, Iterable
from importlib import import_module
from typing import TYPE_CHECKING

import numpy as np

from adamslite.caching.entries import recall
from adamslite.caching.sources import version_of
from adamslite.native import compiler
from adamslite.progress import Progress

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

OPERATIONS = "adamslite.equations.operations.run"
#: Where modules lie whose sources are known to :mod:`adamslite.caching.sources`.
HERE = "adamslite."


def engine(entry: str = OPERATIONS, progress: Progress | None = None) -> Callable[..., int]:
    """The native code of an entry, as a function of Python."""
    if entry not in _functions:
        integers = [ctypes.c_int64, ctypes.c_int64] if entry == OPERATIONS else []
        kind = ctypes.CFUNCTYPE(ctypes.c_int64, ctypes.c_void_p, ctypes.c_void_p, *integers)
        _functions[entry] = kind(address_of(entry, progress))
    return _functions[entry]


def address_of(entry: str, progress: Progress | None = None) -> int:
    """Where the native code of an entry begins."""
    if entry not in _built:
        _built[entry] = _build(entry, progress)
    return _built[entry]


_functions: dict[str, Callable[..., int]] = {}
_built: dict[str, int] = {}


def _build(entry: str, progress: Progress | None) -> int:
    symbol = entry.removeprefix(HERE)

    def compiled() -> bytes:
        if progress is not None:
            what = "the equations" if entry == OPERATIONS else "the integrator"
            progress.say(f"compiling {what}, once after installing: takes a few seconds")
        return compiler.object_code(engine_text(entry))

    name = symbol.rpartition(".")[2]
    code = recall(f"{name}{compiler.digest(entry, _version(entry))}.o", compiled)
    return compiler.addresses([(code, [symbol])])[symbol]


def _version(entry: str) -> str:
    """Changes whenever what an entry is made from does: a method from elsewhere is its text."""
    module = entry.rpartition(".")[0]
    if not module.startswith(HERE):
        return engine_text(entry)
    return version_of("equations.engine", module.removeprefix(HERE))


def engine_text(entry: str) -> str:
    """LLVM assembly of an entry."""
    # Only compilation needs the translator.
    from adamslite.native.translate.statements import translate

    module, _, name = entry.rpartition(".")
    return translate(getattr(import_module(module), name))


def ints(values: Iterable[int]) -> np.ndarray:
    """An array of integers as native code reads it."""
    return np.array(values, dtype=np.int64)


def reals(values: ArrayLike) -> np.ndarray:
    """An array of reals as native code reads it."""
    return np.array(values, dtype=float)
