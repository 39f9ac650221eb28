"""Newton's method on the reduced unknowns, shared by the implicit integrators.

An implicit formula makes q', u' and s' linear in the increments of q, u and s with one coefficient
cu = 1/(beta h).  Velocities and accelerations follow from q, so Newton works on

    z = (dphi and dx of bodies, lam, V, s [, mu])          n + m (index 3) or n + 2m (stabilised)

with dF/dz = F_q + (F_u + cu F_a)(cu I + E), E the part of d(omega)/d(phi) that comes from the
attitude.  In the stabilised form u = T(q) q' + W G^T mu, hence the columns of mu are
(F_u + cu F_a) W G^T.
References: Gear, Gupta, Leimkuhler, J. Comp. Appl. Math. 12 (1985) 77; Hairer, Wanner, Solving
ODE II, 1996, sections VI.7 and VII.2.
"""

from __future__ import annotations

from adamslite.integrators.contract import Problem
from adamslite.integrators.linalg.blocks import factor
from adamslite.integrators.linalg.norms import largest_of, largest_share
from adamslite.integrators.linalg.plan import Plan
from adamslite.integrators.motion_equations import PART, back_rotate, jacobian, spread
from adamslite.native.translate import Reals, maximum, native

# Increments of positions below this share of the largest position are round-off.
ROUND_OFF = 2e-15
# An older matrix serves while inertia alone would make no more than this many times ERROR of the
# residual that is left, and the residual shrinks by this share.
MOST_FELT, SHRUNK = 3.0, 0.3
# Share of ERROR that round-off may make of a residual; an inertia for which it is more counts more.
UNFELT = 1e-5
# The matrix is renewed where this residual stays above this share of the one before.
SHRINKING = 0.5


@native
def newton_matrix(
    P: Problem, L: Plan, phases: int, cu: float, q: Reals, v: Reals, u: Reals
) -> bool:
    """Assemble and factor dF/dz at the workspace's state; ``v`` holds q'."""
    c = P.coef
    c[0], c[1], c[2], c[3], c[4] = 1.0, cu, cu * cu, 1.0, cu
    jacobian(P, phases, c, P.J)
    if P.turning.size or P.mixed.size:
        c[0], c[1], c[2], c[3], c[4] = 0.0, 1.0, cu, 0.0, 0.0
        jacobian(P, phases, c, P.D)
        for k in range(0, P.turning.size, 4):
            add_attitude_part(P, k, P.J, P.D, q, v, u)
        for k in range(0, P.mixed.size, 8):
            add_mixed_product(P, k, P.J, P.D, P.J)
    spread(P, P.LV)
    P.count.factorizations += 1
    return factor(L, P.LV, P.pivots, P.work)


@native
def add_attitude_part(
    P: Problem, entry: int, J: Reals, D: Reals, q: Reals, v: Reals, u: Reals
) -> None:
    """J[:, 3:6] += D[:, 3:6] E on the rows and columns of an entry of ``P.turning``.

    From w = (c' + c x c'/2)/sigma, sigma = 1 + c.c/4:  dw = (dc x c'/2 - w (c.dc)/2)/sigma at
    fixed c', and dc = (I - [c]/2 + c c^T/4) dphi.
    """
    at, rows = P.turning[entry], P.turning[entry + 1]
    i = P.body[P.turning[entry + 2]].first
    c0, c1, c2 = q[i + 3], q[i + 4], q[i + 5]
    d0, d1, d2 = v[i + 3], v[i + 4], v[i + 5]
    w0, w1, w2 = u[i + 3], u[i + 4], u[i + 5]
    half = 0.5 / (1.0 + 0.25 * (c0 * c0 + c1 * c1 + c2 * c2))
    bit, live = 1, P.turning[entry + 3]
    for column in range(3):
        if live & bit:
            e0 = 1.0 if column == 0 else 0.0
            e1 = 1.0 if column == 1 else 0.0
            e2 = 1.0 if column == 2 else 0.0
            k = 0.25 * (c0 * e0 + c1 * e1 + c2 * e2)
            p0 = e0 - 0.5 * (c1 * e2 - c2 * e1) + k * c0
            p1 = e1 - 0.5 * (c2 * e0 - c0 * e2) + k * c1
            p2 = e2 - 0.5 * (c0 * e1 - c1 * e0) + k * c2
            along = c0 * p0 + c1 * p1 + c2 * p2
            x0 = half * (p1 * d2 - p2 * d1 - w0 * along)
            x1 = half * (p2 * d0 - p0 * d2 - w1 * along)
            x2 = half * (p0 * d1 - p1 * d0 - w2 * along)
            for r in range(rows):
                o = at + 6 * r
                J[o + 3 + column] += D[o + 3] * x0 + D[o + 4] * x1 + D[o + 5] * x2
        bit += bit


@native
def add_mixed_product(P: Problem, k: int, J: Reals, D: Reals, G: Reals) -> None:
    """J[row, mu_j] += D[row, body] W G[j, body]^T for the entry ``k`` of ``P.mixed``."""
    mixed = P.mixed
    target, lead, m, source = mixed[k], mixed[k + 1], mixed[k + 2], mixed[k + 3]
    rows, width, gradient, weight = mixed[k + 4], mixed[k + 5], mixed[k + 6], 0.0
    if width == PART:
        weight = P.weight[mixed[k + 7]]
    for r in range(rows):
        for j in range(m):
            d, g = source + r * width, gradient + j * width
            total = D[d] * G[g] + D[d + 1] * G[g + 1] + D[d + 2] * G[g + 2]
            if width == PART:
                turn = D[d + 3] * G[g + 3] + D[d + 4] * G[g + 4] + D[d + 5] * G[g + 5]
                total += turn * weight
            J[target + r * lead + j] += total


@native
def apply_increment(P: Problem, dz: Reals, q: Reals, z: Reals, mu: Reals, si2: bool) -> None:
    """Subtract the Newton increment from the unknowns."""
    body = P.body
    n = P.sizes.n
    for b in range(P.sizes.nb):
        i = body[b].first
        if body[b].width == PART:
            back_rotate(q, dz, i, dz)
            for k in range(3, 6):
                q[i + k] -= dz[i + k]
        for k in range(3):
            q[i + k] -= dz[i + k]
    rest = P.sizes.m + P.sizes.nv + P.sizes.ns
    for k in range(rest):
        z[k] -= dz[n + k]
    if si2:
        for k in range(P.sizes.holonomic):
            mu[k] -= dz[n + rest + k]


@native
def increment_norm(P: Problem, dz: Reals, cu: float, tied: bool, reach: float) -> float:
    """Largest increment of what the error test looks at, each against max(1, |value|).

    Positions and rotations; velocities (cu times those) when ``cu`` is not zero; variables and
    states.  When constraints tie velocities of different size together (``tied``), an error that
    is small against one is large against another, so increments of bodies count as they are, and
    those at the round-off of positions, up to ``reach``, count as none, because at small steps they
    are all there is.
    """
    n, q, u, z = P.sizes.n, P.q, P.u, P.z
    noise, largest = ROUND_OFF * reach, 0.0
    for i in range(n):
        change = abs(dz[i])
        felt = 0.0 if change <= noise else change
        if tied:
            largest = maximum(largest, max(1.0, cu) * felt)
        else:
            moved = maximum(felt / max(1.0, abs(q[i])), cu * felt / max(1.0, abs(u[i])))
            largest = maximum(largest, moved)
    first = P.sizes.m
    share = largest_share(dz[n + first :], z[first:], P.sizes.nv + P.sizes.ns)
    return maximum(largest, share)


@native
def weigh_residuals(P: Problem, cq: float, cv: float) -> float:
    """What a unit residual changes if inertia alone resists it, cq/m of positions and cv/m of
    velocities against max(1, |value|), the larger of both, into ``P.ease``; returns the largest
    position, at least 1.

    The last digits of positions make loads of the bodies that constraints tie together, which are
    not to count more than ``UNFELT`` of ERROR for a part that is all but a point.
    """
    q, u, n, mobility, ease = P.q, P.u, P.sizes.n, P.mobility, P.ease
    reach = maximum(1.0, largest_of(q, n))
    coarse = UNFELT * P.settings.error / (ROUND_OFF * reach)
    for i in range(n):
        x, v = max(1.0, abs(q[i])), max(1.0, abs(u[i]))
        ease[i] = min(mobility[i], coarse * mobility[n + i]) * max(cq * v, cv * x) / (x * v)
    return reach


@native
def unresisted_change(P: Problem, cs: float) -> float:
    """The largest change by the residual in ``P.F`` if inertia alone resisted it, with weights of
    ``weigh_residuals``; cs F of states and F of variables against max(1, |value|).

    The matrix of a stiffness that has gone makes increments small, but not this.
    """
    n, m, nv, F, ease, largest = P.sizes.n, P.sizes.m, P.sizes.nv, P.F, P.ease, 0.0
    for i in range(n):
        largest = maximum(largest, abs(F[i]) * ease[i])
    largest = maximum(largest, largest_share(F[n + m :], P.z[m:], nv))
    return maximum(largest, cs * largest_share(F[n + m + nv :], P.z[m + nv :], P.sizes.ns))


@native
def serves(felt: float, before: float, error: float, share: float) -> bool:
    """Whether increments of a matrix of another state are believed, from ``unresisted_change`` of
    the last residual and the one before: both small against ERROR, or shrunk by this matrix.
    """
    return felt <= MOST_FELT * error and (felt <= share * error or felt <= SHRUNK * before)


@native
def renews(P: Problem, iteration: int, serves: bool) -> bool:
    """Whether an iteration begins with a new matrix: as PATTERN says, without one unless the old
    matrix ``serves``.
    """
    if P.pattern.size > 0:
        return P.pattern[iteration % P.pattern.size] != 0
    return not serves


@native
def multiplier_change(P: Problem, dz: Reals, z: Reals, ca: float) -> float:
    """Largest increment of a multiplier against max(1, |value|), with d(acceleration) = ca dq.

    What round-off of positions does to inertia forces, ca m |q|, is none.
    """
    reach, heaviest, largest = 1.0, 0.0, 0.0
    for i in range(P.sizes.n):
        reach = max(reach, abs(P.q[i]))
    for b in range(P.sizes.nb):
        heaviest = max(heaviest, P.mass[b])
    noise = ROUND_OFF * reach * ca * heaviest
    for k in range(P.sizes.m):
        change, weight = abs(dz[P.sizes.n + k]), max(1.0, abs(z[k]))
        largest = maximum(largest, 0.0 if change <= noise else change / weight)
    return largest


@native
def velocity_change(P: Problem, before: Reals, noise: float) -> float:
    """Largest change of a velocity by an increment of q and mu, 0 up to ``noise``.

    mu itself shows little: its share W G^T mu of the velocities may be a hundred times larger.
    """
    largest = 0.0
    for i in range(P.sizes.n):
        largest = maximum(largest, abs(P.u[i] - before[i]))
    return 0.0 if largest <= noise else largest
