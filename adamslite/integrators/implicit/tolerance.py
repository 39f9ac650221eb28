"""The error test of a step: its tolerance, and the sizes against which it is measured."""

from __future__ import annotations

from adamslite.integrators.contract import (
    Problem,
    Report,
)
from adamslite.integrators.linalg.norms import exceeds
from adamslite.integrators.stepping.outcome import OVERFLOW
from adamslite.native.translate import Reals, native

# Fixed steps have no error test: a corrector looser than this would be all that errs.
LOOSEST = 1e-3


@native
def error_limit(P: Problem, fixed: float) -> float:
    """ERROR; with ``fixed`` steps at most LOOSEST."""
    return min(P.settings.error, LOOSEST) if fixed > 0.0 else P.settings.error


@native
def is_allowed(norm: float, fixed: float) -> bool:
    """Whether a step with this error over ERROR is accepted; ``fixed`` steps have no error test."""
    return norm <= 1.0 or (fixed > 0.0 and norm < OVERFLOW)


@native
def weighted(
    D: Reals, row: int, w: int, n: int, ns: int, y: Reals, si2: bool, report: Report
) -> float:
    """Largest |D_row| against max(1, |y|) over the tested variables; remembers where."""
    top, where = 0.0, 0
    o = row * w
    for i in range(2 * n if si2 else n):
        # Compared before divided: few elements ever set a new maximum.
        weight = max(1.0, abs(y[i]))
        if exceeds(abs(D[o + i]), top * weight):
            top, where = abs(D[o + i]) / weight, i
    for i in range(2 * n, 2 * n + ns):
        weight = max(1.0, abs(y[i]))
        if exceeds(abs(D[o + i]), top * weight):
            top, where = abs(D[o + i]) / weight, i
    report.where = where
    return top
