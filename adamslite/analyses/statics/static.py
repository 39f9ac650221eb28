"""Static equilibrium of the model from its present state."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial
from math import pi
from typing import TYPE_CHECKING

import numpy as np

from adamslite.equations.engine import ints
from adamslite.integrators import contract
from adamslite.integrators.contract import EQUILIBRIUM, JACOBIAN, STATIC
from adamslite.integrators.equilibrium_control import Control
from adamslite.native.worker import Overspent, interruptible
from adamslite.results.outcomes import Outcome

if TYPE_CHECKING:
    from adamslite.analyses.setup.run_options import Budget
    from adamslite.equations.system import System

# Matrices up to this many unknowns may be eliminated densely when the block order meets a singular
# pivot.
PIVOTING = 3000
# Steps of relaxation; and what they may cost with pivoting over the whole matrix, each the cube of
# its unknowns: in a search, and in one that repeats others.
RELAXATIONS, ELIMINATED, REPEATED = 3000, 5e10, 5e9
# Iterations of a search, times unknowns, that are over before anybody would interrupt them: a
# thread takes longer than most searches.
SOON = 3000
# Short increments: of the model, and angles [rad].
SHORT = 0.01
# Unknowns up to which a count of unstable motions is confirmed by eigenvalues.
CONFIRMED = 3000
# Eigenvalues below this share of the largest are round-off, and an imaginary part of that size.
ROUND_OFF, REAL = 1e-12, 1e-6


@dataclass(frozen=True)
class StaticSettings:
    """Settings of the EQUILIBRIUM statement with their defaults.

    ``alimit`` [rad] and ``tlimit`` [length] limit the increments of an iteration; ``error`` is the
    relative correction and ``imbalance`` [force] the residual at which it is done; ``stability``
    is added times the mass matrix to the stiffness; ``pattern``, repeated, says which iterations
    renew the matrix (T).
    """

    alimit: float = 10.0 * pi / 180.0
    tlimit: float = 20.0
    error: float = 1e-4
    imbalance: float = 1e-4
    stability: float = 1e-5
    maxit: int = 25
    pattern: tuple[str, ...] = ()


def at_rest(
    system: System, settings: StaticSettings, pivoted: Callable[[], System], budget: Budget
) -> Outcome:
    """Move ``system`` to an equilibrium; its report has the number of ways in which it is unstable.

    What is slender and bends far is thrown about by increments of ALIMIT: a turn by the angle a
    stretches a link by a^2/2.  Where the search fails, it is repeated with short ones.

    A stiffness alone, other than with the inertia of a time step, need not have regular blocks on
    its diagonal: elimination without pivoting may blow up where the equilibrium is regular.
    ``pivoted``: another system in its state, eliminated with row pivoting.
    """
    start = posture(system)
    tlimit, alimit = SHORT * model_size(system), SHORT
    short = replace(
        settings, tlimit=min(settings.tlimit, tlimit), alimit=min(settings.alimit, alimit)
    )
    # ALIMIT and TLIMIT are those of bodies; increments of states have none.
    for limits in (settings, short)[: 1 + bool(len(system.mass))]:
        outcome = run_static(system, limits, budget)
        if outcome is not Outcome.NO_EQUILIBRIUM:
            return outcome
        put_back(start)
    if system.elimination.pivoting or system.nz > PIVOTING:
        return outcome
    # Where pivots were to blame this one settles within a few iterations; its relaxation is no
    # other than before.
    spare = pivoted()
    outcome = run_static(spare, settings, budget, REPEATED)
    system.adopt(spare)
    system.count.add(spare.count)
    system.report.ways_to_fall = spare.report.ways_to_fall
    return outcome


def run_static(
    system: System, settings: StaticSettings, budget: Budget, cost: float = ELIMINATED
) -> Outcome:
    """Move ``system`` to an equilibrium at its present time; states with STATIC_HOLD stay."""
    make_ready(system, settings, cost)
    try:
        outcome = searched(system, budget)
        if system.report.ways_to_fall != 0:
            count = partial(ways_to_fall, system, settings.stability)
            system.report.ways_to_fall = interruptible(count, over=budget.over)
    except Overspent:
        return Outcome.CPU_LIMIT
    return Outcome.DONE if outcome == contract.DONE else Outcome.NO_EQUILIBRIUM


def make_ready(system: System, settings: StaticSettings, cost: float = ELIMINATED) -> None:
    """Put the numbers of a search in place, whose relaxation may cost so much."""
    system.make_room(control=Control.slots)
    C = Control(system.control)
    C[:] = 0
    for name in ("alimit", "tlimit", "error", "imbalance", "stability", "maxit"):
        setattr(C, name, getattr(settings, name))
    system.pattern = ints([word == "T" for word in settings.pattern])
    C.length = model_size(system)
    each = float(system.nz) ** 3 if system.elimination.pivoting else 0.0
    C.relaxations = RELAXATIONS if each * RELAXATIONS <= cost else int(cost / each)
    system.elimination.freeze(system.held_states)


def searched(system: System, budget: Budget) -> int:
    """The code of a search: a short one ends here, any other one begins again in a thread of its
    own and can be ended.

    Raises
    ------
    KeyboardInterrupt, Overspent
        By the user; when the CPU of the run is spent.
    """
    run, C = system.settings, Control(system.control)
    run.stop = False
    C.most, C.tried = max(1, SOON // max(system.nz, 1)), 0
    kept = posture(system)
    counts = system.count.newton, system.count.factorizations
    code = system.run(EQUILIBRIUM)
    if code == contract.DONE or C.tried < C.most:
        return code
    put_back(kept)
    system.count.newton, system.count.factorizations = counts
    C.most, C.tried = 0, 0
    stop = partial(setattr, run, "stop", True)
    return interruptible(partial(system.run, EQUILIBRIUM), stop, budget.over)


def posture(system: System) -> list[tuple[np.ndarray, np.ndarray]]:
    """What a search changes, and what it was."""
    return [(x, x.copy()) for x in (system.q, system.z, system.mu, system.base)]


def put_back(kept: list[tuple[np.ndarray, np.ndarray]]) -> None:
    """Let arrays be what they were."""
    for array, before in kept:
        array[:] = before


def ways_to_fall(system: System, stability: float) -> int:
    """Motions x exp(sqrt(sigma) t) that grow from the equilibrium: real sigma > ``stability`` with

        (A + sigma B) x = 0,    A = [K, G^T; G, 0], B = [M, 0; 0, 0]

    (variables and states beside the multipliers).  With T = (A + stability B)^-1 B, whose columns
    beyond q vanish, T x = x / (stability - sigma).

    The signs of pivots, which the search goes by, miscount where bodies without mass leave pivots
    of zero; they are what is left of a model of more than CONFIRMED unknowns.
    """
    if system.nz > CONFIRMED:
        return max(0, system.report.ways_to_fall)

    def matrix(stiffness: float, mass: float) -> np.ndarray:
        system.coef[:] = stiffness, 0.0, mass, stiffness, 0.0
        system.run(JACOBIAN, STATIC)
        return system.dense_jacobian()

    inertia, whole = matrix(0.0, 1.0), matrix(1.0, stability)
    used = [k for k in system.elimination.unknowns() if whole[k].any()]
    moved = [k for k in used if k < system.n]
    whole, inertia = whole[np.ix_(used, used)], inertia[np.ix_(used, moved)]
    found = np.linalg.eigvals(np.linalg.solve(whole, inertia)[: len(moved)])
    least = ROUND_OFF * float(np.abs(found).max(initial=0.0))
    return int(np.sum((found.real < -least) & (np.abs(found.imag) <= REAL * np.abs(found.real))))


def model_size(system: System) -> float:
    """Largest extent of the bodies' positions [length], at least the smallest positive number
    used.
    """
    centres = [system.q[system.starts[b] : system.starts[b] + 3] for b in range(len(system.mass))]
    if not centres:
        return 1.0
    reach = float(np.abs(np.array(centres)).max())
    return reach if reach > 0.0 else 1.0
