"""The corrector of sensitivities by backward differences: a linear system for each number.

    F_q dq + F_u du + F_a da + F_z dz + F_s' ds' + F_p = 0,    y' = (psi + d) cu

Its matrix K is that of Newton's method at the accepted state.  Made there it solves the system at
once.  One of an earlier step does so in a few iterations, each one tangent and one solution,

    y <- y - 2/(1 + c^2) K_old^-1 F(y),    c = cu/cu_old

(the eigenvalues of K_old^-1 K lie between 1, of stiff forces, and c^2, of inertia), until what is
left, rate/(1 - rate) times the last increment, is a small share of what the step itself is off by.
The rate is measured with every matrix, of the first iteration, which has to mend multipliers, and
of further ones; it grows as the matrix ages, at most with the square of its steps (motion that
begins at rest).  A matrix serves as long as the
further iterations of a step take less than a new one does on average.  Multipliers and variables
begin on the polynomial through their last values: an error of theirs is an error of places, by as
much as constraints have turned since.  In the stabilised form du = .. + W G^T dmu; mu itself is
nothing but error.

References: Caracotsios, Stewart, Comput. Chem. Eng. 9 (1985) 359 (staggered direct method);
Feehery, Tolsma, Barton, Appl. Numer. Math. 25 (1997) 41 (matrices kept).
"""

from __future__ import annotations

from adamslite.integrators.audit_record import TAPE_HEAD
from adamslite.integrators.bdf.state import tests_velocities
from adamslite.integrators.contract import Problem
from adamslite.integrators.implicit.formulation import equations_kept, is_stabilised
from adamslite.integrators.linalg.blocks import factor, solve
from adamslite.integrators.linalg.norms import largest_of
from adamslite.integrators.linalg.plan import TINY, Plan
from adamslite.integrators.motion_equations import jacobian, project_on_constraints, spread
from adamslite.integrators.newton import add_mixed_product
from adamslite.kernels.code.workspace import OMEGA
from adamslite.native.translate import Reals, copy, native
from adamslite.sensitivity.contract import Forward, Tangents
from adamslite.sensitivity.inverse import invert_small, is_small, times_small_inverse
from adamslite.sensitivity.tangents import clear, put_direction, spun, tangent

# A matrix serves for a step whose cu is within this ratio, for so many steps, and as long as so
# many iterations are enough.
KEEP_RATIO, KEEP_STEPS, MOST = 0.02, 20, 5
# A matrix takes as long as so many iterations.
DEAR = 7.0
# Of the iterations in the first step with an old matrix so much is remembered with each new one.
REMEMBERED = 0.9
# A worse rate of convergence requires a new matrix.
WORST_RATE = 0.5
# No rate is believed to be better than this.
LEAST_RATE = 1e-3
# What iterations may leave, as a share of the error that is estimated for the step.
LEFT = 0.1
# Multipliers and variables are continued by the polynomial through so many values.
KEPT = 4


@native
def outdated(S: Forward, cu: float) -> bool:
    """Whether a new matrix is due."""
    if S.exact or S.factored == 0.0 or S.age >= KEEP_STEPS:
        return True
    if abs(cu / S.factored - 1.0) > KEEP_RATIO:
        return True
    likely = float(S.extra) if S.age > 1 else S.first
    return likely * float(S.age) > DEAR + float(S.spare)


@native
def renewed(P: Problem, L: Plan, S: Forward, cu: float) -> bool:
    """A new matrix; False when it is singular."""
    for k in range(S.slope.size):
        S.slope[k] = 1.0
    S.age, S.extra, S.spare, S.first, S.factored = 0, 0, 0, REMEMBERED * S.first, cu
    S.matrices += 1
    S.inverted = is_small(L) and not S.exact
    if S.inverted:
        put_matrix(P, cu)
        return invert_small(L, P.LV, P.pivots)
    return matrix(P, L, cu)


@native
def grown_older(S: Forward, extra: int) -> None:
    """Count a step and the iterations that it took beyond one for each number."""
    if S.age == 1:
        S.first = float(extra)
    S.age, S.extra, S.spare = S.age + 1, extra, S.spare + extra


@native
def corrected(
    P: Problem, L: Plan, D: Tangents, S: Forward, number: int, cu: float, order: int, here: Reals
) -> int:
    """Sensitivities from the prediction: the first three rows of ``S.y`` hold it, psi, and where
    they are to stand.  The iterations that it took; beyond ``MOST`` when the matrix is too old.
    """
    y, last, slopes = S.y[2 * S.width :], 0.0, S.slope[2 * number :]
    guess(P, S, number)
    motion(P, S, cu)
    for turn in range(MOST):
        put_direction(P, D, y, S.a, S.z, S.sd, 0.0)
        tangent(P, D, number, equations_kept(P), P.F)
        if S.inverted:
            times_small_inverse(L, P.LV, P.pivots, P.F, P.x, P.work)
        else:
            solve(L, P.LV, P.pivots, P.F, P.x, P.work)
        size = apply(P, S, cu)
        copy(P.x, y[P.sizes.n :], P.sizes.n)
        motion(P, S, cu)
        if is_stabilised(P):
            add_corrections(P, S, cu, here)
        if S.age == 0:
            keep(P, S, number)
            return 1
        rate, age = 1.0, float(S.age * S.age)
        if turn > 0:
            rate = size / max(last, TINY)
            slopes[min(turn - 1, 1)] = rate / age
        rate = max(LEAST_RATE, min(rate, slopes[min(turn, 1)] * age))
        if is_near(P, S, number, cu, order, size, min(1.0, rate / (1.0 - min(rate, WORST_RATE)))):
            keep(P, S, number)
            return turn + 1
        if turn > 1 and rate > WORST_RATE:
            keep(P, S, number)
            return turn + 1 if size <= S.floor[number] else MOST + 1
        last = size
    return MOST + 1


@native
def guess(P: Problem, S: Forward, number: int) -> None:
    """Predicted sensitivities; multipliers and variables continued, no correction of places and
    velocities so far.
    """
    w, first = S.width, P.sizes.m + P.sizes.nv
    copy(S.y[2 * w :], S.y, w)
    clear(S.z, first)
    for row in range(S.known):
        share, old = S.share[row], S.kept[(number * KEPT + row) * first :]
        for k in range(first):
            S.z[k] += share * old[k]
    clear(S.mu, P.sizes.holonomic)
    clear(S.v, P.sizes.n)


@native
def keep(P: Problem, S: Forward, number: int) -> None:
    """Remember multipliers and variables in place of the oldest."""
    first = P.sizes.m + P.sizes.nv
    copy(S.kept[(number * KEPT + S.oldest) * first :], S.z, first)


@native
def continued(S: Forward, t: float) -> None:
    """Shares of the values that are kept in those at time ``t``, of the polynomial through them
    (Lagrange).
    """
    for i in range(S.known):
        S.share[i] = 1.0
        for j in range(S.known):
            if j != i:
                S.share[i] *= (t - S.when[j]) / (S.when[i] - S.when[j])


@native
def kept_at(S: Forward, t: float) -> None:
    """The values of all numbers at time ``t`` are kept."""
    S.when[S.oldest] = t
    S.known = max(S.known, S.oldest + 1)
    S.oldest = (S.oldest + 1) % KEPT


@native
def forgotten(S: Forward) -> None:
    """Neither a matrix nor multipliers, where motion begins anew."""
    S.factored, S.known, S.oldest = 0.0, 0, 0


@native
def motion(P: Problem, S: Forward, cu: float) -> None:
    """Velocities, accelerations and rates of states from the increments of places and states."""
    n, ns, w = P.sizes.n, P.sizes.ns, S.width
    yp, psi, y, v = S.y[0:], S.y[w:], S.y[2 * w :], S.y[3 * w :]
    for i in range(n):
        v[i] = (psi[i] + S.v[i]) * cu
    spun(P, y, v, -1.0, y[n:])
    for i in range(n):
        S.a[i] = (psi[n + i] + y[n + i] - yp[n + i]) * cu
    for k in range(ns):
        i = 2 * n + k
        S.sd[k] = (psi[i] + y[i] - yp[i]) * cu


@native
def add_corrections(P: Problem, S: Forward, cu: float, here: Reals) -> None:
    """u += W G^T mu, and accelerations accordingly; multipliers of the workspace are put back."""
    u, change = S.y[2 * S.width + P.sizes.n :], P.F
    project_on_constraints(P, S.mu, change)
    for i in range(P.sizes.n):
        u[i] += change[i]
        S.a[i] += change[i] * cu
    for k in range(P.sizes.m):
        P.W[P.scalar[k]] = here[TAPE_HEAD + P.scalar[k]]


@native
def apply(P: Problem, S: Forward, cu: float) -> float:
    """Subtract the increments in ``F``; the largest of places, turns and states."""
    n, ns, rest = P.sizes.n, P.sizes.ns, P.sizes.n + P.sizes.m + P.sizes.nv
    c, y, F = cu / S.factored, S.y[2 * S.width :], P.F
    ratio = 2.0 / (1.0 + c * c)
    for i in range(P.sizes.nz):
        F[i] *= ratio
    for i in range(n):
        y[i] -= F[i]
        S.v[i] -= F[i]
    for k in range(n, rest):
        S.z[k - n] -= F[k]
    for k in range(ns):
        y[2 * n + k] -= F[rest + k]
    for k in range(rest + ns, P.sizes.nz):
        S.mu[k - rest - ns] -= F[k]
    return max(largest_of(F, n), largest_of(F[rest:], ns))


@native
def is_near(
    P: Problem, S: Forward, number: int, cu: float, order: int, size: float, left: float
) -> bool:
    """Whether the share ``left`` of the last increments is little: of places and states, ``size``,
    and of velocities, before which these stand in ``P.x``.
    """
    n, ns, share = P.sizes.n, P.sizes.ns, LEFT / (order + 1)
    yp, y = S.y[0:], S.y[2 * S.width :]
    error = max(largest_of(S.v, n), largest_gap(y[2 * n :], yp[2 * n :], ns))
    if left * size > max(S.limit * S.top[2 * number], share * error):
        return False
    if not tests_velocities(P) and not is_stabilised(P):
        return True
    error = largest_gap(y[n:], yp[n:], n)
    moved = largest_gap(y[n:], P.x, n)
    return left * moved <= max(S.limit * S.top[2 * number + 1], share * error)


@native
def largest_gap(x: Reals, y: Reals, count: int) -> float:
    """The largest |x - y|."""
    top = 0.0
    for i in range(count):
        top = max(top, abs(x[i] - y[i]))
    return top


@native
def matrix(P: Problem, L: Plan, cu: float) -> bool:
    """Factor the derivative of the equations by the increments at the workspace's state."""
    put_matrix(P, cu)
    return factor(L, P.LV, P.pivots, P.work)


@native
def put_matrix(P: Problem, cu: float) -> None:
    """The derivative itself."""
    c, phases = P.coef, equations_kept(P)
    c[0], c[1], c[2], c[3], c[4] = 1.0, cu, cu * cu, 1.0, cu
    jacobian(P, phases, c, P.J)
    if P.turning.size or P.mixed.size:
        c[0], c[1], c[2], c[3], c[4] = 0.0, 1.0, cu, 0.0, 0.0
        jacobian(P, phases, c, P.D)
        for k in range(0, P.turning.size, 4):
            add_spin(P, k, P.J, P.D)
        for k in range(0, P.mixed.size, 8):
            add_mixed_product(P, k, P.J, P.D, P.J)
    spread(P, P.LV)


@native
def add_spin(P: Problem, entry: int, J: Reals, D: Reals) -> None:
    """J[:, 3:6] -= D[:, 3:6] [w] on the rows and columns of an entry of ``P.turning``."""
    at, rows = P.turning[entry], P.turning[entry + 1]
    o = P.body[P.turning[entry + 2]].at + OMEGA
    w0, w1, w2 = P.W[o], P.W[o + 1], P.W[o + 2]
    for r in range(rows):
        k = at + 6 * r
        d0, d1, d2 = D[k + 3], D[k + 4], D[k + 5]
        J[k + 3] -= d1 * w2 - d2 * w1
        J[k + 4] -= d2 * w0 - d0 * w2
        J[k + 5] -= d0 * w1 - d1 * w0
