"""Runs of the models of a description: a ladder of finer and finer ones, and single ones.

Every rung has twice the sections of the one before and a smaller ERROR. How far the last is off is
told by the differences of the last three.

Runs are counted, in steps times what a step of so many sections costs, and not timed: what they
show is the same on every machine.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from math import inf

from adamslite.cables.deck.scene import Setting, Written, written
from adamslite.cables.description.messages import MESSAGES
from adamslite.cables.description.vocabulary import MOST_SECTIONS
from adamslite.cables.model import advice
from adamslite.cables.model.demand import elastic_level
from adamslite.cables.model.model_choice import CableModel
from adamslite.cables.trials.readings import (
    Doubts,
    Readings,
    Series,
    apart,
    collision,
    columns,
    differences,
    doubts_of,
    larger,
    named,
    read_off,
)
from adamslite.language.diagnostics import DeckError

# Rungs of a ladder that show how fast differences fall, where there is room for them.
RUNGS = 3
# Of the accuracy: what the last rung may be off, and what the model that is taken may be, with it.
SETTLED, ROOM = 0.2, 0.92
# Of the allowance: what a rung costs that is not needed where one is good enough; as long as they
# are cheaper the ladder goes on, for a few sections may agree about a front that none of them has.
DEAR = 0.05
# ERROR from rung to rung, in the order 1, 2, 5, 10 ...
TIGHTER = 2
# ERROR of a run that shows what ERROR does, in the same order: a tenth.
TENTH = 3
# Of the length: ERROR of a rung at least.
FINEST = 1e-11
# Work of a rung over that of the one before, at least.
GROWTH = 3.0
# Of the allowance: what the first rung may be expected to take.
FIRST = 1 / 30
# Of what is left: what the first rung may take.
BEGIN = 0.5
# CPU [s] of reading a deck and making it ready, in any case and for each of its letters.
SETUP, BY_LETTER = 0.03, 2e-6
# Steps of implicit methods where sections go slack, in those where they push.
EVENTS = 30.0
# Runs that are shorter are timed so often again [s].
SHORT, AGAIN = 0.05, 3
# Runs that may fail before others are not tried.
FAILURES = 2
# The method that is taken where another one does not come to an end.
LAST = "GSTIFF, SI2"
# Of the allowance: what a run of a model that is not tried may take, to show that it ends.
PROOF = 0.1
# Why a run ended that took more steps than it may.
TOO_LONG = "a run took more steps than the trial may"


@dataclass(frozen=True)
class Solution:
    """Columns of a run, or how it ended early; steps, and CPU [s] that this machine took."""

    run: Series
    steps: float
    cpu: float
    ended: str = ""


Solver = Callable[[str, tuple[str, ...], float], Solution]
"""Solves a deck for some columns, in so many steps at most."""


@dataclass(frozen=True)
class Option:
    """A model: `form` is auto below level 3, `elements` and `error` are 0 where rules decide."""

    level: int
    form: str
    elements: int
    error: float


@dataclass(frozen=True)
class Tried:
    """A model that was solved: what was read, and its cost where costs were measured [s]."""

    option: Option
    readings: Readings
    model: CableModel
    work: float
    cpu: float


class Runs:
    """The runs of a description."""

    def __init__(self, of: Setting, solve: Solver, allowance: float, spent: float = 0.0) -> None:
        self.of, self.solve, self.allowance, self.spent = of, solve, allowance, spent
        self.known: dict[Option, Tried | None] = {}
        self.wanted = columns(of.spec, of.pieces)
        self.hit, self.ended, self.was_cut = "", "", False

    def set_to(self, option: Option) -> Setting:
        """The description with a model."""
        spec = self.of.spec
        return replace(
            self.of,
            spec=replace(spec, level=option.level, form=option.form, elements=option.elements,
                         error=option.error or spec.error),
        )  # fmt: skip

    def run(self, option: Option, share: float = 1.0) -> Tried | None:
        """A model that is solved; None where it cannot be, or not in a share of what is left."""
        if option not in self.known:
            self.known[option] = self._solved(option, share)
        return self.known[option]

    def _solved(self, option: Option, share: float) -> Tried | None:
        self.was_cut = False
        try:
            deck = written(self.set_to(option))
        except DeckError:
            return None
        self.spent += SETUP + BY_LETTER * len(deck.text)
        step = self._work(deck.model, 1.0)
        left = share * (self.allowance - self.spent) / step
        if left < 1:
            return None
        solution = self.solve(deck.text, self.wanted, left)
        work = self._work(deck.model, solution.steps)
        self.spent += work
        if solution.ended not in ("", TOO_LONG) and deck.model.method != LAST:
            before, self.of = self.of, replace(self.of, method=LAST)
            again = self._solved(option, share)
            if again or self.was_cut:
                return again
            self.of = before
        if solution.ended:
            self.hit, self.ended = self.hit or collision(self.of.spec, solution.run), solution.ended
            self.was_cut = solution.ended == TOO_LONG
            return None
        read = read_off(self.of.spec, self.of.pieces, solution.run)
        option = replace(option, error=deck.model.error)
        return Tried(option, read, deck.model, work, solution.cpu)

    def proven(self, proposed: Written) -> Written:
        """What is proposed, with another method where it does not come to an end."""
        steps = PROOF * self.allowance / self._work(proposed.model, 1.0)
        solution = self.solve(proposed.text, self.wanted, steps)
        if solution.ended in ("", TOO_LONG):
            return proposed
        self.hit, self.ended = collision(self.of.spec, solution.run), solution.ended
        if self.hit or proposed.model.method == LAST:
            return self.failing(proposed)
        self.of = replace(self.of, method=LAST)
        return self.proven(written(self.of))

    def failing(self, proposed: Written) -> Written:
        """What is proposed, with the message why its run does not come to its end."""
        if self.hit and any(each.code == "runs-into-wheel" for each in proposed.messages):
            return proposed
        hint = {"hint": MESSAGES["runs-into-wheel"].hint} if self.hit else {}
        why = self.hit or self.ended
        return written(self.of.telling("does-not-end", ("model",), why=why, **hint))

    def timed(self, one: Tried) -> float:
        """CPU [s] of a run; a short one is timed again, for the first is often disturbed."""
        least, text = one.cpu, written(self.set_to(one.option)).text
        for _ in range(AGAIN if least < SHORT else 0):
            least = min(least, self.solve(text, self.wanted, inf).cpu)
        return least

    def _work(self, model: CableModel, steps: float) -> float:
        method = model.method.split(",")[0]
        return advice.work(self.of.demand, method, model.level, steps, model.elements)

    def expected(self, model: CableModel) -> float:
        """CPU [s] of a run by the linear model."""
        method = model.method.split(",")[0]
        of, level = self.of.demand, model.level
        return advice.expected(of, method, level, model.elements, model.error) * advice.speed()

    def climb(self, proposed: CableModel) -> list[Tried]:
        """Models, each finer than the one before, until they stand still, or two go slack."""
        option: Option | None = self._bottom(proposed)
        rungs: list[Tried] = []
        failures = 0
        while option and failures < FAILURES:
            before = self.spent
            rung = self.run(option, 1.0 if rungs else BEGIN)
            taken = self.spent - before
            if rung:
                rungs.append(rung)
            elif not rungs and self.was_cut and option.elements > 1:
                option = self._coarser(option)
                continue
            failures += rung is None
            if self.is_enough(rungs, GROWTH * taken):
                break
            if GROWTH * taken > self.allowance - self.spent:
                break
            option = self._finer(option)
        return rungs

    def _bottom(self, proposed: CableModel) -> Option:
        """The first rung: the elastic model that is proposed, or less where that is expected to
        take too long, or to leave no room for others."""
        spec, of = self.of.spec, self.of.demand
        level = spec.level or elastic_level(of)
        form = spec.form if spec.form != "auto" else "ale" if level == 3 else "auto"
        method = advice.integrator(of, spec.accuracy, level)[0]
        stops = EVENTS if spec.cable.pulls_only and method != "VERLET" else 1.0
        count = proposed.elements
        while True:
            error = spec.error or advice.error_bound(of, spec.accuracy, count)
            taken = stops * advice.expected(of, method, level, count, error)
            cheap = taken < FIRST * self.allowance and count <= MOST_SECTIONS >> (RUNGS - 1)
            if count == 1 or cheap:
                return Option(level, form, count, error)
            count = (count + 1) // 2

    def _coarser(self, option: Option) -> Option:
        count = (option.elements + 1) // 2
        p = self.of.spec.accuracy
        error = self.of.spec.error or advice.error_bound(self.of.demand, p, count)
        return replace(option, elements=count, error=error)

    def _finer(self, option: Option) -> Option | None:
        if 2 * option.elements > MOST_SECTIONS:
            return None
        error = option.error
        if not self.of.spec.error:
            least = FINEST * self.of.demand.longest
            error = max(advice.notched(error, -TIGHTER), min(least, error))
        return replace(option, elements=2 * option.elements, error=error)

    def off(self, one: Tried, truth: Tried, doubts: Doubts | None = None) -> tuple[float, str]:
        """How far a model is from a finer one, with what that may be off itself, in parts of the
        accuracy, and where."""
        asked = self.of.spec.quantities
        off, key, which = apart(one.readings, truth.readings, asked, doubts)
        return off / self.of.spec.accuracy, named(key, which)

    def doubts(self, rungs: list[Tried]) -> Doubts:
        """How far the last rung may be off, by figure: by its sections and by its ERROR."""
        asked = self.of.spec.quantities
        found = doubts_of([rung.readings for rung in rungs], asked)
        pair = self._tenth_of_error(rungs)
        return larger(found, differences(*pair, rungs[-1].readings, asked)) if pair else found

    def _tenth_of_error(self, rungs: list[Tried]) -> tuple[Readings, Readings] | None:
        """The sections of the first rung with ERROR of the last one, and with a tenth of it. From
        rung to rung both change, and what a step leaves out at a corner may stay for long as ERROR
        falls, and fall at last: the rungs agree before that. None where these runs are dear, too,
        or ERROR is given."""
        last = rungs[-1].option.error
        least = FINEST * self.of.demand.longest
        is_dear = GROWTH * rungs[0].work > DEAR * self.allowance
        if self.of.spec.error or last <= least or is_dear:
            return None
        errors = last, max(advice.notched(last, -TENTH), least)
        runs = [self.run(replace(rungs[0].option, error=error)) for error in errors]
        one, other = (each.readings if each else None for each in runs)
        return (one, other) if one and other else None

    def doubt(self, rungs: list[Tried]) -> float:
        """The largest of them, in parts of the accuracy."""
        if len(rungs) < 2:
            return inf
        return self.off(rungs[-1], rungs[-1], self.doubts(rungs))[0]

    def falls(self, rungs: list[Tried]) -> bool:
        """Whether the last rungs are nearer to each other than the ones before."""
        if len(rungs) < RUNGS:
            return False
        return self.off(rungs[-2], rungs[-1])[0] < self.off(rungs[-3], rungs[-2])[0]

    def good(self, rungs: list[Tried], room: float, doubts: Doubts | None) -> Tried | None:
        """The first rung that is good enough, as are those above it."""
        found = None
        for rung in reversed(rungs):
            if self.off(rung, rungs[-1], doubts)[0] > room:
                break
            found = rung
        return found

    def is_enough(self, rungs: list[Tried], next_one: float) -> bool:
        """Whether no finer model is worth what it will cost."""
        if self.slackens(rungs):
            return True
        if len(rungs) < RUNGS:
            return False
        if next_one <= DEAR * self.allowance:
            return False
        good = self.good(rungs, ROOM, self.doubts(rungs))
        return self.doubt(rungs) <= SETTLED or good not in (None, rungs[-1])

    def slackens(self, rungs: list[Tried]) -> bool:
        """Whether two models agree that a cable which also pushes would be pushed."""
        pulls_only, last = self.of.spec.cable.pulls_only, rungs[-2:]
        return not pulls_only and len(last) > 1 and all(self.least([each]) < 0 for each in last)

    def least(self, rungs: list[Tried]) -> float:
        """Least tension where the cable goes slack, else 0 [N]."""
        if not rungs:
            return 0.0
        share, least = rungs[-1].readings.lowest
        return least if share < -self.of.spec.accuracy else 0.0
