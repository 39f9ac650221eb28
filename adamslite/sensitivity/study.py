"""`sensitivities`: derivatives of a run by numbers of its deck."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import replace
from functools import cache, cached_property
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
from adamslite.sensitivity.recipes import Known
from adamslite.sensitivity.record import Sensitivities
from adamslite.sensitivity.taped import Along, Probe, Ready, Taped, followed, recorded
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
NO_RUN = "derivatives are those of a dynamic analysis, and there is none"
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

    progress: Progress | None = None

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

    def session(self, kind: type[Session], kernels: Kernels, **flags: Any) -> Any:
        return kind(kernels, self.progress, self.flags | flags, self.without, budget=self.budget)

    def run(
        self,
        follow: Callable[[System, str, bool], None],
        kernels: Kernels | None = None,
        planar: bool = False,
        **flags: Any,
    ) -> Taped:
        """A run with its tape, which ``follow(system, method, whether it starts as it is drawn)``
        goes along.

        Raises
        ------
        RunFailed
            When it does not reach its end.
        """
        session: Taped = self.session(Taped, kernels or self.kernels, **flags)

        def along(system: System, method: str) -> None:
            if system.triggered:
                raise UsageError(SENSED)
            follow(system, method, not (session.assembled or session.speeds))

        session.follow, session.planar = along, planar
        session.execute(self.plan)
        if session.outcome is not Outcome.DONE:
            raise RunFailed(explained(session))
        if not session.followed:
            raise UsageError(NO_RUN)
        return session

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
        raise UsageError(NO_RUN)

    def directions(self, named: list[Named]) -> Callable[[System, bool, int], Direction]:
        """What gives derivatives of the arrays by a number, of the system, whether it starts as it
        is drawn, and the place of the number among these.

        What is zero, as the distance of a marker from its mass centre, is left out of equations. A
        number that moves it away from there is put a hair beside its value first.  Behind an
        equilibrium, which any number moves, the way of none is known.

        Raises
        ------
        UsageError
            When a number decides more than values.
        """
        known, names = Known(self.kernels), [each.name for each in named]
        known.verify(named)
        settled = sum(each.keyword == "SIMULATE" for each in self.plan) > 1
        quick = {each.name for each in named if not settled and known.is_known(each)}
        if len(quick) < len(names):
            self.put_beside([each for each in named if each.name not in quick])
            known, named = Known(self.kernels), self.named(names)
            known.verify(named)

        @cache
        def by_setting_up(k: int) -> Direction:
            return self.direction(*base(), named[k])

        @cache
        def base() -> tuple[System, Snapshot]:
            return self.snapshot(self.kernels)

        for k, name in enumerate(names):
            if name not in quick:
                by_setting_up(k)

        def found(system: System, as_drawn: bool, k: int) -> Direction:
            each = named[k]
            if each.name in quick and known.is_direct(each):
                return known.load(system, each, self.step(each))
            if each.name in quick and known.is_of_body(each, as_drawn):
                return known.body(system, each, self.step(each))
            return by_setting_up(k)

        return found

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
        return direction(system, base, around, self.step(number))

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
        scale = self.scales[number.name.partition("[")[0]] or 1.0
        size = abs(number.value)
        return SHARE * (size if size > NUDGE * scale else scale)

    def compared(
        self,
        found: Sensitivities,
        named: list[Named],
        session: Taped,
        made: Mapping[str, Any],
    ) -> Sensitivities:
        """Derivatives of a run with events, beside differences of runs."""
        along, several = made.get("along"), made["several"]
        if not (several or made["events"]) or found.stopped:
            return found
        error = min(session.chosen.settings.error, TIGHT)
        method = session.chosen.settings.method

        def run(values: Mapping[str, float]) -> Columns:
            ended: list[Columns] = []

            def follow(system: System, *_: Any) -> None:
                ended.append((system.times.copy(), *columns(system, recorded(system))))

            kernels = of_deck(self.kernels, self.deck.with_values(dict(values)))
            self.run(follow, kernels, method=method, error=error)
            return ended[0]

        notes = [COUPLED] if several and along and along.coupled else []
        try:
            sizes = {each.name: self.step(each) / SHARE for each in named}
            found, count = compared(found, run, sizes, error)
            notes += [SEVERAL.format(count=count)] if several else []
        except (DeckError, RunFailed, UsageError) as fault:
            notes.append(FAILED.format(fault=fault))
        notes = [each for each in (found.notes.get("events"), *notes) if each]
        told = {"events": "; ".join(notes)} if notes else {}
        return replace(found, notes={**found.notes, **told})

    def gathered(
        self, named: list[Named], session: Taped, made: Mapping[str, Any]
    ) -> Sensitivities:
        """The derivatives of a run by numbers."""
        time, measures = made["time"], made["measures"]
        results = Results(
            time=time, names=made["names"], values=np.ascontiguousarray(made["values"]),
            meta={"deck": self.deck.title}, outcome=session.outcome, message="", summary={},
        )  # fmt: skip
        return Sensitivities(
            tuple(n.name for n in named), np.array([n.value for n in named]), results,
            made["curves"], tuple(map(str, measures)),
            np.array([m.of(time, results[m.channel]) for m in measures]), made["gradient"],
            made["notes"] | session.notes, made["errors"], made.get("stopped", ""),
        )  # fmt: skip

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
    study.progress = progress
    with within_memory(study.memory):
        found, named, session, made = _worked_out(study, by, of)
        return study.compared(found, named, session, made) if compare else found


def noted(along: Along | None, errors: Mapping[str, float]) -> dict[str, str]:
    """Words about estimated errors by name, and about events."""
    notes = {name: COARSE.format(error=error) for name, error in errors.items() if error > DOUBTFUL}
    return notes | ({"events": GRAZED} if along and along.grazed else {})


def _worked_out(
    study: Study, by: Iterable[str], of: Iterable[str]
) -> tuple[Sensitivities, list[Named], Taped, Mapping[str, Any]]:
    named = study.named(by)
    if not named:
        raise UsageError("derivatives by what? --by NAME; `adamslite names DECK` lists numbers")
    directions = study.directions(named)
    made: dict[str, Any] = {}

    def follow(system: System, method: str, as_drawn: bool) -> None:
        time, record = system.times.copy(), recorded(system)
        names, values = columns(system, record)
        measures, kept = asked(of, names) if of else ([], [*range(len(names))])
        lot = max(1, MOST_HELD // max(record.size, 1))
        lot = lot if study.budget.cpu is None else min(lot, LIMITED)
        found = [directions(system, as_drawn, k) for k in range(len(named))]
        curves = np.full((len(found), len(record), len(kept)), np.nan)
        errors = np.full(len(found), np.nan)
        for at in range(0, len(found), lot):
            some = slice(at, at + lot)
            try:
                along = made["along"] = followed(system, method, found[some], study.budget)
            except Overspent:
                made["stopped"] = Outcome.CPU_LIMIT.sentence
                break
            curves[some] = [column_slopes(system, record, each)[:, kept] for each in along.record]
            errors[some] = along.errors
        at_column = {names[k]: (values[:, k], curves[:, :, n]) for n, k in enumerate(kept)}
        gradient = np.full((len(measures), len(found)), np.nan)
        for m, measure in enumerate(measures):
            own, slopes = at_column[measure.channel]
            gradient[m] = [slope(measure, time, own, each) for each in slopes]
        pairs = zip(named, found, strict=True)
        still = [each.name for each, one in pairs if not one.moves(system)]
        off = dict(zip((each.name for each in named), errors, strict=True))
        made.update(
            time=time, names=tuple(names[k] for k in kept), values=values[:, kept], curves=curves,
            measures=measures, gradient=gradient, errors=errors,
            several=made["along"].several if "along" in made else 0,
            events=system.count.events,
            notes=noted(made.get("along"), off) | dict.fromkeys(still, UNUSED),
        )  # fmt: skip

    session = study.run(follow, planar=PLANAR)
    return study.gathered(named, session, made), named, session, made
