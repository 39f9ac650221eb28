"""The options of a run as a caller gives them, checked: names in capitals, numbers that can be.

And what it may spend: CPU, steps; and that it gets on.  The native loop keeps within
``system.budget``; what it has spent is carried from one of its runs to the next.  CPU is looked at
from outside, as interruptions are, and between the steps of analyses that are no native loop.
"""

from __future__ import annotations

import time as clock
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from math import inf, nan
from numbers import Integral, Real
from typing import TYPE_CHECKING, Any

from adamslite.elements.integrator import Integrator
from adamslite.errors import NoRoom, OutOfMemory, UsageError
from adamslite.results.outcomes import KEPT, Outcome

if TYPE_CHECKING:
    from adamslite.equations.system import System
    from adamslite.native.worker import Over

POSITIVE = ("end", "error", "hmax", "cpu_limit")
WHOLE = ("steps", "max_steps")
#: Units of memory [byte].
UNITS = {
    "": 1, "B": 1, "KB": 1e3, "MB": 1e6, "GB": 1e9, "TB": 1e12,
    "KIB": 2**10, "MIB": 2**20, "GIB": 2**30, "TIB": 2**40,
}  # fmt: skip
FORMULATIONS = ("I3", "SI2")
#: Of an analysis; a step below this share is no progress.
CREEPING = 1e-10
#: A step that was requested is progress, and steps are no shorter than this share of it by
#: rounding to output times and stops.
REQUESTED = 0.5
#: Steps below it in a row that end a run: no fewer than these; as many as take a second or so, of
#: unknowns together; less so many for each native run before, which takes as long as they.
LEAST_PATIENCE, PATIENCE, PER_RUN = 10_000, 5_000_000, 1000
#: Of what crept, carried from one native run to the next.
CARRIED = ("crept", "halved", "covered", "longest", "growing")
#: CPU of a run that has none left [s].
LEAST = 1e-3
#: Steps that a native run can count: enough for any.
MOST_COUNTED = 2**62


def checked(options: Mapping[str, Any]) -> dict[str, Any]:
    """Those of ``end steps integrator formulation error hmax cpu_limit max_steps memory_limit``
    that are given.

    Raises
    ------
    UsageError
        For a number that is not positive, a name that there is not.
    """
    given = {name: value for name, value in options.items() if value is not None}
    for name in POSITIVE:
        if name in given:
            given[name] = _positive(name, given[name])
    for name in WHOLE:
        if name in given:
            given[name] = _count(name, given[name])
    if "memory_limit" in given:
        given["memory_limit"] = size_of(given["memory_limit"])
    names = {
        "integrator": Integrator.arguments["method"].supported,
        "formulation": FORMULATIONS,
    }
    for name, known in names.items():
        if name in given:
            given[name] = _one_of(name, given[name], known)
    return given


def _positive(name: str, value: object) -> float:
    number = float(value) if isinstance(value, Real) else nan
    if not 0.0 < number < inf:
        raise UsageError(f"{_flag(name)} {value}: it must be a positive number")
    return number


def size_of(value: object) -> int:
    """The bytes of ``2GB``, ``500 MiB`` or a number of them.

    Raises
    ------
    UsageError
        When it is none, or not positive.
    """
    text = str(value).strip().upper()
    figures = text.rstrip("KMGTIB ")
    try:
        size = float(figures) * UNITS[text[len(figures) :].strip()]
    except (ValueError, KeyError):
        size = nan
    if not 1.0 <= size < inf:
        raise UsageError(
            f"--memory-limit {value}: it must be a size, as 2GB, 500MB or a number of bytes"
        )
    return int(size)


def _flag(name: str) -> str:
    """An option as the command line has it."""
    return f"--{name.replace('_', '-')}"


def _count(name: str, value: object) -> int:
    whole = isinstance(value, Integral) or (isinstance(value, float) and value.is_integer())
    if not whole or not isinstance(value, Integral | float) or value < 1:
        raise UsageError(f"{_flag(name)} {value}: it must be a whole number, at least 1")
    return int(value)


def _one_of(name: str, value: object, known: Sequence[str]) -> str:
    word = str(value).upper()
    if word not in known:
        from adamslite.language.likeness import did_you_mean

        hint = did_you_mean(word, known)
        raise UsageError(
            f"--{name} {value}: there are {', '.join(known)}" + f"; {hint}" * bool(hint)
        )
    return word


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
    runs: int = 0
    crept: dict[str, float] = field(default_factory=dict)

    def begin(self, span: float) -> None:
        """A dynamic analysis over a span of time begins."""
        self.short, self.runs = CREEPING * span if self.steps is None else 0.0, 0
        self.crept.clear()

    def lend(self, system: System) -> None:
        """What a native run that is ready to begin may spend."""
        lent, run = system.budget, system.settings
        lent[:] = 0
        lent.t = float(run.t)
        for name, value in self.crept.items():
            setattr(lent, name, value)
        patience = PATIENCE // max(1, system.nz) - PER_RUN * self.runs
        lent.patience = max(LEAST_PATIENCE, patience)
        lent.short = min(self.short, REQUESTED * float(run.h_max))
        left = 0 if self.steps is None else max(1, self.steps - self.taken)
        lent.most = min(left, MOST_COUNTED)

    def settle(self, system: System) -> None:
        """Take over what a native run has spent."""
        self.taken += int(system.count.steps)
        self.runs += 1
        self.crept = {name: getattr(system.budget, name) for name in CARRIED}

    @property
    def out_of_time(self) -> bool:
        """Whether the CPU is spent."""
        return self.cpu is not None and clock.process_time() - self.began > self.cpu

    @property
    def over(self) -> Over:
        """What says whether the CPU is spent, where it is limited."""
        return None if self.cpu is None else lambda: self.out_of_time

    @property
    def steps_left(self) -> int | None:
        """For what is run next: at least one."""
        return None if self.steps is None else max(1, self.steps - self.taken)

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


def budget_of(options: dict[str, Any]) -> tuple[Budget, int | None]:
    """What may be spent from now on, and the limit of memory, both taken out of checked options."""
    cpu, steps = options.pop("cpu_limit", None), options.pop("max_steps", None)
    return Budget(cpu, steps, clock.process_time()), options.pop("memory_limit", None)


@contextmanager
def within_memory(limit: int | None) -> Iterator[None]:
    """Meanwhile, memory is limited; what runs out of it has a name."""
    try:
        if limit is None:
            yield
            return
        from adamslite.machine import left_of_limit, memory_limited, used_memory

        with memory_limited(limit):
            if not left_of_limit():
                own = (used_memory() or 0) / 1e6
                raise NoRoom(
                    f"--memory-limit {limit}: before the run the process takes {own:.0f} MB"
                )
            yield
    except (MemoryError, SystemError) as fault:
        # Caches of Python that get no memory raise SystemError.
        if limit is None and isinstance(fault, SystemError):
            raise
        raise OutOfMemory(Outcome.MEMORY_LIMIT.sentence.replace(KEPT, "")) from None
