"""A routine of the user written in Python, as native code calls it.

The function gets the parameters of the call, the time, and the values of what it declares that it
reads; it returns a number, or one for each component::

    @adamslite.reads("DX(2, 1)", "VX(2, 1)")
    def spring(parameters, time, x, v):
        stiffness, damping = parameters
        return -stiffness * x - damping * v

What it reads are expressions of the deck, in which ``{1}``, ``{2}`` ... are its parameters,
``{id}``, ``{i}`` ... arguments of the statement.  Derivatives are differences, with steps h::

    f_k = (f(x_k + h) - f(x_k - h))/(2 h)                 h = eps^(1/3) max |x_k| so far
    f_kk = (f(x_k + h) - 2 f(x_k) + f(x_k - h))/h^2       h = eps^(1/4) max |x_k| so far

unless the function has them: ``derivatives=g``, where g takes the same arguments and returns the
partial derivatives by time and by everything that is read, a row for each component.
"""

from __future__ import annotations

import ctypes
from collections.abc import Callable, Sequence
from typing import Any, TypeVar

import numpy as np

from adamslite.symbolic.routines import ADDRESS, ANSWER, INPUTS

F = TypeVar("F", bound=Callable[..., Any])
CALLBACK = ctypes.CFUNCTYPE(None, ctypes.c_int64, ctypes.c_int64, ctypes.c_int64)
EPS = float(np.finfo(float).eps)
# Steps of first and second differences, as shares of the largest value so far; that value at least.
FIRST, SECOND = EPS ** (1 / 3), EPS ** (1 / 4)
LEAST = 1e-3


class Routine:
    """A function of Python with the parameters of one statement.

    Parameters
    ----------
    label : str
        The statement, with its place.
    name : str
        The function as the user names it.
    function : callable
        As above; it may have ``derivatives``.
    parameters : sequence of float
        Numbers of the call in the deck.
    inputs : int
        How many values it gets, the time among them.
    count : int
        How many it returns.
    """

    def __init__(
        self, label: str, name: str, function: Callable[..., Any], parameters: Sequence[float],
        inputs: int, count: int,
    ) -> None:  # fmt: skip
        self.label, self.name = label, name
        self.function, self.parameters, self.count = function, tuple(parameters), count
        self.derivatives = getattr(function, "derivatives", None)
        self._callback = CALLBACK(self._answer)
        self.data = np.zeros(INPUTS + inputs)
        self.data[ADDRESS] = ctypes.cast(self._callback, ctypes.c_void_p).value or 0
        self.forget()

    def __reduce__(self) -> tuple[type[Routine], tuple[Any, ...]]:
        """Its address is that of one process."""
        inputs = len(self.data) - INPUTS
        given = (self.label, self.name, self.function, self.parameters, inputs, self.count)
        return Routine, given

    def forget(self) -> None:
        """Nothing has been called yet."""
        self.fault: Exception | None = None
        self.fault_time = 0.0
        self._largest = np.full(len(self.data) - INPUTS, 0.0)
        self._at = np.full(len(self.data) - INPUTS, np.nan)
        self._value = np.zeros(self.count)
        self._slopes: np.ndarray | None = None

    def _answer(self, component: int, one: int, other: int) -> None:
        """What native code calls; after a fault everything is not a number."""
        answer = np.nan
        if self.fault is None:
            try:
                answer = self._number(component, one - 1, other - 1)
            except Exception as fault:
                self.fault, self.fault_time = fault, float(self.data[INPUTS])
        self.data[ANSWER] = answer

    def _number(self, component: int, one: int, other: int) -> float:
        x = self.data[INPUTS:]
        if not np.array_equal(x, self._at):
            self._at[:] = x
            np.maximum(self._largest, abs(x), out=self._largest)
            self._value, self._slopes = self._values(x), None
        if one < 0:
            return float(self._value[component])
        if other >= 0:
            return self._second(component, one, other)
        if self._slopes is None:
            self._slopes = self._first(self._at)
        return float(self._slopes[component, one])

    def _values(self, x: np.ndarray) -> np.ndarray:
        """The function at inputs x, (count,)."""
        found = np.array(self.function(self.parameters, *x.tolist()), dtype=float).ravel()
        if found.size != self.count:
            raise ValueError(f"it returned {found.size} values instead of {self.count}")
        return found

    def _first(self, x: np.ndarray) -> np.ndarray:
        """Partial derivatives (count, inputs)."""
        if self.derivatives is None:
            columns = [self._difference(self._values, x, k) for k in range(x.size)]
            return np.stack(columns, axis=-1)
        found = np.array(self.derivatives(self.parameters, *x.tolist()), dtype=float)
        if found.size != self.count * x.size:
            wanted = f"{self.count} x {x.size}"
            raise ValueError(f"derivatives returned {found.size} numbers instead of {wanted}")
        return found.reshape(self.count, x.size)

    def _difference(
        self, function: Callable[[np.ndarray], np.ndarray], x: np.ndarray, k: int
    ) -> np.ndarray:
        """Slope of a function by input k; not before the start, where the time is zero."""
        h = FIRST * max(self._largest[k], LEAST)
        middle = max(x[k], h) if k == 0 else x[k]
        return (function(_moved(x, k, middle + h)) - function(_moved(x, k, middle - h))) / (2.0 * h)

    def _second(self, component: int, one: int, other: int) -> float:
        x = self._at.copy()
        if self.derivatives is not None:
            return float(self._difference(self._first, x, other)[component, one])
        h = SECOND * np.maximum(self._largest, LEAST)
        x[0] = max(x[0], h[0])
        if one != other:
            ends = [
                self._values(
                    _moved(_moved(x, one, x[one] + s * h[one]), other, x[other] + z * h[other])
                )
                for s, z in ((1, 1), (1, -1), (-1, 1), (-1, -1))
            ]
            total = (ends[0] - ends[1] - ends[2] + ends[3]) / (4.0 * h[one] * h[other])
        else:
            ends = [self._values(_moved(x, one, x[one] + s * h[one])) for s in (1, 0, -1)]
            total = (ends[0] - 2.0 * ends[1] + ends[2]) / h[one] ** 2
        return float(total[component])

    def report(self) -> str:
        """What went wrong, where and when."""
        fault = self.fault
        said = f"{type(fault).__name__}: {fault}" if str(fault) else type(fault).__name__
        return f"{self.label}: at t = {self.fault_time:.9g}, {self.name} failed: {said}"


def _moved(x: np.ndarray, k: int, value: float) -> np.ndarray:
    """x with another value of input k."""
    found = x.copy()
    found[k] = value
    return found


def reads(*expressions: str, derivatives: Callable[..., Any] | None = None) -> Callable[[F], F]:
    """Declare what a routine reads of the model, as expressions of the deck.

    ``{1}`` is its first parameter, ``{id}`` and ``{i}`` arguments of the statement.
    ``derivatives``: its partial derivatives by time and by each of these.
    """

    def declare(function: F) -> F:
        function.reads = expressions  # type: ignore[attr-defined]
        function.derivatives = derivatives  # type: ignore[attr-defined]
        return function

    return declare
