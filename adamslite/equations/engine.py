"""Native code of integrators and equations, built once per version and processor.

An entry is a native function that takes tables of addresses, by module and name: ``f(P, L)`` of a
method of integration, ``run(P, L, operation, phases)`` of the rest.  The latter is compiled first,
together with all that methods share; each method is compiled when a run first needs it, and calls
what is shared.
"""

from __future__ import annotations

import ctypes
from collections.abc import Callable, Iterable
from functools import cache
from importlib import import_module
from typing import TYPE_CHECKING

import numpy as np

from adamslite.caching.entries import recall, recall_json
from adamslite.caching.sources import version_of
from adamslite.language.method import declared
from adamslite.native import compiler
from adamslite.progress import Progress

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from adamslite.native.translate.modules import Parts

#: Where modules lie whose sources are known to :mod:`adamslite.caching.sources`.
HERE = "adamslite."
OPERATED = "equations.operations"
OPERATIONS = f"{HERE}{OPERATED}.run"


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
    if entry != OPERATIONS:
        address_of(OPERATIONS)

    @cache
    def parts() -> Parts:
        if progress is not None:
            progress.say(_announced(entry))
        return engine_parts(entry)

    symbol, kind, digest = entry.removeprefix(HERE), entry.rpartition(".")[2], _digest(entry)
    codes = (
        recall(f"{kind}{digest}.o", lambda: compiler.object_code(parts().often)),
        recall(f"{kind}_seldom{digest}.o", lambda: compiler.plain_code(parts().seldom)),
        recall(f"{kind}_rare{digest}.o", lambda: compiler.quick_code(parts().rare)),
    )
    return compiler.addresses([(codes, [symbol])])[symbol]


def _announced(entry: str) -> str:
    if entry == OPERATIONS:
        return (
            "compiling the engine, once after installing: what all integrators share, then each "
            "integrator when it is first used"
        )
    names = "/".join(name for each in declared() if each.entry == entry for name in each.names)
    return f"compiling the integrator {names}"


def _digest(entry: str) -> str:
    """Changes whenever what an entry is made from does: a method from elsewhere is its text."""
    module = entry.rpartition(".")[0]
    if not module.startswith(HERE):
        return compiler.digest(entry, *engine_parts(entry), _digest(OPERATIONS))
    needed = {"equations.engine", OPERATED, module.removeprefix(HERE)}
    return compiler.digest(entry, version_of(*sorted(needed)))


def engine_parts(entry: str) -> Parts:
    """LLVM assembly of an entry."""
    if entry == OPERATIONS:
        return _shared()[0]
    # Only compilation needs the translator.
    from adamslite.native.translate.modules import method_parts

    shared = recall_json(f"shared{_digest(OPERATIONS)}.json", lambda: _shared()[1])
    module, _, name = entry.rpartition(".")
    return method_parts(getattr(import_module(module), name), frozenset(shared))


@cache
def _shared() -> tuple[Parts, list[str]]:
    """LLVM assembly of the operations and of what methods share, and the symbols in it."""
    from adamslite.equations.operations import SHARED, run
    from adamslite.native.translate.modules import shared_parts

    return shared_parts([run, *SHARED])


def ints(values: Iterable[int]) -> np.ndarray:
    """An array of integers as native code reads it."""
    return np.array(values, dtype=np.int64)


def distinct(values: np.ndarray) -> np.ndarray:
    """Different numbers, none below zero, in order; `np.unique` imports masked arrays."""
    found = np.sort(values)
    return found[np.diff(found, prepend=-1) > 0]


def reals(values: ArrayLike) -> np.ndarray:
    """An array of reals as native code reads it."""
    return np.array(values, dtype=float)


#: Numbers in a line of the processor's cache.
LINE = 8


def room(size: int, dtype: np.dtype) -> np.ndarray:
    """Zeros that begin a line of the cache: loops then load whole vectors from one line each."""
    found = np.zeros(size + LINE, dtype=dtype)
    first = -found.ctypes.data // found.itemsize % LINE
    return found[first : first + size]
