"""Maximum norms that keep not-a-number.

A norm that forgets it calls a state good whose worst component has no value.
"""

from __future__ import annotations

from adamslite.native.translate import Reals, maximum, native


@native
def exceeds(size: float, largest: float) -> bool:
    """Whether ``size`` takes the place of the ``largest`` so far: not-a-number exceeds every
    number, and nothing exceeds it.
    """
    return not size <= largest and largest == largest


@native
def weighted_norm(d: Reals, x: Reals, count: int) -> float:
    """The largest |d| against max(1, |x|)."""
    top = 0.0
    for i in range(count):
        top = maximum(top, abs(d[i]) / max(1.0, abs(x[i])))
    return top
