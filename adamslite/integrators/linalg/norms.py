"""Maximum norms that keep not-a-number.

A norm that forgets it calls a state good whose worst component has no value.
"""

from __future__ import annotations

from adamslite.integrators.linalg.plan import HUGE
from adamslite.native.translate import Reals, maximum, native

# Two numbers are one but for round-off from this share on.
ALIKE = 1.0 - 1e-12


@native
def exceeds(size: float, largest: float) -> bool:
    """Whether ``size`` takes the place of the ``largest`` so far: not-a-number exceeds every
    number, and nothing exceeds it.
    """
    return not size <= largest and largest == largest


@native
def largest_of(d: Reals, count: int) -> float:
    """The largest |d|."""
    top = 0.0
    for i in range(count):
        top = maximum(top, abs(d[i]))
    return top


@native
def largest_share(d: Reals, x: Reals, count: int) -> float:
    """The largest |d| against max(1, |x|)."""
    top = 0.0
    for i in range(count):
        top = maximum(top, abs(d[i]) / max(1.0, abs(x[i])))
    return top


@native
def place_of(top: float, d: Reals, x: Reals, count: int) -> int:
    """Where :func:`largest_share` found ``top``, the first place that is it but for round-off; -1
    where it is not among these.
    """
    least = ALIKE * top if top == top else HUGE
    for i in range(count):
        if not abs(d[i]) < least * max(1.0, abs(x[i])):
            return i
    return -1
