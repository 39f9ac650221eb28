"""The operations in which elements and functions write their formulas.

A formula is written once.  What it gives depends on what it is written for: nodes of a graph
(:mod:`adamslite.symbolic.graph`), from which kernels are made; inside :func:`with_numbers` numbers
with their slopes.  Beside functions of the C library there are choices, floors, powers and lengths
whose derivatives stay finite, and values of tables.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from threading import local
from typing import Any

from adamslite.symbolic.types import Expr


class _Algebra(local):
    """The functions of the module that formulas are written for; fetched once each.

    Each thread has its own: while one computes numbers, another one may make kernels.
    """

    def __getattr__(self, name: str) -> Any:
        from adamslite.symbolic import algebra

        value = getattr(algebra, name)
        setattr(self, name, value)
        return value


fn: Any = _Algebra()


@contextmanager
def with_numbers() -> Iterator[None]:
    """Meanwhile formulas compute numbers with slopes, see :mod:`adamslite.symbolic.duals`."""
    from adamslite.symbolic import duals

    kept = dict(fn.__dict__)
    fn.__dict__.clear()
    fn.__dict__.update(vars(duals))
    try:
        yield
    finally:
        fn.__dict__.clear()
        fn.__dict__.update(kept)


def piecewise(*pieces: tuple[Expr, Expr], otherwise: Expr, order: int | None = None) -> Expr:
    """The value of the first ``(value, condition)`` that holds, else ``otherwise``.

    ``order``: where the choice changes, derivatives up to this order are continuous (-1: the value
    jumps); ``None``: all that matter are, as when a formula is only kept from 0/0.  Decides where
    a run restarts: :mod:`adamslite.symbolic.guards`.
    """
    return fn.chosen(*pieces, otherwise=otherwise, order=order)


def floor(x: Expr, order: int | None = None) -> Expr:
    """Largest integer not above ``x``, with derivative zero; ``order`` as in :func:`piecewise`."""
    return fn.floor(x, order)


def magnitude(x: Expr, order: int | None = 0) -> Expr:
    """|x|, with the derivative 1 at zero; ``order`` as in :func:`piecewise`."""
    return piecewise((x, x >= 0), otherwise=-x, order=order)


def power(base: Expr, exponent: Expr) -> Expr:
    """``base**exponent`` of real numbers."""
    return fn.power(base, exponent)


def root(x: Expr) -> Expr:
    """Square root of ``x`` >= 0."""
    return power(x, 0.5)


def norm(vector: tuple[Expr, Expr, Expr]) -> Expr:
    """Length of a vector; at the zero vector the value and the derivative are 0.

    A speed or a reaction is often exactly zero, where sqrt alone would have the derivative 0/0.
    """
    square = sum(component**2 for component in vector)
    return piecewise((root(square), square > 0), otherwise=0)


# Values of tables by the kinds of their nodes, whose first three arguments are whole numbers.
LOOKUPS = ("Lookup", "LookupBetween")


def lookup(table: int, x: Expr, curve: int = 0, order: int = 0) -> Expr:
    """A curve of a table at ``x``, or its derivative; see :mod:`adamslite.kernels.code.lookup`.

    ``table``: as a statement sees it that derives an interpolant.
    """
    return fn.lookup(table, x, curve, order)


def lookup_between(table: int, x: Expr, z: Expr, order: int = 0, z_order: int = 0) -> Expr:
    """A table of two arguments at ``x`` and ``z``, or its derivatives."""
    return fn.lookup_between(table, x, z, order, z_order)


def lookup_with_corners(table: int, pieces: int, x: Expr, order: int = 0) -> Expr:
    """A table of straight lines at ``x``, or its derivative, on the piece that an integrator holds:
    a corner is an event.

    ``pieces``: the table of the numbers of its pieces, see
    :func:`adamslite.symbolic.interpolant.piece_numbers`.
    """
    return fn.lookup_with_corners(table, pieces, x, order)


def lookup_between_with_corners(table: int, strips: int, x: Expr, z: Expr) -> Expr:
    """A table of two arguments, on the strip between two curves that an integrator holds: where z
    meets a curve is an event.

    ``strips``: the table of the numbers of its strips.
    """
    return fn.lookup_between_with_corners(table, strips, x, z)
