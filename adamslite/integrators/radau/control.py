"""What the Radau formula remembers from step to step: control numbers, rows of its history."""

from __future__ import annotations

from adamslite.integrators.implicit.control import ImplicitControl

# Rows of y: the start of the step, behind it its stages; the start with q as it is; rates of the
# stages (those of the first one are RATES + 1); the step before.
ORIGIN, RATES, BEFORE, Y_ROWS = 4, 4, 8, 12
# What a step is known by: its start and its stages, of y and of z; rates follow.
KEPT_ROWS, KEPT_Z = 5, 3


# Rows of z: the stages, those of the step before.
Z_ROWS = 6


class Control(ImplicitControl):
    """The numbers of the Radau formula.

    theta, turns         rate of the last iterations, how many there were
    last_norm, last_size error and size of the last accepted step (0: none)
    cautious, known      the step must not grow; there is a Jacobian
    separate             each stage gets derivatives of its own in this step
    to_target            equal steps to the time that must be met
    passed               the step that has passed its error test from where the run stands, and was
                         taken again, shorter, to end at a crossing
    lengthened           how often that one then was taken again, longer, because it ended before
                         the crossing
    """

    theta: float
    turns: int
    last_norm: float
    last_size: float
    cautious: bool
    known: bool
    separate: bool
    to_target: float
    passed: float
    lengthened: int
