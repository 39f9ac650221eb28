"""Tables of past values, which a run fills as it proceeds."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from adamslite.language.expression import fold
from adamslite.symbolic.interpolant import joined

if TYPE_CHECKING:
    from adamslite.language.expression import Call
    from adamslite.model.model import Model
    from adamslite.symbolic.interpolant import Interpolant

# Knots of a table.
KNOTS = 512


@dataclass(frozen=True, eq=False)
class Past:
    """What a call of DELAY takes of the past.

    ``delay`` [time]; ``initial``: the value before the run; ``table``: values over TIME - delay, in
    the span that is being run.
    """

    delay: float
    initial: float
    table: Interpolant


def past_of(model: Model, call: Call) -> Past:
    """The past of a call, the same each time it is asked for."""
    return model.once(("PAST", call), lambda: _empty(call))


def _empty(call: Call) -> Past:
    delay, initial = (fold(node) or 0.0 for node in call.args[1:3])
    pieces = np.zeros((KNOTS + 1, 1, 4))
    pieces[:, :, 0] = initial
    return Past(delay, initial, joined(np.linspace(-2.0 * delay, -delay, KNOTS), pieces))
