"""The deck of a description of a cable scene, by models that are tried."""

from __future__ import annotations

from math import inf

import numpy as np

from adamslite.analyses import simulation
from adamslite.cables.deck.scene import setting, several
from adamslite.cables.description.spec import read_scene
from adamslite.cables.trials.readings import Series
from adamslite.cables.trials.trial import Found, tried
from adamslite.cables.trials.trial_runs import TOO_LONG, Solution, Solver
from adamslite.errors import RunFailed
from adamslite.language.diagnostics import DeckError
from adamslite.progress import Progress, RunState
from adamslite.reading.read import read
from adamslite.results.outcomes import Outcome

# Words that tell what a sentence is about.
WORDS = 3


class _Counted(Progress):
    """Ends a run after so many steps."""

    def __init__(self, most: float, shown: Progress, said: set[tuple[str, ...]]) -> None:
        self.most, self.shown, self.said = most, shown, said

    def watch(self, state: RunState) -> None:
        """Look whether it has to end."""
        if state.steps > self.most:
            raise KeyboardInterrupt

    def say(self, sentence: str) -> None:
        """Say what takes long, the same for one run only."""
        about = tuple(sentence.split()[:WORDS])
        if about not in self.said:
            self.said.add(about)
            self.shown.say(sentence)


def described(text: str, file: str, allowance: float | None, shown: Progress) -> Found:
    """The deck of a description, tried as it says itself where `allowance` is None.

    Raises
    ------
    DeckError
        With everything that is wrong with the description.
    """
    given = read_scene(text, file)
    if given.is_several:
        return Found(several(given))
    of = setting(text, file)
    return tried(of, solver(shown), of.spec.trial if allowance is None else allowance)


def solver(shown: Progress) -> Solver:
    """Runs decks, and says to `shown` what takes long."""
    said: set[tuple[str, ...]] = set()

    def solve(text: str, columns: tuple[str, ...], most: float) -> Solution:
        try:
            run = simulation.simulate(read(text), progress=_Counted(most, shown, said))
        except (DeckError, RunFailed) as fault:
            return _ended(" ".join(str(fault).split()))
        steps = int(run.summary["steps"])
        if steps > most:
            # Where it was noticed depends on the clock.
            return _ended(TOO_LONG, most)
        if run.outcome is Outcome.INTERRUPTED:
            raise KeyboardInterrupt
        names = set(run.names)
        found = {name: np.asarray(run[name]) for name in columns if name in names}
        if run.outcome is not Outcome.DONE:
            why = run.outcome.sentence.partition(". ")[0]
            return Solution(Series(np.asarray(run.time), found), steps, inf, why)
        if not all(np.isfinite(each).all() for each in found.values()):
            return _ended("a tension or a place has no value", steps)
        cpu = float(run.summary["solve_cpu_s"])
        return Solution(Series(np.asarray(run.time), found), steps, cpu)

    return solve


def _ended(why: str, steps: float = 0) -> Solution:
    return Solution(Series(np.empty(0), {}), steps, inf, why)
