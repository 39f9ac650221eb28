"""Control numbers of an implicit method between steps."""

from __future__ import annotations

from adamslite.integrators.stepping.control import StepControl


class ImplicitControl(StepControl):
    """What every implicit method remembers from step to step; each extends it by its own numbers.

    order, highest       of the formula, and the highest that it may take
    equal                steps of this size since it changed
    factored             what the factored matrix was made for (0: there is none); ``age`` in steps,
                         ``fresh``: made in this step, ``made``: in this iteration of it
    rate                 of convergence
    noisy                rejections in a row that did not help
    """

    order: int
    highest: int
    equal: int
    factored: float
    rate: float
    fresh: bool
    made: int
    age: int
    noisy: int
