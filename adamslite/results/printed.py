"""How far numbers of a file are rounded: what that hides is no difference."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

#: From so many on, a double has no more.
ALL_DIGITS, ALL_DECIMALS = 16, 16


class Printed(NamedTuple):
    """``decimals``: digits after the point, of small numbers after that of the mantissa;
    ``digits``: significant ones, of all numbers.  0 means all that there are.
    """

    decimals: int = 0
    digits: int = 0

    def hidden(self, values: np.ndarray) -> np.ndarray:
        """Half a unit of the last digit, the same shape as ``values``."""
        if self.digits and self.digits < ALL_DIGITS:
            return _half_of_last(values, self.digits)
        if self.decimals and self.decimals < ALL_DECIMALS:
            small = _half_of_last(values, self.decimals + 1)
            return np.where(np.abs(values) < 1e-4, small, 0.5 * 10.0**-self.decimals)
        return np.zeros_like(values)


def _half_of_last(values: np.ndarray, digits: int) -> np.ndarray:
    size = np.abs(values)
    leading = np.floor(np.log10(size, out=np.zeros_like(size), where=size > 0))
    return np.where(size > 0, 0.5 * 10.0 ** (leading + 1 - digits), 0.0)
