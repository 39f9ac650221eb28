"""Sensors of a run: whether they can be watched, and the record where one of them ends it."""

from __future__ import annotations

import numpy as np

from adamslite.equations.system import System
from adamslite.errors import UsageError
from adamslite.integrators import contract
from adamslite.integrators.contract import ACCELERATIONS, RECORD
from adamslite.language.interfaces import Key
from adamslite.results.outcomes import Outcome

CONSTANT = "its relation is always the same, because FUNCTION does not change"
EQUAL = "a method with equal steps locates no event; use one with variable steps"
AT_TIMES = "{kind} analyses of several times locate no event; use SIMULATE/DYNAMICS or DEACTIVATE"


def require_changing(system: System) -> None:
    """Reject sensors whose relation never changes, unless it is known to be false.

    Raises
    ------
    UsageError
        When there is one.
    """
    for sensor in system.numbering.unchanging:
        value = system.model.constant(sensor.function)
        if value is None or sensor.holds(value):
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


class SensorLog:
    """What sensors did in a session.

    ``notes``: which of them ended an analysis, and when; ``values``: of EVALUATE, by key, of those
    that ended the last one.
    """

    def __init__(self) -> None:
        self.notes: list[str] = []
        self.values: dict[Key, float] = {}

    @property
    def meta(self) -> dict[str, str]:
        """The comment of the results."""
        return {"sensor": "ended by " + "; ".join(self.notes)} if self.notes else {}

    def end(self, system: System, times: np.ndarray) -> tuple[Outcome, np.ndarray]:
        """Write the record at the time at which sensors ended the run, instead of one at the same
        time; the outcome, and the times (nt,) of all records.
        """
        system.settings.t = time = float(system.report.t)
        if system.run(ACCELERATIONS) != contract.DONE:
            return Outcome.UNDETERMINED, times
        row = int(np.searchsorted(times[: system.count.records], time))
        system.run(RECORD, row)
        written = system.record.reshape(-1)[row * (system.nw + system.sizes.n_out) + system.nw :]
        for sensor in system.triggered:
            self.notes.append(f"{sensor.label} at t = {time:.9g}")
            if sensor.evaluate is not None:
                self.values[sensor.key] = float(written[system.instances.outputs[sensor]])
        halted = any(sensor.halt for sensor in system.triggered)
        return Outcome.HALTED if halted else Outcome.DONE, np.append(times[:row], time)
