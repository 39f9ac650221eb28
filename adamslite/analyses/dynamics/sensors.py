"""Sensors of a run: whether they can be watched, and the record where one of them ends it."""

from __future__ import annotations

from math import inf
from typing import TYPE_CHECKING

import numpy as np

from adamslite.analyses.initial.conditions import without_accelerations
from adamslite.elements.simulate import MOST_STEPS
from adamslite.errors import UsageError
from adamslite.integrators import contract
from adamslite.integrators.contract import ACCELERATIONS, RECORD
from adamslite.results.outcomes import Outcome

if TYPE_CHECKING:
    from adamslite.elements.sensor import Sensor
    from adamslite.equations.system import System
    from adamslite.language.interfaces import Key

# A sensor that has triggered does not do so again within this share of the longest step.
ROUND_OFF = 1e-7
# Sensors that act so many times in a row, each within this share of the longest step after the one
# before, would do so for ever: what one of them changes leads back to the other.
ENDLESS, AT_ONCE = 1_000, 1e-5
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

    ``notes``: which of them ended an analysis, and when; ``acted``: how often others did, and when
    first; ``values``: of EVALUATE, by key, of those that triggered last; ``asleep``: by key, until
    when those that the analysis continued from are left out; ``rapid``: how often they acted in
    a row without a pause.
    """

    def __init__(self) -> None:
        self.notes: list[str] = []
        self.acted: dict[str, tuple[int, float]] = {}
        self.values: dict[Key, float] = {}
        self.asleep: dict[Key, float] = {}
        self.continuing: list[Sensor] = []
        self.rapid, self.last = 0, -inf

    @property
    def meta(self) -> dict[str, str]:
        """The comment of the results."""
        ended = {"sensor": "ended by " + "; ".join(self.notes)} if self.notes else {}
        acted = "; ".join(
            f"{label} at t = {first:.9g}" + (f" and {count - 1} times later" if count > 1 else "")
            for label, (count, first) in self.acted.items()
        )
        return {**ended, **({"sensor passed": acted} if acted else {})}

    def arm(self, system: System) -> None:
        """Before a run: what has triggered and has not been false since sleeps."""
        for row, (sensor, *_) in zip(system.sensors, system.numbering.sensors, strict=True):
            row.asleep, row.quiet = sensor.key in self.asleep, self.asleep.get(sensor.key, 0.0)

    def end(
        self, system: System, times: np.ndarray, apart: float
    ) -> tuple[Outcome, np.ndarray, bool]:
        """Write the record at the time at which sensors ended the run, instead of one at the same
        time; the outcome, the times (nt,) of all records, and whether the last was requested.

        ``apart``: the longest step of the run.
        """
        system.settings.t = time = float(system.report.t)
        if system.run(ACCELERATIONS) != contract.DONE:
            return without_accelerations(system), times, True
        first = int(system.block.first)
        row = int(np.searchsorted(times[: system.count.records], time))
        output = row < len(times) and times[row] == time
        system.run(RECORD, row)
        at = (row - first) * (system.nw + system.sizes.n_out)
        written = system.record.reshape(-1)[at + system.nw :]
        triggered, found = (
            system.triggered,
            zip(system.sensors, system.numbering.sensors, strict=True),
        )
        self.asleep = {
            s.key: row.quiet for row, (s, *_) in found if row.asleep and s not in triggered
        }
        for sensor in triggered:
            self._note(sensor, time)
            if not sensor.ends_analysis:
                self.asleep[sensor.key] = time + ROUND_OFF * apart
            if sensor.evaluate is not None:
                self.values[sensor.key] = float(written[system.instances.outputs[sensor]])
        halted, ended = (any(getattr(s, w) for s in triggered) for w in ("halt", "ends_analysis"))
        self.continuing = [] if ended else triggered
        wanted = output or ended or any(sensor.prints for sensor in triggered)
        outcome = Outcome.HALTED if halted else Outcome.DONE
        if self._is_endless(time, apart) and not ended:
            outcome, wanted = Outcome.CHATTERING, True
        return outcome, np.append(times[:row], time), wanted

    def _is_endless(self, time: float, apart: float) -> bool:
        """Whether sensors, of which some act now, have acted without a pause for too often."""
        self.rapid = self.rapid + 1 if time - self.last <= AT_ONCE * apart else 0
        self.last = time
        return self.rapid >= ENDLESS

    def _note(self, sensor: Sensor, time: float) -> None:
        if sensor.ends_analysis:
            self.notes.append(f"{sensor.label} at t = {time:.9g}")
        else:
            count, first = self.acted.get(sensor.label, (0, time))
            self.acted[sensor.label] = count + 1, first

    def rest(self, times: np.ndarray, time: float) -> np.ndarray:
        """Output times after sensors that the analysis continues from; the first is its start.

        Raises
        ------
        UsageError
            When there are more than ``MOST_STEPS`` of them.
        """
        steps = [sensor.dt for sensor in self.continuing if sensor.dt is not None]
        later, end = times[times > time], float(times[-1])
        if steps and end > time:
            count = int(np.ceil((end - time) / min(steps) * (1.0 - ROUND_OFF)))
            if count > MOST_STEPS:
                whose = self.continuing[0].label
                raise UsageError(
                    f"{whose}: there may be {MOST_STEPS:.0e} output steps; a longer DT."
                )
            later = np.append(time + min(steps) * np.arange(1, count), end)
        return np.append(time, later)

    @property
    def first_step(self) -> float | None:
        """The first step after them, where one is given."""
        sizes = [sensor.stepsize for sensor in self.continuing if sensor.stepsize is not None]
        return min(sizes, default=None)
