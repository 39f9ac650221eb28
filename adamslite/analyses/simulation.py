"""`simulate` and `linearize`: from a deck, a model or kernels to results."""

from __future__ import annotations

import time as clock
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import replace
from functools import partial
from itertools import takewhile
from math import inf, tau
from numbers import Real
from typing import TYPE_CHECKING, Any

import numpy as np

from adamslite.analyses.session.row_notes import seen_in_rows, with_accuracy
from adamslite.analyses.session.session import Session
from adamslite.analyses.setup.output_times import SETTINGS, dynamics, need_room, plan_of
from adamslite.analyses.setup.run_options import Budget, budget_of, checked, within_memory
from adamslite.analyses.setup.subject import deck_of, prepared_for
from adamslite.deck.element_switch import Switch
from adamslite.deck.redefinition import Redefinition
from adamslite.elements.simulate import Simulate
from adamslite.equations.result_columns import column_names
from adamslite.equations.unknown_names import placed, tested
from adamslite.errors import RunFailed, UsageError
from adamslite.integrators.linalg.plan import TINY
from adamslite.language.interfaces import key_of
from adamslite.language.method import without_effect
from adamslite.model.reduction import MERGED, kept_apart, left_off
from adamslite.outputs.saved_files import SavedFiles
from adamslite.results.adams_options import adams_options
from adamslite.results.outcomes import Outcome
from adamslite.results.results import Results
from adamslite.results.source import source_of

# Few runs need them, and they take a while to load.
if TYPE_CHECKING:
    from pathlib import Path

    from adamslite.analyses.dynamics.history import Journal
    from adamslite.analyses.setup.subject import Subject
    from adamslite.deck.deck import Deck
    from adamslite.deck.redefinition import Command
    from adamslite.language.interfaces import Key
    from adamslite.progress import Progress
    from adamslite.results.balance import Balance
    from adamslite.results.linearization import Linearization
    from adamslite.results.source import RunSource

CAPPED = (
    "held at 2: higher orders feed a vibration of {where}, about {rate:.2g} cycles per unit of "
    "time, for lack of damping; it is not followed. HHT suits such a scene"
)
FASTER = (
    "an expression of TIME changes faster or more often than the steps of this run can follow, and "
    "what it does may be missed; a shorter HMAX shows it"
)
#: How often all rows are in memory to be compared with those of witnesses, to be drawn.
CONFIRMED, DRAWN = 5, 2
COUNTED = (
    "steps", "rejected", "newton", "jacobians", "factorizations", "events", "restarts",
)  # fmt: skip


def simulate(
    scene: Subject,
    end: float | None = None,
    steps: int | None = None,
    integrator: str | None = None,
    formulation: str | None = None,
    error: float | None = None,
    hmax: float | None = None,
    commands: Iterable[Command] = (),
    progress: Progress | None = None,
    no_reduction: Iterable[str] = (),
    audit: bool = False,
    confirm: bool = False,
    files: SavedFiles | None = None,
    outputs: Iterable[str] = (),
    notes: bool = True,
    cpu_limit: float | None = None,
    max_steps: int | None = None,
    memory_limit: int | str | None = None,
    output: Path | None = None,
    journal: Journal | None = None,
) -> Results:
    """Run a deck, a model or its kernels; ``commands`` are statements.

    Without ``notes`` the results say nothing of the run in words, which takes a while; ``output``
    is the file that they will be written to, for which there has to be room; ``journal`` keeps a
    run that takes long. The other arguments are those of :func:`adamslite.simulate`.

    Raises
    ------
    UsageError
        When nothing says how long to run, there is no such rule, an option is none, or a pattern of
        ``outputs`` means no column.
    """
    began, source = clock.process_time(), source_of(deck_of(scene), commands)
    commands = tuple(commands)
    options = checked(
        {"end": end, "steps": steps, "integrator": integrator, "formulation": formulation,
         "error": error, "hmax": hmax, "cpu_limit": cpu_limit, "max_steps": max_steps,
         "memory_limit": memory_limit}
    )  # fmt: skip
    memory = options.pop("memory_limit", None)
    budget = Budget(options.pop("cpu_limit", None), options.pop("max_steps", None), began)
    end, steps = options.pop("end", None), options.pop("steps", None)
    flags = {{"integrator": "method"}.get(name, name): each for name, each in options.items()}
    plan = plan_of(deck_of(scene), commands, end, steps)
    files = files or SavedFiles()
    without = left_off(no_reduction) | kept_apart(plan, audit)
    wanted = (outputs,) if isinstance(outputs, str) else tuple(outputs)
    with within_memory(memory):
        subject = prepared_for(scene, commands)
        session = Session(subject, progress, flags, without, audit, files, budget, journal)
        session.memory = memory
        second = partial(
            _attempted, session.kernels, end, steps, commands=commands, no_reduction=no_reduction,
            notes=False,
        )  # fmt: skip
        kept = _columns_kept(session, wanted)
        _begin_files(session, journal, source)

        def need_its_room() -> None:
            asked = adams_options(session.deck, commands).results
            files = 2 if asked and output and output.suffix.lower() != ".res" else 1
            tables = _tables_in_memory(journal, confirm)
            need_room(session.system, plan, kept, output, journal is not None, tables, files)

        cpu = _carried_out(session, plan, began, need_its_room)
        session.again = partial(second, files=files.to_read)
        results = _results_in_memory(session, cpu, notes, source)
    if confirm and results.outcome is not Outcome.INTERRUPTED:
        again = partial(
            simulate, scene, end, steps, commands=commands, progress=progress,
            no_reduction=no_reduction, files=files.to_read, max_steps=max_steps,
            cpu_limit=budget.cpu_left, journal=journal,
        )  # fmt: skip
        results = _confirmed(results, session, again)
    return _limited(results, wanted) if wanted else results


# Most runs need none of what the following functions import.


def _attempted(*arguments: Any, **options: Any) -> Results | None:
    """The results of `simulate`; None where there are none, as without memory."""
    try:
        return simulate(*arguments, **options)
    except (UsageError, RunFailed):
        return None


def _tables_in_memory(journal: Journal | None, confirm: bool) -> int:
    """How often all rows are in memory when a run has ended whose rows are kept in a file."""
    if journal is None:
        return 0
    return CONFIRMED if confirm else DRAWN if journal.drawn else 0


def _begin_files(session: Session, journal: Journal | None, source: RunSource) -> None:
    """Have files of the results written while the session lasts, where they can be."""
    if not journal:
        return
    session.history.growing = tuple(journal.growing.values())
    journal.growing = {}  # witnesses have other results

    def begun(names: tuple[str, ...]) -> Results:
        none = np.zeros((0, len(names)))
        meta = _known(session)
        return Results(time=np.zeros(0), names=names, values=none, meta=meta, source=source)

    for file in session.history.growing:
        file.begun = begun


def _columns_kept(session: Session, wanted: tuple[str, ...]) -> int:
    """How many columns are written; raises UsageError for a pattern that means none."""
    if not wanted:
        return len(column_names(session.kernels))
    from adamslite.results.selection import selected

    return len(selected(column_names(session.kernels), wanted))


def _results_in_memory(
    session: Session, cpu: tuple[float, float], notes: bool, source: RunSource
) -> Results:
    """The results, without a word where there is no memory for notes."""
    try:
        return _results(session, cpu, notes, source)
    except MemoryError:
        session.end_for_memory()
    return _results(session, cpu, False, source)


def _limited(results: Results, wanted: tuple[str, ...]) -> Results:
    from adamslite.results.selection import limited

    return limited(results, wanted)


def explained(session: Session) -> str:
    """Why a run has ended early."""
    from adamslite.analyses.findings.failure_report import explain

    return explain(session.system, session.outcome, session.unclosed)


def _carried_out(
    session: Session, plan: list[Command], began: float, need_room: Callable[[], None]
) -> tuple[float, float]:
    """Carry out the plan; CPU [s] of what comes before the first step, and of the rest."""
    first = next((k for k, c in enumerate(plan) if not _sets_up(c)), len(plan))
    session.execute(plan[:first])
    session.prepare()
    need_room()
    ready = clock.process_time()
    session.execute(plan[first:])
    late, now = session.late_setup, clock.process_time()
    ready = ready if session.first_step is None else session.first_step
    return ready - began + late, now - ready - late


def _sets_up(command: Command) -> bool:
    """Whether a command before the first analysis changes what that starts from."""
    return isinstance(command, Redefinition | Switch) or command.keyword in SETTINGS


def _confirmed(results: Results, session: Session, again: Callable[..., Results]) -> Results:
    """The results with what their witnesses say."""
    from adamslite.analyses.findings.confirmation import confirmation

    found = confirmation(results, session.chosen.settings, again)
    summary = {**results.summary, "confirmed": found.confirmed, "verdict": found.verdict}
    return replace(results, confirmation=found, summary=summary)


def linearize(
    scene: Subject,
    commands: Iterable[Command] = (),
    time: float | None = None,
    rm: Key | None = None,
    **limits: Any,
) -> Linearization:
    """The model about one state: at the end of the commands, or integrated to ``time``.

    Without commands it is the equilibrium that the deck's own SIMULATE statements begin with, else
    the assembled start.  A LINEAR command decides state and observer; otherwise, and with ``rm``, a
    MARKER on whose body the observer stands, it is the last state.  ``limits`` are those of
    :func:`simulate`.

    Raises
    ------
    UsageError
        When there is no such MARKER.
    RunFailed
        When the state could not be reached.
    """
    from adamslite.analyses.linearization.linearization import linear

    _need_time(time)
    deck = deck_of(scene)
    marker = None if rm is None else _marker(deck, str(rm))
    settings = (s for s in deck.statements if s.keyword in ("INTEGRATOR", "EQUILIBRIUM"))
    commands = tuple(commands)
    own = _at_first(deck) if time is None and not commands else ()
    plan: list[Command] = [*settings, *own, *commands, *([dynamics(time)] if time else [])]
    budget, memory = budget_of(checked(limits))
    with within_memory(memory):
        session = Session(prepared_for(scene, plan), None, {}, frozenset({MERGED}), budget=budget)
        session.execute(plan)
        if not session.outcome.is_requested:
            raise RunFailed(explained(session))
        made = session.linearizations
        if made and rm is None:
            return made[-1].model
        found = session.linearized(partial(linear, session.system, relative_to=marker))
        if found is None:
            raise RunFailed(explained(session))
        return found


def _at_first(deck: Deck) -> Iterator[Command]:
    """What the deck's own SIMULATE statements do before anything moves."""
    return takewhile(lambda each: each.at_once, deck.of(Simulate))


def _need_time(time: object) -> None:
    if time is not None and not (isinstance(time, Real) and 0.0 <= float(time) < inf):
        raise UsageError(f"--time {time}: it must be a time, zero or above")


def _marker(deck: Deck, word: str) -> Key:
    """The id of a MARKER that a flag names."""
    from adamslite.language.likeness import did_you_mean

    found = deck.find("MARKER", key_of(word))
    if found is None:
        hint = did_you_mean(word, deck.names.known("MARKER"))
        raise UsageError(f"--rm {word}: there is no MARKER/{word}" + (f"; {hint}" if hint else ""))
    return found.key


def _results(session: Session, cpu: tuple[float, float], notes: bool, source: RunSource) -> Results:
    system, counts = session.system, session.counts.values()
    summary: dict[str, Any] = {
        "outcome": session.outcome.name, "t_end": session.time, "dof": system.dof,
        **{name: counts[name] for name in COUNTED}, "setup_cpu_s": cpu[0], "solve_cpu_s": cpu[1],
        "max_violation": float(system.report.violation),
    }  # fmt: skip
    if session.balances:
        worst = _worst(session.balances)
        summary |= {"energy_gap": worst.gap, "energy_gap_explained": worst.explained}
    done = session.outcome.is_requested
    meta = _meta(session) if notes else {}
    facts: dict[str, Any] = {
        "meta": meta, "outcome": session.outcome, "message": "" if done else explained(session),
        "summary": summary, "linearizations": tuple(session.linearizations),
        "balances": tuple(session.balances), "source": source,
    }  # fmt: skip
    if session.history.part:
        from adamslite.results.filed import FiledResults

        return FiledResults(session.history, **facts)
    table = session.history.whole
    return Results(time=table.times, names=table.names, values=table.values, **facts)


def _known(session: Session) -> Mapping[str, str]:
    """What is known before the first row."""
    deck, settings = session.deck, session.chosen.settings
    units = deck.single("UNITS").names
    return {
        "deck": deck.title,
        "deck hash": deck.hash,
        "units": " ".join(units) if units else "as in the deck",
        "integrator": f"{settings.method} {settings.form} ERROR={settings.error:g}",
        **({"user": f"not as the deck has it: {deck.user.summary()}"} if deck.user.used else {}),
        **({"integrator chosen": session.chosen.reason} if session.chosen.reason else {}),
    }


def _meta(session: Session) -> Mapping[str, str]:
    hurried = ", ".join(dict.fromkeys(map(placed, session.system.hurried)))
    known = {
        **_known(session),
        **_notes(session),
        **session.apart.meta,
        **session.sensors.meta,
        **session.kinematic,
        **({"info": "; ".join(session.printed)} if session.printed else {}),
        **_past(session),
        **({"time": f"{hurried}: {FASTER}"} if hurried else {}),
        **seen_in_rows(session),
    }
    return with_accuracy(known, session)


def _past(session: Session) -> dict[str, str]:
    note = session.delays.note(session.kernels)
    return {"delay": f"the past of {note}"} if note else {}


def _worst(balances: list[Balance]) -> Balance:
    """Of several analyses."""
    return max(balances, key=lambda b: (not b.closes, b.gap / max(b.explained, TINY)))


def _notes(session: Session) -> dict[str, str]:
    """What the program did to the model on its own: moves of the assembly, rows left out."""
    found = {}
    if session.assembled:
        found["assembled"] = "moved " + "; ".join(session.assembled)
    if session.speeds:
        changed = "; ".join(session.speeds)
        found["start speeds"] = f"contradicted constraints, the nearest that do not: {changed}"
    if session.ways_to_fall:
        ways = "one way" if session.ways_to_fall == 1 else f"{session.ways_to_fall} ways"
        found["equilibrium"] = f"unstable in {ways}: the least disturbance makes it leave"
    if session.system.report.order_capped:
        where = tested(session.system, int(session.system.report.vibrating))
        found["order"] = CAPPED.format(where=where, rate=session.system.report.vibration / tau)
    if session.balances:
        found["energy"] = str(_worst(session.balances))
    notes = {each.model.note: each.time for each in reversed(session.linearizations)}
    if varying := [f"t = {t:g}: {note}" for note, t in reversed(notes.items()) if note]:
        found["linear"] = "; ".join(varying)
    idle = list(without_effect(session.chosen.settings.method, session.settings.given))
    if idle:
        text = "; ".join(f"{word}, because {reason}" for word, reason in idle)
        found["integrator arguments"] = f"without effect: {text}"
    if session.system.elimination.dropped:
        from adamslite.analyses.initial.redundancy import row_name

        rows = [row_name(session.system, row) for row in session.system.elimination.dropped]
        found["redundant"] = f"left out, their reactions are zero: {'; '.join(rows)}"
    return found
