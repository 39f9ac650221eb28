"""Control numbers of an implicit method between steps, and its last accepted multipliers."""

from __future__ import annotations

from adamslite.integrators.contract import (
    Problem,
)
from adamslite.integrators.stepping.control import StepControl
from adamslite.native.translate import native


class ImplicitControl(StepControl):
    """What every implicit method remembers from step to step; each extends it by its own numbers.

    order, highest       of the formula, and the highest that it may take
    equal                steps of this size since it changed
    factored             what the factored matrix was made for (0: there is none); ``age`` in steps,
                         ``fresh``: made in this step
    rate                 of convergence
    noisy                rejections in a row that did not help
    """

    order: int
    highest: int
    equal: int
    factored: float
    rate: float
    fresh: bool
    age: int
    noisy: int


@native
def keep_algebraic(P: Problem) -> None:
    """Remember multipliers and variables of the accepted state."""
    for i in range(P.z.size):
        P.rz[i] = P.z[i]
