"""The state of the BDF between steps: its history, and the last accepted state.

D_0 = y and D_1 = h y' start a history of order 1.
"""

from __future__ import annotations

from adamslite.integrators.accelerations import put_state
from adamslite.integrators.bdf.control import Control
from adamslite.integrators.bdf.differences import change_step
from adamslite.integrators.contract import Problem
from adamslite.integrators.motion_equations import vector_rates
from adamslite.native.translate import native


@native
def start_values(P: Problem, C: Control) -> None:
    """Order 1: D_0 = y, D_1 = h y'."""
    D, n, w, h = P.history, P.sizes.n, C.width, C.h
    first = P.sizes.m + P.sizes.nv
    for k in range(P.history.size):
        D[k] = 0.0
    rates = P.trial[0:]
    vector_rates(P, P.q, P.u, rates)
    for i in range(n):
        D[i], D[n + i] = P.q[i], P.u[i]
        D[w + i], D[w + n + i] = h * rates[i], h * P.a[i]
    for k in range(P.sizes.ns):
        D[2 * n + k] = P.z[first + k]
        D[w + 2 * n + k] = h * P.rd[k]


@native
def forget_multipliers(P: Problem) -> None:
    """Multipliers of the accepted state are those of the one before, too."""
    for i in range(P.z.size):
        P.pz[i] = P.rz[i]


@native
def resize(P: Problem, C: Control, factor: float) -> None:
    """Change the step and with it the history."""
    change_step(P.history, C.width, C.order, factor)
    C.h *= factor
    C.equal = 0


@native
def tests_velocities(P: Problem) -> bool:
    """Whether errors of velocities are tested: they are not in index 3, where those of constrained
    directions are round-off over the step.
    """
    return P.sizes.si2 or P.sizes.holonomic == 0


@native
def restore_state(P: Problem, C: Control) -> None:
    """The accepted state into the unknowns and the workspace."""
    D, n, first = P.history, P.sizes.n, P.sizes.m + P.sizes.nv
    for i in range(n):
        P.q[i], P.u[i], P.a[i] = D[i], D[n + i], P.ra[i]
    for i in range(first):
        P.z[i] = P.rz[i]
    for i in range(P.sizes.ns):
        P.z[first + i] = D[2 * n + i]
    put_state(P, C.t, P.q, P.u, P.a, P.z, P.rd)
