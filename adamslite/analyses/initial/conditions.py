"""Initial conditions: the nearest state that satisfies every constraint.

Positions:   min sum w_i^2 (q_i - q_i0)^2  subject to g(t0, q) = 0       Gauss-Newton
Velocities:  min sum w_i^2 (u_i - u_i0)^2  subject to G u + g_t = 0      one linear solve

Accelerations and multipliers follow from the equations of motion when the run starts.
Reference: Haug, Computer Aided Kinematics and Dynamics, 1989, section 4.3.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field
from math import isnan

import numpy as np

from adamslite.elements.bases.constraint import Constraint
from adamslite.equations.system import System
from adamslite.integrators import contract
from adamslite.integrators.contract import JACOBIAN, RESIDUAL
from adamslite.integrators.linalg.plan import TINY
from adamslite.model.model import PART
from adamslite.model.scaling import coordinate_weights, turned
from adamslite.results.outcomes import Outcome

MAX_ITERATIONS = 100
# |g| below this share of the model's size counts as closed.
CLOSED = 1e-13
# Beyond this share a constraint is open, and one of velocities.
OPEN, OPEN_SPEED = 1e-9, 1e-8
# Steps below this share are round-off.
STILL = 1e-15
# Largest turn of a part in one step [rad], halvings of a step that does not help.
MOST_TURN, HALVINGS = 0.5, 12
# Singular values below this share of the largest are redundant rows.
RANK = 1e-9
# Rows off by this share of the worst take part in a contradiction.
INVOLVED = 1e-3
SPEEDS = contract.VELOCITY_ROWS | contract.RATE_ROWS


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


def initial_conditions(system: System, free: Iterable[Constraint] = ()) -> Unclosed | None:
    """Put the nearest consistent positions and velocities into ``system``; None when it worked.

    ``free``: constraints that leave the velocities alone.
    """
    if system.m == 0:
        return None
    if system.holonomic:
        unclosed = _positions(system)
        if unclosed:
            return unclosed
    return _velocities(system, free)


def _positions(system: System) -> Unclosed | None:
    rows = np.arange(system.n, system.n + system.holonomic)
    size = max(1.0, float(np.abs(system.q).max()))
    g = _residual(system, contract.POSITION_ROWS)[rows]
    for _ in range(MAX_ITERATIONS):
        if not np.isfinite(g).all() or float(np.abs(g).max()) <= CLOSED * size:
            break
        gradient = _gradient(system, contract.POSITION_ROWS, 0, rows)
        if not np.isfinite(gradient).all():
            g = g + 0.0 * gradient.sum(axis=1)
            break
        step = _least_change(system, gradient, g)
        g, moved = _damped(system, step, g, rows)
        if moved <= STILL * size:
            break
    return _unclosed(system, g, np.arange(len(g)), OPEN * size, "position")


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


def _velocities(system: System, free: Iterable[Constraint]) -> Unclosed | None:
    kept = np.setdiff1d(np.arange(system.m), [row for c in free for row in _rows_of(system, c)])
    rows = velocity_rows(system)[kept]
    if not len(rows):
        return None
    for _ in range(3):
        defect = _residual(system, SPEEDS)[rows]
        gradient = _gradient(system, SPEEDS, 1, rows)
        if not (np.isfinite(defect).all() and np.isfinite(gradient).all()):
            defect = defect + 0.0 * gradient.sum(axis=1)
            break
        system.u[: system.n] -= _least_change(system, gradient, defect, speeds=True)
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
    return _velocities(system, ()) if np.abs(defect).max() > OPEN * size else None


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


def _gradient(system: System, phases: int, kind: int, rows: np.ndarray) -> np.ndarray:
    """Derivative of constraint rows with respect to positions (kind 0) or velocities (1), dense."""
    system.coef[:5] = 0.0
    system.coef[kind] = 1.0
    system.run(JACOBIAN, phases)
    return system.dense_jacobian()[rows, : system.n]


def _least_change(
    system: System, gradient: np.ndarray, defect: np.ndarray, speeds: bool = False
) -> np.ndarray:
    """Smallest weighted step that removes the defect to first order (redundant rows are shared)."""
    scale = 1.0 / weights(system, speeds)
    step, *_ = np.linalg.lstsq(gradient * scale, defect, rcond=RANK)
    return scale * step


def constraint_gradient(system: System) -> np.ndarray:
    """G: derivative of every constraint row with respect to velocities, (m, n)."""
    return _gradient(system, SPEEDS, 1, velocity_rows(system))


def velocity_rows(system: System) -> np.ndarray:
    """Rows of the velocity conditions: holonomic ones (at mu when there is one), then rates."""
    first = system.nz - system.holonomic if system.numbering.stabilised else system.n
    rates = np.arange(system.n + system.holonomic, system.n + system.m)
    return np.concatenate([np.arange(first, first + system.holonomic), rates])


def weights(system: System, speeds: bool = False) -> np.ndarray:
    """(n,) weights of the coordinates, or of their velocities."""
    model = system.model
    table = model.once(("weights", speeds), lambda: coordinate_weights(model, speeds))
    w = np.ones(system.n)
    for b, body in enumerate(model.bodies):
        w[system.starts[b] : system.starts[b] + body.width] = table[b, : body.width]
    return w


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
