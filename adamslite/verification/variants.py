"""The integrators that a chart tries, and runs that are ended when they take too long."""

from __future__ import annotations

import time as clock
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Any

from adamslite.errors import UsageError
from adamslite.language.method import FIXED, declared
from adamslite.progress import Progress, RunState
from adamslite.results.outcomes import Outcome
from adamslite.results.results import Results

Run = Callable[..., Results]


@dataclass(frozen=True)
class Variant:
    """An integrator as a user requests it.

    formulation : empty where it makes no difference;  also : other names of the same
    """

    integrator: str
    formulation: str = ""
    also: tuple[str, ...] = ()

    @property
    def label(self) -> str:
        """As in the INTEGRATOR statement."""
        return " ".join(filter(None, (self.integrator, self.formulation)))

    @property
    def options(self) -> dict[str, str]:
        """Keyword arguments of `simulate`."""
        named = {"integrator": self.integrator, "formulation": self.formulation}
        return {key: value for key, value in named.items() if value}


def variants() -> list[Variant]:
    """Every integrator of the INTEGRATOR statement that ERROR steers, those that do the same once.

    Formulations differ without constraints, too: I3 does not test the error of velocities.
    """
    found = [
        Variant(method.name, form if len(method.formulations) > 1 else "", method.names[1:])
        for method in declared()
        if method.steps != FIXED
        for form in method.formulations
    ]
    return sorted(found, key=lambda variant: variant.label)


def chosen(names: Sequence[str]) -> list[Variant]:
    """The variants of the integrators of these names; all, if there are none.

    Raises
    ------
    UsageError
        When there is no such integrator.
    """
    tried = variants()
    known = dict.fromkeys(name for each in tried for name in (each.integrator, *each.also))
    wanted = [name.upper() for name in names]
    for name in wanted:
        if name not in known:
            raise UsageError(f"--integrator {name}: there are {', '.join(known)}")
    return [each for each in tried if not wanted or {*wanted} & {each.integrator, *each.also}]


class Patience(Progress):
    """Ends a run that takes more than ``seconds`` of CPU."""

    def __init__(self, seconds: float, progress: Progress | None = None) -> None:
        self.seconds, self.progress, self.over = seconds, progress or Progress(), False
        self._start = clock.process_time()

    def watch(self, state: RunState) -> None:
        self.progress.watch(state)
        if clock.process_time() - self._start > self.seconds:
            self.over = True
            raise KeyboardInterrupt

    def say(self, sentence: str) -> None:
        self.progress.say(sentence)


def patient(run: Run, seconds: float, progress: Progress | None = None) -> Run:
    """``run`` that gives up after ``seconds`` of CPU; a user's own interruption is passed on."""

    def runs(**options: Any) -> Results:
        patience = Patience(seconds, progress)
        results = run(progress=patience, **options)
        if results.outcome is not Outcome.INTERRUPTED:
            return results
        if not patience.over:
            raise KeyboardInterrupt
        return replace(results, message=f"it took more than {seconds:g} s and was given up")

    return runs
