"""Static equilibrium: F(q, 0, 0, lam, V, s) = 0, g(q) = 0, ds/dt = 0.

Newton with limited increments on [K + sigma (M + C), G^T; G, 0]; sigma is the small STABILITY at
first. When that does not settle, dynamic relaxation: implicit Euler steps from rest, the velocity
dropped after each (pseudo-transient continuation), sigma = 1/h^2 with a step h that grows while it
works.  Each step lowers the potential energy, so this ends in a stable equilibrium, and with h ->
infinity it is Newton.  It also follows when Newton went far and ended where the stiffness has a
negative direction: folded cables, links in compression.

References: Kelley, Keyes, SIAM J. Numer. Anal. 35 (1998) 508 (continuation); Day, The Engineer 219
(1965) 218 (relaxation); Wittrick, Williams, Quart. J. Mech. Appl. Math. 24 (1971) 263 (signs).
"""

from __future__ import annotations

from adamslite.integrators.accelerations import put_state
from adamslite.integrators.contract import DONE, MODE_STATICS, NOT_SETTLED, STATIC, Problem
from adamslite.integrators.equilibrium_control import Control
from adamslite.integrators.linalg.blocks import factor, signature, solve
from adamslite.integrators.linalg.norms import exceeds
from adamslite.integrators.linalg.plan import HUGE, TINY, Plan
from adamslite.integrators.motion_equations import PART, jacobian, put_pose, residual, spread
from adamslite.integrators.newton import apply_increment
from adamslite.native.translate import copy, native, rare

GROWTH, UPHILL = 1.6, 4.0
# An equilibrium is far from the start beyond this share of the model, or this turn [rad].
FAR = 0.02
# Weight of the stiffness where only the inertia shall count.
SMALL = 1e-13
# Weight of the inertia after a singular matrix, at least.
LEAST_SIGMA = 1e-8
# Accelerations below this are none.
AT_REST = 1e-12
# A larger number is none to form products of.
LARGE = 1e200
# A correction below this share of the model, or angle [rad], is the rounding of the coordinates.
ROUNDED = 1e-14
# Constraints are closed to this share of the tolerance.
CLOSED = 1e-3


@native
@rare
def equilibrium(P: Problem, L: Plan) -> int:
    """Move to the nearest equilibrium; DONE or NOT_SETTLED."""
    C = Control(P.control)
    keep_start(P)
    if newton(P, L) and not (wandered(P) and unstable_ways(P, L) != 0):
        return noted(P, L)
    if C.found:
        # Newton finds unstable equilibria as well as stable ones, and here it went far to do so.
        back_to_start(P)
    if relaxed(P, L):
        return noted(P, L)
    return NOT_SETTLED


@native
def newton(P: Problem, L: Plan) -> bool:
    """Limited Newton steps; True when settled."""
    C = Control(P.control)
    C.sigma, C.found = C.stability, False
    renews = True
    for iteration in range(C.maxit):
        if given_up(P):
            return False
        if not static_step(P, L, renews):
            C.sigma, renews = max(10.0 * C.sigma, LEAST_SIGMA), True
        elif settled(P):
            C.found = True
            return True
        elif P.pattern.size > 0:
            renews = P.pattern[(iteration + 1) % P.pattern.size] != 0
    return False


@native
def relaxed(P: Problem, L: Plan) -> bool:
    """Relaxation from where the model is; True when settled."""
    C = Control(P.control)
    C.sigma = first_sigma(P)
    last, signs = HUGE, pivot_signs(P, L, SMALL, 1.0)
    for _iteration in range(C.relaxations):
        if given_up(P):
            return False
        if signs >= 0 and pivot_signs(P, L, 1.0, C.sigma) != signs:
            # Too long a step: it would go uphill, to an unstable equilibrium.
            C.sigma *= UPHILL
        elif not static_step(P, L, True):
            C.sigma *= 16.0
            if C.sigma > HUGE:
                return False  # no step is short enough: it is not the bodies that are singular
        elif settled(P):
            return True
        elif C.worst > 10.0 * last:
            C.sigma *= 16.0
        else:
            C.sigma /= GROWTH * GROWTH
        last = C.worst
    return False


@native
def given_up(P: Problem) -> bool:
    """Whether the search is to end before another iteration."""
    C = Control(P.control)
    if P.settings.stop or (C.most > 0 and C.tried >= C.most):
        return True
    C.tried += 1
    return False


@native
def noted(P: Problem, L: Plan) -> int:
    """DONE, with the number of ways in which the equilibrium is unstable in the report."""
    P.report.ways_to_fall = unstable_ways(P, L)
    imbalance(P)
    return DONE


@native
def keep_start(P: Problem) -> None:
    """Remember the posture the search begins with."""
    copy(P.history, P.q, P.q.size)
    for i in range(P.base.size):
        P.history[P.q.size + i] = P.base[i]


@native
def back_to_start(P: Problem) -> None:
    """The posture the search began with."""
    copy(P.q, P.history, P.q.size)
    for i in range(P.base.size):
        P.base[i] = P.history[P.q.size + i]


@native
def wandered(P: Problem) -> bool:
    """Whether the posture is far from the one the search began with."""
    C = Control(P.control)
    n, away = P.q.size, 0.0
    for b in range(P.sizes.nb):
        i = P.body[b].first
        for k in range(3):
            away = max(away, abs(P.q[i + k] - P.history[i + k]) / C.length)
        for k in range(9):
            away = max(away, abs(P.base[9 * b + k] - P.history[n + 9 * b + k]))
    return away > FAR


@native
def unstable_ways(P: Problem, L: Plan) -> int:
    """Difference between the negative pivots of [K, G^T; G, 0] and of [M, G^T; G, 0].

    K + sigma M becomes singular once for every sigma > 0 with a motion that grows like
    exp(sqrt(sigma) t), and changes the sign of one pivot there.  Less than none means that forces
    without a potential, or inertias near zero, leave the signs of pivots without that meaning.
    """
    C = Control(P.control)
    stiff = pivot_signs(P, L, 1.0, C.stability)
    heavy = pivot_signs(P, L, SMALL, 1.0)
    return max(stiff - heavy, 0) if stiff >= 0 and heavy >= 0 else 0


@native
def pivot_signs(P: Problem, L: Plan, stiffness: float, mass: float) -> int:
    """Negative pivots of the matrix of an equilibrium with K and M weighted."""
    c = P.coef
    imbalance(P)
    c[0], c[1], c[2], c[3], c[4] = stiffness, 0.0, mass, 1.0, 0.0
    jacobian(P, STATIC, c, P.J)
    spread(P, P.LV)
    for k in range(P.unit.size):
        P.LV[P.unit[k]] = 1.0
    P.count.factorizations += 1
    return signature(L, P.LV, P.pivots, P.work, P.x, 0.0)


@native
def first_sigma(P: Problem) -> float:
    """1/h^2 for a step that moves the most accelerated body by a hundredth of the model."""
    C = Control(P.control)
    imbalance(P)
    fastest = AT_REST
    for b in range(P.sizes.nb):
        i = P.body[b].first
        if P.mass[b] > 0.0:
            for k in range(3):
                fastest = max(fastest, abs(P.F[i + k]) / P.mass[b])
    return 100.0 * fastest / C.length


@native
def imbalance(P: Problem) -> None:
    """Residual at rest; the largest force left over is the worst."""
    C = Control(P.control)
    n = P.sizes.n
    for i in range(n):
        P.u[i] = 0.0
        P.a[i] = 0.0
    for i in range(P.rd.size):
        P.rd[i] = 0.0
    put_state(P, P.settings.t, P.q, P.u, P.a, P.z, P.rd)
    P.W[1] = MODE_STATICS
    residual(P, STATIC, P.F)
    worst = 0.0
    for i in range(n):
        if exceeds(abs(P.F[i]), worst):
            worst = abs(P.F[i])
    C.worst = worst


@native
def static_step(P: Problem, L: Plan, renews: bool) -> bool:
    """One limited Newton step, with the matrix of the last one unless it ``renews`` it; False when
    the matrix is singular or the residual is not finite.
    """
    C = Control(P.control)
    c = P.coef
    imbalance(P)
    if not C.worst < LARGE:
        return False
    P.count.newton += 1
    if renews:
        c[0], c[1], c[2], c[3], c[4] = 1.0, 0.0, C.sigma, 1.0, 0.0
        jacobian(P, STATIC, c, P.J)
        spread(P, P.LV)
        for k in range(P.unit.size):
            P.LV[P.unit[k]] = 1.0
        P.count.factorizations += 1
        if not factor(L, P.LV, P.pivots, P.work):
            return False
    solve(L, P.LV, P.pivots, P.F, P.x, P.work)
    return limited_move(P)


@native
def limited_move(P: Problem) -> bool:
    """Apply the increment in P.F, shortened to TLIMIT and ALIMIT; attitudes are counted from the
    new ones.
    """
    C = Control(P.control)
    shrink, moved, shift = 1.0, 0.0, 0.0
    for b in range(P.sizes.nb):
        i, kind = P.body[b].first, P.body[b].width
        for k in range(kind):
            size = abs(P.F[i + k])
            moved = max(moved, size / max(1.0, abs(P.q[i + k])))
            shift = max(shift, size / C.length if k < 3 else size)
            if not size < LARGE:
                return False
            limit = C.tlimit if k < 3 else C.alimit
            shrink = min(shrink, limit / max(size, TINY))
    C.moved, C.shift = states_moved(P, moved), states_moved(P, shift)
    if shrink < 1.0:
        for i in range(P.sizes.n):
            P.F[i] *= shrink
    apply_increment(P, P.F, P.q, P.z, P.mu, False)
    put_pose(P, P.q)
    for b in range(P.sizes.nb):
        if P.body[b].width == PART:
            o = P.body[b].at
            for k in range(9):
                P.base[9 * b + k] = P.W[o + 15 + k]
            for k in range(3, 6):
                P.q[P.body[b].first + k] = 0.0
    return True


@native
def states_moved(P: Problem, moved: float) -> float:
    """The largest of ``moved`` and the relative increments of states in P.F."""
    first = P.sizes.m + P.sizes.nv
    for k in range(first, first + P.sizes.ns):
        size = abs(P.F[P.sizes.n + k]) / max(1.0, abs(P.z[k]))
        if exceeds(size, moved):
            moved = size
    return moved


@native
def settled(P: Problem) -> bool:
    """Small correction, and small residual of forces and constraints after it.

    Where the full correction is no more than the rounding of the coordinates, no others leave less
    of the forces, stiff as they may be, nor of variables, which then have the digits of ERROR.
    """
    C = Control(P.control)
    imbalance(P)
    n, rows = P.sizes.n, P.sizes.m + P.sizes.nv
    rounded = C.shift <= ROUNDED and C.sigma <= C.stability
    for k in range(rows):
        left = C.error * CLOSED * max(1.0, C.length)
        if rounded and k >= P.sizes.m:
            left = max(left, C.error * abs(P.z[k]))
        if not abs(P.F[n + k]) <= left:
            return False
    if rounded:
        return True
    return C.worst <= C.imbalance and C.moved <= C.error
