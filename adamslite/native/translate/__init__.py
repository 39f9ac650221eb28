"""The translator from a small, typed part of Python to native code.

A function marked :func:`native` may use ``int`` (64 bit), ``float``, ``bool``, arrays (``Ints``,
``Reals``), records (:mod:`adamslite.native.translate.records`) and their ``Rows``, ``if``,
``while``, ``for .. in range``, assignments, arithmetic, comparisons, ``abs min max float int sqrt
floor maximum``, slices ``a[k:]`` (a shifted array), calls of other native functions, ``copy`` and
``call_address``. Arguments carry annotations; a local variable has the type of its first
assignment. ``Alone`` is an array of reals that no other argument reaches while the function runs.
Sums may be reordered except in functions marked :func:`as_written`; those marked :func:`seldom` or
:func:`rare` are compiled with less effort, those marked :func:`inline` are part of their callers.
There is no bounds check, and division follows the processor.

The same functions run under plain Python on numpy arrays and records, which is how tests compare
the two. The translator itself is in :mod:`adamslite.native.translate.modules`: what is compiled
already does not need it.
"""

from adamslite.native.translate.language import (
    REGISTERED,
    Untranslatable,
    as_written,
    call_address,
    copy,
    inline,
    maximum,
    native,
    rare,
    seldom,
    symbol,
)
from adamslite.native.translate.records import Alone, Ints, Reals, Record, Rows, array

__all__ = [
    "REGISTERED",
    "Alone",
    "Ints",
    "Reals",
    "Record",
    "Rows",
    "Untranslatable",
    "array",
    "as_written",
    "call_address",
    "copy",
    "inline",
    "maximum",
    "native",
    "rare",
    "seldom",
    "symbol",
]
