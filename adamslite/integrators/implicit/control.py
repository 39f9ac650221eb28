"""Control numbers of an implicit method between steps, and its last accepted multipliers."""

from __future__ import annotations

from adamslite.integrators.contract import (
    Problem,
)
from adamslite.native.translate import Record, native

RUNNING = -1


class StepControl(Record):
    """What every implicit method remembers from step to step; each extends it by its own numbers.

    t, h, h_last         accepted time, size of the next try, of the last step (0: none)
    order, highest       of the formula, and the highest that it may take
    equal                steps of this size since it changed
    row                  the next row of the record
    factored             what the factored matrix was made for (0: there is none); ``age`` in steps,
                         ``fresh``: made in this step
    rate                 of convergence
    retries, blamed      failures of the corrector in a row, the unknown that moved most
    norm, noisy          error of the last rejected try (0: none), rejections that did not help
    signature            signs of the pivots of the acceleration matrix
    """

    t: float
    h: float
    order: int
    highest: int
    equal: int
    row: int
    h_last: float
    factored: float
    rate: float
    fresh: bool
    age: int
    retries: int
    signature: int
    blamed: int
    norm: float
    noisy: int


@native
def keep_algebraic(P: Problem) -> None:
    """Remember multipliers and variables of the accepted state."""
    for i in range(P.z.size):
        P.rz[i] = P.z[i]
