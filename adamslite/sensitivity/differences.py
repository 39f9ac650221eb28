"""Sensitivities by backward differences on the steps of the run.

The formula of GSTIFF (:mod:`adamslite.integrators.bdf.method`) is applied to the derivatives of the
equations: with differences of the sensitivities y on the same steps and orders

    y' = (psi + d) cu,    F_q dq + F_u du + F_a da + F_z dz + F_s' ds' + F_p = 0

whose matrix is that of Newton's method at the accepted state.  It is linear: each step takes one
matrix for all numbers, and for each number one tangent and one solution.  Turns are rates of
theta' = dw + w x theta.  In the stabilised form dq' = du - W G^T dmu; mu itself is nothing but
error.

Reference: Caracotsios, Stewart, Comput. Chem. Eng. 9 (1985) 359 (staggered direct method).
"""

from __future__ import annotations

from adamslite.integrators.accelerations import factor_accelerations
from adamslite.integrators.audit_record import (
    AT_STEP,
    TAPE_HEAD,
    TAPE_KIND,
    TAPE_ORDER,
    TAPE_RESTARTS,
    TAPE_STEP,
    TAPE_TIME,
)
from adamslite.integrators.bdf.dense_output import interpolate
from adamslite.integrators.bdf.differences import change_step, extend_history, extrapolate, gamma
from adamslite.integrators.bdf.state import tests_velocities
from adamslite.integrators.contract import DONE, SINGULAR_MASS, Problem
from adamslite.integrators.implicit.formulation import equations_kept, is_stabilised
from adamslite.integrators.linalg.blocks import factor, solve
from adamslite.integrators.linalg.plan import Plan
from adamslite.integrators.motion_equations import (
    jacobian,
    project_on_constraints,
    spread,
    track,
)
from adamslite.integrators.newton import add_mixed_product
from adamslite.integrators.stepping.output import WITHIN
from adamslite.kernels.code.workspace import OMEGA
from adamslite.native.translate import Reals, copy, native
from adamslite.sensitivity.begin import begin_history
from adamslite.sensitivity.contract import Forward, Tangents
from adamslite.sensitivity.outputs import write_outputs
from adamslite.sensitivity.rates import spun
from adamslite.sensitivity.start import at_start, jump
from adamslite.sensitivity.tangents import clear, put_direction, tangent


@native
def by_differences(P: Problem, L: Plan, D: Tangents, S: Forward) -> int:
    """Follow the tape; the record of derivatives is filled."""
    T = P.tape
    if not at_start(P, L, D, S):
        return SINGULAR_MASS
    fresh = True
    for row in range(1, T.rows):
        here = T.data[row * T.width :]
        if here[TAPE_KIND] != AT_STEP:
            jump(P, L, D, S, T.data[(row - 1) * T.width + TAPE_HEAD :], here[TAPE_HEAD:])
            copy(P.W, here[TAPE_HEAD:], P.W.size)
            if row + 1 < T.rows:
                fresh = restarts(T.data[(row - 1) * T.width :], T.data[(row + 1) * T.width :])
            continue
        if fresh and not begin_history(P, L, D, S, here[TAPE_STEP], int(here[TAPE_ORDER])):
            return SINGULAR_MASS
        fresh = False
        copy(P.W, here[TAPE_HEAD:], P.W.size)
        if not step(P, L, D, S, here):
            return SINGULAR_MASS
        if not record(P, L, D, S, here):
            return SINGULAR_MASS
        copy(P.W, here[TAPE_HEAD:], P.W.size)
        track(P)
    return DONE


@native
def restarts(before: Reals, behind: Reals) -> bool:
    """Whether the history began anew between two steps."""
    return before[TAPE_RESTARTS] != behind[TAPE_RESTARTS]


@native
def step(P: Problem, L: Plan, D: Tangents, S: Forward, here: Reals) -> bool:
    """Sensitivities at the end of a step, whose state is in the workspace."""
    h, order, w = here[TAPE_STEP], int(here[TAPE_ORDER]), S.width
    cu = gamma(order) / h
    if not matrix(P, L, cu):
        return False
    yp, psi, y = S.y[0:], S.y[w:], S.y[2 * w :]
    for number in range(D.count):
        H = S.history[number * S.room :]
        if h != S.h:
            change_step(H, w, order, h / S.h)
        extrapolate(H, w, order, yp, psi)
        for i in range(w):
            yp[i] += H[i]
            y[i] = yp[i]
        solved(P, L, D, S, number, cu, here)
        for i in range(w):
            psi[i] = y[i] - yp[i]
        note_error(P, S, number, y, psi, order)
        extend_history(H, psi, w, order)
    S.h, S.order = h, order
    return True


@native
def solved(
    P: Problem, L: Plan, D: Tangents, S: Forward, number: int, cu: float, here: Reals
) -> None:
    """Sensitivities from the prediction: the first three rows of ``S.y`` hold it, psi, and where
    they are to stand.
    """
    n, w, first = P.sizes.n, S.width, P.sizes.m + P.sizes.nv
    yp, psi, y, v = S.y[0:], S.y[w:], S.y[2 * w :], S.y[3 * w :]
    for i in range(n):
        v[i] = psi[i] * cu
    spun(P, y, v, -1.0, y[n:])
    for i in range(n):
        S.a[i] = (psi[n + i] + y[n + i] - yp[n + i]) * cu
    clear(S.z, first)
    for k in range(P.sizes.ns):
        S.sd[k] = psi[2 * n + k] * cu
    put_direction(P, D, y, S.a, S.z, S.sd, 0.0)
    tangent(P, D, number, equations_kept(P), P.F)
    solve(L, P.LV, P.pivots, P.F, P.x, P.work)
    for i in range(n):
        y[i] -= P.F[i]
        v[i] -= P.F[i] * cu
    for k in range(P.sizes.ns):
        y[2 * n + k] -= P.F[n + first + k]
    spun(P, y, v, -1.0, y[n:])
    if is_stabilised(P):
        add_multipliers(P, S, y[n:], here)


@native
def note_error(P: Problem, S: Forward, number: int, y: Reals, change: Reals, order: int) -> None:
    """Add the error estimate of the formula, d/(k + 1), of places and of velocities, the latter
    where that of the run is tested.
    """
    n = P.sizes.n
    for part in range(2 if tests_velocities(P) else 1):
        error, top = 0.0, 0.0
        for i in range(part * n, (part + 1) * n):
            error, top = max(error, abs(change[i])), max(top, abs(y[i]))
        S.spent[2 * number + part] += error / (order + 1)
        S.top[2 * number + part] = max(S.top[2 * number + part], top)


@native
def add_multipliers(P: Problem, S: Forward, u: Reals, here: Reals) -> None:
    """u += W G^T dmu; the solution is in F, the multipliers of the workspace are put back."""
    n, mu = P.sizes.n, P.sizes.nz - P.sizes.holonomic
    for k in range(P.sizes.holonomic):
        S.z[k] = -P.F[mu + k]
    project_on_constraints(P, S.z, S.a)
    for i in range(n):
        u[i] += S.a[i]
    for k in range(P.sizes.m):
        P.W[P.scalar[k]] = here[TAPE_HEAD + P.scalar[k]]


@native
def matrix(P: Problem, L: Plan, cu: float) -> bool:
    """Factor the derivative of the equations by the increments at the workspace's state."""
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
    return factor(L, P.LV, P.pivots, P.work)


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


@native
def record(P: Problem, L: Plan, D: Tangents, S: Forward, here: Reals) -> bool:
    """Every output time of the step; the record of the run has its states."""
    t, h, size = here[TAPE_TIME], here[TAPE_STEP], P.sizes.nw + P.sizes.n_out
    while S.row < P.times.size and P.times[S.row] <= t + WITHIN * h:
        copy(P.W, P.record[S.row * size :], P.sizes.nw)
        if not factor_accelerations(P, L):
            return False
        for number in range(D.count):
            H = S.history[number * S.room :]
            interpolate(H, S.width, S.order, t, h, P.times[S.row], S.y)
            write_outputs(P, L, D, S, number, S.y)
        S.row += 1
    return True
