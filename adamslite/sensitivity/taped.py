"""A run that keeps its tape, and the derivatives along it."""

from __future__ import annotations

import ctypes
from collections.abc import Callable, Iterable
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from adamslite.analyses.dynamics.begun_again import Beginning
from adamslite.analyses.dynamics.dynamic import integrate, make_ready
from adamslite.analyses.dynamics.method_choice import MethodChoice
from adamslite.analyses.dynamics.planar_reduction import NOTHING, reduce_to_plane
from adamslite.analyses.session.session import Session
from adamslite.equations.engine import address_of
from adamslite.errors import UsageError
from adamslite.integrators.audit_record import TAPE_HEAD
from adamslite.integrators.bdf.history import room
from adamslite.integrators.contract import AUDIT, DONE
from adamslite.integrators.linalg.plan import TINY
from adamslite.integrators.radau.control import KEPT_ROWS, KEPT_Z, Y_ROWS
from adamslite.native.worker import interruptible
from adamslite.results.outcomes import Outcome
from adamslite.sensitivity.begin import ROWS
from adamslite.sensitivity.contract import Forward
from adamslite.sensitivity.corrector import KEPT
from adamslite.sensitivity.directions import Collected, Direction, Snapshot, tangent_groups

if TYPE_CHECKING:
    from adamslite.analyses.setup.run_options import Budget
    from adamslite.equations.system import System

#: By method: the native function that follows its tape.
FORMULAS = {
    "GSTIFF": "adamslite.sensitivity.differences.by_differences",
    "RADAU": "adamslite.sensitivity.stages.by_stages",
}
WITHOUT = (
    "derivatives are worked out along the steps of {known}; {method} is none of them: ask for one "
    "of these, or for none"
)
INSTEAD = (
    "{method}, which the deck asks for, has no derivatives: values and derivatives are those of a "
    "run by {taken}"
)
SEVERAL = (
    "derivatives are those of one dynamic analysis: here a second one follows (several SIMULATE, "
    "or a SENSOR from which the analysis continues)"
)
# Share of ERROR that iterations of the corrector may leave.
CORRECTED = 0.02
# Of what steps are off by this multiple, and ERROR, contain what derivatives are off by.
FACTOR = 8.0
# Whether systems of all steps are solved to round-off.
EXACT = False
# Increments below this share of what the workspace holds, over the number, are round-off.
ROUND_OFF = 1e-13
# What acts out of a plane is round-off below this share of what acts in it.
OUT_OF_PLANE = 1e-9
# Rows of a first tape, or as many as take so many bytes (which are there once they are written),
# and how much longer the next one is.
FIRST_ROWS, FIRST_BYTES, LONGER = 1000, 250_000_000, 8
# Bytes that a tape may take.
MOST_BYTES = 4_000_000_000
TOO_LONG = (
    "the states of this run take more than {most:.3g} GB, and derivatives need all of them: a "
    "larger ERROR, or a shorter run"
)


class LeftPlane(Exception):
    """Motion in a plane leaves it, or would with other numbers."""


class Along(NamedTuple):
    """Derivatives of the record (np, nt, nw + n_out), and what they may be off by (np,), as a share
    of the largest place or velocity; events whose time has no derivative, those where several
    guards change or states are reset, and those whose order matters;
    ``matrices``: how many were made along steps of GSTIFF.
    """

    record: np.ndarray
    errors: np.ndarray
    grazed: int
    several: int
    coupled: int
    matrices: int


class Ready(Exception):
    """An analysis is about to begin to step."""

    def __init__(self, snapshot: Snapshot) -> None:
        super().__init__()
        self.snapshot = snapshot


class Taped(Session):
    """Follows the tape of a run with ``follow(system, method)``; ``planar``: in the plane of the
    motion, if it has one, where that finds out what leaves it; ``refused``: the method of the deck
    that has no derivatives.
    """

    follow: Callable[[System, str], None]
    followed = planar = False
    refused = ""

    def _take(self, choice: MethodChoice) -> None:
        taken = allowed(choice, "method" in self.flags)
        if not choice.reason and taken.settings.method != choice.settings.method:
            self.refused = choice.settings.method
        super()._take(taken)

    def is_determined(self, times: np.ndarray) -> bool:
        """No: derivatives follow the steps of a run."""
        return False

    @property
    def notes(self) -> dict[str, str]:
        """A word about another method than that of the deck."""
        taken = self.chosen.settings.method
        if not self.refused:
            return {}
        return {"integrator": INSTEAD.format(method=self.refused, taken=taken)}

    def _integrated(
        self, system: System, times: np.ndarray, apart: float, wanted: np.ndarray
    ) -> Outcome:
        if self.followed:
            raise UsageError(SEVERAL)
        beginning = Beginning(system)
        try:
            if self.planar and reduce_to_plane(system):
                return self._taped(system, times, apart, beginning, True)
        except LeftPlane:
            beginning.return_to()
        return self._taped(system, times, apart, beginning, False)

    def _taped(
        self, system: System, times: np.ndarray, apart: float, beginning: Beginning, planar: bool
    ) -> Outcome:
        """A run with its tape, which is followed; raises :class:`LeftPlane`."""
        settings = self.chosen.settings
        width = 8 * _width(system, settings.method)
        rows, most = max(FIRST_ROWS, FIRST_BYTES // width), MOST_BYTES // width
        while True:
            make_ready(system, times, apart, settings)
            lay_tape(system, rows, settings.method)
            self.budget.crept.clear()  # it may begin again
            outcome = integrate(system, settings, self.whole, budget=self.budget)
            system.audit.on = False
            if not system.tape.full:
                break
            if rows >= most:
                raise UsageError(TOO_LONG.format(most=MOST_BYTES / 1e9))
            rows = min(LONGER * rows, most)
            beginning.return_to()
            planar = planar and reduce_to_plane(system)
        if planar and system.report.left_plane:
            raise LeftPlane
        if outcome is Outcome.DONE:
            system.instances.remember(beginning.memories)
            self.follow(system, settings.method)
            self.followed = True
        system.tape.width = 0
        if system.tape.data.nbytes <= FIRST_BYTES:
            _spare[:] = [system.tape.data]
        system.tape.data = np.zeros(1)
        return outcome


class Probe(Taped):
    """Comes to where a dynamic analysis begins, and says what it begins with."""

    def _integrated(
        self, system: System, times: np.ndarray, apart: float, wanted: np.ndarray
    ) -> Outcome:
        raise Ready(Snapshot.of(system))


def allowed(choice: MethodChoice, asked: bool) -> MethodChoice:
    """The method, which AUTO or the deck has chosen only where derivatives can follow it.

    Raises
    ------
    UsageError
        When another was ``asked`` for beside the deck.
    """
    from dataclasses import replace

    method = choice.settings.method
    if method in FORMULAS:
        return replace(choice, instead="")
    if choice.reason or not asked:
        return MethodChoice(replace(choice.settings, method=next(iter(FORMULAS))), "derivatives")
    raise UsageError(WITHOUT.format(known=" and ".join(FORMULAS), method=method))


def lay_tape(system: System, rows: int, method: str) -> None:
    """Have the run that is ready keep its states."""
    tape, audit = system.tape, system.audit
    tape.rows, tape.full = 0, False
    tape.kept, tape.further, tape.more = _kept(system, method)
    tape.width = _width(system, method)
    tape.data = _room(rows * tape.width)
    for name in ("previous", "previous_before"):
        setattr(audit, name, np.zeros(system.W.size))
    audit.on = True
    system.run(AUDIT)


def _room(size: int) -> np.ndarray:
    """Room for a tape: what one of this process has left, whose pages are there already."""
    try:
        spare = _spare.pop()  # another thread finds none
    except IndexError:
        return np.zeros(size)
    return spare if spare.size >= size else np.zeros(size)


#: The room of the last tape: what the system gives anew costs as much as half of a run.
_spare: list[np.ndarray] = []


def _width(system: System, method: str) -> int:
    """Numbers of a row."""
    kept, _, more = _kept(system, method)
    return TAPE_HEAD + system.W.size + 9 * len(system.model.bodies) + kept + more


def _kept(system: System, method: str) -> tuple[int, int, int]:
    """Of the history: the first numbers that are kept, where others begin, and how many."""
    if method != "RADAU":
        return 0, 0, 0
    w, z = 2 * system.n + system.ns, system.m + system.nv + system.ns + system.holonomic
    return KEPT_ROWS * w, Y_ROWS * w, KEPT_Z * z


def recorded(system: System) -> np.ndarray:
    """The record of a run (nt, nw + n_out)."""
    size = system.nw + system.sizes.n_out
    return system.record[: len(system.times) * size].reshape(len(system.times), size)


def followed(
    system: System, method: str, found: Iterable[Direction], budget: Budget | None = None
) -> Along:
    """Derivatives of the record along the tape.

    Raises
    ------
    UsageError
        When a step has none.
    Overspent
        When the CPU is spent before the end of the tape.
    """
    found = [*found]
    collected = Collected(system, found, tangent_groups(system))
    reach = float(max(np.abs(system.W[: system.nw]).max(), 1.0))
    count, w = collected.record.count, 2 * system.n + system.ns
    size, guards = system.nw + system.sizes.n_out, system.W.size - system.nw
    made = Forward.zeros()
    made.exact, made.limit, made.last_t = EXACT, CORRECTED * system.settings.error, -1e300
    made.width, made.room = w, max(room(w), 8 * w + 3 * (system.nz + system.holonomic))
    history = np.zeros((count, made.room))
    history[:, :w] = collected.start
    arrays = {
        "history": history.ravel(), "y": np.zeros(4 * w + 1), "a": np.zeros(system.n + 1),
        "start": np.zeros(count * ROWS * w + 1), "state": np.zeros((ROWS + 2) * w),
        "z": np.zeros(system.m + system.nv + 1), "sd": np.zeros(system.ns + 1),
        "floor": np.array([ROUND_OFF * reach / each.size for each in found] + [0.0]),
        "stages": np.zeros(3 * system.W.size), "guard": np.zeros(system.W.size),
        "spent": np.zeros(2 * count), "top": np.zeros(2 * count),
        "slope": np.full(2 * count, 1.0), "when": np.zeros(KEPT), "share": np.zeros(KEPT),
        "kept": np.zeros(KEPT * count * (system.m + system.nv) + 1),
        "v": np.zeros(system.n), "mu": np.zeros(system.holonomic + 1),
        "rate": np.zeros(w), "jump": np.zeros(w),
        "speed": np.zeros(guards), "kind": np.zeros(guards), "shift": np.zeros(count * guards + 1),
        "last": np.zeros(count + 1),
        "record": np.zeros(count * len(system.times) * size + 1),
    }  # fmt: skip
    for name, value in arrays.items():
        setattr(made, name, value)
    if _starts_out(system, found, reach):
        raise LeftPlane
    problem, plan = system.records()
    run = _native(FORMULAS[method])

    # What native code may still use when it is left to itself.
    held = (problem, plan, collected.record, made), system.tape.data

    def along_the_tape() -> int:
        return int(run(*(each.address for each in held[0])))

    code = interruptible(along_the_tape, over=budget.over if budget else None)
    if code != DONE:
        raise UsageError("derivatives are not determined where the equations are singular")
    if _driven_out(system, collected, found):
        raise LeftPlane
    least = np.repeat(made.floor[:-1], 2)
    shares = made.spent / np.maximum(made.top, np.maximum(least, TINY))
    known = FACTOR * shares.reshape(count, 2).max(axis=1) + system.settings.error
    return Along(
        made.record[:-1].reshape(count, len(system.times), size), known, made.grazed,
        made.several, made.coupled, made.matrices,
    )  # fmt: skip


def _starts_out(system: System, found: list[Direction], reach: float) -> bool:
    """Whether starts move out of the plane in which the run was."""
    held = system.elimination.held
    out = held[held < system.n]
    for each in found:
        moved = np.abs(each.start[[*out, *(system.n + out)]]).max(initial=0.0)
        if moved > NOTHING * max(np.abs(each.start).max(initial=0.0), reach / each.size):
            return True
    return False


def _driven_out(system: System, collected: Collected, found: list[Direction]) -> bool:
    """Whether a number would drive the motion out of the plane in which the run was."""
    tangents, loose = collected.record, float(system.elimination.loose[0])
    least = np.array([loose / each.size for each in found])
    limit = np.maximum(OUT_OF_PLANE * tangents.top[:-1], least)
    return bool(system.elimination.held.size and (tangents.out[:-1] > limit).any())


def _native(entry: str) -> Any:
    kind = ctypes.CFUNCTYPE(ctypes.c_int64, *[ctypes.c_void_p] * 4)
    return kind(address_of(entry))
