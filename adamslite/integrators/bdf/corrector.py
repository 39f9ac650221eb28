"""The corrector of the backward differences: Newton from the prediction, d = y - y_p.

    y' = (psi + d) cu,    cu = gamma_k / h

A matrix factored with another cu serves on; its increments are multiplied by 2/(1 + cu/cu_old).
Iterations stop when rate/(1 - rate) times the last increment is a small share of ERROR, and fail
when increments do not shrink.
Reference: Brenan, Campbell, Petzold, Numerical Solution of IVP in DAE, 1996, section 5.2.
"""

from __future__ import annotations

from adamslite.integrators.bdf.control import Control
from adamslite.integrators.bdf.state import tests_velocities
from adamslite.integrators.contract import Problem
from adamslite.integrators.implicit.formulation import equations_kept, is_stabilised
from adamslite.integrators.implicit.tolerance import error_limit
from adamslite.integrators.linalg.blocks import solve
from adamslite.integrators.linalg.plan import Plan
from adamslite.integrators.motion_equations import (
    project_on_constraints,
    put_motion,
    put_pose,
    put_scalars,
    residual,
    velocities,
)
from adamslite.integrators.newton import (
    ROUND_OFF,
    SHRINKING,
    apply_increment,
    increment_norm,
    multiplier_change,
    newton_matrix,
    renews,
    serves,
    unresisted_change,
    velocity_change,
    weigh_residuals,
)
from adamslite.integrators.stepping.outcome import OVERFLOW
from adamslite.native.translate import Reals, native

# Newton stops when the estimated remaining error is this share of ERROR.
CORRECTOR_SHARE = 0.02
# What inertia alone makes of the residual that is left, as a share of ERROR, whatever the matrix:
# as much as the error test admits, and CORRECTOR_SHARE where velocities are not tested.
FELT = 1.0
# Near a singular posture round-off keeps increments of velocities from shrinking further, to less
# than this of the one before: with a new matrix this share of ERROR is as good as it gets.
STALLED, STALL_SHARE = 0.5, 0.2
# Increments that shrink by less than this do not converge within a reasonable number.
SLOWEST = 0.9
# The factored matrix is kept while its cu is within this ratio of the present one.
KEEP_RATIO = 0.25
# ... and for this many steps.
KEEP_STEPS = 20.0
# The rate of convergence is not believed to be better than this, and is doubted twice as much
# after every step that needed one iteration, because the matrix grows old unseen.
LEAST_RATE = 0.02
# ... or worse than this, at which the remaining error is that of the last increment anyway.
WORST_RATE = 0.999


@native
def motion_from_increments(P: Problem, cu: float, yp: Reals, psi: Reals, si2: bool) -> None:
    """u and a from the increments e of q, the history and (stabilised form) mu; writes the
    workspace; v = q' to trial, before e.

    q - q_p would do in place of e but for the round-off of q, which small steps divide by h.
    """
    n = P.sizes.n
    w = 2 * n + P.sizes.ns
    q, u, a, v, e = P.q, P.u, P.a, P.trial[2 * w :], P.trial[2 * w + n :]
    for i in range(n):
        v[i] = (psi[i] + e[i]) * cu
    put_pose(P, q)
    velocities(P, q, v, u)
    if si2:
        project_on_constraints(P, P.mu, P.F)
        for i in range(n):
            u[i] += P.F[i]
    for i in range(n):
        a[i] = (psi[n + i] + u[i] - yp[n + i]) * cu
    put_motion(P, u, a)
    first = P.sizes.m + P.sizes.nv
    for k in range(P.sizes.ns):
        P.rd[k] = (psi[2 * n + k] + P.z[first + k] - yp[2 * n + k]) * cu
    put_scalars(P, P.z, P.rd)


@native
def correct(P: Problem, L: Plan, C: Control) -> bool:
    """Newton iterations from the predictor; True when converged."""
    cu, phases, si2 = C.cu, equations_kept(P), is_stabilised(P)
    n, w = P.sizes.n, C.width
    yp, psi, v, e = P.trial[0:], P.trial[w:], P.trial[2 * w :], P.trial[2 * w + n :]
    error = error_limit(P, P.settings.fixed_step)
    tolerance = CORRECTOR_SHARE * error + P.settings.adaptivity / C.h
    tested = cu if tests_velocities(P) else 0.0
    share = FELT if tested > 0.0 else CORRECTOR_SHARE
    last, felt, made, renew, small = 0.0, 0.0, -1, False, False
    motion_from_increments(P, cu, yp, psi, si2)
    reach = weigh_residuals(P, 1.0 / (cu * cu), tested / (cu * cu))
    noise = ROUND_OFF * reach * cu
    for iteration in range(P.settings.max_it):
        P.report.iteration = iteration + 1
        if renew or not fits_step(C) or renews(P, iteration, C.age < KEEP_STEPS):
            if not newton_matrix(P, L, phases, cu, P.q, v, P.u):
                C.factored = 0.0
                return False
            C.factored, C.rate, C.fresh, C.age = cu, 1.0, True, 0
            made, renew = iteration, False
        residual(P, phases, P.F)
        before, felt = felt, unresisted_change(P, 1.0 / cu)
        if small and serves(felt, before, tolerance / CORRECTOR_SHARE, share):
            return True
        solve(L, P.LV, P.pivots, P.F, P.x, P.work)
        scale_increment(P, 2.0 / (1.0 + cu / C.factored))
        size = increment_norm(P, P.F, tested, si2, reach)
        apply_increment(P, P.F, P.q, P.z, P.mu, si2)
        for i in range(n):
            P.x[i] = P.u[i]
            e[i] -= P.F[i]
            # One rounding for all: noise of q is noise of forces.
            P.q[i] = P.history[i] + (yp[i] + e[i])
        motion_from_increments(P, cu, yp, psi, si2)
        # What an old matrix leaves open shrinks, noise does not: the first change is no noise.
        size = max(size, further_change(P, cu, noise if iteration > 0 else 0.0, si2))
        P.count.newton += 1
        if iteration > 0 and made < iteration:
            C.rate = max(LEAST_RATE, size / last)
        small = is_small(C, size, error, tolerance, iteration)
        if small:
            if made == iteration or serves(felt, before, tolerance / CORRECTOR_SHARE, share):
                C.rate = min(1.0, 2.0 * C.rate) if iteration == 0 else C.rate
                return True
            renew = iteration > 0 and felt > SHRINKING * before
        elif not size < OVERFLOW or (C.rate > SLOWEST and iteration > 0):
            return False
        last = size
    return False


@native
def is_small(C: Control, size: float, error: float, tolerance: float, iteration: int) -> bool:
    """Whether what is left after an increment of ``size`` may be left."""
    if iteration > 1 and C.rate > STALLED and C.fresh and size <= STALL_SHARE * error:
        return True
    return remaining(C, size) <= tolerance


@native
def further_change(P: Problem, cu: float, noise: float, si2: bool) -> float:
    """What an increment changed besides positions: velocities in the stabilised form (``P.x``:
    those before) above ``noise`` and, with CORRECTOR=ORIGINAL, multipliers.
    """
    size = velocity_change(P, P.x, noise) if si2 else 0.0
    if P.settings.all_converge:
        size = max(size, multiplier_change(P, P.F, P.z, cu * cu))
    return size


@native
def remaining(C: Control, size: float) -> float:
    """Error left after an increment of ``size`` when increments shrink by RATE each time."""
    return size * min(1.0, C.rate / (1.0 - min(C.rate, WORST_RATE)))


@native
def fits_step(C: Control) -> bool:
    """Whether there is a factored matrix for about this cu."""
    return C.factored != 0.0 and abs(C.cu / C.factored - 1.0) <= KEEP_RATIO


@native
def scale_increment(P: Problem, ratio: float) -> None:
    """Correct the increment for a matrix factored with another cu (Brenan et al., eq. 5.2.12)."""
    if ratio != 1.0:
        for k in range(P.sizes.nz):
            P.F[k] *= ratio
