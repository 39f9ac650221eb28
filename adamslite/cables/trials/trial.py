"""Models of a description are solved, and the cheapest of those that are good enough is taken.

The linear model proposes; what it leaves out (slack, slip, large angles, heavy ropes that whip)
only runs show. The last rung of a ladder of models stands for the cable, less what it is off
itself. From the first rung that is good enough the way goes down, as long as half the sections,
ten times the ERROR, the next lower level or, at last, the sections between these and half of them
are good enough and cheaper.
"""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from math import inf, sqrt

from adamslite.cables.deck.scene import Setting, Written, written
from adamslite.cables.description.vocabulary import MOST_SECTIONS
from adamslite.cables.model import advice
from adamslite.cables.model.model_choice import CableModel, Reasons
from adamslite.cables.trials.readings import columns
from adamslite.cables.trials.trial_runs import ROOM, Option, Runs, Solver, Tried

# How much cheaper a model has to be that is less accurate.
WORTH = 1.2
# Sections between those of two rungs, as a share of the upper one's.
BETWEEN = 1 / sqrt(2)
# ERROR of the next cheaper model, in the order 1, 2, 5, 10 ...
LOOSER = 3
# Of the accuracy: a rigid cable that the linear model has further off is not tried.
HOPELESS = 20.0
# Of the difference of the last two rungs: models that differ by less are alike.
ALIKE = 0.1


@dataclass(frozen=True)
class Found:
    """The deck that is written, with what trying has shown.

    `off` is the error of its model and `doubt` that of the finest one that was solved, as shares of
    the quantities; `cpu` is that of a run [s]. All of them are inf where nothing was solved.
    """

    deck: Written
    off: float = inf
    doubt: float = inf
    cpu: float = inf
    spent: float = 0.0
    finest: Option | None = None

    @property
    def summary(self) -> str:
        """What was found, in a sentence; empty where nothing was solved."""
        if self.off == inf:
            return ""
        model = self.deck.model
        many = f", {model.elements} section{'s' * (model.elements > 1)}" * (model.level > 1)
        return (
            f"level {model.level}{many}: {100 * self.off:.2g} % off by trial; "
            f"a run takes about {self.cpu:.1g} s of CPU"
        )


def is_open(of: Setting, model: CableModel) -> bool:
    """Whether a trial has anything to decide, and figures to decide by."""
    spec = of.spec
    if spec.level == 1 or spec.elements or spec.pitch or spec.bends or model.form == "brute":
        return False
    return bool(columns(spec, of.pieces))


def tried(of: Setting, solve: Solver, allowance: float) -> Found:
    """The deck of a description by the model that runs show to be the cheapest.

    Parameters
    ----------
    of : Setting
    solve : Solver
    allowance : float
        What all runs may cost, in seconds of a machine on which costs were measured.

    Raises
    ------
    DeckError
        With everything that is wrong with the description.
    """
    proposed = written(of)
    if not allowance:
        return Found(proposed)
    trial = Runs(of, solve, allowance)
    if not is_open(of, proposed.model):
        return Found(trial.proven(proposed))
    rungs = trial.climb(proposed.model)
    least = trial.least(rungs)
    if least < 0 and not of.spec.cable.pulls_only:
        of = of.only_pulling().telling("goes-slack", ("cable",), least=least)
        proposed = written(of)
        trial = Runs(of, solve, allowance, trial.spent)
        rungs = trial.climb(proposed.model)
    return _Choice(trial, proposed, rungs).found()


class _Choice:
    """What the runs of a description show."""

    def __init__(self, trial: Runs, proposed: Written, rungs: list[Tried]) -> None:
        self.trial, self.proposed, self.rungs = trial, proposed, rungs
        self.doubt = trial.doubt(rungs)
        self.room = ROOM
        self.doubts = trial.doubts(rungs) if len(rungs) > 1 else None
        self.others: dict[Option, Tried] = {}

    def found(self) -> Found:
        """The deck by what was found."""
        trial, rungs = self.trial, self.rungs
        start = trial.good(rungs, self.room, self.doubts) if self.doubts else None
        if start is None:
            return self._unsettled()
        chosen = self._down(start)
        off, where = trial.off(chosen, rungs[-1])
        return self._of(chosen, max(off, self.doubt if chosen is rungs[-1] else 0.0), where)

    def _does(self, one: Tried) -> bool:
        """Whether a model is good enough."""
        return self.trial.off(one, self.rungs[-1], self.doubts)[0] <= self.room

    def _down(self, start: Tried) -> Tried:
        """The last on the way to cheaper ones that are good enough."""
        current = start
        while True:
            cheaper = (self._good(option, current) for option in self._lesser(current))
            better = next((each for each in cheaper if each), None)
            if better is None:
                return current
            current = better

    def _good(self, option: Option, than: Tried) -> Tried | None:
        """A model that is good enough and cheaper."""
        one = self.trial.run(option)
        if one is None or one.option == than.option:
            return None
        self.others[one.option] = one
        simpler = one.option.level < than.option.level or one.option.form != than.option.form
        worth = 1.0 if simpler else WORTH
        return one if self._does(one) and worth * one.work <= than.work else None

    def _lesser(self, of: Tried) -> Iterator[Option]:
        """A lower level, half the sections, ten times the ERROR, the simpler form, and the sections
        between these and half of them."""
        spec, option = self.trial.of.spec, of.option
        has_fewer = option.level > 1 and option.elements > 1 and "arrival" not in spec.quantities
        if not spec.level and option.level > 1 and self._may_be_rigid():
            yield Option(1, "auto", 0, 0.0)
        if has_fewer:
            yield replace(option, elements=(option.elements + 1) // 2)
        if not spec.error:
            yield replace(option, error=advice.notched(option.error, LOOSER))
        if option.form == "ale" and spec.form == "auto":
            yield replace(option, form="paper")
        if has_fewer:
            half = (option.elements + 1) // 2
            yield replace(option, elements=max(int(BETWEEN * option.elements), half + 1))

    def _may_be_rigid(self) -> bool:
        p = self.trial.of.spec.accuracy
        left = self.trial.of.demand.left(p)
        return left is None or left.rigid < HOPELESS * p

    def _of(self, chosen: Tried, off: float, where: str) -> Found:
        """The deck by a model."""
        deck = written(self.trial.set_to(chosen.option), self._reasons(chosen, off, where))
        messages = [each for each in deck.messages if each.code not in self._refuted()]
        p = self.trial.of.spec.accuracy
        return Found(
            replace(deck, messages=messages), off * p, self.doubt * p, self.trial.timed(chosen),
            self.trial.spent, self.rungs[-1].option,
        )  # fmt: skip

    def _refuted(self) -> set[str]:
        """Messages of the linear model that runs have shown to be wrong."""
        spec, found = self.trial.of.spec, {"slackens", "pushed", "pushed-at-once"}
        found |= {"rigid-has-waves"} if not spec.level else set()
        return found | ({"paper-not-valid"} if spec.form == "auto" else set())

    def _reasons(self, chosen: Tried, off: float, where: str) -> Reasons:
        """Why this model: what was tried."""
        before, option = self.proposed.model, chosen.option
        reasons = [f"{self._named(option)} by trial: {self._share(off)} off"]
        if chosen is self.rungs[-1] and not self.doubts:
            reasons = [f"{self._named(option)}, the finest that was tried"]
        elif chosen is self.rungs[-1]:
            reasons[0] += " by how differences fall"
        else:
            reasons[0] += f" in the {where}, against {self._named(self.rungs[-1].option)}"
        reasons += self._not_taken(option)
        if before.level != option.level or before.elements != option.elements:
            reasons.append(f"the linear model asks for {self._of_model(before)}")
        return replace(self._chosen_by_trial(chosen), elements=tuple(reasons))

    def _chosen_by_trial(self, chosen: Tried) -> Reasons:
        """Why this level, form, method and ERROR."""
        before, option = self.proposed.model, chosen.option
        same = before.level == option.level
        reasons = before.reasons if same else chosen.model.reasons
        form = (f"form {option.form} by trial",) if option.level == 3 else ()
        return replace(
            reasons,
            level=reasons.level if same else (f"level {option.level} by trial",),
            form=reasons.form if same and before.form == chosen.model.form else form,
            error="as asked" if self.trial.of.spec.error else "by trial",
        )

    def _not_taken(self, chosen: Option) -> list[str]:
        """What less would have been."""
        reasons = []
        for option, one in self.others.items():
            less = {
                f"level {option.level}": option.level < chosen.level,
                self._counted(option.elements): option.elements < chosen.elements,
                f"ERROR={option.error:.0E}": option.error > chosen.error,
                f"form {option.form}": option.form != chosen.form,
            }
            alike = replace(chosen, elements=option.elements) == option
            alike |= replace(chosen, error=option.error) == option
            alike |= replace(chosen, form=option.form) == option
            words = [word for word, is_less in less.items() if is_less]
            if words and (alike or option.level < chosen.level):
                off, _ = self.trial.off(one, self.rungs[-1])
                cheaper = ", and no cheaper" * self._does(one)
                reasons.append(f"{words[0]}: {self._share(off)} off{cheaper}")
        return reasons

    def _share(self, off: float) -> str:
        """Of a figure, in per cent."""
        return f"{100 * off * self.trial.of.spec.accuracy:.2g} %"

    def _named(self, option: Option) -> str:
        if option.level == 1:
            return "level 1"
        form = f" in form {option.form}" * (option.level == 3)
        return f"{self._counted(option.elements)}{form}, ERROR={option.error:.0E}"

    @staticmethod
    def _counted(sections: int) -> str:
        return f"{sections} section{'s' * (sections > 1)}"

    def _of_model(self, model: CableModel) -> str:
        return "level 1" if model.level == 1 else self._counted(model.elements)

    def _unsettled(self) -> Found:
        """A model that is not known to be good enough: as good as the finest one where differences
        fall; else the cheapest of those that are as near to the finest one as the rungs are to one
        another, and as the one that is proposed."""
        trial, before, rungs = self.trial, self.proposed.model, self.rungs
        if trial.hit and not rungs:
            return Found(trial.failing(self.proposed))
        if len(rungs) < 2 or self._asks_for_more():
            return self._as_proposed(rungs[-1] if rungs else None)
        self.doubts, self.room = None, trial.off(rungs[-2], rungs[-1])[0]
        if trial.falls(rungs):
            self.room *= ALIKE
        elif rungs[0].option.elements == before.elements:
            self.room = min(self.room, trial.off(rungs[0], rungs[-1])[0])
        chosen = self._down(trial.good(rungs, self.room, None) or rungs[-1])
        off, where = trial.off(chosen, rungs[-1])
        trial.of = self._told(chosen.model)
        deck = self._of(chosen, off, where)
        return replace(deck, off=inf)

    def _asks_for_more(self) -> bool:
        """Whether the linear model asks for more than was solved, and nothing speaks against it: it
        knows nothing of a slack cable."""
        trial, rungs = self.trial, self.rungs
        if trial.of.spec.cable.pulls_only or trial.off(rungs[-2], rungs[-1])[0] <= 1:
            return False
        return rungs[-1].option.elements < self.proposed.model.elements

    def _told(self, model: CableModel) -> Setting:
        """The description, with the warning that its model is not known to be good enough."""
        trial = self.trial
        return trial.of.telling(
            "unsettled", ("model", "accuracy"), accuracy=trial.of.spec.accuracy,
            reached=self._reached(), model=self._of_model(model), more=10 * trial.allowance,
            hint=self._at_the_limit(self.rungs[-1] if self.rungs else None),
        )  # fmt: skip

    @staticmethod
    def _at_the_limit(finest: Tried | None) -> str:
        """What helps where no finer model may be; empty where more runs do."""
        if finest is None or 2 * finest.option.elements <= MOST_SECTIONS:
            return ""
        return f"a cable may have {MOST_SECTIONS} sections: a larger accuracy, or fewer quantities"

    def _as_proposed(self, finest: Tried | None) -> Found:
        """The model of the linear model; its cost by that of the finest that was solved."""
        trial, before = self.trial, self.proposed.model
        trial.of = self._told(before)
        if finest is None:
            return Found(written(trial.of), cpu=trial.expected(before), spent=trial.spent)
        cpu = finest.cpu * trial.expected(before) / trial.expected(finest.model)
        return Found(written(trial.of), cpu=cpu, spent=trial.spent, finest=finest.option)

    def _reached(self) -> str:
        """What runs have shown where they have not shown enough."""
        if len(self.rungs) > 1:
            coarse, fine = self.rungs[-2:]
            off, where = self.trial.off(coarse, fine)
            return (
                f"the {where} differs by {self._share(off)} between "
                f"{self._named(coarse.option)} and {self._named(fine.option)}"
            )
        if self.rungs:
            return f"nothing finer than {self._named(self.rungs[0].option)} was solved in time"
        return self.trial.ended or "no run came to its end in time"
