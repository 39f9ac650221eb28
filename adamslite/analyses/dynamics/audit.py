"""The balance of energy of a run: set up before the run, evaluated after it.

A step whose error is ERROR max(1, |y|) in every component, positions and velocities alike, moves
the energy by the root of

    s^2 = sum (M u max(1, |u|))^2 + sum (f max(1, |x|))^2        times ERROR,

if errors of components do not know of each other; nor do those of steps, so that ERROR explains

    gap <= CONFIDENCE ERROR (sum over steps of s^2)^(1/2) + error of the audit's own integrals.

What goes beyond adds up one-sidedly, or is a force that a step did not see.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from adamslite.equations.engine import ints
from adamslite.integrators.audit_record import POINTS, ROWS_OF_GUARDS
from adamslite.integrators.contract import ACCELERATIONS, AUDIT
from adamslite.results.balance import Balance

if TYPE_CHECKING:
    from adamslite.equations.system import System

# Standard deviations within which a sum of independent errors stays.
CONFIDENCE = 3.0
# Round-off of a balance: this share of the largest energy, per step.
ROUND_OFF = 1e-15
# Net share of the loads below which they are taken for pairs.
INTERNAL = 1e-9
# Constraints that may drive the model.
DRIVING = ("MOTION", "GCON", "COUPLER")


def start_audit(system: System) -> None:
    """Begin a balance with the state at the start."""
    kept = [(name, getattr(system, name).copy()) for name in ("a", "z", "rd", "count", "report")]
    system.run(ACCELERATIONS)
    _make_room(system)
    system.run(AUDIT)
    for name, values in kept:
        getattr(system, name)[:] = values


def _make_room(system: System) -> None:
    A, n, m = system.audit, system.n, system.m
    rest, guards = m + system.nv + system.ns, system.guard.size - system.nw
    A.on, A.solved = True, _needs_solving(system)
    A.elastic = any(g.face == "stored" for g in system.kernels.groups)
    A.now[:] = A.before[:] = 0
    A.previous, A.previous_before, A.present = (np.zeros(system.W.size) for _ in range(3))
    A.curve, A.vectors = np.zeros(6 * n), np.zeros(2 * n + rest + system.ns)
    A.points = np.zeros(POINTS + (ROWS_OF_GUARDS + 1) * guards)
    A.matrix = np.zeros(system.elimination.LA.size)
    A.pivots = ints([0] * system.elimination.pivots_a.size)
    A.moving = np.zeros(m)
    for node, start, width in zip(system.nodes, system.starts, system.widths, strict=True):
        if node[0] in DRIVING:
            A.moving[start - n : start - n + width] = 1.0


def _needs_solving(system: System) -> bool:
    """Whether a load depends on multipliers, variables or accelerations, or a constraint drives."""
    if any(node[0] in DRIVING for node in system.nodes) or system.sizes.implicit_mass:
        return True
    loads = [g for g in system.kernels.groups if g.face == "loads"]
    return any(
        node[0] != "DIFF" for g in loads for _, binding in g.instances for node in binding.nodes
    )


def balance(system: System) -> Balance:
    """What the audit of the last run found."""
    A, steps = system.audit.now, system.count.steps
    explained = CONFIDENCE * float(np.sqrt(A.squares)) + float(A.quadrature)
    explained += ROUND_OFF * (steps + 1) * float(A.largest)
    return Balance(
        gap=float(A.worst), time=float(A.worst_at), explained=explained,
        energy=float(A.largest), created=float(A.most_created),
        created_at=float(A.created_at), momenta=_momenta(system), missed=A.missed,
    )  # fmt: skip


def _momenta(system: System) -> tuple[tuple[float, float], ...]:
    """Drift and explained drift of both momenta; empty when something external acts."""
    A = system.audit.now
    if system.gravity.any() or _is_held(system) or A.external > INTERNAL:
        return ()
    pairs = ((A.drift, A.pushes), (A.spin_drift, A.turns))
    return tuple((float(drift), CONFIDENCE * float(np.sqrt(s))) for drift, s in pairs)


def _is_held(system: System) -> bool:
    """Whether a constraint refers to ground."""
    for group in system.kernels.groups:
        if group.face == "reactions":
            for statement, binding in group.instances:
                places = [system.model.marker(marker) for marker in binding.markers]
                if statement.keyword == "GCON" or len(binding.bodies) < 2:
                    return True
                if any(place is None or place.kind == "ground" for place in places):
                    return True
    return False
