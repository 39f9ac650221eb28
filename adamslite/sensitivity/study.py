"""`sensitivities`: derivatives of a run by numbers of its deck."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import replace
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from adamslite.analyses.setup.output_times import plan_of
from adamslite.analyses.setup.run_options import budget_of, checked, within_memory
from adamslite.analyses.setup.subject import deck_of, kernels_of, prepared_for
from adamslite.analyses.simulation import explained
from adamslite.equations.result_columns import columns
from adamslite.errors import RunFailed, UsageError
from adamslite.kernels.groups import Kernels
from adamslite.language.diagnostics import DeckError
from adamslite.model.reduction import MERGED
from adamslite.native.worker import Overspent
from adamslite.results.outcomes import Outcome
from adamslite.results.results import Results
from adamslite.sensitivity.adjoint_columns import column_slopes
from adamslite.sensitivity.directions import SHARE, STENCIL, Direction, Snapshot, direction
from adamslite.sensitivity.measures import Columns, asked, compared, slope
from adamslite.sensitivity.recipes import Known, alone
from adamslite.sensitivity.record import Sensitivities
from adamslite.sensitivity.taped import Along, Probe, Ready, Taped, followed
from adamslite.variation.decks import variable_of
from adamslite.variation.kernels import of_deck

if TYPE_CHECKING:
    from adamslite.analyses.session.session import Session
    from adamslite.analyses.setup.subject import Subject
    from adamslite.deck.deck import Deck
    from adamslite.deck.redefinition import Command
    from adamslite.equations.system import System
    from adamslite.progress import Progress
    from adamslite.reading.numbers import Named

UNUSED = "no equation hangs on it: nothing moves otherwise"
FORM = (
    "{name} decides a form or is a whole number (an exponent, a flag, a constant of a call): there "
    "is no derivative by it"
)
TABLE = "{name} is a number of a table: there is no derivative by it yet"
SENSED = "A SENSOR ended the run: derivatives where the end itself moves are not worked out"
# A hair, as a share of the distance of the values that are taken.
NUDGE = 1e-6
COARSE = (
    "the steps of the run are coarse for it: derivatives may be off by {error:.1g} of the largest, "
    "a smaller ERROR is needed"
)
SEVERAL = (
    "changes of branches coincide, or creep of friction begins anew: derivatives are compared with "
    "differences of {count} more runs"
)
FAILED = "derivatives where changes of branches coincide are not compared: {fault}"
COUPLED = (
    "the order of changes at one time matters: derivatives to both sides differ, and these are "
    "their mean"
)
GRAZED = "the motion only touches what changes a branch: nothing is known behind such an event"
# Estimates from here on are reported; runs that are compared have this ERROR at most.
DOUBTFUL, TIGHT = 0.08, 1e-6
# Whether motion in a plane is followed in the plane.
PLANAR = True
# Numbers of derivatives that are held at a time; and numbers of the deck that are followed at a
# time where CPU is limited, so that there are some when it is spent.
MOST_HELD, LIMITED = 40_000_000, 4


class Study:
    """A scene whose derivatives are asked for.

    ``plan``: what is carried out; ``flags``: of the session.
    """

    def __init__(
        self, scene: Subject, commands: Iterable[Command], options: dict[str, Any]
    ) -> None:
        commands = tuple(commands)
        given = checked(options)
        self.budget, self.memory = budget_of(given)
        end, steps = given.pop("end", None), given.pop("steps", None)
        self.flags = {{"integrator": "method"}.get(k, k): each for k, each in given.items()}
        self.plan = plan_of(deck_of(scene), commands, end, steps)
        self.without = frozenset({MERGED, "plane"})
        subject = prepared_for(scene, commands)
        self.deck = deck_of(subject)
        if self.deck.delays:
            raise UsageError("DELAY: derivatives of a past that is looked up are not worked out")
        self.kernels = self._kernels(subject)

    def _kernels(self, subject: Subject) -> Kernels:
        """Those of a deck are kept with it, and what is known of its numbers with them."""
        if subject is not self.deck:
            return kernels_of(subject, None, self.without, False)
        base, asked = self.deck.base or self.deck, (Kernels, self.without, False)
        if base.kept.get(asked) is None:
            base.kept[asked] = kernels_of(base, None, self.without, False)
        kernels: Kernels = base.kept[asked]
        return of_deck(kernels, self.deck) if self.deck.base else kernels

    def named(self, by: Iterable[str]) -> list[Named]:
        """The numbers of these names.

        Raises
        ------
        UsageError
            When there is none, with what may have been meant.
        """
        numbers = variable_of(self.deck.base or self.deck).numbers
        listed = [by] if isinstance(by, str) else [*by]
        found = {each.name: each for each in map(numbers.find, listed)}
        return [
            each._replace(value=self.deck.values.get(name, each.value))
            for name, each in found.items()
        ]

    def session(self, kind: type[Session], kernels: Kernels) -> Any:
        return kind(kernels, None, dict(self.flags), self.without, budget=self.budget)

    def snapshot(self, kernels: Kernels) -> tuple[System, Snapshot]:
        """The system where the dynamic analysis begins, and its arrays.

        Raises
        ------
        RunFailed
            When there is none, or it is not reached.
        """
        session = self.session(Probe, kernels)
        try:
            session.execute(self.plan)
        except Ready as ready:
            return session.system, ready.snapshot
        if session.outcome is not Outcome.DONE:
            raise RunFailed(explained(session))
        raise UsageError("derivatives are those of a dynamic analysis, and there is none")

    def directions(self, named: list[Named]) -> Callable[[System, bool], list[Direction]]:
        """What gives derivatives of the arrays by each number, of the system and whether it starts
        as it is drawn.

        What is zero, as the distance of a marker from its mass centre, is left out of equations. A
        number that moves it away from there is put a hair beside its value first.

        Raises
        ------
        UsageError
            When a number decides more than values.
        """
        known = Known(self.kernels)
        quick = self._quick(known, named)
        slow = [each for each in named if each.name not in quick]
        if slow:
            self.put_beside(slow)
            known, named = Known(self.kernels), self.named(each.name for each in named)
        made: dict[str, Direction] = {}
        if slow:
            system, base = self.snapshot(self.kernels)
            for each in named:
                if each.name not in quick:
                    made[each.name] = self.direction(system, base, each)

        def found(system: System, as_drawn: bool) -> list[Direction]:
            for each in named:
                if each.name in quick and known.is_load(each):
                    made[each.name] = known.load(system, each, self.step(each))
                elif each.name in quick and as_drawn:
                    made[each.name] = known.mass(system, each, self.step(each))
                elif each.name not in made:
                    made[each.name] = self.direction(*self.snapshot(self.kernels), each)
            return [made[each.name] for each in named]

        return found

    def _quick(self, known: Known, named: list[Named]) -> set[str]:
        """Numbers whose way into arrays is known; behind an equilibrium, which any number moves,
        there are none.
        """
        if sum(each.keyword == "SIMULATE" for each in self.plan) > 1:
            return set()
        return {each.name for each in named if known.is_load(each) or known.is_mass(each)}

    def put_beside(self, named: list[Named]) -> None:
        """Put a hair beside its value what has another form there."""
        base = [group.name for group in self.kernels.groups]
        beside = {}
        for each in named:
            deck = self._varied(each, self.step(each))
            if [group.name for group in of_deck(self.kernels, deck).groups] != base:
                beside[each.name] = each.value + NUDGE * self.step(each)
        if beside:
            self.deck = self.deck.with_values(beside)
            self.kernels = of_deck(self.kernels, self.deck)

    def direction(self, system: System, base: Snapshot, number: Named) -> Direction:
        """Derivatives of the arrays by one number; ``base``: the arrays themselves.

        Raises
        ------
        UsageError
            When the number decides the form of expressions, or is one of a table.
        """
        around = self._around(number)
        if any(one.names != base.names for one in around.values()):
            raise UsageError(FORM.format(name=number.name))
        if any(one.tables != base.tables for one in around.values()):
            raise UsageError(TABLE.format(name=number.name))
        found = direction(system, base, around, self.step(number))
        if not found.pieces and not found.start.any():
            alone(self.deck).add(number.name)
        return found

    def _around(self, number: Named) -> dict[int, Snapshot]:
        """Snapshots beside the value of a number."""
        h, found = self.step(number), {}
        for k in STENCIL:
            deck = self._varied(number, k * h)
            found[k] = self.snapshot(of_deck(self.kernels, deck))[1]
        return found

    def _varied(self, number: Named, change: float) -> Deck:
        """The deck with another value of a number, beside its own."""
        try:
            return self.deck.with_values({number.name: number.value + change})
        except DeckError as fault:
            raise UsageError(FORM.format(name=number.name)) from fault

    def step(self, number: Named) -> float:
        """Distance of the values: a share of it, or of the numbers beside a zero."""
        scale = self._scale(number)
        size = abs(number.value)
        return SHARE * (size if size > NUDGE * scale else scale)

    def _scale(self, number: Named) -> float:
        """What a zero is small against: the numbers beside it."""
        return self.scales[number.name.partition("[")[0]] or 1.0

    def compared(
        self,
        found: Sensitivities,
        named: list[Named],
        session: Taped,
        several: int,
        coupled: int,
    ) -> Sensitivities:
        """Derivatives of a run with ``several`` events at a time, beside differences of runs."""
        if not several or found.stopped:
            return found
        error = min(session.chosen.settings.error, TIGHT)
        flags = {**self.flags, "method": session.chosen.settings.method, "error": error}

        def run(values: Mapping[str, float]) -> Columns:
            made: list[Columns] = []
            kernels = of_deck(self.kernels, self.deck.with_values(dict(values)))
            other = Taped(kernels, None, flags, self.without, budget=self.budget)
            other.follow = lambda system, _: made.append(
                (system.times.copy(), *columns(system, recorded(system)))
            )
            other.execute(self.plan)
            if other.outcome is not Outcome.DONE:
                raise RunFailed(explained(other))
            return made[0]

        notes = [COUPLED] if coupled else []
        try:
            sizes = {each.name: self.step(each) / SHARE for each in named}
            found, count = compared(found, run, sizes, error)
            notes.append(SEVERAL.format(count=count))
        except (DeckError, RunFailed, UsageError) as fault:
            notes.append(FAILED.format(fault=fault))
        notes = [each for each in (found.notes.get("events"), *notes) if each]
        return replace(found, notes={**found.notes, "events": "; ".join(notes)})

    @cached_property
    def scales(self) -> dict[str, float]:
        """The largest of the numbers beside each other, by what they have in common."""
        found: dict[str, float] = {}
        for each in variable_of(self.deck.base or self.deck).numbers.named.values():
            label = each.name.partition("[")[0]
            found[label] = max(found.get(label, 0.0), abs(each.value))
        return found


def sensitivities(
    scene: Subject,
    by: Iterable[str],
    of: Iterable[str] = (),
    commands: Iterable[Command] = (),
    progress: Progress | None = None,
    compare: bool = True,
    **options: Any,
) -> Sensitivities:
    """Derivatives of a deck, a model or kernels; see :func:`adamslite.sensitivities`.  ``compare``:
    with differences of runs where several events happen at a time.
    """
    study = Study(scene, commands, options)
    with within_memory(study.memory):
        found, named, session, along = _worked_out(study, by, of)
        if along and compare:
            return study.compared(found, named, session, along.several, along.coupled)
        return found


def noted(along: Along | None, errors: Mapping[str, float]) -> dict[str, str]:
    """Words about estimated errors by name, and about events."""
    notes = {name: COARSE.format(error=error) for name, error in errors.items() if error > DOUBTFUL}
    return notes | ({"events": GRAZED} if along and along.grazed else {})


def recorded(system: System) -> np.ndarray:
    """The record of a run (nt, nw + n_out)."""
    size = system.nw + system.sizes.n_out
    return system.record[: len(system.times) * size].reshape(len(system.times), size)


def _worked_out(
    study: Study, by: Iterable[str], of: Iterable[str]
) -> tuple[Sensitivities, list[Named], Taped, Along | None]:
    named = study.named(by)
    if not named:
        raise UsageError("derivatives by what? --by NAME; `adamslite names DECK` lists numbers")
    directions = study.directions(named)
    session = study.session(Taped, study.kernels)
    made: dict[str, Any] = {}

    def follow(system: System, method: str) -> None:
        if system.triggered:
            raise UsageError(SENSED)
        record = recorded(system)
        names, values = columns(system, record)
        measures, kept = asked(of, names) if of else ([], [*range(len(names))])
        lot = max(1, MOST_HELD // max(record.size, 1))
        lot = lot if study.budget.cpu is None else min(lot, LIMITED)
        found = directions(system, not (session.assembled or session.speeds))
        curves: list[np.ndarray] = []
        errors: list[float] = []
        for at in range(0, len(found), lot):
            try:
                along = followed(system, method, found[at : at + lot], study.budget)
            except Overspent:
                curves += [np.full((len(record), len(kept)), np.nan)] * (len(found) - at)
                errors += [np.nan] * (len(found) - at)
                made["stopped"] = Outcome.CPU_LIMIT.sentence
                break
            curves += [column_slopes(system, record, each)[:, kept] for each in along.record]
            errors += along.errors.tolist()
            made["along"] = along
        made.update(names=names, values=values, kept=kept, measures=measures, curves=curves)
        made["errors"] = np.array(errors)
        made["time"] = system.times.copy()
        pairs = zip(named, found, strict=True)
        made["still"] = [each.name for each, one in pairs if not one.moves(system)]

    session.follow, session.planar = follow, PLANAR
    session.execute(study.plan)
    if session.outcome is not Outcome.DONE:
        raise RunFailed(explained(session))
    return _gathered(study, named, session, made), named, session, made.get("along")


def _gathered(
    study: Study, named: list[Named], session: Any, made: dict[str, Any]
) -> Sensitivities:
    kept, names, time = made["kept"], made["names"], made["time"]
    chosen = tuple(names[k] for k in kept)
    results = Results(
        time=time, names=chosen, values=np.ascontiguousarray(made["values"][:, kept]),
        meta={"deck": study.deck.title}, outcome=session.outcome, message="", summary={},
    )  # fmt: skip
    curves, measures = np.array(made["curves"]), made["measures"]
    at = {name: k for k, name in enumerate(chosen)}
    gradient = np.array([
        [slope(m, time, results[m.channel], curve[:, at[m.channel]]) for curve in curves]
        for m in measures
    ]).reshape(len(measures), len(named))  # fmt: skip
    off = zip((n.name for n in named), made["errors"], strict=True)
    notes = noted(made.get("along"), dict(off)) | dict.fromkeys(made["still"], UNUSED)
    notes |= session.notes
    return Sensitivities(
        tuple(n.name for n in named), np.array([n.value for n in named]), results, curves,
        tuple(map(str, measures)), np.array([m.of(time, results[m.channel]) for m in measures]),
        gradient, notes, made["errors"], made.get("stopped", ""),
    )  # fmt: skip
