"""Accelerations, multipliers, variables and DIFF rates at given positions, velocities and states.

    F(t, q, u, a, lam, V, s') = 0,   d2g/dt2 = 0        solved by Newton for (a, lam, V, s')

Its matrix [M - df/da, G^T; G, 0] loses rank when a force that depends on accelerations cancels the
inertia; :func:`mass_signature` sees that between two steps.  Where nothing couples them,
accelerations follow body by body (:mod:`adamslite.integrators.unconstrained`).
"""

from __future__ import annotations

from adamslite.integrators.contract import ACCELERATION, MODE_DYNAMICS, Problem
from adamslite.integrators.effective_mass import effective_masses, signature_of_masses
from adamslite.integrators.failure_notes import note_trouble
from adamslite.integrators.linalg.blocks import factor, signature, solve
from adamslite.integrators.linalg.plan import HUGE, Plan
from adamslite.integrators.motion_equations import (
    jacobian,
    put_motion,
    put_pose,
    put_scalars,
    put_time,
    residual,
    spread,
)
from adamslite.integrators.unconstrained import invert_bodies, is_free, times_inverse
from adamslite.native.translate import Reals, native

MAX_ITERATIONS = 12
ROUND_OFF = 1e-11
# Increments below this that no longer shrink are round-off of a badly conditioned matrix.
STALLED = 1e-7
# The size of an increment that is not finite: beyond HUGE.
NOT_A_NUMBER = 1e301
# The equations are linear but for loops of variables: a worse rate of convergence requires a new
# matrix.
SLOW = 0.03
# A pivot of the acceleration matrix below this share of its first value has vanished.
VANISHING = 1e-3
# A pivot that others have brought down to this share of what it was is round-off.
LATE = 1e-11


@native
def put_state(P: Problem, t: float, q: Reals, u: Reals, a: Reals, z: Reals, sd: Reals) -> None:
    """A whole state into the workspace."""
    P.W[1] = MODE_DYNAMICS
    put_time(P, t)
    put_pose(P, q)
    put_motion(P, u, a)
    put_scalars(P, z, sd)


@native
def acceleration_matrix(P: Problem) -> None:
    """dF/d(a, lam, V, s') spread into ``P.LA``."""
    c = P.coef
    c[0], c[1], c[2], c[3], c[4] = 0.0, 0.0, 1.0, 1.0, 1.0
    jacobian(P, ACCELERATION, c, P.J)
    spread(P, P.LA)
    for k in range(P.unit.size):
        P.LA[P.unit[k]] = 1.0
    P.count.factorizations += 1


@native
def factor_accelerations(P: Problem, L: Plan) -> bool:
    """The matrix of the accelerations at the workspace's state, factored; False when singular."""
    if is_free(P):
        P.count.jacobians += 1
        P.count.factorizations += 1
        return invert_bodies(P, P.LA)
    acceleration_matrix(P)
    return factor(L, P.LA, P.pivots_a, P.work)


@native
def solve_accelerations(P: Problem, L: Plan) -> None:
    """Replace ``P.F`` by the solution with the matrix of :func:`factor_accelerations`."""
    if is_free(P):
        times_inverse(P, P.LA, P.F)
    else:
        solve(L, P.LA, P.pivots_a, P.F, P.x, P.work)


@native
def accelerations(
    P: Problem, L: Plan, t: float, q: Reals, u: Reals, a: Reals, z: Reals, sd: Reals
) -> bool:
    """Solve for a, lam, V and s' in place; False when the matrix is singular or Newton fails."""
    put_state(P, t, q, u, a, z, sd)
    return factor_accelerations(P, L) and settle(P, L, u, a, z, sd)


@native
def settle(P: Problem, L: Plan, u: Reals, a: Reals, z: Reals, sd: Reals) -> bool:
    """Newton at the workspace's state with the matrix that is factored, renewed when it is slow."""
    last = HUGE
    for iteration in range(MAX_ITERATIONS):
        P.report.iteration = iteration + 1
        residual(P, ACCELERATION, P.F)
        for k in range(P.sizes.nz - P.sizes.n - P.sizes.m - P.sizes.nv - P.sizes.ns):
            P.F[P.sizes.nz - 1 - k] = 0.0
        solve_accelerations(P, L)
        size = correct_rates(P, a, z, sd)
        if not size < HUGE:
            break
        put_motion(P, u, a)
        put_scalars(P, z, sd)
        if size <= ROUND_OFF or (iteration > 1 and size >= 0.5 * last and size < STALLED):
            return True
        if iteration > 0 and size > SLOW * last:
            if not factor_accelerations(P, L):
                return False
        last = size
    note_trouble(P, ACCELERATION, P.report.iteration)
    return False


@native
def correct_rates(P: Problem, a: Reals, z: Reals, sd: Reals) -> float:
    """Subtract the increment in ``P.F``; returns its size against the largest unknown of a kind."""
    n, algebraic = P.sizes.n, P.sizes.m + P.sizes.nv
    change, top = 0.0, 0.0
    for k in range(n):
        a[k] -= P.F[k]
        change, top = max(change, abs(P.F[k])), max(top, abs(a[k]))
    size = change / max(1.0, top)
    change, top = 0.0, 0.0
    for k in range(algebraic):
        z[k] -= P.F[n + k]
        change, top = max(change, abs(P.F[n + k])), max(top, abs(z[k]))
    for k in range(P.sizes.ns):
        sd[k] -= P.F[n + algebraic + k]
        change, top = max(change, abs(P.F[n + algebraic + k])), max(top, abs(sd[k]))
    size = max(size, change / max(1.0, top))
    for k in range(n + algebraic + P.sizes.ns):
        if not abs(P.F[k]) < HUGE:
            return NOT_A_NUMBER
    return size


@native
def mass_signature(P: Problem, L: Plan, found: Reals) -> int:
    """Negative pivots of the acceleration matrix at the workspace's state; -1 when singular."""
    if P.sizes.added_mass and P.sizes.nz == P.sizes.n:
        P.count.jacobians += 1
        P.count.factorizations += 1
        effective_masses(P, P.J)
        return signature_of_masses(P, P.J, found, LATE)
    acceleration_matrix(P)
    return signature(L, P.LA, P.pivots_a, P.work, found, LATE)


@native
def mass_vanishes(P: Problem, L: Plan, before: int) -> bool:
    """Whether the acceleration matrix at the workspace's state has lost a pivot since the start, or
    is close to it; ``before`` is its last signature.
    """
    if not P.sizes.implicit_mass:
        return False
    if mass_signature(P, L, P.x) != before:
        return True
    for k in range(P.sizes.nz):
        if not abs(P.x[k]) >= VANISHING * abs(P.pivot0[k]):
            return True
    return False
