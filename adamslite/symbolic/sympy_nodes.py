"""Access to sympy, imported at its first use, and the nodes that adamslite adds to it.

Beside it stand the few operations where the form sympy gives is not what a kernel needs: choices,
floors, powers and lengths whose derivatives stay finite, explicit and quick to form; and values of
tables.  Inside :func:`with_numbers` all of them compute numbers instead, and sympy is not needed.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from functools import cache
from types import ModuleType
from typing import TYPE_CHECKING, Any

from adamslite.symbolic.types import Expr, Symbol


class _Sympy:
    """Stands for the module; each name is fetched once and then lives in the instance."""

    def __getattr__(self, name: str) -> Any:
        import sympy

        value = getattr(sympy, name)
        setattr(self, name, value)
        return value


_names = _Sympy()
_duals: list[ModuleType] = []
"""The module that computes numbers, while that is what is wanted."""

if TYPE_CHECKING:
    import sympy as sp
else:
    sp = _names


@contextmanager
def with_numbers() -> Iterator[None]:
    """Meanwhile formulas compute numbers with slopes, see :mod:`adamslite.symbolic.duals`."""
    from adamslite.symbolic import duals

    kept = dict(_names.__dict__)
    _names.__dict__.clear()
    _names.__dict__.update(vars(duals))
    _duals.append(duals)
    try:
        yield
    finally:
        _duals.pop()
        _names.__dict__.clear()
        _names.__dict__.update(kept)


@cache
def _nodes(smooth: int | None = None) -> tuple[type, type]:
    """Our Piecewise and floor, named as sympy's own because printers go by the name.

    ``smooth`` stays with them as ``order``, in derivatives too.
    """
    from sympy.functions.elementary.piecewise import ExprCondPair

    # sympy's folds a choice inside a condition into all combinations and asks every condition what
    # it implies: seconds for a contact force.  This one only drops what is decided.
    class Piecewise(sp.Expr):
        is_commutative = True
        is_extended_real = True
        order = smooth

        def __new__(cls, *pairs: Expr) -> Expr:
            kept = []
            for pair in pairs:
                piece = ExprCondPair(*pair)
                if piece.cond != sp.false:
                    kept.append(piece)
                if piece.cond == sp.true:
                    break
            if all(piece.expr == kept[-1].expr for piece in kept):
                return kept[-1].expr
            return sp.Expr.__new__(cls, *kept)

        def _eval_derivative(self, symbol: Symbol) -> Expr:
            return self.func(*[(piece.expr.diff(symbol), piece.cond) for piece in self.args])

    # sympy leaves d floor(x)/dx as an unevaluated Derivative; between its jumps it is zero.
    class floor(sp.floor):  # noqa: N801  printers look rules up by this name
        order = smooth

        def _eval_derivative(self, symbol: Symbol) -> Expr:
            return sp.S.Zero

    return Piecewise, floor


def piecewise(*pieces: tuple[Expr, Expr], otherwise: Expr, order: int | None = None) -> Expr:
    """The value of the first ``(value, condition)`` that holds, else ``otherwise``.

    ``order``: where the choice changes, derivatives up to this order are continuous (-1: the value
    jumps); ``None``: all that matter are, as when a formula is only kept from 0/0.  Decides where
    a run restarts: :mod:`adamslite.symbolic.guards`.
    """
    if _duals:
        return _duals[-1].chosen(*pieces, otherwise=otherwise)
    return _nodes(order)[0](*pieces, (otherwise, True))


def floor(x: Expr, order: int | None = None) -> Expr:
    """Largest integer not above ``x``, with derivative zero; ``order`` as in :func:`piecewise`."""
    if _duals:
        return _duals[-1].floor(x)
    return _nodes(order)[1](x)


def magnitude(x: Expr, order: int | None = 0) -> Expr:
    """|x|, with the derivative 1 at zero; ``order`` as in :func:`piecewise`."""
    return piecewise((x, x >= 0), otherwise=-x, order=order)


def power(base: Expr, exponent: Expr) -> Expr:
    """``base**exponent`` of real numbers; a whole or half exponent is kept as an exact fraction."""
    if _duals:
        return _duals[-1].power(base, exponent)
    exponent = sp.S.Zero + exponent
    if exponent.is_Float and 2 * exponent == int(2 * exponent):
        exponent = sp.Rational(int(2 * exponent), 2)
    result = (sp.S.Zero + base) ** exponent
    # sympy knows that sqrt(x**2) is |x|, whose derivative it can only call sign(x).
    return result.replace(sp.Abs, magnitude) if result.has(sp.Abs) else result


def root(x: Expr) -> Expr:
    """Square root of ``x`` >= 0."""
    return power(x, sp.S.Half)


def norm(vector: tuple[Expr, Expr, Expr]) -> Expr:
    """Length of a vector; at the zero vector the value and the derivative are 0.

    A speed or a reaction is often exactly zero, where sqrt alone would have the derivative 0/0.
    """
    square = sum(component**2 for component in vector)
    return piecewise((root(square), square > 0), otherwise=0)


# Values of tables by the names of their nodes, whose first three arguments are whole numbers.
LOOKUPS = ("Lookup", "LookupBetween")


@cache
def _lookups() -> tuple[type, type, type, type]:
    """The nodes of ``LOOKUPS``, and those of a piece and of a strip that are held."""

    class Lookup(sp.Function):
        """(table, curve, order, x)"""

        is_extended_real = True

        def fdiff(self, argindex: int = 4) -> Expr:
            table, curve, order, x = self.args
            return self.func(table, curve, order + 1, x) if order < 3 else sp.S.Zero

    class LookupBetween(sp.Function):
        """(table, order by x, order by z, x, z)"""

        is_extended_real = True

        def fdiff(self, argindex: int = 4) -> Expr:
            table, order, z_order, x, z = self.args
            if argindex == 4:
                return self.func(table, order + 1, z_order, x, z) if order < 3 else sp.S.Zero
            return self.func(table, order, z_order + 1, x, z) if z_order < 1 else sp.S.Zero

    class LookupHeld(sp.Function):
        """(table, curve, order, piece, x)"""

        is_extended_real = True

        def fdiff(self, argindex: int = 5) -> Expr:
            table, curve, order, piece, x = self.args
            further = argindex == 5 and order < 3
            return self.func(table, curve, order + 1, piece, x) if further else sp.S.Zero

    class LookupBetweenHeld(sp.Function):
        """(table, order by x, order by z, strip, x, z)"""

        is_extended_real = True

        def fdiff(self, argindex: int = 5) -> Expr:
            table, order, z_order, strip, x, z = self.args
            if argindex == 5:
                return self.func(table, order + 1, z_order, strip, x, z) if order < 3 else sp.S.Zero
            further = argindex == 6 and z_order < 1
            return self.func(table, order, z_order + 1, strip, x, z) if further else sp.S.Zero

    return Lookup, LookupBetween, LookupHeld, LookupBetweenHeld


def lookup(table: int, x: Expr, curve: int = 0, order: int = 0) -> Expr:
    """A curve of a table at ``x``, or its derivative; see :mod:`adamslite.kernels.code.lookup`.

    ``table``: as a statement sees it that derives an interpolant.
    """
    if _duals:
        return _duals[-1].lookup(table, x, curve, order)
    return _lookups()[0](table, curve, order, x)


def lookup_between(table: int, x: Expr, z: Expr, order: int = 0, z_order: int = 0) -> Expr:
    """A table of two arguments at ``x`` and ``z``, or its derivatives."""
    if _duals:
        return _duals[-1].lookup_between(table, x, z, order, z_order)
    return _lookups()[1](table, order, z_order, x, z)


def lookup_with_corners(table: int, pieces: int, x: Expr, order: int = 0) -> Expr:
    """A table of straight lines at ``x``, or its derivative, on the piece that an integrator holds:
    a corner is an event.

    ``pieces``: the table of the numbers of its pieces, see
    :func:`adamslite.symbolic.interpolant.piece_numbers`.
    """
    if _duals:
        return _duals[-1].lookup(table, x, 0, order)
    piece = floor(lookup(pieces, x), order=-1 if order else 0)
    return _lookups()[2](table, 0, order, piece, x)


def lookup_between_with_corners(table: int, strips: int, x: Expr, z: Expr) -> Expr:
    """A table of two arguments, on the strip between two curves that an integrator holds: where z
    meets a curve is an event.

    ``strips``: the table of the numbers of its strips.
    """
    if _duals:
        return _duals[-1].lookup_between(table, x, z, 0, 0)
    return _lookups()[3](table, 0, 0, floor(lookup(strips, z), order=0), x, z)
