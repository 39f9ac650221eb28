"""The state of a session: the model as the commands have left it, its equations, their values.

::

    deck --compile_model--> kernels --numbered--> system --assembled_of--> a consistent state

Another deck takes over the values of bodies, multipliers and states that it still has.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from adamslite.analyses.clock.clock import Clock
from adamslite.analyses.clock.motion_jumps import followed_jumps, without_value
from adamslite.analyses.dynamics.delays import Delays
from adamslite.analyses.dynamics.dynamic import Settings
from adamslite.analyses.dynamics.history import History, Piece
from adamslite.analyses.dynamics.method_choice import MethodChoice
from adamslite.analyses.dynamics.sensors import SensorLog
from adamslite.analyses.findings.apart import Apart
from adamslite.analyses.initial.conditions import (
    initial_conditions,
    settle_states,
    settle_variables,
)
from adamslite.analyses.initial.redundancy import leave_out_redundant
from adamslite.analyses.session.saves import Saves
from adamslite.analyses.setup.run_options import Budget
from adamslite.analyses.setup.subject import deck_of, kernels_of
from adamslite.analyses.statics.static import PIVOTING, StaticSettings
from adamslite.equations.engine import engine
from adamslite.equations.result_columns import columns
from adamslite.equations.system import System
from adamslite.gc_pause import without_collection
from adamslite.integrators import contract
from adamslite.integrators.contract import ACCELERATIONS
from adamslite.model.model import assemble
from adamslite.model.reduction import MERGED
from adamslite.outputs.saved_files import SavedFiles
from adamslite.results.outcomes import Outcome

if TYPE_CHECKING:
    from collections.abc import Callable

    from adamslite.analyses.dynamics.history import Journal
    from adamslite.analyses.initial.conditions import Unclosed
    from adamslite.analyses.setup.subject import Subject
    from adamslite.deck.deck import Deck
    from adamslite.deck.redefinition import Redefinition
    from adamslite.progress import AnalysisProgress, Progress
    from adamslite.results.balance import Balance
    from adamslite.results.results import Linearized, Results


#: Statements that may have initial conditions of their own.
STARTED = ("JOINT", "MOTION", "PTCV")


class SessionState:
    """A model and its present state.

    Attributes
    ----------
    system : System
        Equations and present state.
    time : float
        Time reached.
    history : History
        What the analyses wrote.
    first_step : float or None
        CPU [s] of the process when the first analysis began to step.
    late_setup : float
        CPU [s] of compiling integrators since then, or since the first command.
    outcome, unclosed
        How the last analysis ended; the constraint that stayed open, if one did.
    present : System or None
        ``system``, as far as it is there; ``began_static``: it is at rest after an equilibrium.
    kinematic
        Comments on kinematic analyses.
    recorded
        The kernels of the last analysis.
    analyses
        Kind and start of each analysis, and the number of rows before it.
    before
        The history without what the present run has written.
    saves, changes
        What SAVE has kept; commands that have changed statements of the deck.
    sensors : SensorLog
    linearizations : list of Linearized
    balances : list of Balance
        What the audits of dynamic analyses found.
    """

    def __init__(
        self,
        scene: Subject,
        progress: Progress | None,
        flags: dict[str, Any],
        without: frozenset[str] = frozenset(),
        audited: bool = False,
        files: SavedFiles | None = None,
        budget: Budget | None = None,
        journal: Journal | None = None,
    ) -> None:
        self.progress, self.journal = progress, journal
        self.budget = budget or Budget()
        self.flags = flags
        self.audited = audited
        deck_of(scene).user.start()
        self.kernels = kernels_of(scene, progress, without, audited)
        self.without = without | self.kernels.model.without
        engine(progress=progress)
        self.settings = replace(Settings(), **flags)
        self.chosen = MethodChoice(self.settings)
        self.statics = StaticSettings()
        self.time = self.late_setup = 0.0
        self.first_step: float | None = None
        self.history = History()
        self.before = self.history.mark()
        self.outcome = Outcome.DONE
        self.unclosed: Unclosed | None = None
        self.linearizations: list[Linearized] = []
        self.balances: list[Balance] = []
        self.counts = contract.Counts.zeros()
        self.whole: AnalysisProgress | None = None
        self.ways_to_fall = 0
        self.sensors = SensorLog()
        self.delays = Delays()
        self.out_of_law: dict[str, str] = {}
        self.apart = Apart()
        self.printed: list[str] = []
        self.assembled: list[str] = []
        self.speeds: list[str] = []
        self.saves = Saves(files or SavedFiles(), self.deck)
        self.changes: tuple[Redefinition[Any], ...] = ()
        self.present: System | None = None
        self.began_static = False
        self.recorded = self.kernels
        self.kinematic: dict[str, str] = {}
        self.analyses: list[tuple[str, float, int]] = []
        #: Carries out the same commands with other options, where that may be asked for.
        self.again: Callable[..., Results | None] | None = None
        #: The limit of memory.
        self.memory: int | None = None

    @property
    def deck(self) -> Deck:
        """As the commands so far have left it."""
        return self.kernels.model.deck

    @property
    def system(self) -> System:
        """The equations, numbered and assembled when first needed."""
        if self.present is None:
            system = self.present = self.numbered(False)
            if self.is_driven(system):
                self.unclosed = self._start_of_joints(system)
                if system.model.merges_parts:
                    return self._merged_start(system)
                self.present = self.assembled_of(system)
        return self.present

    def _merged_start(self, system: System) -> System:
        """The equations of bodies made of parts, where each part would start alike by itself."""
        from adamslite.analyses.initial.drawn import Drawn, other_rows_left_out

        drawn = Drawn.of(system)
        self.present = self.assembled_of(system)
        if drawn.differs(self.present) or other_rows_left_out(self.present):
            return self._taken_apart()
        return self.present

    def _taken_apart(self) -> System:
        """The equations of every part by itself: the start is not as drawn, and by how much each
        part is to be moved is another question for one that is part of a body; or reactions are
        not determined, and other rows would be left out.
        """
        self.without |= {MERGED}
        self.outcome, self.unclosed, self.present = Outcome.DONE, None, None
        self.kernels = kernels_of(self.deck, self.progress, self.without, self.audited)
        return self.system

    def _start_of_joints(self, system: System) -> Unclosed | None:
        if not any(map(self.deck.of, STARTED)):
            return None
        # Only initial conditions of joints take another model.
        from adamslite.analyses.initial.joint_start import start_of_joints

        return start_of_joints(system, self.progress)

    def is_determined(self, times: np.ndarray) -> bool:
        """Whether TIME alone determines every posture of a dynamic analysis, no element depends on
        what was before, and a speed jumps, so that it cannot be integrated.
        """
        system, deck = self.system, self.deck
        if system.dof > 0 or not system.holonomic or len(times) < 2 or self.has_rates():
            return False
        remembers = deck.delays or any(map(deck.of, ("SENSOR", "FRICTION", "GSE")))
        return not (remembers or self.audited) and bool(followed_jumps(system, times)[-1])

    def has_rates(self) -> bool:
        """Whether TIME alone does not determine a posture: states, MOTIONs that give speeds."""
        return self.system.ns > 0 or self.system.m > self.system.holonomic

    def end_for_memory(self) -> None:
        """The run ends; what there is takes some memory more to be kept, and gets it."""
        from adamslite.machine import lift_memory_limit

        self.outcome = Outcome.MEMORY_LIMIT
        lift_memory_limit()

    def prepare(self) -> None:
        """Number and assemble the equations now."""
        self.present = self.system

    def change(self, deck: Deck) -> None:
        """Go on with another deck from the present state."""
        old = self.present
        from adamslite.kernels.compile import compile_model
        from adamslite.model.merging import merged

        self.kernels = compile_model(
            merged(assemble(deck, self.without)), self.progress, self.audited
        )
        self.present = None
        if old is not None:
            system = self.present = self.numbered(False)
            system.adopt(old)
            if self.is_driven(system):
                self.present = self.assembled_of(system)

    def numbered(self, pivoting: bool, form: str = "") -> System:
        with without_collection():
            stabilised = (form or self.settings.form) == "SI2"
            system = System(self.kernels, stabilised, pivoting)
        system.settings.t = self.time
        return system

    def is_driven(self, system: System) -> bool:
        """Whether all that drives a constraint has a value at this time."""
        system.broken = without_value(Clock(self.kernels), self.time)
        if system.broken:
            self.outcome = Outcome.BROKEN_MOTION
            system.report.t = self.time
        return system.broken is None

    def assembled_of(self, system: System) -> System:
        """Consistent positions and velocities, redundant rows, a regular elimination order."""
        self.unclosed = self.unclosed or initial_conditions(system)
        if self.unclosed:
            self.outcome = self.unclosed.outcome
            return system
        if self.time == 0.0 and not self.history.stretches:
            self.assembled = system.largest_changes()
            self.speeds = system.changed_speeds()
        settle_variables(system)
        settle_states(system)
        leave_out_redundant(system)
        system.settings.t = self.time
        small = system.nz <= PIVOTING and not system.elimination.pivoting
        if small and system.run(ACCELERATIONS) != contract.DONE and np.isfinite(system.F).all():
            return self.renumbered(system, True)
        return system

    def renumbered(self, system: System, pivoting: bool) -> System:
        """``system`` in its present state, in the formulation of the method that AUTO picked, or
        eliminated with row pivoting.
        """
        other = self.numbered(pivoting, self.chosen.settings.form)
        other.adopt(system)
        other.settings.t = system.settings.t  # which is ahead of the session's between two outputs
        other.drop(system.elimination.dropped)
        return other

    def keep(
        self, system: System, times: np.ndarray, static: bool, wanted: np.ndarray | None = None
    ) -> None:
        """Keep the records made, of which only those ``wanted`` were requested."""
        self.out_of_law = system.instances.out_of_law() | self.out_of_law
        self.apart.look(system)
        try:
            self._add(system, times, static, wanted)
        except MemoryError:
            self.end_for_memory()
            self._add(system, times, static, wanted)
        self.began_static, self.recorded = static, self.kernels
        self.counts.add(system.count)

    def _add(
        self, system: System, times: np.ndarray, static: bool, wanted: np.ndarray | None
    ) -> None:
        """The records of the present block to the history."""
        first, rows = system.block.first, system.rows
        names, values = columns(system, rows)
        here = slice(first, first + len(rows))
        times = times[here]
        if wanted is not None and not wanted[here].all():
            times, values = times[wanted[here]], values[wanted[here]]
        piece = Piece(times, names, values)
        if first:
            self.history.extend(piece)
        else:
            changed = self.kernels is not self.recorded
            self.history.append(piece, static, self.began_static, changed)

    def spill(
        self, system: System, times: np.ndarray, wanted: np.ndarray, static: bool = False
    ) -> None:
        """Keep the records of a full block, whose room is for the next one; where a step was taken
        back behind its first record, take those away that were kept too early.

        All of that or, where it is interrupted or memory is short, nothing: who goes on has the
        records once.
        """
        block, kept, record = system.block, self.history.mark(), system.record
        first = int(block.first)
        try:
            if block.row < first:
                self._take_back(block.row, wanted[:first])
            else:
                fresh = np.zeros_like(record)  # the history may keep the old one
                self._add(system, times, static, wanted)
                system.record = fresh
            block.first = system.count.records = block.row
        except (KeyboardInterrupt, MemoryError):
            system.record, block.first = record, first
            self.history.return_to(kept)
            raise

    def _take_back(self, row: int, wanted: np.ndarray) -> None:
        if row:
            self.history.cut(int(wanted[row:].sum()))
        else:
            self.history.return_to(self.before)
