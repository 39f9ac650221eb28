"""The types and decorators of the native language."""

from __future__ import annotations

import ctypes
import inspect
import os
from collections.abc import Callable
from typing import Any, TypeGuard, TypeVar

import numpy as np

from adamslite.native.translate.records import Kind, Numbers, Record, RowsOf, is_record, resolve

F = TypeVar("F", bound=Callable[..., Any])
Native = Callable[..., Any]
"""A function marked for translation."""

REGISTERED: dict[str, Native] = {}
"""Every native function by its symbol."""
AS_WRITTEN: set[Native] = set()
"""Those whose sums are not reordered."""
SELDOM: set[Native] = set()
"""Those that most steps do not wait for."""
RARE: set[Native] = set()
"""Those that no step waits for."""
INLINE: set[Native] = set()
"""Those that become part of each function that calls them."""


class Untranslatable(Exception):
    """A native function uses something outside the language above."""


def native(function: F) -> F:
    """Mark a function for translation; it stays an ordinary Python function."""
    if symbol(function) in REGISTERED:
        raise Untranslatable(f"two native functions are called {symbol(function)}")
    REGISTERED[symbol(function)] = function
    return function


def symbol(function: Native) -> str:
    """Its name in LLVM assembly: functions of two modules may have the same name in Python."""
    return f"{function.__module__.removeprefix('adamslite.')}.{function.__name__}"


def is_native(function: object) -> TypeGuard[Native]:
    return callable(function) and REGISTERED.get(symbol(function)) is function


def as_written(function: F) -> F:
    """Sums and products of this native function are neither reordered nor contracted."""
    AS_WRITTEN.add(function)
    return function


def seldom(function: F) -> F:
    """This native function, and what only such functions call, is compiled with less effort: most
    steps do not wait for it.
    """
    SELDOM.add(function)
    return function


def rare(function: F) -> F:
    """The same with least effort: no step waits for it."""
    RARE.add(function)
    return function


def inline(function: F) -> F:
    """Wherever this native function is called, its body is there instead of a call."""
    INLINE.add(function)
    return function


def call_address(address: int, *arguments: np.ndarray | Record | float) -> None:
    """Call the kernel at an address; natively a plain call, under Python one through ctypes."""
    given = [_passed(a) for a in arguments]
    ctypes.CFUNCTYPE(None, *[type(a) for a in given])(int(address))(*given)


def maximum(a: float, b: float) -> float:
    """The larger one, or not-a-number where one is: loops natively take several at once of it."""
    return a if a > b or a != a else b


def _passed(value: np.ndarray | Record | float) -> Any:
    """An argument as C takes it: arrays and records by their address."""
    if isinstance(value, Record):
        return ctypes.c_void_p(value.address)
    if isinstance(value, np.ndarray):
        return ctypes.c_void_p(value.ctypes.data)
    return ctypes.c_double(value) if isinstance(value, float) else ctypes.c_int64(int(value))


def copy(target: Numbers, source: Numbers, count: int) -> None:
    """The first ``count`` numbers of an array into another that does not overlap it, bit by bit:
    also those of a room that records are seen in, which are reals as well as integers.
    """
    target[:count] = source[:count]


def signature(function: Native) -> tuple[list[tuple[str, Kind]], Kind]:
    """Argument names with kinds, and the kind of the result (``void`` for none)."""
    hints, kinds = function.__annotations__, []
    for name in inspect.signature(function).parameters:
        kind = resolve(hints[name], function.__globals__)
        if kind is None:
            why = f"{name}: {hints[name]} is no type of an argument"
            raise Untranslatable(f"{position(function)}: {why}")
        kinds.append((name, kind))
    result = hints.get("return")
    return kinds, "void" if result in (None, "None") else resolve(result, function.__globals__)


def position(function: Native, line: int = 1) -> str:
    """File and line of a line of a function, and its name."""
    code = function.__code__
    file = os.path.basename(code.co_filename)
    return f"{file}:{code.co_firstlineno + line - 1}, {function.__qualname__}"


def llvm_type(kind: Kind) -> str:
    """How a value of this kind is passed: arrays and records by their address."""
    return kind if kind in ("i64", "double", "i1", "void") else "ptr"


def name_of(kind: Kind) -> str:
    """A kind in a message."""
    if isinstance(kind, RowsOf):
        return f"Rows[{kind.record.__name__}]"
    return kind.__name__ if is_record(kind) else kind
