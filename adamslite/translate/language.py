"""The words of the native language: types, tables, and the functions marked for translation."""

from __future__ import annotations

import ctypes
import inspect
from collections.abc import Callable
from typing import Any

Ints = "Ints"
Reals = "Reals"
Alone = "Alone"
SCALARS = {"int": "i64", "float": "double", "bool": "i1"}
ARRAYS = {"Ints": "i64", "Reals": "double"}

REGISTERED: dict[str, Callable[..., Any]] = {}


class Untranslatable(Exception):
    """A native function uses something outside the language above."""


def native(function: Callable[..., Any]) -> Callable[..., Any]:
    """Mark a function for translation; it stays an ordinary Python function."""
    if function.__name__ in REGISTERED:
        raise Untranslatable(f"two native functions are called {function.__name__}")
    REGISTERED[function.__name__] = function
    return function


def as_written(function: Callable[..., Any]) -> Callable[..., Any]:
    """Sums and products of this native function are neither reordered nor contracted."""
    function.as_written = True
    return function


def call_address(address: int, *arguments: Any) -> None:
    """Call the kernel at an address; natively a plain call, under Python one through ctypes."""
    given = [
        ctypes.c_void_p(a.ctypes.data) if hasattr(a, "ctypes") else ctypes.c_int64(int(a))
        for a in arguments
    ]
    ctypes.CFUNCTYPE(None, *[type(a) for a in given])(int(address))(*given)


class Table:
    """A native argument that is a table of (address, length): one pair for each field, in order."""

    def __init__(self, name: str, fields: dict[str, str]) -> None:
        self.name = name
        self.fields = fields

    def place(self, field: str) -> int:
        return list(self.fields).index(field)


def signature(function: Callable[..., Any]) -> tuple[list[tuple[str, str]], str]:
    """Argument names with types, and the result type (``void`` for none)."""
    hints = function.__annotations__
    names = list(inspect.signature(function).parameters)
    words = [Reals if word_of(hints[n]) == Alone else word_of(hints[n]) for n in names]
    kinds = [(n, SCALARS.get(word, word)) for n, word in zip(names, words, strict=True)]
    result = word_of(hints.get("return", "None"))
    return kinds, "void" if result == "None" else SCALARS[result]


def word_of(hint: Any) -> str:
    """The name of an annotation, whether it is kept as text or not."""
    return hint if isinstance(hint, str) else getattr(hint, "__name__", str(hint))


def llvm_type(kind: str) -> str:
    """How a value of this kind is passed: arrays and tables by their address."""
    return kind if kind in ("i64", "double", "i1", "void") else "ptr"
