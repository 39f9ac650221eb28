"""Initial conditions: the nearest state that satisfies every constraint.

Positions:   min sum w_i^2 (q_i - q_i0)^2  subject to g(t0, q) = 0       Gauss-Newton
Velocities:  min sum w_i^2 (u_i - u_i0)^2  subject to G u + g_t = 0      one linear solve

Accelerations and multipliers follow from the equations of motion when the run starts.
Reference: Haug, Computer Aided Kinematics and Dynamics, 1989, section 4.3.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field
from math import isfinite, isnan, nan
from typing import TYPE_CHECKING

import numpy as np

from adamslite.analyses.initial.least_change import POSITIONS, VELOCITIES, Way, ways
from adamslite.analyses.initial.rows import SPEEDS, velocity_rows
from adamslite.elements.diff import Diff
from adamslite.elements.variable import Variable
from adamslite.integrators import contract
from adamslite.integrators.contract import RESIDUAL
from adamslite.integrators.linalg.plan import TINY
from adamslite.language.expression import Ref, calls
from adamslite.model.model import PART
from adamslite.model.scaling import turned
from adamslite.results.outcomes import Outcome

if TYPE_CHECKING:
    from adamslite.deck.deck import Deck
    from adamslite.elements.bases.constraint import Constraint
    from adamslite.equations.system import System

MAX_ITERATIONS = 100
# |g| below this share of the model's size counts as closed.
CLOSED = 1e-13
# Beyond this share a constraint is open, and one of velocities.
OPEN, OPEN_SPEED = 1e-9, 1e-8
# Steps below this share are round-off.
STILL = 1e-15
# Largest turn of a part in one step [rad], halvings of a step that does not help.
MOST_TURN, HALVINGS = 0.5, 12
# Passes over the velocities: what round-off leaves of the first.
PASSES = 3
# Rows off by this share of the worst take part in a contradiction.
INVOLVED = 1e-3


@dataclass
class Unclosed:
    """A constraint the initial conditions cannot satisfy: which row, and by how much.

    ``size`` is not a number where the row has no value; ``others`` are the statements that the row
    contradicts.
    """

    statement: Constraint
    size: float
    level: str
    equation: str
    others: list[Constraint] = field(default_factory=list)

    @property
    def outcome(self) -> Outcome:
        """How the analysis ends."""
        return Outcome.NOT_FINITE if isnan(self.size) else Outcome.INITIAL_CONDITIONS_FAILED


def without_accelerations(system: System) -> Outcome:
    """How an analysis ends where ACCELERATIONS are not solved for: not-a-number is no singular
    matrix, and no force cancels a mass where none depends on accelerations.
    """
    if not (np.isfinite(system.F).all() and np.isfinite(system.elimination.LA).all()):
        return Outcome.NOT_FINITE
    cancels = bool(system.sizes.implicit_mass)
    return Outcome.SINGULAR_ACCELERATION if cancels else Outcome.UNDETERMINED


def initial_conditions(
    system: System, free: Iterable[Constraint] = (), redundant: Iterable[int] = ()
) -> Unclosed | None:
    """Put the nearest consistent positions and velocities into ``system``; None when it worked.

    ``free``: constraints that leave the velocities alone; ``redundant``: rows that are not solved
    for, as they follow from the others.  A posture that is closed but for round-off turns such a
    dependence into a nearly singular matrix.
    """
    if system.m == 0:
        return None
    before = system.q.copy(), system.u.copy(), system.base.copy()
    unclosed = None
    for way in ways(system):
        system.q[:], system.u[:], system.base[:] = before
        unclosed = _positions(system, way, redundant) if system.holonomic else None
        unclosed = unclosed or _velocities(system, free, way, redundant)
        if unclosed is None:
            break
    return unclosed


def _positions(system: System, way: Way, redundant: Iterable[int]) -> Unclosed | None:
    kept = np.setdiff1d(np.arange(system.holonomic), [*redundant])
    rows = system.n + kept
    size = max(1.0, float(np.abs(system.q).max()))
    g = _residual(system, contract.POSITION_ROWS)[rows]
    for _ in range(MAX_ITERATIONS):
        if not np.isfinite(g).all() or float(np.abs(g).max()) <= CLOSED * size:
            break
        gradient = way(system, POSITIONS, kept)
        if not np.isfinite(gradient.sums).all():
            g = g + 0.0 * gradient.sums
            break
        g, moved = _damped(system, gradient.step(g), g, rows)
        if moved <= STILL * size:
            break
    if len(kept) < system.holonomic and np.isfinite(g).all():
        kept = np.arange(system.holonomic)
        g = _residual(system, contract.POSITION_ROWS)[system.n + kept]
    return _unclosed(system, g, kept, OPEN * size, "position")


def _damped(
    system: System, step: np.ndarray, g: np.ndarray, rows: np.ndarray
) -> tuple[np.ndarray, float]:
    """Take the step, or the longest half, quarter ... of it that reduces |g|; turns stay below
    MOST_TURN.
    """
    before = (system.q.copy(), system.base.copy())
    share = min(1.0, MOST_TURN / max(TINY, largest_turn(system, step)))
    for _ in range(HALVINGS):
        move(system, share * step)
        new = _residual(system, contract.POSITION_ROWS)[rows]
        if np.linalg.norm(new) < np.linalg.norm(g) or not np.abs(g).max() > CLOSED:
            break
        system.q[:], system.base[:] = before
        share *= 0.5
    else:
        return g, 0.0
    return new, float(share * np.abs(step).max())


def largest_turn(system: System, step: np.ndarray) -> float:
    turns = [
        float(np.linalg.norm(step[i + 3 : i + 6]))
        for i, width in zip(system.starts, system.widths, strict=True)
        if width == PART and i < system.n
    ]
    return max(turns, default=0.0)


def _velocities(
    system: System, free: Iterable[Constraint], way: Way, redundant: Iterable[int] = ()
) -> Unclosed | None:
    without = [*redundant, *(row for c in free for row in _rows_of(system, c))]
    kept = np.setdiff1d(np.arange(system.m), without)
    rows = velocity_rows(system)[kept]
    if not len(rows):
        return None
    defect = _residual(system, SPEEDS)[rows]
    for _ in range(PASSES):
        gradient = way(system, VELOCITIES, kept)
        if not (np.isfinite(defect).all() and np.isfinite(gradient.sums).all()):
            defect = defect + 0.0 * gradient.sums
            break
        system.u[: system.n] -= gradient.step(defect)
        defect = _residual(system, SPEEDS)[rows]
    size = max(1.0, float(np.abs(system.u).max()))
    return _unclosed(system, defect, kept, OPEN_SPEED * size, "velocity")


def settle_variables(system: System) -> None:
    """Start VARIABLEs that are solved for, but do not depend on themselves, at their FUNCTION.

    The rows are V - FUNCTION; each pass settles those whose FUNCTION needs settled ones only.
    """
    circular = system.model.circular
    nodes = [k for k in system.nodes if k[0] == "VARIABLE" and k[1] not in circular]
    rows = np.array([system.starts[system.node_at[node]] for node in nodes], dtype=int)
    for _ in nodes:
        defect = _residual(system, contract.ROWS)[rows]
        known = np.isfinite(defect)
        if not defect[known].any():
            return
        system.z[rows[known] - system.n] -= defect[known]


def consistent_velocities(system: System) -> Unclosed | None:
    """Let a state that statics brought to rest move as its constraints ask, a MOTION above all."""
    if system.m == 0:
        return None
    defect = _residual(system, SPEEDS)[velocity_rows(system)]
    size = max(1.0, float(np.abs(system.u).max()))
    if np.abs(defect).max() <= OPEN * size:
        return None
    before, unclosed = system.u.copy(), None
    for way in ways(system):
        system.u[:] = before
        unclosed = _velocities(system, (), way)
        if unclosed is None:
            break
    return unclosed


def speed_defects(system: System, constraints: Iterable[Constraint]) -> list[np.ndarray]:
    """What the velocity rows of each constraint are off by."""
    defect = _residual(system, SPEEDS)[velocity_rows(system)]
    return [defect[_rows_of(system, each)] for each in constraints]


def _unclosed(
    system: System, defect: np.ndarray, rows: np.ndarray, allowed: float, level: str
) -> Unclosed | None:
    """The worst of the constraint rows ``rows`` when it is off by more than ``allowed``.

    At the least sum of squares the defects are a combination of rows that cancels: rows that are
    off contradict each other.
    """
    sizes = np.where(np.isfinite(defect), np.abs(defect), np.inf)
    worst = int(np.argmax(sizes))
    if sizes[worst] <= allowed:
        return None
    statement, equation = _owner(system, int(rows[worst]))
    size, others = float("nan"), []
    if np.isfinite(sizes[worst]):
        size = float(sizes[worst])
        also = [_owner(system, int(row))[0] for row in rows[sizes > INVOLVED * size]]
        others = list(dict.fromkeys(each for each in also if each is not statement))
    return Unclosed(statement, size, level, equation, others)


def _residual(system: System, phases: int) -> np.ndarray:
    system.run(RESIDUAL, phases)
    return system.F.copy()


def move(system: System, step: np.ndarray) -> None:
    """Subtract a step of positions and ground-axes rotations; attitudes are counted from the new
    ones.
    """
    for b, body in enumerate(system.model.bodies):
        i = system.starts[b]
        system.q[i : i + 3] -= step[i : i + 3]
        if body.width == PART:
            attitude = system.base[9 * b : 9 * b + 9]
            attitude[:] = turned(attitude.reshape(3, 3), -step[i + 3 : i + 6]).ravel()


def _rows_of(system: System, constraint: Constraint) -> range:
    """Numbers of the rows of a constraint, counted from the first multiplier."""
    first = 0
    for each in system.model.constraints:
        if (each.keyword, each.key) == (constraint.keyword, constraint.key):
            return range(first, first + each.n_rows)
        first += each.n_rows
    return range(0)


def _owner(system: System, row: int) -> tuple[Constraint, str]:
    """The constraint that owns multiplier row ``row``, and what the row keeps at zero."""
    for constraint in system.model.constraints:
        if row < constraint.n_rows:
            return constraint, constraint.row_names[row]
        row -= constraint.n_rows
    raise IndexError("no constraint has this row")


ROUNDS = 50
# Step of a difference, and correction that is round-off, as shares of the value.
STEP, SETTLED = 1e-6, 1e-14


def settle_states(system: System) -> None:
    """Start a DIFF whose equation has no rate of its own where that equation holds.

    Newton for each state by itself, with the slope from a difference; what does not settle stays
    as the deck starts it.
    """
    deck = system.model.deck
    for diff in deck.of(Diff):
        if not diff.implicit or diff.dynamic_hold or not is_algebraic(deck, diff):
            continue
        row = system.starts[system.node_at["DIFF", diff.key]]
        start = float(system.z[row - system.n])
        for _ in range(ROUNDS):
            y = float(system.z[row - system.n])
            h = STEP * max(1.0, abs(y))
            g, beside = (_at_rest(system, row, value) for value in (y, y + h))
            change = g * h / (beside - g) if beside != g else nan
            system.z[row - system.n] = y - change if isfinite(change) else start
            if not abs(change) > SETTLED * max(1.0, abs(y)):
                break


def _at_rest(system: System, row: int, y: float) -> float:
    """What is left of the equation of a state with the value y; it stays in ``system``."""
    system.z[row - system.n] = y
    system.run(contract.RESIDUAL_AT_REST, contract.ROWS)
    return float(system.F[row])


def is_algebraic(deck: Deck, diff: Diff) -> bool:
    """Whether FUNCTION does without the rate of its own state, also through VARIABLEs."""
    pending, seen = [diff.function], set()
    while pending:
        for call in calls(pending.pop(), "DIF1", "VARVAL", "DDT"):
            (ref,) = call.args
            if call.name == "DIF1" and ref == Ref("DIFF", diff.key):
                return False
            if call.name != "DIF1" and isinstance(ref, Ref) and ref not in seen:
                seen.add(ref)
                pending.append(deck.get(Variable, ref.id).function)
    return True
