"""Motion in a plane is solved in the plane.

A model that starts in a plane across a coordinate axis (its bodies move in it and turn about its
normal) stays there as long as nothing drives it out. Coordinates out of the plane then keep their
values, the constraint rows that act on them alone carry nothing, and both are left out of the
matrix. Their equations are still evaluated with all others: where one is not fulfilled the plane
was an error, and the analysis begins again in space. So a run that reaches its end fulfils every
equation of the model in space.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np

from adamslite.analyses.initial.least_change import VELOCITIES
from adamslite.analyses.initial.sparse_rows import evaluated, pattern_of
from adamslite.integrators import contract
from adamslite.integrators.contract import ACCELERATIONS
from adamslite.model.model import PART

if TYPE_CHECKING:
    from adamslite.equations.system import System
    from adamslite.results.outcomes import Outcome

# Of the largest of their kind: speeds, accelerations, reactions and gradients below are round-off.
NOTHING = 1e-11
# Of the largest force, or 1 in the units of the deck.
LOOSE = 1e-10


def in_its_plane(system: System, run: Callable[[], Outcome]) -> Outcome:
    """Run in the plane of a model that has one; in space when it has none or leaves it."""
    if not reduce_to_plane(system):
        return run()
    from adamslite.analyses.dynamics.begun_again import Beginning

    beginning = Beginning(system)
    outcome = run()
    if not system.report.left_plane:
        return outcome
    beginning.return_to()
    return run()


def reduce_to_plane(system: System) -> bool:
    """Leave out what keeps a model in its plane; False when it has none, or nothing is gained.

    Blocks of point masses without constraints are quick as they are.
    """
    if not system.m or PART not in system.widths[: len(system.model.bodies)]:
        return False
    if system.run(ACCELERATIONS) != contract.DONE:
        return False
    system.report.left_plane = False
    for normal in range(3):
        out = _out_of_plane(system, normal)
        if _is_still(system.u, out) and _is_still(system.a, out):
            rows = _rows_out(system, out)
            if rows is not None:
                system.u[out] = system.a[out] = 0.0
                system.z[rows] = 0.0
                system.elimination.fold(out, rows, LOOSE * max(1.0, _largest_force(system)))
                return True
    return False


def _out_of_plane(system: System, normal: int) -> list[int]:
    """Coordinates along the normal, and turns about the two other axes."""
    found = []
    for body, i in zip(system.model.bodies, system.starts, strict=False):
        found.append(i + normal)
        if body.width == PART:
            found += [i + 3 + k for k in range(3) if k != normal]
    return found


def _is_still(values: np.ndarray, out: list[int]) -> bool:
    return bool(np.abs(values[out]).max() <= NOTHING * np.abs(values).max())


def _rows_out(system: System, out: list[int]) -> list[int] | None:
    """Constraint rows that act out of the plane and carry nothing; None when a row does both."""
    gradient = evaluated(system, pattern_of(system, True), *VELOCITIES)
    across = np.zeros(system.n, dtype=bool)
    across[out] = True
    beside, within = gradient.largest(across), gradient.largest(~across)
    away, inside = within <= NOTHING * beside, beside <= NOTHING * within
    if not (away | inside).all():
        return None
    rows = np.flatnonzero(away & ~inside).tolist()
    return rows if not rows or _is_still(system.z[: system.m], rows) else None


def _largest_force(system: System) -> float:
    reactions = np.abs(system.z[: system.m]).max()
    return float(max(reactions, system.mass.max() * np.abs(system.gravity).max()))
