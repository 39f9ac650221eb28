"""Sensors of a run: whether they can be watched, and the record where one of them ends it."""

from __future__ import annotations

import numpy as np

from adamslite.equations.system import System
from adamslite.errors import UsageError
from adamslite.integrators import contract
from adamslite.integrators.contract import ACCELERATIONS, RECORD

CONSTANT = "its relation is the same for ever, because FUNCTION does not change"
EQUAL = "a method with equal steps locates no event; use one with variable steps"
AT_TIMES = "{kind} analyses of several times locate no event; use SIMULATE/DYNAMICS or DEACTIVATE"


def require_changing(system: System) -> None:
    """Reject sensors whose relation never changes.

    Raises
    ------
    UsageError
        When there is one.
    """
    for sensor, first, _ in system.numbering.sensors:
        if first < 0:
            raise UsageError(f"{sensor.label} cannot be watched: {CONSTANT}")


def require_none(system: System, why: str) -> None:
    """Reject sensors where no event is located.

    Raises
    ------
    UsageError
        When a sensor acts.
    """
    for sensor, *_ in system.numbering.sensors:
        raise UsageError(f"{sensor.label} cannot be watched: {why}")


def end_record(system: System, times: np.ndarray) -> np.ndarray | None:
    """Write the record at the time at which a sensor ended the run, instead of one at the same
    time; the times (nt,) of all records, None where the accelerations have no solution.
    """
    system.settings.t = time = float(system.report.t)
    if system.run(ACCELERATIONS) != contract.DONE:
        return None
    row = int(np.searchsorted(times[: system.count.records], time))
    system.run(RECORD, row)
    return np.append(times[:row], time)
