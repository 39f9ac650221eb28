"""The one door to sympy: ``sp`` imports it at the first use; reading a deck never pays for it."""

from __future__ import annotations

from functools import cache
from typing import Any


class _Sympy:
    """Stands for the module; each name is fetched once and then lives in the instance."""

    def __getattr__(self, name: str) -> Any:
        import sympy

        value = getattr(sympy, name)
        setattr(self, name, value)
        return value


sp = _Sympy()


@cache
def _floor_class() -> type:
    # sympy leaves d floor(x)/dx as an unevaluated Derivative; between its jumps it is zero.
    class floor(sp.floor):  # noqa: N801  printers look rules up by this name
        def _eval_derivative(self, symbol: Any) -> Any:
            return sp.S.Zero

    return floor


def floor(x: Any) -> Any:
    """Largest integer not above ``x``, with derivative zero."""
    return _floor_class()(x)


def choose(*pieces: tuple[Any, Any], otherwise: Any) -> Any:
    """The value of the first ``(value, condition)`` that holds, else ``otherwise``."""
    return sp.Piecewise(*pieces, (otherwise, True))


def norm(vector: tuple[Any, Any, Any]) -> Any:
    """Length of a vector; at the zero vector the value and the derivative are 0.

    A speed or a reaction is often exactly zero, where sqrt alone would have the derivative 0/0.
    """
    square = sum(component**2 for component in vector)
    return choose((sp.sqrt(square), square > 0), otherwise=0)
