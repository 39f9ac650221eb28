"""A dynamic run: native integration in a worker thread that can be watched and interrupted."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, fields, replace
from functools import partial
from time import thread_time
from typing import TYPE_CHECKING

import numpy as np

from adamslite.analyses.clock.clock import Clock
from adamslite.analyses.clock.motion_jumps import first_jump
from adamslite.analyses.clock.step_limits import timetable
from adamslite.analyses.dynamics.sensors import EQUAL, require_changing, require_none
from adamslite.analyses.dynamics.step_limits import StepLimits
from adamslite.analyses.initial.conditions import without_accelerations
from adamslite.analyses.setup.run_options import MOST_COUNTED, Budget
from adamslite.equations.engine import ints
from adamslite.integrators import contract
from adamslite.language.method import FIXED, FIXED_BY_HINIT, USUAL, method_of
from adamslite.native.translate import Rows
from adamslite.native.worker import Over, Worker, is_interrupted_here
from adamslite.progress import RunState
from adamslite.results.outcomes import Outcome

if TYPE_CHECKING:
    from adamslite.analyses.dynamics.history import Outlet
    from adamslite.equations.system import System
    from adamslite.language.method import Method
    from adamslite.progress import Progress

# Of a method with fixed steps where the deck gives none.
STEPS_PER_OUTPUT = 20.0
# Share of a time that its round-off may be.
ROUND_OFF = 1e-14
# Time between two looks at a run [s], and unknowns times tries of a step that usually take less.
WATCH_INTERVAL, UNWATCHED = 0.1, 50_000.0
FEW, MORE = 4, 8  # tries that say how long one takes, and how many times as many say it next
# Numbers that the records of a run have room for, where they go elsewhere block by block.
ROOM = 2**19
# Codes after which a method is called again.
UNFINISHED = (contract.PAUSED, contract.FULL, contract.HELD)
# Code of a run that was given up, see :func:`integrate`.
GIVEN_UP = -1
# Tries of a step after which a run is judged; each later judgement is at twice as many.
JUDGED, LATER = 1_000, 2
# A decay in so much less time than a step holds steps of an explicit formula down, which is stable
# up to 6 or so; where accuracy limits steps they are shorter than a decay.
HELD_DOWN = 2.0
# Numbers of results from which on it takes a while to keep them, and what is said then.
MANY = 1_000_000
ENDING = "interrupted: what there is will be written, which takes a while; Ctrl-C ends that, too"
# How a run may end before a motion that jumps, or gets ever faster.
CLOSE = (Outcome.DONE, Outcome.STEP_TOO_SMALL, Outcome.NEWTON_FAILED, Outcome.CREEPING)
# Error estimates from here on stand for not-a-number.
OVERFLOW = 1e300
# CORRECTOR options that ask for convergence of multipliers too.
EVERYTHING = ("ORIGINAL", "ORIG_CONSTANT")
OUTCOMES = {
    contract.DONE: Outcome.DONE,
    contract.STEP_TOO_SMALL: Outcome.STEP_TOO_SMALL,
    contract.NEWTON_FAILED: Outcome.NEWTON_FAILED,
    contract.SINGULAR_MASS: Outcome.SINGULAR_ACCELERATION,
    contract.NOT_FINITE: Outcome.NOT_FINITE,
    contract.INTERRUPTED: Outcome.INTERRUPTED,
    contract.UNSTABLE: Outcome.UNSTABLE,
    contract.CHATTERING: Outcome.CHATTERING,
    contract.STEP_LIMIT: Outcome.STEP_LIMIT,
    contract.CREEPING: Outcome.CREEPING,
}


@dataclass(frozen=True)
class Settings:
    """Integration settings after deck, commands and flags: see the INTEGRATOR statement."""

    method: str = USUAL
    formulation: str = "SI2"
    error: float = 1e-3
    hmax: float | None = None
    hmin: float | None = None
    hinit: float | None = None
    kmax: int = 5
    maxit: int = 10
    alpha: float = -0.3
    beta: float = 0.36
    gamma: float = 0.7
    interpolate: str | None = None
    adaptivity: float = 0.0
    corrector: str | None = None
    pattern: tuple[str, ...] = ()
    scale: tuple[float, ...] = ()

    @property
    def given(self) -> list[str]:
        """Arguments that differ from what holds without them."""
        usual = Settings()
        return [
            f.name.upper() for f in fields(self) if getattr(self, f.name) != getattr(usual, f.name)
        ]

    @property
    def formula(self) -> Method:
        """The method of integration; the usual one until AUTO has chosen."""
        return method_of(self.method)

    @property
    def form(self) -> str:
        """The formulation used: what is asked for where the method has a choice.

        Explicit methods solve for accelerations and take I3, because the multipliers of the other
        form would only be carried along.
        """
        known = self.formula.formulations
        return self.formulation if self.formulation in known else known[0]

    def fixed_step(self, output_step: float) -> float:
        """The step of a method that takes equal ones; zero for all others."""
        if self.formula.steps != FIXED:
            return 0.0
        return self.hinit or self.hmax or output_step / STEPS_PER_OUTPUT

    def tests_velocities(self, constrained: bool) -> bool:
        """Whether the error test sees velocities; that of index 3 only where nothing is held."""
        method = self.formula
        determined = method.explicit or self.form == "SI2" or not constrained
        return method.tests_velocities and determined

    def equal_steps(self, hmax: float) -> bool:
        """Whether the requested steps may not be shortened."""
        return self.formula.steps == FIXED or self.hinit == self.hmin == hmax

    def starting_with(self, step: float | None) -> Settings:
        """The same with a first step; HINIT of methods with equal steps is the size of all."""
        equal = self.formula.steps in (FIXED, FIXED_BY_HINIT) or self.hinit is not None
        return self if step is None or equal else replace(self, hinit=step)

    @property
    def interpolates(self) -> bool:
        """Whether steps pass output times."""
        return self.interpolate == "ON" if self.interpolate else self.formula.interpolates

    def least_step(self, end: float, hmax: float) -> float:
        """HMIN, or what round-off of the time leaves; the small steps of a start-up are exempt."""
        own = 0.0 if self.formula.steps == FIXED else self.hmin
        return own or max(ROUND_OFF * abs(end), self.formula.least_step * hmax)

    @property
    def damping(self) -> tuple[float, float, float]:
        """alpha, beta, gamma of a formula of Newmark's kind; zeros of others."""
        damping = self.formula.damping
        return damping(self) if damping else (0.0, 0.0, 0.0)


def make_ready(
    system: System,
    times: np.ndarray,
    apart: float,
    settings: Settings,
    audited: bool = False,
    in_blocks: bool = False,
    over: Over = None,
) -> None:
    """Whatever an integration over ``times`` (nt,) needs to begin.

    ``apart``: the largest step between requested outputs; ``audited``: with a balance of energy in
    ``system.audit``; ``in_blocks``: records go elsewhere when there is no more room for them;
    Overspent is raised when the CPU is ``over`` before.
    """
    start, end = float(times[0]), float(times[-1])
    fixed = settings.fixed_step(apart)
    # A longer step than the run is none, and its square may be no number.
    hmax = fixed or min(settings.hmax or apart, max(apart, end - start))
    run = system.settings
    run.t, run.t_end, run.error = start, end, settings.error
    run.h_max, run.h_min = hmax, settings.least_step(end, hmax)
    run.h_init, run.fixed_step = settings.hinit or 0.0, fixed
    run.k_max, run.max_it = settings.kmax, settings.maxit
    run.alpha, run.beta, run.gamma = settings.damping
    run.interpolate, run.adaptivity = settings.interpolates, settings.adaptivity
    run.all_converge = settings.corrector in EVERYTHING
    run.stop, run.begun, system.report.torn = False, False, 0
    system.pattern = ints([word == "T" for word in settings.pattern])
    times = _scheduled(system, times, settings, hmax, over)
    run.t_end = float(system.stops[-1])
    settings.formula.prepare(system, settings)
    require_changing(system)
    system.audit.on = False
    if audited:
        # Few runs are audited.
        from adamslite.analyses.dynamics.audit import start_audit

        start_audit(system)
    row = max(1, system.nw + system.sizes.n_out)
    in_blocks &= settings.formula.in_blocks
    system.start_record(times, max(2, ROOM // row) if in_blocks else None)
    system.records()


def integrate(
    system: System,
    settings: Settings,
    progress: Progress | None,
    judged: bool = False,
    budget: Budget | None = None,
    outlet: Outlet | None = None,
) -> Outcome:
    """Run what was made ready; how it ended.

    ``judged``: a method that pauses ends with STEP_TOO_SMALL when a decay holds its steps down;
    ``outlet``: takes the records for which there is no more room, and keeps the run.
    """
    budget = budget or Budget()
    budget.lend(system)
    run = system.settings
    start, end, hmax = float(run.t), float(run.t_end), float(run.h_max)
    code = _watched(system, settings.formula, progress, start, end, judged, budget, outlet)
    if outlet:
        outlet.end(code, final=not judged)
    budget.settle(system)
    system.release_guards()
    if code == GIVEN_UP:
        return Outcome.STEP_TOO_SMALL
    if system.search.loose:
        require_none(system, EQUAL)
    outcome = _named(system, code)
    if outcome is Outcome.INTERRUPTED and budget.out_of_time:
        return Outcome.CPU_LIMIT
    if system.broken and outcome in CLOSE:
        near = system.report.t >= system.broken.time - hmax
        return Outcome.BROKEN_MOTION if near else outcome
    return outcome


def _scheduled(
    system: System, times: np.ndarray, settings: Settings, hmax: float, over: Over
) -> np.ndarray:
    """Put stops and paces in place; the output times up to where a motion jumps."""
    clock, fine = Clock(system.kernels), not settings.tests_velocities(system.holonomic > 0)
    table = timetable(system, clock, times, hmax, fine, over)
    equal = settings.equal_steps(hmax)
    system.paces = Rows(contract.Pace, np.array(contract.NO_PACE) if equal else table.paces)
    system.hurried += table.overfull + (table.paced if equal else [])
    system.stops = table.stops
    system.broken = first_jump(clock, table.stops, float(times[0]), settings.error)
    if system.broken is None:
        return times
    system.stops = table.stops[table.stops <= system.broken.time]
    return times[times <= system.broken.time]


def _named(system: System, code: int) -> Outcome:
    """The outcome of a return code.

    Not-a-number is neither a corrector that does not converge, nor an error that is too large.
    """
    report, cancels = system.report, bool(system.sizes.implicit_mass)
    if code == contract.BROKEN_START or (code == contract.SINGULAR_MASS and not cancels):
        return without_accelerations(system)
    if code == contract.INTERRUPTED and report.torn:
        return Outcome.TORN
    if code == contract.INTERRUPTED and system.triggered:
        return Outcome.DONE
    if code == contract.NEWTON_FAILED and np.isnan(report.open_by):
        return Outcome.NOT_FINITE
    if code == contract.STEP_TOO_SMALL and not report.error < OVERFLOW:
        return Outcome.NOT_FINITE
    return OUTCOMES[code]


def _first_tries(system: System, method: Method, judged: bool) -> int:
    """So many tries of a step as take no longer than a run goes unwatched, without a thread; PAUSED
    where there are more. Routines of the user take any time, audits that of thousands of tries.
    """
    run, costly = system.settings, system.model.deck.user.used or system.audit.on
    most = min(int(UNWATCHED / max(system.nz, 1)), JUDGED if judged else MOST_COUNTED)
    run.pause, began = min(most, FEW), thread_time()
    if not method.pauses or most == 0 or costly:
        return contract.PAUSED
    try:
        while (code := system.integrate(method.entry)) == contract.PAUSED and run.pause < most:
            if (thread_time() - began) * MORE > WATCH_INTERVAL:
                break
            run.pause = min(most, run.pause * MORE)
        return code
    except KeyboardInterrupt:
        run.stop = True
    return contract.PAUSED


def _resumed(system: System, method: Method, judged: bool, outlet: Outlet | None) -> int:
    """Run until there is an outcome."""
    run = system.settings
    run.pause = max(run.pause, JUDGED) if judged and method.pauses else 0
    while (code := system.integrate(method.entry)) in UNFINISHED:
        if code == contract.PAUSED:
            if is_held_down(system):
                return GIVEN_UP
            run.pause *= LATER
        elif outlet:
            outlet.take(code)
    return code


def is_held_down(system: System) -> bool:
    """Whether forces decay within less than the last step, and faster than anything vibrates: what
    an explicit formula follows in vain and an implicit one steps over.
    """
    from adamslite.analyses.dynamics.checkpoint import undisturbed  # few runs are judged

    step = float(system.report.h)
    with undisturbed(system):
        system.settings.t = float(system.report.t)
        found = system.run(contract.SPECTRUM) == contract.DONE
        decay, squared = float(system.report.damping), float(system.report.stiffness)
    return found and decay * step > HELD_DOWN and decay * decay > squared


def _watched(
    system: System,
    method: Method,
    progress: Progress | None,
    start: float,
    end: float,
    judged: bool,
    budget: Budget,
    outlet: Outlet | None,
) -> int:
    """Run; what is not over soon in a thread of its own, with a look at it from time to time."""
    code = outlet.begin() if outlet else None
    unseen = progress is None and budget.cpu is None and not is_interrupted_here()
    system.settings.pause = 0
    if code is None:
        code = contract.PAUSED if unseen else _first_tries(system, method, judged)
    if code in UNFINISHED and unseen:
        return _resumed(system, method, judged, outlet)
    if code not in UNFINISHED and not (progress and progress.is_due()):
        return code
    look = partial(_state, system, StepLimits(system), start, end)
    if code in UNFINISHED:
        running = Worker(partial(_resumed, system, method, judged, outlet))
        _watch(running, system, progress, look, budget, outlet)
        code = running.result()
        if code == contract.DONE and _was_interrupted(system, budget, outlet):
            return contract.INTERRUPTED  # just before its end; more may follow
    try:
        if progress and not system.settings.stop and progress.is_due():
            progress.watch(look())  # it may be one of many short runs
    except KeyboardInterrupt:
        return contract.INTERRUPTED
    return code


def _was_interrupted(system: System, budget: Budget, outlet: Outlet | None) -> bool:
    """Whether the user has interrupted a run, whatever it has come to since."""
    asked = bool(system.settings.stop) and not budget.out_of_time
    return asked or (outlet is not None and bool(outlet.interrupted))


def _watch(
    running: Worker,
    system: System,
    progress: Progress | None,
    look: Callable[[], RunState],
    budget: Budget,
    outlet: Outlet | None,
) -> None:
    """Until the worker is done."""
    while running.works:
        try:
            running.wait(WATCH_INTERVAL)
            if outlet:
                outlet.look()
                if (note := outlet.journal.note()) and progress:
                    progress.say(note)
            if budget.out_of_time:
                outlet.expire() if outlet else _stop(system)
            elif progress and running.works:
                progress.watch(look())
        except KeyboardInterrupt:
            rows = int(system.count.records) + (outlet.history.count if outlet else 0)
            if progress and rows * system.nw > MANY:
                progress.say(ENDING)
            outlet.interrupt() if outlet else _stop(system)


def _stop(system: System) -> None:
    system.settings.stop = True


def _state(system: System, limits: StepLimits, start: float, end: float) -> RunState:
    """What another thread sees of a running integration, without stopping it."""
    report = system.report
    limits.look()
    return RunState(
        time=float(report.t), start=start, end=end, step=float(report.h), order=int(report.order),
        steps=int(system.count.steps), longest=float(system.settings.h_max), limit=limits.reason,
    )  # fmt: skip
