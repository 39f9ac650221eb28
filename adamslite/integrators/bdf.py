"""GSTIFF: backward differentiation formulas of order 1 to 5 with variable step (BDF).

With backward differences D_i of the past values on the present step h, for y = (q, u, s)

    predictor  y_p = sum_{i=0..k} D_i,        psi = sum_{i=1..k} gamma_i D_i / gamma_k
    corrector  y' = (psi + d) gamma_k / h,    y = y_p + d,    gamma_k = 1 + 1/2 + ... + 1/k
    error      d / (k + 1)

Index 3 (I3): unknowns (q, lam), u = T q', errors of q tested.  Stabilised index 2 (SI2): also
G u + g_t = 0 with multipliers mu, errors of q and u tested.  Both in the maximum norm with weights
ERROR max(1, |y|).
CONSTANT_BDF has no error test: steps of FIXED_STEP and the order KMAX, both reached in a start-up;
what the corrector cannot do ends the run.

References: Gear, IEEE Trans. Circuit Theory 18 (1971) 89; Shampine, Reichelt, SIAM J. Sci. Comput.
18 (1997) 1 (quasi-constant step, differences); Brenan, Campbell, Petzold, Numerical Solution of
IVP in DAE, 1996, section 5.2 (tests of the corrector).
"""

from __future__ import annotations

from adamslite.integrators.acceleration import accelerations, mass_signature, put_state
from adamslite.integrators.base import (
    AT,
    BROKEN_START,
    CHATTERING,
    DONE,
    ERROR,
    FAILURES,
    FIXED_STEP,
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
    NEWTON,
    NEWTON_FAILED,
    NOT_FINITE,
    NS,
    NV,
    NZ,
    ORDER,
    ORDER_CAPPED,
    REJECTED,
    RESTARTS,
    SI2,
    SINGULAR_MASS,
    STABILISED,
    STEP,
    STEP_TOO_SMALL,
    STEPS,
    STOP,
    T_END,
    WATCHED,
    WHERE,
    M,
    N,
    Plan,
    Problem,
    T,
)
from adamslite.integrators.bdf_events import put_between, restart_step
from adamslite.integrators.equations import (
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
from adamslite.integrators.events import (
    FREED,
    HUNT,
    JUMP,
    OPEN,
    SHARE,
    change_here,
    crawls,
    ends_beyond,
    ends_there,
    happened,
    hold_watch,
    horizon,
    is_harmless,
    judge,
    keep_margins,
    let_go,
    open_search,
    pass_event,
    shorter,
    start_events,
    starts_there,
)
from adamslite.integrators.history import (
    MAX_ORDER,
    change_step,
    extend_history,
    gamma,
    predict,
    rebase,
)
from adamslite.integrators.linalg import solve
from adamslite.integrators.newton import (
    apply_increment,
    increment_norm,
    newton_matrix,
    velocity_change,
)
from adamslite.integrators.order_cap import (
    BAD,
    CAP,
    CAPPED,
    SUSPECT,
    TRAVELLED,
    TRIES,
    highest_order,
    start_watch,
    suspect,
)
from adamslite.integrators.records import note_violation, record_at
from adamslite.integrators.undo import bring_back, remember
from adamslite.translate import Reals, native

# Newton stops when the estimated remaining error is this share of ERROR.
CORRECTOR_SHARE = 0.02
# Near a singular posture round-off keeps increments of velocities from shrinking further: with a
# new matrix this share of ERROR is as good as it gets.
STALL_SHARE = 0.2
# The next step aims at an estimated error below ERROR by these factors (at a higher order: more
# caution).
SAFETY, SAFETY_UP = 3.0, 4.5
# The factored matrix is kept while its cu is within this ratio of the present one.
KEEP_RATIO = 0.25
# ... and for this many steps.
KEEP_STEPS = 20.0
# The rate of convergence is not believed to be better than this, and is doubted twice as much
# after every step that needed one iteration, because the matrix grows old unseen.
LEAST_RATE = 0.02
# A sign change of the effective mass is approached to this share of HMAX.
SINGULAR_RESOLUTION = 1e-6
# A step grows only when it pays for a new matrix, and never by more than this at once.
LEAST_GROWTH, MOST_GROWTH = 1.2, 10.0
# Cuts of the step after corrector failures before other lengths are tried.
CUTS = 3
# A step is noise, not truncation, when the error estimates of this many tries in turn keep more
# than this share of the one before, although each was shorter.
NOISY_TRIES, NOISY_SHARE = 2.0, 0.3
# Accepted steps taken back in one place.
MOST_BACKS = 6.0
# Fixed steps begin with this part of the step, because order 1 starts.
START_PARTS = 1024.0
# Steps that double again and again amplify the noise of higher orders.
GROWING_ORDER = 3.0
# A pivot of the acceleration matrix below this share of its first value has vanished.
VANISHING = 1e-3

# A jump at a stop that moves velocities by less than this share of ERROR within a step is none.
SMOOTH = 0.02

RUNNING = -1
# Places in P.control.
(
    NOW, H, K, K_TOP, EQUAL, NEXT, H_LAST, FACTORED, RATE, FRESH, AGE, RETRIES, SIGNATURE, BLAMED,
) = range(14)  # fmt: skip
NORM, NOISY, BACKS, PASSED, UNDOABLE = range(30, 35)


@native
def motion_from_increments(P: Problem, cu: float, yp: Reals, psi: Reals, si2: bool) -> None:
    """u and a from q, the history and (stabilised form) mu; writes the workspace; v = q' to
    trial.
    """
    n = P.sizes[N]
    w = 2 * n + P.sizes[NS]
    q, u, a, v = P.q, P.u, P.a, P.trial[2 * w :]
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
def correct(P: Problem, L: Plan, phases: int, cu: float, si2: bool) -> bool:
    """Newton iterations from the predictor; True when converged."""
    n, C = P.sizes[N], P.control
    w = 2 * n + P.sizes[NS]
    yp, psi, v = P.trial[0:], P.trial[w:], P.trial[2 * w :]
    error = P.settings[ERROR]
    tolerance = CORRECTOR_SHARE * error
    tested = cu if P.sizes[SI2] == 1 else 0.0
    last = 0.0
    motion_from_increments(P, cu, yp, psi, si2)
    for iteration in range(int(P.settings[MAX_IT])):
        if not keeps_matrix(C, cu):
            if not newton_matrix(P, L, phases, cu, P.q, v, P.u):
                C[FACTORED] = 0.0
                return False
            C[FACTORED], C[RATE], C[FRESH], C[AGE] = cu, 1.0, 1.0, 0.0
        residual(P, phases, P.F)
        solve(L, P.LV, P.pivots, P.F, P.x, P.work)
        scale_increment(P, 2.0 / (1.0 + cu / C[FACTORED]))
        size = increment_norm(P, P.F, tested, si2)
        apply_increment(P, P.F, P.q, P.z, P.mu, si2)
        for i in range(n):
            P.x[i] = P.u[i]
        motion_from_increments(P, cu, yp, psi, si2)
        size = max(size, velocity_change(P, P.x, cu) if si2 else 0.0)
        P.count[NEWTON] += 1
        if iteration > 0:
            C[RATE] = max(LEAST_RATE, size / last)
        if iteration > 1 and C[RATE] > 0.5 and C[FRESH] == 1.0 and size <= STALL_SHARE * error:
            return True
        if not size < 1e12 or (C[RATE] > 0.9 and iteration > 0 and size > tolerance):
            return False
        if remaining(C, size) <= tolerance:
            if iteration == 0:
                C[RATE] = min(1.0, 2.0 * C[RATE])
            return True
        last = size
    return False


@native
def remaining(C: Reals, size: float) -> float:
    """Error left after an increment of ``size`` when increments shrink by RATE each time."""
    return size * min(1.0, C[RATE] / max(1e-3, 1.0 - min(C[RATE], 0.999)))


@native
def keeps_matrix(C: Reals, cu: float) -> bool:
    """Whether the factored matrix still serves for ``cu``."""
    if C[FACTORED] == 0.0 or C[AGE] >= KEEP_STEPS:
        return False
    return abs(cu / C[FACTORED] - 1.0) <= KEEP_RATIO


@native
def scale_increment(P: Problem, ratio: float) -> None:
    """Correct the increment for a matrix factored with another cu (Brenan et al., eq. 5.2.12)."""
    if ratio != 1.0:
        for k in range(P.sizes[NZ]):
            P.F[k] *= ratio


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
    fastest, reach = 0.0, 1.0
    for i in range(n):
        reach = max(reach, abs(P.q[i]))
        fastest = max(
            fastest, abs(P.a[i]) / max(1.0, abs(P.u[i])), abs(P.u[i]) / max(1.0, abs(P.q[i]))
        )
    for k in range(P.sizes[NS]):
        fastest = max(fastest, abs(P.rd[k]))
    span = P.settings[T_END] - P.settings[T]
    h = min(P.settings[H_MAX], span)
    if P.settings[FIXED_STEP] > 0.0:
        return P.settings[FIXED_STEP] / START_PARTS
    if P.settings[H_INIT] > 0.0:
        return min(h, P.settings[H_INIT])
    # Below this step round-off of positions alone would exceed ERROR in the velocities.
    noise = 1e-14 * reach / tol if P.sizes[SI2] == 1 else 0.0
    return min(0.05 * h, max(noise, tol**0.5 / max(fastest, 1e-12) * 0.3))


@native
def weighted(
    D: Reals, row: int, w: int, n: int, ns: int, y: Reals, si2: bool, report: Reals
) -> float:
    """Largest |D_row| against max(1, |y|) over the tested variables; remembers where."""
    top, where = 0.0, 0
    o = row * w
    for i in range(2 * n if si2 else n):
        # Compared before divided: few elements ever set a new maximum.
        weight = max(1.0, abs(y[i]))
        if not abs(D[o + i]) <= top * weight:
            top, where = abs(D[o + i]) / weight, i
    for i in range(2 * n, 2 * n + ns):
        weight = max(1.0, abs(y[i]))
        if not abs(D[o + i]) <= top * weight:
            top, where = abs(D[o + i]) / weight, i
    report[WHERE] = where
    return top


@native
def bdf(P: Problem, L: Plan) -> int:
    """Integrate to the end time; returns an outcome."""
    outcome = begin(P, L)
    while outcome == RUNNING:
        outcome = advance(P, L)
    restore_state(P, P.history, 2 * P.sizes[N] + P.sizes[NS], P.control[NOW])
    P.report[AT] = P.control[NOW]
    return outcome


@native
def begin(P: Problem, L: Plan) -> int:
    """Accelerations at the start, history of order 1, first record."""
    C, t = P.control, P.settings[T]
    w = 2 * P.sizes[N] + P.sizes[NS]
    for i in range(P.control.size):
        C[i] = 0.0
    C[NOW], C[RATE], C[K], C[K_TOP] = t, 1.0, 1.0, most_order(P)
    start_watch(C)
    P.report[ORDER_CAPPED] = 0.0
    start_events(P, True)
    started = accelerations(P, L, t, P.q, P.u, P.a, P.z, P.rd)
    hold_watch(P)
    h = first_step(P, w)
    C[H] = h
    start_values(P, P.history, w, h)
    if not started:
        return BROKEN_START
    if P.sizes[IMPLICIT_MASS]:
        C[SIGNATURE] = float(mass_signature(P, L, P.pivot0))
    keep_algebraic(P)
    for i in range(P.z.size):
        P.pz[i] = P.rz[i]
    for i in range(P.sizes[N]):
        P.ra[i] = P.a[i]
    track(P)
    C[NEXT] = float(record_at(P, L, P.history, w, 0, t, h, 0))
    restore_state(P, P.history, w, t)
    return RUNNING


@native
def advance(P: Problem, L: Plan) -> int:
    """One try of a step: RUNNING to go on, whether accepted or not, else the outcome."""
    C = P.control
    n, ns = P.sizes[N], P.sizes[NS]
    w = 2 * n + ns
    if C[NOW] >= P.settings[T_END]:
        return DONE
    if P.settings[STOP] != 0.0:
        return INTERRUPTED
    limit_step(P, w)
    P.report[AT], P.report[STEP], P.report[ORDER] = C[NOW], C[H], C[K]
    if C[H] < P.settings[H_MIN] or crawls(P, C[H]):
        return RUNNING if land_elsewhere(P, w) else stuck(P, L, w)
    stabilised = P.sizes[SI2] == 1 and P.sizes[HOLONOMIC] > 0
    cu = gamma(int(C[K])) / C[H]
    start_try(P, w)
    if not correct(P, L, STABILISED if stabilised else INDEX3, cu, stabilised):
        return after_failure(P, w)
    norm = local_error(P, w)
    P.report[HOW_MUCH] = norm
    if not norm <= 1.0 and not (P.settings[FIXED_STEP] > 0.0 and norm < 1e12):
        return after_rejection(P, w, norm)
    if P.sizes[IMPLICIT_MASS]:
        if mass_signature(P, L, P.x) != int(C[SIGNATURE]):
            return near_singularity(P, w)
    return finish(P, L, w, cu, norm)


@native
def finish(P: Problem, L: Plan, w: int, cu: float, norm: float) -> int:
    """The step has passed its tests: accept it, or take it again to end at the first crossing."""
    C = P.control
    if P.sizes[WATCHED] > 0:
        locate(P, L, cu)
        if not ends_there(P):
            if starts_there(P):
                return switch_at_start(P, L, w)
            resize(P, w, shorter(P) / C[H])
            return RUNNING
    return accept(P, L, w, norm)


@native
def locate(P: Problem, L: Plan, cu: float) -> None:
    """Look for the first change of a branch within the step that has passed its test."""
    C = P.control
    t, h = C[NOW], C[H]
    stabilised = P.sizes[SI2] == 1 and P.sizes[HOLONOMIC] > 0
    open_search(P, t, h)
    if ends_beyond(P) and P.search[HUNT] == 0.0:
        if is_harmless(P, L, STABILISED if stabilised else INDEX3, cu):
            return
    while P.search[OPEN] != 0.0:
        put_between(P, int(C[K]), t, h, P.search[SHARE])
        judge(P)
    put_state(P, t + h, P.q, P.u, P.a, P.z, P.rd)


@native
def switch_at_start(P: Problem, L: Plan, w: int) -> int:
    """A branch changes just behind the start of the step: change it there and begin anew."""
    P.control[UNDOABLE] = 0.0
    restore_state(P, P.history, w, P.control[NOW])
    for i in range(P.sizes[N]):
        P.a[i] = P.ra[i]
    if not change_here(P, L, P.control[NOW]):
        return NEWTON_FAILED
    begin_anew(P, L, w)
    return RUNNING


@native
def pass_on(P: Problem, L: Plan, w: int) -> int:
    """Behind an event: the history goes on when nothing jumped, else a new one begins."""
    C = P.control
    # A step that is taken back must not lead across an event.
    C[UNDOABLE] = 0.0
    restore_state(P, P.history, w, C[NOW])
    for i in range(P.sizes[N]):
        P.a[i] = P.ra[i]
    if not pass_event(P, L, C[NOW]):
        return NEWTON_FAILED
    if P.search[JUMP] * C[H_LAST] > SMOOTH * P.settings[ERROR]:
        begin_anew(P, L, w)
        return RUNNING
    C[FACTORED] = 0.0
    for i in range(P.sizes[N]):
        P.ra[i] = P.a[i]
    keep_algebraic(P)
    restore_state(P, P.history, w, C[NOW])
    return RUNNING


@native
def begin_anew(P: Problem, L: Plan, w: int) -> None:
    """A history of order 1 from the state and the accelerations in place."""
    C = P.control
    P.count[RESTARTS] += 1
    for i in range(P.sizes[N]):
        P.ra[i] = P.a[i]
    keep_algebraic(P)
    for i in range(P.z.size):
        P.pz[i] = P.rz[i]
    C[H], C[K], C[EQUAL] = restart_step(P, L, C[NOW], first_step(P, w)), 1.0, 0.0
    C[H_LAST], C[FACTORED] = 0.0, 0.0
    C[TRAVELLED], C[BAD], C[TRIES], C[SUSPECT] = 0.0, 0.0, 0.0, 0.0
    start_values(P, P.history, w, C[H])
    put_state(P, C[NOW], P.q, P.u, P.ra, P.z, P.rd)
    if P.sizes[IMPLICIT_MASS]:
        C[SIGNATURE] = float(mass_signature(P, L, P.x))


@native
def limit_step(P: Problem, w: int) -> None:
    """Keep the step within HMAX and the end time."""
    C = P.control
    if C[H] > P.settings[H_MAX] * 1.0000001:
        resize(P, w, P.settings[H_MAX] / C[H])
    left = horizon(P) - C[NOW]
    if C[H] * 1.0000001 > left:
        resize(P, w, left / C[H])
    elif 2.0 * C[H] > left and horizon(P) < P.settings[T_END]:
        resize(P, w, 0.5 * left / C[H])


@native
def resize(P: Problem, w: int, factor: float) -> None:
    """Change the step and with it the history."""
    change_step(P.history, w, int(P.control[K]), factor)
    P.control[H] *= factor
    P.control[EQUAL] = 0.0


@native
def start_try(P: Problem, w: int) -> None:
    """Predicted values of all unknowns at the end of the step."""
    n, ns, C = P.sizes[N], P.sizes[NS], P.control
    first = P.sizes[M] + P.sizes[NV]
    yp = P.trial[0:]
    predict(P.history, w, int(C[K]), yp, P.trial[w:])
    for i in range(n):
        P.q[i] = yp[i]
    for i in range(ns):
        P.z[first + i] = yp[2 * n + i]
    ahead = C[H] / C[H_LAST] if C[H_LAST] > 0.0 else 0.0
    for i in range(first):
        P.z[i] = P.rz[i] + min(ahead, 2.0) * (P.rz[i] - P.pz[i])
    for i in range(P.mu.size):
        P.mu[i] = 0.0
    put_time(P, C[NOW] + C[H])


@native
def after_failure(P: Problem, w: int) -> int:
    """The corrector failed: renew an old matrix, else cut the step."""
    C = P.control
    P.count[FAILURES] += 1
    old = C[FRESH] == 0.0 and C[FACTORED] != 0.0
    C[FACTORED] = 0.0
    if old or let_go(P):
        return RUNNING
    C[RETRIES] += 1.0
    C[FRESH] = 0.0
    C[BLAMED] = float(wildest(P))
    if P.settings[FIXED_STEP] > 0.0:
        P.report[WHERE] = C[BLAMED]
        return NEWTON_FAILED
    if int(C[RETRIES]) != CUTS or not land_elsewhere(P, w):
        resize(P, w, retry_factor(C))
    return RUNNING


@native
def land_elsewhere(P: Problem, w: int) -> bool:
    """Take the last accepted step back and make it shorter; False when that was tried enough."""
    C = P.control
    if C[UNDOABLE] == 0.0 or C[BACKS] >= MOST_BACKS:
        return False
    backs, passed = C[BACKS] + 1.0, max(C[PASSED], C[NOW])
    bring_back(P)
    C[BACKS], C[PASSED], C[UNDOABLE], C[FACTORED] = backs, passed, 0.0, 0.0
    restore_state(P, P.history, w, C[NOW])
    # 0.6, 0.82, 0.33, 0.55, 0.77, 0.28: lengths that are no multiples of each other.
    resize(P, w, 0.6 if backs == 1.0 else 0.25 + 0.75 * (0.38 * backs - int(0.38 * backs)))
    return True


@native
def wildest(P: Problem) -> int:
    """The unknown with the largest last increment, numbered as in the error test."""
    n, first, where, top = P.sizes[N], P.sizes[M] + P.sizes[NV], 0, -1.0
    for i in range(n):
        if not abs(P.F[i]) <= top * max(1.0, abs(P.q[i])):
            top, where = abs(P.F[i]) / max(1.0, abs(P.q[i])), i
    for k in range(first, first + P.sizes[NS]):
        if not abs(P.F[n + k]) <= top * max(1.0, abs(P.z[k])):
            top, where = abs(P.F[n + k]) / max(1.0, abs(P.z[k])), 2 * n + k - first
    return where


@native
def retry_factor(C: Reals) -> float:
    """Change of the step after a failed corrector: smaller at first.

    Near a singular posture (dead centre, flattened parallelogram) ever smaller steps do not help,
    but a step across does: after some cuts a few other lengths around the last good one are tried.
    """
    tried = int(C[RETRIES])
    if tried == 1:
        return 0.6
    if C[H_LAST] > 0.0 and tried > CUTS and tried <= CUTS + 5:
        leap = 0.7
        if tried == CUTS + 1:
            leap = 1.3
        if tried == CUTS + 2:
            leap = 1.9
        if tried == CUTS + 3:
            leap = 2.7
        if tried == CUTS + 4:
            leap = 4.0
        return leap * C[H_LAST] / C[H]
    return 0.25


@native
def local_error(P: Problem, w: int) -> float:
    """Estimated error over ERROR; leaves d in psi's place and y in the prediction's."""
    n, ns, C = P.sizes[N], P.sizes[NS], P.control
    first = P.sizes[M] + P.sizes[NV]
    y, d = P.trial[0:], P.trial[w:]
    for i in range(w):
        value = P.q[i] if i < n else (P.u[i - n] if i < 2 * n else P.z[first + i - 2 * n])
        d[i] = value - y[i]
        y[i] = value
    C[TRIES] += 1.0
    size = weighted(d, 0, 0, n, ns, y, P.sizes[SI2] == 1, P.report)
    return size / ((C[K] + 1.0) * P.settings[ERROR])


@native
def after_rejection(P: Problem, w: int, norm: float) -> int:
    """The error was too large: a smaller step."""
    C = P.control
    P.count[REJECTED] += 1
    C[FRESH] = 0.0
    if not norm < 1e12:
        return NOT_FINITE
    factor = max(0.2, (SAFETY * norm) ** (-1.0 / (C[K] + 1.0)))
    # At the last, tiny steps the error is round-off, and anybody's.
    if C[H] > 1e-9 * P.settings[H_MAX]:
        C[BLAMED] = P.report[WHERE]
    C[NOISY] = C[NOISY] + 1.0 if norm > NOISY_SHARE * C[NORM] and C[NORM] > 0.0 else 0.0
    C[NORM] = norm
    if C[NOISY] >= NOISY_TRIES and land_elsewhere(P, w):
        return RUNNING
    if C[K] > 2.0:
        C[BAD] += 1.0
    resize(P, w, factor)
    return RUNNING


@native
def near_singularity(P: Problem, w: int) -> int:
    """The acceleration matrix became singular within the step: approach the place, never pass
    it.
    """
    if P.control[H] < SINGULAR_RESOLUTION * P.settings[H_MAX] or P.settings[FIXED_STEP] > 0.0:
        return SINGULAR_MASS
    P.control[FRESH] = 0.0
    resize(P, w, 0.25)
    return RUNNING


@native
def stuck(P: Problem, L: Plan, w: int) -> int:
    """Why the step became too small: a vanishing pivot of the acceleration matrix, or something
    else.
    """
    restore_state(P, P.history, w, P.control[NOW])
    if P.sizes[IMPLICIT_MASS]:
        if mass_signature(P, L, P.x) != int(P.control[SIGNATURE]):
            return SINGULAR_MASS
        for k in range(P.sizes[NZ]):
            if not abs(P.x[k]) > VANISHING * abs(P.pivot0[k]):
                return SINGULAR_MASS
    P.report[WHERE] = P.control[BLAMED]
    if P.search[FREED] > 0.0:
        return CHATTERING
    return NEWTON_FAILED if P.control[RETRIES] > 2.0 else STEP_TOO_SMALL


@native
def accept(P: Problem, L: Plan, w: int, norm: float) -> int:
    """Move the history on, write records, choose the next order and step."""
    C, D = P.control, P.history
    k = int(C[K])
    P.count[STEPS] += 1
    C[RETRIES], C[FRESH], C[NORM], C[NOISY] = 0.0, 0.0, 0.0, 0.0
    make_undoable(P)
    C[AGE] += 1.0
    extend_history(D, P.trial[w:], w, k)
    t, h = C[NOW] + C[H], C[H]
    if t + 1e-7 * h > horizon(P):
        t = horizon(P)
    C[NOW], C[H_LAST] = t, h
    for i in range(P.z.size):
        P.pz[i] = P.rz[i]
    keep_algebraic(P)
    for i in range(P.sizes[N]):
        P.ra[i] = P.a[i]
    note_violation(P, t)
    following = record_at(P, L, D, w, k, t, h, int(C[NEXT]))
    if following < 0:
        return SINGULAR_MASS
    if following > int(C[NEXT]):
        restore_state(P, D, w, t)
    C[NEXT] = float(following)
    track(P)
    rebase(P, D, w, k)
    C[EQUAL] += 1.0
    C[TRAVELLED] += h
    C[K_TOP] = highest_order(C, C[K_TOP], most_order(P), P.settings[H_MAX])
    P.report[ORDER_CAPPED] = 1.0 if C[CAP] == CAPPED else 0.0
    if happened(P, t):
        return pass_on(P, L, w)
    keep_margins(P)
    adapt_order(P, w, norm)
    return RUNNING


@native
def adapt_order(P: Problem, w: int, norm: float) -> None:
    """Order and size of the next step."""
    C = P.control
    if P.settings[FIXED_STEP] > 0.0:
        approach_fixed_step(P, w)
    elif C[K] > C[K_TOP]:
        drop_order(P, w)
    elif C[EQUAL] > C[K]:
        choose_order(P, w, norm)


@native
def make_undoable(P: Problem) -> None:
    """Keep the state from which the accepted step started."""
    C = P.control
    if P.undo.size > 0:
        remember(P)
        C[UNDOABLE] = 1.0
        if C[NOW] > C[PASSED]:
            C[BACKS] = 0.0


@native
def most_order(P: Problem) -> float:
    """KMAX, as far as there are formulas."""
    return min(float(MAX_ORDER), P.settings[K_MAX])


@native
def drop_order(P: Problem, w: int) -> None:
    """Down to the highest order allowed, with the step that suits it."""
    C, D, si2 = P.control, P.history, P.sizes[SI2] == 1
    k = int(C[K_TOP])
    size = weighted(D, k + 1, w, P.sizes[N], P.sizes[NS], D, si2, P.coef)
    C[K] = C[K_TOP]
    norm = size / ((k + 1) * P.settings[ERROR])
    resize(P, w, min(1.0, max(SAFETY * norm, 1e-10) ** (-1.0 / (k + 1))))


@native
def approach_fixed_step(P: Problem, w: int) -> None:
    """Raise the order to GROWING_ORDER, the step to FIXED_STEP, then the order to KMAX; each only
    after as many equal steps as the formula looks back.
    """
    C, growth = P.control, min(2.0, P.settings[FIXED_STEP] / P.control[H])
    if C[EQUAL] <= C[K]:
        return
    grown = growth <= 1.0000001
    if C[K] < most_order(P) and (C[K] < GROWING_ORDER or grown):
        C[K] += 1.0
        C[EQUAL] = 0.0
    elif not grown:
        resize(P, w, growth)


@native
def keep_algebraic(P: Problem) -> None:
    """Remember multipliers and variables of the accepted state."""
    for i in range(P.z.size):
        P.rz[i] = P.z[i]


@native
def choose_order(P: Problem, w: int, norm: float) -> None:
    """The order and the step ratio that promise the largest next step.

    When HMAX caps the step, the present order is kept unless a higher one is more accurate, because
    "largest step" would always pick the lowest.
    """
    C, D, n, ns = P.control, P.history, P.sizes[N], P.sizes[NS]
    k, si2, tol, room = int(C[K]), P.sizes[SI2] == 1, P.settings[ERROR], P.settings[H_MAX] / C[H]
    same = max(SAFETY * norm, 1e-10) ** (-1.0 / (k + 1))
    best, factor = k, same
    if k > 1:
        low = weighted(D, k, w, n, ns, D, si2, P.coef)
        suspect(C, k, low, norm * (k + 1) * tol, tol, C[EQUAL])
        f = max(SAFETY * low / (k * tol), 1e-10) ** (-1.0 / k)
        if f > factor and min(f, same) < room:
            best, factor = k - 1, f
    if k < int(C[K_TOP]):
        high = weighted(D, k + 2, w, n, ns, D, si2, P.coef) / ((k + 2) * tol)
        f = max(SAFETY_UP * high, 1e-10) ** (-1.0 / (k + 2))
        if f > factor or (min(f, factor) >= room and high < norm):
            best, factor = k + 1, f
    factor = min(factor, min(room, MOST_GROWTH))
    if best != k or factor >= LEAST_GROWTH or factor < 0.9:
        C[K] = float(best)
        resize(P, w, factor)


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
