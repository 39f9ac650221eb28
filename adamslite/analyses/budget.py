"""What a run may spend: CPU, steps; and that it gets on.

The native loop keeps within ``system.budget``; what it has spent is carried from one of its runs to
the next.  CPU is looked at from outside, as interruptions are, and between the steps of analyses
that are no native loop.
"""

from __future__ import annotations

import time as clock
from dataclasses import dataclass
from typing import TYPE_CHECKING

from adamslite.results.outcomes import Outcome

if TYPE_CHECKING:
    from adamslite.equations.system import System

#: Of an analysis; a step below this share is no progress.
CREEPING = 1e-10
#: A step that was requested is progress, and steps are no shorter than this share of it by
#: rounding to output times and stops.
REQUESTED = 0.5
#: CPU of a run that has none left [s].
LEAST = 1e-3


@dataclass
class Budget:
    """Limits of a run, and what has been spent.

    Parameters
    ----------
    cpu : float or None
        CPU of the process from ``began`` on [s].
    steps : int or None
        Accepted steps of all analyses; as many as are needed unless given, but none that creep.
    began : float
        CPU of the process when the run began [s].
    """

    cpu: float | None = None
    steps: int | None = None
    began: float = 0.0
    taken: int = 0
    short: float = 0.0
    crept: int = 0

    def begin(self, span: float) -> None:
        """A dynamic analysis over a span of time begins."""
        self.short, self.crept = CREEPING * span if self.steps is None else 0.0, 0

    def lend(self, system: System) -> None:
        """What a native run that is ready to begin may spend."""
        lent, run = system.budget, system.settings
        lent[:] = 0
        lent.t, lent.crept = float(run.t), self.crept
        lent.short = min(self.short, REQUESTED * float(run.h_max))
        lent.most = 0 if self.steps is None else max(1, self.steps - self.taken)

    def settle(self, system: System) -> None:
        """Take over what a native run has spent."""
        self.taken += int(system.count.steps)
        self.crept = int(system.budget.crept)

    @property
    def out_of_time(self) -> bool:
        """Whether the CPU is spent."""
        return self.cpu is not None and clock.process_time() - self.began > self.cpu

    @property
    def cpu_left(self) -> float | None:
        """For what is run again [s]: next to nothing when all is spent."""
        if self.cpu is None:
            return None
        return max(self.cpu - (clock.process_time() - self.began), LEAST)

    def spent(self, steps: int = 0) -> Outcome | None:
        """How a run ends that has spent it, with ``steps`` more than those settled."""
        if self.out_of_time:
            return Outcome.CPU_LIMIT
        spent = self.steps is not None and self.taken + steps >= self.steps
        return Outcome.STEP_LIMIT if spent else None
