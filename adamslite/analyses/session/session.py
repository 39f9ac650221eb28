"""A session: a model, its present state, and the commands executed on it in turn.

::

    INTEGRATOR EQUILIBRIUM              settings from here on
    SIMULATE                            statics, dynamics, kinematics, initial conditions, from
                                        where it stands
    ACTIVATE DEACTIVATE redefinitions   another deck; bodies, multipliers and states keep their
                                        values
    LINEAR                              the model about the present state
    STOP                                the end
"""

from __future__ import annotations

import time as clock
from collections.abc import Callable, Iterable
from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING, TypeVar

import numpy as np

from adamslite.analyses.clock.motion_jumps import followed_jumps
from adamslite.analyses.dynamics.delays import NO_PAST, require_no_delay
from adamslite.analyses.dynamics.dynamic import integrate, make_ready
from adamslite.analyses.dynamics.method_choice import choose_method
from adamslite.analyses.dynamics.planar_reduction import in_its_plane
from adamslite.analyses.dynamics.sensors import AT_TIMES, require_none
from adamslite.analyses.initial.conditions import consistent_velocities, without_accelerations
from adamslite.analyses.initial.redundancy import badly_chosen, leave_out_redundant
from adamslite.analyses.session.session_state import SessionState
from adamslite.analyses.session.setting_commands import changes_the_model, updated
from adamslite.analyses.setup.output_times import largest_step, output_times
from adamslite.analyses.statics.static import StaticSettings, at_rest
from adamslite.analyses.statics.static import make_ready as make_ready_to_rest
from adamslite.deck.redefinition import Redefinition
from adamslite.equations.engine import engine
from adamslite.integrators import contract
from adamslite.integrators.contract import ACCELERATIONS, RECORD, RECORD_AT_REST
from adamslite.native.worker import Overspent, interruptible
from adamslite.progress import AnalysisProgress
from adamslite.results.outcomes import Outcome

if TYPE_CHECKING:
    from adamslite.analyses.dynamics.begun_again import Beginning
    from adamslite.analyses.dynamics.method_choice import MethodChoice
    from adamslite.deck.redefinition import Command
    from adamslite.elements.equilibrium import Equilibrium
    from adamslite.elements.info import Info
    from adamslite.elements.integrator import Integrator
    from adamslite.elements.linear import Linear
    from adamslite.elements.reload import Reload
    from adamslite.elements.save import Save
    from adamslite.elements.simulate import Simulate
    from adamslite.equations.system import System
    from adamslite.kernels.groups import Kernels

Found = TypeVar("Found")
DETERMINED = (
    "solved as a kinematic analysis: the model has no degree of freedom, and the speed of a MOTION "
    "jumps, which no integrator passes"
)
# Outcomes after which the rank of the constraints is computed again.
STALLED = (Outcome.NEWTON_FAILED, Outcome.STEP_TOO_SMALL)
# Outcomes after which nothing else is tried.
OVERSPENT = (
    Outcome.INTERRUPTED, Outcome.CPU_LIMIT, Outcome.STEP_LIMIT, Outcome.CREEPING,
    Outcome.MEMORY_LIMIT,
)  # fmt: skip


class Session(SessionState):
    """Commands and what each does to the model and its state."""

    def execute(self, commands: Iterable[Command]) -> None:
        """Carry out commands until one stops the run or an analysis ends early."""
        for command in commands:
            if command.keyword == "STOP" or self.outcome is not Outcome.DONE:
                return
            before = self.kernels, self.present
            try:
                self._carry_out(command)
            except (KeyboardInterrupt, MemoryError) as fault:
                self._end_by(fault, *before)
            if self.deck.user.failed:
                self.outcome = Outcome.ROUTINE_FAILED

    def _end_by(self, fault: BaseException, kernels: Kernels, present: System | None) -> None:
        """Keep what earlier commands have written, and nothing of what is half done, as a model
        that is being changed.  What a resumed run begins with is kept already.
        """
        if not self.history.stretches or (self.journal and self.journal.catching_up):
            raise fault
        self.kernels, self.present = kernels, present
        self.outcome = Outcome.INTERRUPTED
        if isinstance(fault, MemoryError):
            self.end_for_memory()

    def _carry_out(self, command: Command) -> None:
        self._keep_senvals()
        action = getattr(self, f"_do_{command.keyword.lower()}", None)
        if action is not None:
            action(command)
        elif changes_the_model(command, self.deck):
            self.change(self.deck.after(command))
            if isinstance(command, Redefinition):
                self.changes += (command,)

    # settings

    def _do_integrator(self, command: Integrator) -> None:
        self.settings = replace(updated(self.settings, command), **self.flags)

    def _do_equilibrium(self, command: Equilibrium) -> None:
        self.statics = updated(StaticSettings() if command.default else self.statics, command)

    # kept states

    def _do_save(self, command: Save) -> None:
        require_no_delay(self.kernels, "SAVE", "its file does not hold the past")
        self.saves.save(self, command)

    def _do_reload(self, command: Reload) -> None:
        require_no_delay(self.kernels, "RELOAD", "its file does not hold the past")
        self.saves.reload(self, command)

    # analyses

    def _do_simulate(self, command: Simulate) -> None:
        self.system.elimination.unfold()
        self.system.settings.t = self.time
        self.outcome = self.budget.spent() or self.outcome
        if self.outcome is not Outcome.DONE:
            return
        times = output_times(command, self.time)
        kind = command.kind
        if kind == "TRANSIENT":
            kind = "KINEMATICS" if self.system.dof == 0 else "DYNAMICS"
        if kind == "KINEMATICS" and self.system.dof == 0 and self.has_rates():
            kind = "DYNAMICS"
        if self.outcome is not Outcome.DONE:
            return
        if kind in ("STATICS", "KINEMATICS") and len(times) > 1:
            require_none(self.system, AT_TIMES.format(kind=kind))
        self.analyses.append((kind, self.time, self.history.count))
        {
            "DYNAMICS": self._dynamics,
            "STATICS": self._statics,
            "KINEMATICS": self._kinematics,
            "INITIAL_CONDITIONS": self._initial,
        }[kind](times)

    def _dynamics(self, times: np.ndarray) -> None:
        system = self.system
        if self.outcome is not Outcome.DONE:
            return
        if self.is_determined(times):
            self._determined(times)
            return
        if self.began_static:
            self.unclosed = consistent_velocities(system)
            if self.unclosed:
                self.outcome = Outcome.INITIAL_CONDITIONS_FAILED
                return
        self.budget.begin(float(times[-1] - times[0]))
        self._take(choose_method(system, times, self.settings))
        if self.progress:
            start, end = float(times[0]), float(times[-1])
            self.whole = AnalysisProgress(self.progress, start, end, self._steps_before)
        self._run_over(times, np.ones(len(times), dtype=bool))
        while self.outcome is Outcome.DONE and self.sensors.continuing and self.time < times[-1]:
            require_no_delay(self.kernels, "A SENSOR from which the analysis continues", NO_PAST)
            times = self.sensors.rest(times, self.time)
            self._after_sensors()
            self._run_over(times, np.arange(len(times)) > 0)

    def _take(self, choice: MethodChoice) -> None:
        """The method from here on, compiled, and the equations in its formulation."""
        began, system = clock.process_time(), self.system
        self.chosen, formula = choice, choice.settings.formula
        if system.holonomic and bool(system.sizes.si2) != (choice.settings.form == "SI2"):
            system = self.present = self.renumbered(system, system.elimination.pivoting)
        engine(formula.entry, self.progress)
        if formula.by_component:
            system.lay_lanes()
        self.late_setup += clock.process_time() - began

    def _steps_before(self) -> int:
        """Steps of the runs that are over."""
        return int(self.counts.steps)

    def _run_over(self, times: np.ndarray, wanted: np.ndarray) -> None:
        """Integrate over output times (nt,), of which those ``wanted`` were requested."""
        system, apart, error = self.system, largest_step(times), self.settings.error
        for span, kept in self.delays.spans(self.kernels, system, times, wanted, error):
            self.outcome = self._tried(span, apart, kept)
            system = self.system
            self.keep(system, *self._sensed(system, span, kept, apart))
            if not self.deck.delays:  # which look into it
                system.record = np.zeros(1)
            if self.outcome is Outcome.DONE and self.time < times[-1]:
                # The spans of a delay may be too short to be looked at.
                self.outcome = self.budget.spent() or self.outcome
            if self.outcome in OVERSPENT:
                return
            if self.outcome in STALLED and self._rank_changed(system):
                self._continue(system, span, kept, apart)

    def _keep_senvals(self) -> None:
        """SENVAL from now on, after sensors with EVALUATE have triggered."""
        found, self.sensors.values = self.sensors.values, {}
        if any(self.deck.senvals.get(key, 0.0) != value for key, value in found.items()):
            self.change(self.deck.with_senvals(found))

    def _after_sensors(self) -> None:
        """What sensors change before the analysis continues: SENVAL, the first step."""
        self._keep_senvals()
        started = self.chosen.settings.starting_with(self.sensors.first_step)
        self.chosen = replace(self.chosen, settings=started)
        self.sensors.continuing = []

    def _tried(self, times: np.ndarray, apart: float, wanted: np.ndarray) -> Outcome:
        """Integrate; where the method that AUTO took stalls, from the beginning by that which it
        has in reserve.
        """
        beginning = self._beginning() if self.chosen.instead else None
        drawn_up = len(self.balances)
        self.sensors.arm(self.system)
        outcome = self._integrated(self.system, times, apart, wanted)
        if beginning is None or outcome not in (*STALLED, Outcome.CREEPING):
            return outcome
        self.budget.crept.clear()
        beginning.return_to()
        self.history.return_to(self.before)
        del self.balances[drawn_up:]
        self._take(self.chosen.other)
        return self._tried(times, apart, wanted)

    def _beginning(self) -> Beginning:
        # Only a run that may begin again needs it.
        from adamslite.analyses.dynamics.begun_again import Beginning

        return Beginning(self.system)

    def _integrated(
        self, system: System, times: np.ndarray, apart: float, wanted: np.ndarray
    ) -> Outcome:
        self.before = self.history.mark()
        run = partial(self._run, system, times, apart, wanted)
        outcome = run() if "plane" in self.without else in_its_plane(system, run)
        self._note_balance(system)
        return outcome

    def _run(self, system: System, times: np.ndarray, apart: float, wanted: np.ndarray) -> Outcome:
        """One run from the present state over ``times``, of which those ``wanted`` are kept."""
        settings = self.chosen.settings
        self.history.return_to(self.before)  # what left its plane begins again
        in_blocks = self.journal is not None and not self.deck.delays
        try:
            over = self.budget.over
            make_ready(system, times, apart, settings, self.audited, in_blocks, over)
        except Overspent:
            system.start_record(times)
            return Outcome.CPU_LIMIT
        if self.first_step is None and not self.history.stretches:
            self.first_step, self.late_setup = clock.process_time(), 0.0
        spill = partial(self.spill, system, times, wanted)
        outlet = self.journal.outlet(self.history, system, spill) if self.journal else None
        judged = bool(self.chosen.instead)
        return integrate(system, settings, self.whole, judged, self.budget, outlet)

    def _note_balance(self, system: System) -> None:
        if self.audited:
            # Few runs are audited, and what an audit needs takes a while to load.
            from adamslite.analyses.dynamics.audit import balance

            self.balances.append(balance(system))

    def _rank_changed(self, system: System) -> bool:
        """Leave out other redundant rows when those kept have become redundant."""
        if not badly_chosen(system):
            return False
        leave_out_redundant(system)
        return True

    def _continue(
        self, system: System, times: np.ndarray, wanted: np.ndarray, apart: float
    ) -> None:
        """Go on from where a run stalled to the rest of its output times."""
        require_no_delay(self.kernels, "A run whose constraints change their rank", NO_PAST)
        later = times > self.time
        self.outcome = Outcome.DONE
        rest, kept = np.append(self.time, times[later]), np.append(False, wanted[later])
        self.before = self.history.mark()
        self.outcome = self._run(system, rest, apart, kept)
        self._note_balance(system)
        self.keep(system, *self._sensed(system, rest, kept, apart))

    def _sensed(
        self, system: System, times: np.ndarray, wanted: np.ndarray, apart: float
    ) -> tuple[np.ndarray, bool, np.ndarray]:
        """Times of the records of a run, that they are no equilibrium, and which were requested;
        where sensors have ended the run, with one there at last.
        """
        self.time = float(system.report.t)
        if self.outcome is Outcome.DONE and system.triggered:
            self.outcome, times, last = self.sensors.end(system, times, apart)
            wanted = np.append(wanted[: len(times) - 1], last)
        return times, False, wanted

    def _statics(self, times: np.ndarray) -> None:
        system = self.system
        if len(times) > 1:
            require_no_delay(self.kernels, "STATICS at several times", NO_PAST)
        self.delays.hold(self.kernels, self.time)
        times = times if len(times) > 1 else np.array([self.time])
        pivoted = partial(self.renumbered, system, True)

        def reach(row: int) -> Outcome:
            system.settings.t = times[row]
            outcome = at_rest(system, self.statics, pivoted, self.budget)
            system.report.t = times[row]
            return outcome

        make_ready_to_rest(system, self.statics)
        from adamslite.analyses.session.in_turn import in_turn

        self.outcome = in_turn(self, times, reach, RECORD_AT_REST, True)
        self.ways_to_fall = int(system.report.ways_to_fall)

    def _kinematics(self, times: np.ndarray) -> None:
        system = self.system
        require_no_delay(self.kernels, "KINEMATICS", NO_PAST)
        if system.dof > 0:
            self.outcome = Outcome.NOT_KINEMATIC
            return
        from adamslite.analyses.session.in_turn import in_turn
        from adamslite.analyses.statics.kinematic import reached

        def reach(row: int) -> Outcome:
            outcome, self.unclosed = reached(system, times, row, self.budget)
            return outcome

        *_, jumps = followed_jumps(system, times)
        self.kinematic |= {"speed jumps": jumps} if jumps else {}
        try:
            self.outcome = in_turn(self, times, reach, RECORD, False)
        finally:
            self.budget.settle(system)

    def _determined(self, times: np.ndarray) -> None:
        """A dynamic analysis without degrees of freedom, up to a jump of a displacement."""
        self.kinematic["kinematic"] = DETERMINED
        self.chosen = choose_method(self.system, times, self.settings)
        times, broken, _ = followed_jumps(self.system, times)
        self._kinematics(times)
        if broken and self.outcome is Outcome.DONE:
            self.system.broken, self.outcome = broken, Outcome.BROKEN_MOTION

    def _initial(self, times: np.ndarray) -> None:
        """Record the assembled state with its accelerations."""
        system = self.system
        system.settings.t = self.time
        system.start_record(np.array([self.time]))
        if system.run(ACCELERATIONS) != contract.DONE:
            self.outcome = without_accelerations(system)
            return
        system.run(RECORD, 0)
        self.keep(system, np.array([self.time]), True)

    def _do_linear(self, command: Linear) -> None:
        from adamslite.analyses.linearization.linearization import carried_out

        require_no_delay(self.kernels, "LINEAR", "x(t - delay) has no state matrix")
        found = self.linearized(partial(carried_out, command, self.system, self.time))
        self.linearizations += [] if found is None else [found]

    def linearized(self, call: Callable[[], Found]) -> Found | None:
        """What a linearization of the state returns; None where ``outcome`` says why not."""
        from adamslite.analyses.linearization.instant import NoDerivative

        try:
            return interruptible(call, over=self.budget.over)
        except Overspent:
            self.outcome = Outcome.CPU_LIMIT
        except NoDerivative:
            self.outcome = Outcome.NOT_FINITE
        return None

    def _do_info(self, command: Info) -> None:
        from adamslite.analyses.session.info import info

        self.printed.append(info(self.system, command, self.time))
