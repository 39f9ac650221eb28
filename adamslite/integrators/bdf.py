"""GSTIFF: backward differentiation formulas of order 1 to 5 with variable step (BDF).

With backward differences D_i of the past values on the present step h, for y = (q, u, s)

    predictor  y_p = sum_{i=0..k} D_i,        psi = sum_{i=1..k} gamma_i D_i / gamma_k
    corrector  y' = (psi + d) gamma_k / h,    y = y_p + d,    gamma_k = 1 + 1/2 + ... + 1/k
    error      d / (k + 1)

Index 3 (I3): unknowns (q, lam), u = T q', errors of q tested.  Stabilised index 2 (SI2): also
G u + g_t = 0 with multipliers mu, errors of q and u tested.  Both in the maximum norm with weights
ERROR max(1, |y|).
References: Gear, IEEE Trans. Circuit Theory 18 (1971) 89; Shampine, Reichelt, SIAM J. Sci. Comput. 18
(1997) 1 (quasi-constant step, differences); Brenan, Campbell, Petzold, Numerical Solution of IVP in DAE,
1996, section 5.2 (tests of the corrector).
"""

from __future__ import annotations

from adamslite.translate import native

from adamslite.integrators.acceleration import accelerations, mass_signature, put_state
from adamslite.integrators.base import (
    AT,
    BROKEN_START,
    DONE,
    ERROR,
    FAILURES,
    H_INIT,
    H_MAX,
    H_MIN,
    HOLONOMIC,
    HOW_MUCH,
    IMPLICIT_MASS,
    INDEX3,
    INTERRUPTED,
    K_MAX,
    MAX_IT,
    NB,
    NEWTON,
    NEWTON_FAILED,
    NOT_FINITE,
    NS,
    NV,
    NZ,
    ORDER,
    REJECTED,
    SI2,
    SINGULAR_MASS,
    STABILISED,
    STEP,
    STEP_TOO_SMALL,
    STEPS,
    STOP,
    T_END,
    WHERE,
    M,
    N,
    T,
)
from adamslite.integrators.equations import (
    BODY,
    PART,
    project_on_constraints,
    put_motion,
    put_pose,
    put_scalars,
    put_time,
    residual,
    track,
    vector_rates,
    velocities,
)
from adamslite.integrators.linalg import solve
from adamslite.integrators.newton import apply_increment, increment_norm, newton_matrix
from adamslite.integrators.records import note_violation, record_at

MAX_ORDER = 5
ROWS = MAX_ORDER + 3
# Newton stops when the estimated remaining error is this share of ERROR.
CORRECTOR_SHARE = 0.05
# The next step aims at an estimated error below ERROR by these factors (at a higher order: more caution).
SAFETY, SAFETY_UP = 3.0, 4.5
# The factored matrix is kept while its cu is within this ratio of the present one.
KEEP_RATIO = 0.25
# ... and for this many steps.
KEEP_STEPS = 20.0
# The rate of convergence is not believed to be better than this, and is doubted twice as much after every
# step that needed one iteration, because the matrix grows old unseen.
LEAST_RATE = 0.02
# Rotation vectors are counted anew from the present attitude beyond this length (squared).
REBASE = 0.01
# A sign change of the effective mass is approached to this share of HMAX.
SINGULAR_RESOLUTION = 1e-6
# Orders above 2 are unstable on weakly damped stiff modes; the symptom is many rejections while the run
# advances far less than before.  In a window of tries: more rejections than this at order 3 and above,
# and less than this share of the time covered by the best window.
WINDOW = 50
STIFF_REJECTIONS = 7
STIFF_SHARE = 0.2


@native
def gamma(k: int) -> float:
    """1 + 1/2 + ... + 1/k"""
    total = 0.0
    for j in range(1, k + 1):
        total += 1.0 / j
    return total


@native
def predict(D: Reals, w: int, k: int, yp: Reals, psi: Reals) -> None:
    """Extrapolate the history: the value and the known part of the derivative."""
    for i in range(w):
        yp[i] = D[i]
        psi[i] = 0.0
    g = 0.0
    for j in range(1, k + 1):
        g += 1.0 / j
        for i in range(w):
            yp[i] += D[j * w + i]
            psi[i] += g * D[j * w + i]
    for i in range(w):
        psi[i] /= g


@native
def change_step(D: Reals, w: int, k: int, factor: float) -> None:
    """Differences of the same polynomial on the step ``factor * h`` (Shampine, Reichelt, eq. 2.5)."""
    table = D[ROWS * w:]
    size = k + 1
    ru = table[0:]
    for i in range(size):
        for j in range(size):
            ru[i * size + j] = 0.0
    r = table[size * size:]
    u = table[2 * size * size:]
    difference_matrix(r, size, factor)
    difference_matrix(u, size, 1.0)
    for i in range(size):
        for m in range(size):
            for j in range(size):
                ru[i * size + j] += r[i * size + m] * u[m * size + j]
    column = table[3 * size * size:]
    for c in range(w):
        for i in range(size):
            total = 0.0
            for j in range(size):
                total += ru[j * size + i] * D[j * w + c]
            column[i] = total
        for i in range(size):
            D[i * w + c] = column[i]


@native
def difference_matrix(r: Reals, size: int, factor: float) -> None:
    """R_ij = prod_{m=1..i} (m - 1 - factor j)/m."""
    for j in range(size):
        r[j] = 1.0
    for i in range(1, size):
        for j in range(size):
            r[i * size + j] = 0.0 if j == 0 else r[(i - 1) * size + j] * (i - 1 - factor * j) / i


@native
def motion_from_increments(P: Problem, cu: float, yp: Reals, psi: Reals, si2: bool) -> None:
    """u and a from q, the history and (stabilised form) mu; writes the workspace; v = q' to trial."""
    n = P.sizes[N]
    w = 2 * n + P.sizes[NS]
    q, u, a, v = P.q, P.u, P.a, P.trial[2 * w:]
    for i in range(n):
        v[i] = (psi[i] + q[i] - yp[i]) * cu
    put_pose(P, q)
    velocities(P, q, v, u)
    if si2:
        project_on_constraints(P, P.mu, P.F)
        for i in range(n):
            u[i] += P.F[i]
    for i in range(n):
        a[i] = (psi[n + i] + u[i] - yp[n + i]) * cu
    put_motion(P, u, a)
    first = P.sizes[M] + P.sizes[NV]
    for k in range(P.sizes[NS]):
        P.rd[k] = (psi[2 * n + k] + P.z[first + k] - yp[2 * n + k]) * cu
    put_scalars(P, P.z, P.rd)


@native
def correct(P: Problem, L: Plan, phases: int, cu: float, state: Reals, si2: bool) -> bool:
    """Newton iterations from the predictor; True when converged.

    ``state``: cu of the factored matrix (0: none), convergence rate, matrix made in this step.
    """
    n = P.sizes[N]
    w = 2 * n + P.sizes[NS]
    yp, psi, v = P.trial[0:], P.trial[w:], P.trial[2 * w:]
    tolerance = CORRECTOR_SHARE * P.settings[ERROR]
    tested = cu if P.sizes[SI2] == 1 else 0.0
    last = 0.0
    for iteration in range(int(P.settings[MAX_IT])):
        motion_from_increments(P, cu, yp, psi, si2)
        if state[0] == 0.0 or abs(cu / state[0] - 1.0) > KEEP_RATIO or state[4] >= KEEP_STEPS:
            if not newton_matrix(P, L, phases, cu, P.q, v, P.u):
                state[0] = 0.0
                return False
            state[0], state[1], state[2], state[4] = cu, 1.0, 1.0, 0.0
        residual(P, phases, P.F)
        solve(L, P.LV, P.pivots, P.F, P.x, P.work)
        ratio = 2.0 / (1.0 + cu / state[0])
        if ratio != 1.0:
            for k in range(P.sizes[NZ]):
                P.F[k] *= ratio
        size = increment_norm(P, P.F, tested, si2)
        apply_increment(P, P.F, P.q, P.z, P.mu, si2)
        P.count[NEWTON] += 1
        if not size < 1e12:
            return False
        if iteration > 0:
            state[1] = max(LEAST_RATE, size / last)
            if state[1] > 0.9 and size > tolerance:
                return False
        if size * min(1.0, state[1] / max(1e-3, 1.0 - min(state[1], 0.999))) <= tolerance:
            motion_from_increments(P, cu, yp, psi, si2)
            if iteration == 0:
                state[1] = min(1.0, 2.0 * state[1])
            return True
        last = size
    return False


@native
def start_values(P: Problem, D: Reals, w: int, h: float) -> None:
    """Order 1: D_0 = y, D_1 = h y'."""
    n = P.sizes[N]
    first = P.sizes[M] + P.sizes[NV]
    for k in range(P.history.size):
        D[k] = 0.0
    rates = P.trial[0:]
    vector_rates(P, P.q, P.u, rates)
    for i in range(n):
        D[i], D[n + i] = P.q[i], P.u[i]
        D[w + i], D[w + n + i] = h * rates[i], h * P.a[i]
    for k in range(P.sizes[NS]):
        D[2 * n + k] = P.z[first + k]
        D[w + 2 * n + k] = h * P.rd[k]


@native
def first_step(P: Problem, w: int) -> float:
    """A step whose first-order error is a tenth of ERROR, judged by the accelerations."""
    n = P.sizes[N]
    tol = P.settings[ERROR]
    fastest = 0.0
    for i in range(n):
        fastest = max(fastest, abs(P.a[i]) / max(1.0, abs(P.u[i])), abs(P.u[i]) / max(1.0, abs(P.q[i])))
    for k in range(P.sizes[NS]):
        fastest = max(fastest, abs(P.rd[k]))
    span = P.settings[T_END] - P.settings[T]
    h = min(P.settings[H_MAX], span)
    if P.settings[H_INIT] > 0.0:
        return min(h, P.settings[H_INIT])
    return min(0.05 * h, tol**0.5 / max(fastest, 1e-12) * 0.3)


@native
def weighted(D: Reals, row: int, w: int, n: int, ns: int, y: Reals, si2: bool, report: Reals) -> float:
    """Largest |D_row| against max(1, |y|) over the tested variables; remembers where."""
    top, where = 0.0, 0
    o = row * w
    for i in range(2 * n if si2 else n):
        size = abs(D[o + i]) / max(1.0, abs(y[i]))
        if not size <= top:
            top, where = size, i
    for i in range(2 * n, 2 * n + ns):
        size = abs(D[o + i]) / max(1.0, abs(y[i]))
        if not size <= top:
            top, where = size, i
    report[WHERE] = where
    return top


@native
def rebase(P: Problem, D: Reals, w: int, k: int) -> None:
    """Count rotation vectors from the present attitude; the history follows exactly.

    Past values y_j = sum_i (-1)^i C(j,i) D_i; composition of Cayley vectors
    cay(a) cay(b) = cay((a + b + a x b/2)/(1 - a.b/4)), here with b = -c.
    """
    rows = min(k + 3, ROWS)
    for b in range(P.sizes[NB]):
        i = P.body[BODY * b + 1] + 3
        if P.body[BODY * b] != PART:
            continue
        c0, c1, c2 = D[i], D[i + 1], D[i + 2]
        if c0 * c0 + c1 * c1 + c2 * c2 < REBASE:
            continue
        o = P.body[BODY * b + 2]
        for c in range(3):
            P.q[i + c] = D[i + c]
        put_pose(P, P.q)
        for m in range(9):
            P.base[9 * b + m] = P.W[o + 15 + m]
        for c in range(3):
            to_values(D, w, i + c, rows)
        for j in range(rows):
            p = j * w + i
            a0, a1, a2 = D[p], D[p + 1], D[p + 2]
            s = 1.0 / (1.0 + 0.25 * (a0 * c0 + a1 * c1 + a2 * c2))
            D[p] = s * (a0 - c0 - 0.5 * (a1 * c2 - a2 * c1))
            D[p + 1] = s * (a1 - c1 - 0.5 * (a2 * c0 - a0 * c2))
            D[p + 2] = s * (a2 - c2 - 0.5 * (a0 * c1 - a1 * c0))
        for c in range(3):
            to_values(D, w, i + c, rows)


@native
def to_values(D: Reals, w: int, i: int, rows: int) -> None:
    """Differences to past values and back: the map is its own inverse."""
    for m in range(1, rows):
        for j in range(rows - 1, m - 1, -1):
            D[j * w + i] = D[(j - 1) * w + i] - D[j * w + i]


@native
def bdf(P: Problem, L: Plan) -> int:
    """Integrate to the end time; returns an outcome."""
    n, ns, si2 = P.sizes[N], P.sizes[NS], P.sizes[SI2] == 1
    stabilised = si2 and P.sizes[HOLONOMIC] > 0
    w = 2 * n + ns
    phases = STABILISED if stabilised else INDEX3
    D, yp, psi = P.history, P.trial[0:], P.trial[w:]
    t, t_end, error = P.settings[T], P.settings[T_END], P.settings[ERROR]
    k_max = min(MAX_ORDER, int(P.settings[K_MAX]))
    if not accelerations(P, L, t, P.q, P.u, P.a, P.z, P.rd):
        P.report[AT] = t
        return BROKEN_START
    signature = mass_signature(P, L, P.pivot0) if P.sizes[IMPLICIT_MASS] else 0
    for i in range(n):
        P.ra[i] = P.a[i]
    for i in range(P.z.size):
        P.rz[i] = P.z[i]
    h = first_step(P, w)
    start_values(P, D, w, h)
    track(P)
    next_record = record_at(P, L, D, w, 0, t, h, 0)
    k, equal, fresh_starts, tries, bad = 1, 0, 0, 0, 0
    travelled, farthest = 0.0, 0.0
    state = P.coef[5:]
    state[0], state[1], state[2], state[4] = 0.0, 1.0, 0.0, 0.0
    while t < t_end:
        if h > P.settings[H_MAX] * 1.0000001:
            change_step(D, w, k, P.settings[H_MAX] / h)
            h, equal = P.settings[H_MAX], 0
        if t + h * 1.0000001 > t_end:
            change_step(D, w, k, (t_end - t) / h)
            h, equal = t_end - t, 0
        if P.settings[STOP] != 0.0:
            leave(P, D, w)
            return INTERRUPTED
        P.report[AT], P.report[STEP], P.report[ORDER] = t, h, k
        if h < P.settings[H_MIN]:
            leave(P, D, w)
            return STEP_TOO_SMALL if fresh_starts < 3 else NEWTON_FAILED
        cu = gamma(k) / h
        predict(D, w, k, yp, psi)
        for i in range(n):
            P.q[i] = yp[i]
        first = P.sizes[M] + P.sizes[NV]
        for i in range(ns):
            P.z[first + i] = yp[2 * n + i]
        for i in range(P.mu.size):
            P.mu[i] = 0.0
        put_time(P, t + h)
        converged = correct(P, L, phases, cu, state, stabilised)
        if not converged:
            P.count[FAILURES] += 1
            for i in range(first):
                P.z[i] = P.rz[i]
            if state[2] == 0.0 and state[0] != 0.0:
                state[0] = 0.0
                continue
            fresh_starts += 1
            change_step(D, w, k, 0.25)
            h, equal = 0.25 * h, 0
            state[0], state[2] = 0.0, 0.0
            continue
        tries += 1
        # d goes where the history expects the next difference, D_{k+1}, after its old value moves on
        row, above = (k + 1) * w, (k + 2) * w
        for i in range(w):
            y = P.q[i] if i < n else (P.u[i - n] if i < 2 * n else P.z[first + i - 2 * n])
            d = y - yp[i]
            psi[i] = d
            yp[i] = y
        size = difference_size(psi, yp, n, ns, si2, P.report)
        norm = size / ((k + 1) * error)
        P.report[HOW_MUCH] = norm
        if not norm <= 1.0:
            P.count[REJECTED] += 1
            fresh_starts = 0
            if not norm < 1e12:
                leave(P, D, w)
                return NOT_FINITE
            factor = max(0.2, (SAFETY * norm) ** (-1.0 / (k + 1)))
            bad += 1 if k > 2 else 0
            if bad > STIFF_REJECTIONS and travelled < STIFF_SHARE * farthest:
                k_max, k, bad = 2, min(k, 2), 0
            for i in range(first):
                P.z[i] = P.rz[i]
            change_step(D, w, k, factor)
            h, equal = h * factor, 0
            state[2] = 0.0
            continue
        if P.sizes[IMPLICIT_MASS] and mass_signature(P, L, P.x) != signature:
            if h < SINGULAR_RESOLUTION * P.settings[H_MAX]:
                leave(P, D, w)
                return SINGULAR_MASS
            for i in range(first):
                P.z[i] = P.rz[i]
            change_step(D, w, k, 0.25)
            h, equal = 0.25 * h, 0
            state[2] = 0.0
            continue
        P.count[STEPS] += 1
        state[2], fresh_starts = 0.0, 0
        state[4] += 1.0
        for i in range(w):
            D[above + i] = psi[i] - D[row + i]
            D[row + i] = psi[i]
        for j in range(k, -1, -1):
            for i in range(w):
                D[j * w + i] += D[(j + 1) * w + i]
        t = t_end if t + h * 1.0000001 > t_end else t + h
        for i in range(first):
            P.rz[i] = P.z[i]
        for i in range(n):
            P.ra[i] = P.a[i]
        note_violation(P, t)
        next_record = record_at(P, L, D, w, k, t, h, next_record)
        if next_record < 0:
            leave(P, D, w)
            return SINGULAR_MASS
        restore_state(P, D, w, t)
        track(P)
        rebase(P, D, w, k)
        equal += 1
        travelled += h
        if tries % WINDOW == 0:
            farthest = max(farthest, travelled)
            travelled, bad = 0.0, 0
        if equal < k + 1:
            continue
        k_new = choose_order(P, D, w, n, ns, si2, k, k_max, norm, h, state)
        factor = state[3]
        if k_new != k or factor >= 1.2 or factor < 0.9:
            if factor > 1.0 or k_new != k:
                factor = min(factor, 10.0)
            k = k_new
            change_step(D, w, k, factor)
            h, equal = h * factor, 0
    leave(P, D, w)
    P.report[AT] = t
    return DONE


@native
def difference_size(d: Reals, y: Reals, n: int, ns: int, si2: bool, report: Reals) -> float:
    """Largest |d| against max(1, |y|) over the tested variables."""
    return weighted(d, 0, 0, n, ns, y, si2, report)


@native
def choose_order(P: Problem, D: Reals, w: int, n: int, ns: int, si2: bool, k: int, k_max: int, norm: float, h: float, state: Reals) -> int:
    """The order and the step ratio that promise the largest next step.

    When HMAX caps the step, the present order is kept unless a higher one is more accurate, because
    "largest step" would always pick the lowest.  The ratio goes to ``state[3]``.
    """
    y = D[0:]
    tol = P.settings[ERROR]
    same = max(SAFETY * norm, 1e-10) ** (-1.0 / (k + 1))
    best, factor = k, same
    if k > 1:
        low = weighted(D, k, w, n, ns, y, si2, P.report) / (k * tol)
        f = max(SAFETY * low, 1e-10) ** (-1.0 / k)
        capped = h * min(f, same) >= P.settings[H_MAX]
        if f > factor and not capped:
            best, factor = k - 1, f
    if k < k_max:
        high = weighted(D, k + 2, w, n, ns, y, si2, P.report) / ((k + 2) * tol)
        f = max(SAFETY_UP * high, 1e-10) ** (-1.0 / (k + 2))
        capped = h * min(f, factor) >= P.settings[H_MAX]
        if f > factor or (capped and high < norm):
            best, factor = k + 1, f
    state[3] = min(factor, P.settings[H_MAX] / h)
    return best


@native
def restore_state(P: Problem, D: Reals, w: int, t: float) -> None:
    """The accepted state back into q, u, z and the workspace after records were made."""
    n, first = P.sizes[N], P.sizes[M] + P.sizes[NV]
    for i in range(n):
        P.q[i], P.u[i] = D[i], D[n + i]
    for i in range(first):
        P.z[i] = P.rz[i]
    for i in range(P.sizes[NS]):
        P.z[first + i] = D[2 * n + i]
    put_state(P, t, P.q, P.u, P.ra, P.z, P.rd)


@native
def leave(P: Problem, D: Reals, w: int) -> None:
    """Leave the last accepted state in q, u and z."""
    restore_state(P, D, w, P.report[AT])
