"""The three stages of the Radau formula: values, residuals, Newton matrices and increments.

Equations and references: :mod:`adamslite.integrators.radau.method`.  With A^-1 = (w_ij) the stages
give

    q'_i = sum_j w_ij (q_j - q_0)/h,    u_i = T(q_i) q'_i + W G^T mu_i,
    u'_i = sum_j w_ij (u_j - u_0)/h,    s'_i = sum_j w_ij (s_j - s_0)/h

so that only (q, lam, V, s, mu) of each stage are unknown.  With the same derivatives at all stages
the Newton equations of the three fall apart in the eigenvectors of A^-1 into one real and one
complex system with the matrix

    J(c) = J_0 + c J_1 + c^2 J_2,      c = g/h and (alpha + i beta)/h

    J_0 = F_q + F_u (E, W G^T, .),     J_1 = F_u + F_a (E, W G^T, .) + F_s',     J_2 = F_a

E: the part of d(omega)/d(phi) that comes from the attitude.  For a step of another size the parts
are only added up again.

``P.history``: rows of y = (q, u, s) with q counted from the start of the step, because differences
of positions over h would lose digits; then rows of z = (lam, V, s, mu), then three rows of
residuals and workspace of the complex system.
"""

from __future__ import annotations

from adamslite.integrators.contract import Problem
from adamslite.integrators.implicit.formulation import equations_kept, is_stabilised
from adamslite.integrators.implicit.rotation_count import count_anew
from adamslite.integrators.linalg.blocks import factor, solve
from adamslite.integrators.linalg.complex_blocks import factor_complex, solve_complex
from adamslite.integrators.linalg.norms import largest_of, largest_share
from adamslite.integrators.linalg.plan import Plan
from adamslite.integrators.motion_equations import (
    PART,
    jacobian,
    project_on_constraints,
    put_motion,
    put_pose,
    put_scalars,
    put_time,
    residual,
    spread,
    velocities,
)
from adamslite.integrators.newton import (
    add_attitude_part,
    add_mixed_product,
    apply_increment,
    multiplier_change,
    unresisted_change,
)
from adamslite.integrators.radau.coefficients import (
    ALPHA_MODE,
    BETA_MODE,
    INVERSE,
    NODE,
    REAL,
    TO_MODES,
    TO_STAGES,
)
from adamslite.integrators.radau.control import BEFORE, ORIGIN, RATES, Y_ROWS, Z_ROWS, Control
from adamslite.native.translate import Reals, copy, maximum, native, rare


@native
def stage_z(P: Problem, row: int) -> int:
    """Where a row of z begins."""
    first = P.sizes.m + P.sizes.nv
    w, e = 2 * P.sizes.n + P.sizes.ns, first + P.sizes.ns + P.sizes.holonomic
    return Y_ROWS * w + row * e


@native
def radau_jacobian(P: Problem, stage: int, h: float) -> None:
    """J_0, J_1, J_2 at a stage, one after the other in ``P.parts``."""
    n, size, c, K = P.sizes.n, P.J.size, P.coef, P.parts
    w = 2 * n + P.sizes.ns
    y, d = P.history[stage * w :], P.history[(RATES + stage) * w :]
    put_stage(P, stage, h)
    for part in range(3):
        for k in range(5):
            c[k] = 0.0
        c[part] = 1.0
        if part == 0:
            c[3] = 1.0
        if part == 1:
            c[4] = 1.0
        jacobian(P, equations_kept(P), c, K[part * size :])
    P.count.jacobians -= 2
    # Products with F_u and F_a as they are: of each pair of blocks the lower power comes first, and
    # the columns of mu before those of the attitude change F_u.
    for part in range(2):
        for k in range(0, P.mixed.size, 8):
            add_mixed_product(P, k, K[part * size :], K[(part + 1) * size :], K)
    for part in range(2):
        for k in range(0, P.turning.size, 4):
            add_attitude_part(P, k, K[part * size :], K[(part + 1) * size :], y, d, y[n:])


@native
def add_up(P: Problem, first: float, second: float, third: float, target: Reals) -> None:
    """The parts of the matrix with these weights, spread into ``target``."""
    size = P.J.size
    for k in range(size):
        P.J[k] = first * P.parts[k] + second * P.parts[size + k] + third * P.parts[2 * size + k]
    spread(P, target)


@native
def radau_matrices(P: Problem, L: Plan, h: float) -> bool:
    """Factor J(c) for the complex pair and for the real eigenvalue."""
    x, y = P.tableau[ALPHA_MODE] / h, P.tableau[BETA_MODE] / h
    add_up(P, 0.0, y, 2.0 * x * y, P.LA)
    add_up(P, 1.0, x, x * x - y * y, P.LV)
    for k in range(P.LV.size):
        P.LC[2 * k], P.LC[2 * k + 1] = P.LV[k], P.LA[k]
    P.count.factorizations += 2
    if not factor_complex(L, P.LC, P.pivots_c, P.work):
        return False
    return real_matrix(P, L, h)


@native
def real_matrix(P: Problem, L: Plan, h: float) -> bool:
    """Factor J(c) for the real eigenvalue."""
    x = P.tableau[REAL] / h
    add_up(P, 1.0, x, x * x, P.LV)
    return factor(L, P.LV, P.pivots, P.work)


@native
def put_counted(P: Problem, y: Reals) -> None:
    """Positions counted from the start of the step into ``P.q`` and the workspace."""
    n = P.sizes.n
    origin = P.history[ORIGIN * (2 * n + P.sizes.ns) :]
    for i in range(n):
        P.q[i] = origin[i] + y[i]
    put_pose(P, P.q)


@native
def stage_velocities(P: Problem, stage: int, h: float) -> None:
    """q', u and s' of a stage."""
    C = Control(P.control)
    n, ns, first = P.sizes.n, P.sizes.ns, P.sizes.m + P.sizes.nv
    w, Y = 2 * n + ns, P.history
    y, d, z = Y[stage * w :], Y[(RATES + stage) * w :], Y[stage_z(P, stage - 1) :]
    row = INVERSE + 3 * (stage - 1)
    a, b, c = P.tableau[row] / h, P.tableau[row + 1] / h, P.tableau[row + 2] / h
    for i in range(n):
        s = Y[i]
        d[i] = a * (Y[w + i] - s) + b * (Y[2 * w + i] - s) + c * (Y[3 * w + i] - s)
    for k in range(ns):
        i = 2 * n + k
        s = Y[i]
        y[i] = z[first + k]
        d[i] = a * (Y[w + i] - s) + b * (Y[2 * w + i] - s) + c * (Y[3 * w + i] - s)
    velocities(P, y, d, y[n:])
    if is_stabilised(P):
        put_time(P, C.t + P.tableau[NODE + stage - 1] * h)
        put_counted(P, y)
        project_on_constraints(P, z[first + ns :], P.F)
        for i in range(n):
            y[n + i] += P.F[i]


@native
def stage_motion(P: Problem, h: float) -> None:
    """Velocities, then accelerations of all stages."""
    n, ns, first = P.sizes.n, P.sizes.ns, P.sizes.m + P.sizes.nv
    w, Y = 2 * n + ns, P.history
    for stage in range(1, 4):
        copy(Y[stage * w + 2 * n :], Y[stage_z(P, stage - 1) + first :], ns)
    for stage in range(1, 4):
        stage_velocities(P, stage, h)
    for stage in range(1, 4):
        d, row = Y[(RATES + stage) * w :], INVERSE + 3 * (stage - 1)
        a, b, c = P.tableau[row] / h, P.tableau[row + 1] / h, P.tableau[row + 2] / h
        for i in range(n, 2 * n):
            s = Y[i]
            d[i] = a * (Y[w + i] - s) + b * (Y[2 * w + i] - s) + c * (Y[3 * w + i] - s)


@native
def stage_residuals(P: Problem, h: float) -> float:
    """The equations at the three stages; returns the largest change that inertia would not resist
    (:func:`adamslite.integrators.newton.unresisted_change`).
    """
    nz, at, largest = P.sizes.nz, stage_z(P, Z_ROWS), 0.0
    for stage in range(1, 4):
        put_stage(P, stage, h)
        residual(P, equations_kept(P), P.F)
        largest = maximum(largest, unresisted_change(P, h))
        copy(P.history[at + (stage - 1) * nz :], P.F, nz)
    return largest


@native
def put_stage(P: Problem, stage: int, h: float) -> None:
    """A stage into the workspace."""
    C = Control(P.control)
    n, Y = P.sizes.n, P.history
    y, d = Y[stage * (2 * n + P.sizes.ns) :], Y[(RATES + stage) * (2 * n + P.sizes.ns) :]
    put_time(P, C.t + P.tableau[NODE + stage - 1] * h)
    put_counted(P, y)
    put_motion(P, y[n:], d[n:])
    put_scalars(P, Y[stage_z(P, stage - 1) :], d[2 * n :])


@native
def stage_increments(P: Problem, L: Plan) -> None:
    """Newton increments of the three stages in the place of their residuals."""
    nz, X = P.sizes.nz, P.tableau
    R = P.history[stage_z(P, Z_ROWS) :]
    pair, spare = R[3 * nz :], R[5 * nz :]
    for k in range(nz):
        a, b, c = R[k], R[nz + k], R[2 * nz + k]
        P.F[k] = X[TO_MODES] * a + X[TO_MODES + 1] * b + X[TO_MODES + 2] * c
        pair[2 * k] = X[TO_MODES + 3] * a + X[TO_MODES + 4] * b + X[TO_MODES + 5] * c
        pair[2 * k + 1] = X[TO_MODES + 6] * a + X[TO_MODES + 7] * b + X[TO_MODES + 8] * c
    solve(L, P.LV, P.pivots, P.F, P.x, P.work)
    solve_complex(L, P.LC, P.pivots_c, pair, spare, P.work)
    for k in range(nz):
        a, b, c = P.F[k], pair[2 * k], pair[2 * k + 1]
        for stage in range(3):
            o = TO_STAGES + 3 * stage
            R[stage * nz + k] = X[o] * a + X[o + 1] * b + X[o + 2] * c


@native
@rare
def separate_increments(P: Problem, L: Plan, h: float) -> bool:
    """Increments of each stage by its own derivatives in the place of the residuals; those of the
    middle stage, and their factors, are left.
    """
    nz, R = P.sizes.nz, P.history[stage_z(P, Z_ROWS) :]
    for turn in range(3):
        stage = 3 - 2 * turn if turn < 2 else 2
        radau_jacobian(P, stage, h)
        if not real_matrix(P, L, h):
            return False
        copy(P.F, R[(stage - 1) * nz :], nz)
        solve(L, P.LV, P.pivots, P.F, P.x, P.work)
        copy(R[(stage - 1) * nz :], P.F, nz)
    P.count.factorizations += 3
    return True


@native
def move_stages(P: Problem, h: float) -> float:
    """Subtract the increments; returns the largest change of a tested variable of a stage.

    Positions, rotations and velocities against max(1, |value|), where constraints tie them together
    as they are (see :func:`adamslite.integrators.newton.increment_norm`); variables and states.
    """
    n, ns, nz, first = P.sizes.n, P.sizes.ns, P.sizes.nz, P.sizes.m + P.sizes.nv
    w, Y, tied, largest = 2 * n + ns, P.history, is_stabilised(P), 0.0
    R, origin = Y[stage_z(P, Z_ROWS) :], Y[ORIGIN * w :]
    for stage in range(3):
        y, z, dz = Y[(1 + stage) * w :], Y[stage_z(P, stage) :], R[stage * nz :]
        for k in range(P.sizes.m, first + ns):
            largest = maximum(largest, abs(dz[n + k]) / max(1.0, abs(z[k])))
        if P.settings.all_converge:
            largest = max(largest, multiplier_change(P, dz, z, (P.tableau[REAL] / h) ** 2.0))
        copy(P.trial[stage * n :], y[n:], n)
        apply_increment(P, dz, y, z, z[first + ns :], tied)
    stage_motion(P, h)
    for stage in range(3):
        y, dz = Y[(1 + stage) * w :], R[stage * nz :]
        for i in range(n):
            P.x[i] = y[n + i] - P.trial[stage * n + i]
        if tied:
            size = maximum(largest_of(dz, n), largest_of(P.x, n))
        else:
            size = maximum(largest_share(dz, origin, n), largest_share(P.x, origin[n:], n))
        largest = maximum(largest, size)
    copy(P.F, R[2 * nz :], nz)
    return largest


@native
def keep_stages(P: Problem) -> None:
    """Remember the accepted stages with positions counted from the end of the step."""
    w, e = 2 * P.sizes.n + P.sizes.ns, stage_z(P, 1) - stage_z(P, 0)
    Y, n = P.history, P.sizes.n
    for i in range(n):
        Y[ORIGIN * w + i] += Y[3 * w + i]
        Y[ORIGIN * w + n + i] = Y[3 * w + n + i]
    copy(Y[ORIGIN * w + 2 * n :], Y[3 * w + 2 * n :], P.sizes.ns)
    for k in range(4 * w):
        Y[BEFORE * w + k] = Y[k]
    old = stage_z(P, 0)
    copy(Y[old + 3 * e :], Y[old:], 3 * e)
    for b in range(P.sizes.nb):
        count_from_end(P, b, w)
    copy(Y, Y[(BEFORE + 3) * w :], w)


@native
def count_from_end(P: Problem, b: int, w: int) -> None:
    """Positions of a body in the step before, counted from its end."""
    Y, i = P.history, P.body[b].first
    for k in range(3):
        for row in range(4):
            Y[(BEFORE + row) * w + i + k] -= Y[3 * w + i + k]
    if P.body[b].width == PART:
        c0, c1, c2 = Y[3 * w + i + 3], Y[3 * w + i + 4], Y[3 * w + i + 5]
        for row in range(4):
            count_anew(Y, (BEFORE + row) * w + i + 3, c0, c1, c2)
        for k in range(3, 6):
            Y[ORIGIN * w + i + k] = 0.0
