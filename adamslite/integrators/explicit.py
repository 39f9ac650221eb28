"""ABAM, RKF45: an explicit Runge-Kutta pair of order 8(5,3) with dense output of order 7.

    y = (q, u, s),   y' = f(t, y) = (T^-1 u, a, s'),     k_i = f(t + c_i h, y + h sum a_ij k_j)
    y+ = y + h sum b_i k_i,    error = |e5|^2/sqrt(|e5|^2 + 0.01 |e3|^2)    over ERROR max(1, |y|)

Accelerations come body by body when nothing ties bodies together
(:mod:`adamslite.integrators.free`), else from the index-1 equations
(:mod:`adamslite.integrators.acceleration`) with a factored matrix that serves all stages of a step.
With constraints every accepted state is projected in the mass metric,

    [M, G^T; G, 0] (dq, .) = (0, g),    [M, G^T; G, 0] (du, .) = (0, G u + g_t),

so that nothing drifts.  Rotations are Cayley vectors counted from the attitude at the step's start.
References: Hairer, Norsett, Wanner, Solving ODE I, 1993, sections II.4 (start, steps), II.5, II.6,
II.10 (error); Hairer, Lubich, Wanner, Geometric Numerical Integration, 2006, sections IV.4, VII.1.
"""

from __future__ import annotations

from adamslite.integrators.acceleration import (
    acceleration_matrix,
    accelerations,
    mass_signature,
    put_state,
    settle,
)
from adamslite.integrators.base import (
    AT,
    BROKEN_START,
    CHATTERING,
    DONE,
    ERROR,
    FACTORIZATIONS,
    FAILURES,
    H_INIT,
    H_MAX,
    H_MIN,
    HOW_MUCH,
    IMPLICIT_MASS,
    INTERRUPTED,
    NB,
    NEWTON_FAILED,
    NS,
    NV,
    ORDER,
    REJECTED,
    RESTARTS,
    SINGULAR_MASS,
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
from adamslite.integrators.dop853 import (
    ERROR3,
    ERROR5,
    LATE,
    POWERS,
    RESULT,
    ROW,
    TIMES,
)
from adamslite.integrators.equations import BODY, PART, track, vector_rates
from adamslite.integrators.events import (
    FREED,
    JUMP,
    change_here,
    crawls,
    ends_there,
    happened,
    hold_watch,
    horizon,
    keep_margins,
    let_go,
    pass_event,
    shorter,
    start_events,
    starts_there,
)
from adamslite.integrators.explicit_events import locate_between
from adamslite.integrators.free import (
    free_accelerations,
    invert_inertia,
    is_free,
    mass_accelerations,
    mass_tables,
)
from adamslite.integrators.linalg import factor
from adamslite.integrators.projection import project
from adamslite.integrators.records import note_violation, write_record
from adamslite.translate import Alone, Reals, native

# Rows of the history: stages from 0, then the accepted state, the new one, one in between, and
# the inverse inertias.
K_NEW, OLD, NEXT_STATE, BETWEEN, INVERSE = 12, 16, 17, 18, 19
HISTORY_ROWS = 20
# The next step aims at this share of what the error test allows; exponents of the present and the
# last error (section IV.2 of the second volume: steadier at the limit of stability).
SAFETY = 0.9
NOW_POWER, LAST_POWER = -0.125 + 0.03, 0.04
SHRINK, GROW = 0.2, 6.0
SINGULAR_RESOLUTION = 1e-6

RUNNING = -1
# Places in P.control.
CLOCK, H, FOLLOWING, LAST_ERROR, FREE, CAUTIOUS, SIGNATURE, FAILED, WIDTH, STALE = range(10)
# Kinds of scenes, in C[FREE]: tied, free bodies, point masses alone.
BODIES, MASSES = 1.0, 2.0


@native
def combine(P: Problem, row: int, w: int, h: float, x: Reals, y: Reals) -> None:
    """y = x + h sum (weight k) over one row of the tableau."""
    if P.control[FREE] == MASSES:
        n, s = P.sizes[N], h * P.tableau[ROW * row + 1]
        for i in range(n):
            y[n + i] = x[n + i]
            y[i] = x[i] + s * x[n + i]
    else:
        for i in range(w):
            y[i] = x[i]
    add_combined(P, row, w, h, y)


@native
def add_combined(P: Problem, row: int, w: int, h: float, y: Reals) -> None:
    """y += h sum (weight k) over one row of the tableau.

    Masses keep no rates of positions: those of stage i are u + h sum a_ij a_j, so that positions
    get h^2 sum (weight A)_j a_j.
    """
    K, o, n = P.history, ROW * row, P.sizes[N]
    for g in range(0, int(P.tableau[o]), 4):
        V = P.tableau[o + 2 + 3 * g :]
        if P.control[FREE] == MASSES:
            add_twice(
                K[n * int(V[0]) :], K[n * int(V[3]) :], K[n * int(V[6]) :], K[n * int(V[9]) :],
                h * V[1], h * V[4], h * V[7], h * V[10],
                h * P.control[H] * V[2], h * P.control[H] * V[5],
                h * P.control[H] * V[8], h * P.control[H] * V[11], n, y, y[n:],
            )  # fmt: skip
        else:
            add_once(
                K[w * int(V[0]) :], K[w * int(V[3]) :], K[w * int(V[6]) :], K[w * int(V[9]) :],
                h * V[1], h * V[4], h * V[7], h * V[10], w, y,
            )  # fmt: skip


@native
def add_once(
    a: Reals, b: Reals, c: Reals, d: Reals,
    ca: float, cb: float, cc: float, cd: float, w: int, y: Alone,
) -> None:  # fmt: skip
    """y += ca a + cb b + cc c + cd d"""
    for i in range(w):
        y[i] += (ca * a[i] + cb * b[i]) + (cc * c[i] + cd * d[i])


@native
def add_twice(
    a: Reals, b: Reals, c: Reals, d: Reals,
    ca: float, cb: float, cc: float, cd: float,
    ea: float, eb: float, ec: float, ed: float, n: int, q: Alone, u: Alone,
) -> None:  # fmt: skip
    """u += ca a + ..., q += ea a + ... in one pass."""
    for i in range(n):
        u[i] += (ca * a[i] + cb * b[i]) + (cc * c[i] + cd * d[i])
        q[i] += (ea * a[i] + eb * b[i]) + (ec * c[i] + ed * d[i])


@native
def explicit(P: Problem, L: Plan) -> int:
    """Integrate to the end time; returns an outcome."""
    outcome = begin_explicit(P, L)
    while outcome == RUNNING:
        outcome = try_step(P, L)
    P.report[AT] = P.control[CLOCK]
    return outcome


@native
def rates_at(P: Problem, L: Plan, t: float, y: Reals, k: Reals) -> bool:
    """k = f(t, y); False when the accelerations cannot be solved for."""
    n, first = P.sizes[N], P.sizes[M] + P.sizes[NV]
    inverse = P.history[INVERSE * (2 * n) :]
    if P.control[FREE] == MASSES:
        mass_accelerations(P, t, y, y[n:], inverse, inverse[n:], k)
        return True
    if P.control[FREE] == BODIES:
        free_accelerations(P, t, y, y[n:], inverse, k[n:])
        vector_rates(P, y, y[n:], k)
        return True
    for i in range(P.sizes[NS]):
        P.z[first + i] = y[2 * n + i]
    # Once the matrix of the step's start was too old for a stage, each of the rest gets its own.
    before = P.count[FACTORIZATIONS]
    if P.control[STALE] == 1.0:
        good = accelerations(P, L, t, y, y[n:], P.a, P.z, P.rd)
    else:
        put_state(P, t, y, y[n:], P.a, P.z, P.rd)
        good = settle(P, L, y[n:], P.a, P.z, P.rd)
        P.control[STALE] = 1.0 if P.count[FACTORIZATIONS] > before else 0.0
    keep_rates(P, y, k)
    return good


@native
def keep_rates(P: Problem, y: Reals, k: Reals) -> None:
    """k = (T^-1 u, a, s') from what was solved for."""
    n = P.sizes[N]
    vector_rates(P, y, y[n:], k)
    for i in range(n):
        k[n + i] = P.a[i]
    for i in range(P.sizes[NS]):
        k[2 * n + i] = P.rd[i]


@native
def exact_rates(P: Problem, L: Plan, t: float, y: Reals, k: Reals) -> bool:
    """Rates at a state that is kept: projected onto the constraints, with a new matrix; writes
    q, u, a and the workspace.
    """
    n, first = P.sizes[N], P.sizes[M] + P.sizes[NV]
    good = True
    if P.control[FREE] != 0.0:
        rates_at(P, L, t, y, k)
        first = 0 if P.control[FREE] == MASSES else n
        for i in range(n):
            P.a[i] = k[first + i]
        put_state(P, t, y, y[n:], P.a, P.z, P.rd)
    else:
        for i in range(P.sizes[NS]):
            P.z[first + i] = y[2 * n + i]
        put_state(P, t, y, y[n:], P.a, P.z, P.rd)
        acceleration_matrix(P)
        good = factor(L, P.LA, P.pivots_a, P.work)
        if good and P.sizes[M] > 0:
            good = project(P, L, y, y[n:])
        if good:
            put_state(P, t, y, y[n:], P.a, P.z, P.rd)
            good = settle(P, L, y[n:], P.a, P.z, P.rd)
        keep_rates(P, y, k)
    for i in range(n):
        P.q[i], P.u[i] = y[i], y[n + i]
    return good


@native
def begin_explicit(P: Problem, L: Plan) -> int:
    """Rates at the start, first record, first step."""
    C, t = P.control, P.settings[T]
    n, ns, first = P.sizes[N], P.sizes[NS], P.sizes[M] + P.sizes[NV]
    w = 2 * n + ns
    for i in range(P.control.size):
        C[i] = 0.0
    C[CLOCK], C[LAST_ERROR] = t, 1e-4
    y, k = P.history[OLD * w :], P.history[0:]
    for i in range(n):
        y[i], y[n + i] = P.q[i], P.u[i]
    for i in range(ns):
        y[2 * n + i] = P.z[first + i]
    C[WIDTH] = float(w)
    start_events(P, True)
    inverse = P.history[INVERSE * w :]
    if is_free(P) and mass_tables(P, inverse, inverse[n:]):
        C[FREE], C[WIDTH] = MASSES, float(n)
    elif is_free(P) and invert_inertia(P, inverse):
        C[FREE] = BODIES
    elif not accelerations(P, L, t, P.q, P.u, P.a, P.z, P.rd):
        return BROKEN_START
    if P.sizes[IMPLICIT_MASS]:
        C[SIGNATURE] = float(mass_signature(P, L, P.pivot0))
    if not exact_rates(P, L, t, y, k):
        return BROKEN_START
    hold_watch(P)
    P.report[ORDER] = 8.0
    C[H] = starting_step(P, L, w)
    if not exact_rates(P, L, t, y, k):
        return BROKEN_START
    base_here(P, w)
    keep_solution(P)
    track(P)
    write_record(P, 0)
    C[FOLLOWING] = 1.0
    return RUNNING


@native
def distance(P: Problem, a: Reals, y: Reals, w: int) -> float:
    """Largest |a_i| against ERROR max(1, |y_i|); remembers where."""
    top, where = 0.0, 0
    for i in range(w):
        # Compared before divided: few elements ever set a new maximum.
        weight = max(1.0, abs(y[i]))
        if not abs(a[i]) <= top * weight:
            top, where = abs(a[i]) / weight, i
    P.report[WHERE] = where
    return top / P.settings[ERROR]


@native
def starting_step(P: Problem, L: Plan, w: int) -> float:
    """A step whose errors are small, from the rates here and one small step further (section
    II.4).
    """
    t = P.control[CLOCK]
    room = min(P.settings[H_MAX], P.settings[T_END] - t)
    if P.settings[H_INIT] > 0.0:
        return min(room, P.settings[H_INIT])
    y, new, width = P.history[OLD * w :], P.history[NEXT_STATE * w :], int(P.control[WIDTH])
    h = euler(P, w, 1.0)
    d0, d1 = distance(P, y, y, w), change(P, w) / h
    h = min(room, 0.01 * d0 / d1 if d0 > 1e-5 and d1 > 1e-5 else 1e-6)
    euler(P, w, h)
    k = P.history[width:]
    if not rates_at(P, L, t + h, new, k):
        return 0.01 * h
    d2, n = d1, P.sizes[N]
    for i in range(w - n):
        k[i] = k[width - w + n + i] - P.history[width - w + n + i]
    d2 = max(d2, distance(P, k, y[n:], w - n) / h)
    later = (0.01 / d2) ** 0.125 if d2 > 1e-15 else max(1e-6, 1e-3 * h)
    return min(room, min(100.0 * h, later))


@native
def euler(P: Problem, w: int, h: float) -> float:
    """The new state by Euler's formula; returns h."""
    P.control[H] = h
    combine(P, 0, w, h / P.tableau[3], P.history[OLD * w :], P.history[NEXT_STATE * w :])
    return h


@native
def change(P: Problem, w: int) -> float:
    """Distance of the new state from the old."""
    y, new, e = P.history[OLD * w :], P.history[NEXT_STATE * w :], P.trial[0:]
    for i in range(w):
        e[i] = new[i] - y[i]
    return distance(P, e, y, w)


@native
def try_step(P: Problem, L: Plan) -> int:
    """One try of a step: RUNNING to go on, whether accepted or not, else the outcome."""
    C = P.control
    w = 2 * P.sizes[N] + P.sizes[NS]
    if C[CLOCK] >= P.settings[T_END]:
        return DONE
    if P.settings[STOP] != 0.0:
        return INTERRUPTED
    C[H] = min(C[H], P.settings[H_MAX])
    left = horizon(P) - C[CLOCK]
    if C[H] * 1.0000001 > left:
        C[H] = left
    P.report[AT], P.report[STEP] = C[CLOCK], C[H]
    if C[H] < P.settings[H_MIN] or crawls(P, C[H]):
        return why_stuck(P)
    if not run_stages(P, L, w, C[H]):
        if let_go(P):
            return RUNNING
        return shorten(P, 0.25)
    error = estimate(P, w, C[H])
    P.report[HOW_MUCH] = error
    if not error <= 1.0:
        P.count[REJECTED] += 1
        if not error < 1e150 and let_go(P):
            return RUNNING
        C[CAUTIOUS] = 1.0
        C[H] *= max(SHRINK, SAFETY * error**NOW_POWER) if error < 1e12 else SHRINK
        return RUNNING
    return accept_step(P, L, w, error)


@native
def shorten(P: Problem, factor: float) -> int:
    """Accelerations could not be solved for within the step: a shorter one."""
    C = P.control
    P.count[FAILURES] += 1
    C[FAILED] = C[FAILED] + 1.0
    C[H] *= factor
    C[CAUTIOUS] = 1.0
    if P.sizes[IMPLICIT_MASS] and C[H] < SINGULAR_RESOLUTION * P.settings[H_MAX]:
        return SINGULAR_MASS
    return RUNNING


@native
def why_stuck(P: Problem) -> int:
    """The step became too small: because the equations could not be solved, or for accuracy."""
    if P.search[FREED] > 0.0:
        return CHATTERING
    return NEWTON_FAILED if P.control[FAILED] > 0.0 else STEP_TOO_SMALL


@native
def run_stages(P: Problem, L: Plan, w: int, h: float) -> bool:
    """Rates of all stages and the new state; False when one could not be had."""
    K, t = P.history, P.control[CLOCK]
    y, new = K[OLD * w :], K[NEXT_STATE * w :]
    P.control[STALE] = 0.0
    for i in range(1, RESULT + 1):
        combine(P, i - 1, w, h, y, new)
        at = t + h * P.tableau[ROW * TIMES + i]
        if not rates_at(P, L, at, new, K[i * int(P.control[WIDTH]) :]):
            return False
    combine(P, RESULT, w, h, y, new)
    return True


@native
def estimate(P: Problem, w: int, h: float) -> float:
    """Error of the step against ERROR: the fifth order's, tamed by the third's."""
    y, zero, e = P.history[NEXT_STATE * w :], P.history[BETWEEN * w :], P.trial[0:]
    for i in range(w):
        zero[i] = 0.0
    combine(P, ERROR3, w, h, zero, e)
    third = distance(P, e, y, w)
    combine(P, ERROR5, w, h, zero, e)
    fifth = distance(P, e, y, w)
    if not third < 1e150 or not fifth < 1e150:
        return 1e300
    if fifth == 0.0:
        return 0.0
    return fifth * fifth / (fifth * fifth + 0.01 * third * third) ** 0.5


@native
def accept_step(P: Problem, L: Plan, w: int, error: float) -> int:
    """Project, and move on unless the step is to end at a crossing before."""
    C, K = P.control, P.history
    h, t = C[H], C[CLOCK] + C[H]
    if t + 1e-7 * h > horizon(P):
        t = horizon(P)
    new, width = K[NEXT_STATE * w :], int(C[WIDTH])
    if P.sizes[IMPLICIT_MASS] and changed_signature(P, L, t, new):
        return shorten(P, 0.25)
    if not exact_rates(P, L, t, new, K[K_NEW * width :]):
        return shorten(P, 0.25)
    if P.sizes[WATCHED] > 0:
        locate_between(P, C[CLOCK], h, width, OLD * w, K_NEW)
        if not ends_there(P):
            if starts_there(P):
                return change_where_it_stands(P, L, w)
            C[H] = shorter(P)
            return RUNNING
    return move_on(P, L, w, t, error)


@native
def move_on(P: Problem, L: Plan, w: int, t: float, error: float) -> int:
    """Write records up to ``t``, take over the new state, choose the next step."""
    C, K, width = P.control, P.history, int(P.control[WIDTH])
    new = K[NEXT_STATE * w :]
    P.count[STEPS] += 1
    C[FAILED] = 0.0
    note_violation(P, t)
    keep_solution(P)
    if not write_dense(P, L, w, t):
        return SINGULAR_MASS
    C[CLOCK] = t
    for i in range(w):
        K[OLD * w + i] = new[i]
    for i in range(width):
        K[i] = K[K_NEW * width + i]
    stand_again(P, w)
    track(P)
    base_here(P, w)
    if happened(P, t):
        return pass_by(P, L, w)
    keep_margins(P)
    choose_explicit_step(P, error)
    return RUNNING


@native
def choose_explicit_step(P: Problem, error: float) -> None:
    """The next step from the errors of this and the last one."""
    C, factor = P.control, GROW
    if error > 0.0:
        factor = min(GROW, SAFETY * error**NOW_POWER * C[LAST_ERROR] ** LAST_POWER)
    if C[CAUTIOUS] != 0.0:
        factor = min(1.0, factor)
    C[H] *= max(SHRINK, factor)
    C[CAUTIOUS], C[LAST_ERROR] = 0.0, max(error, 1e-4)


@native
def change_where_it_stands(P: Problem, L: Plan, w: int) -> int:
    """A branch changes just behind the start of the step: change it there and begin anew."""
    stand_again(P, w)
    if not change_here(P, L, P.control[CLOCK]):
        return NEWTON_FAILED
    return rates_anew(P, L, w, True)


@native
def pass_by(P: Problem, L: Plan, w: int) -> int:
    """Behind an event: rates of the new branches, another step when something jumped."""
    if not pass_event(P, L, P.control[CLOCK]):
        return NEWTON_FAILED
    return rates_anew(P, L, w, P.search[JUMP] > 0.0)


@native
def rates_anew(P: Problem, L: Plan, w: int, restart: bool) -> int:
    """The first stage again; with ``restart`` the step is chosen as at the start of a run."""
    C, y, k = P.control, P.history[OLD * w :], P.history[0:]
    if not exact_rates(P, L, C[CLOCK], y, k):
        return NEWTON_FAILED
    if restart:
        P.count[RESTARTS] += 1
        keep_solution(P)
        if P.sizes[IMPLICIT_MASS]:
            C[SIGNATURE] = float(mass_signature(P, L, P.x))
        C[H], C[LAST_ERROR] = starting_step(P, L, w), 1e-4
        if not exact_rates(P, L, C[CLOCK], y, k):
            return NEWTON_FAILED
    keep_solution(P)
    return RUNNING


@native
def changed_signature(P: Problem, L: Plan, t: float, y: Reals) -> bool:
    """Whether the acceleration matrix became singular within the step."""
    n = P.sizes[N]
    put_state(P, t, y, y[n:], P.a, P.z, P.rd)
    return mass_signature(P, L, P.x) != int(P.control[SIGNATURE])


@native
def keep_solution(P: Problem) -> None:
    """Remember accelerations, multipliers and variables of the new state."""
    for i in range(P.sizes[N]):
        P.ra[i] = P.a[i]
    for i in range(P.z.size):
        P.rz[i] = P.z[i]


@native
def stand_again(P: Problem, w: int) -> None:
    """The accepted state back into q, u, a, z and the workspace after records were made."""
    n, first = P.sizes[N], P.sizes[M] + P.sizes[NV]
    y = P.history[OLD * w :]
    for i in range(n):
        P.q[i], P.u[i], P.a[i] = y[i], y[n + i], P.ra[i]
    for i in range(first):
        P.z[i] = P.rz[i]
    for i in range(P.sizes[NS]):
        P.z[first + i], P.rd[i] = y[2 * n + i], P.history[2 * n + i]
    put_state(P, P.control[CLOCK], P.q, P.u, P.a, P.z, P.rd)


@native
def base_here(P: Problem, w: int) -> None:
    """Count rotation vectors from the accepted attitude."""
    n, y, k = P.sizes[N], P.history[OLD * w :], P.history[0:]
    for b in range(P.sizes[NB]):
        if P.body[BODY * b] == PART:
            i, o = P.body[BODY * b + 1] + 3, P.body[BODY * b + 2] + 15
            for m in range(9):
                P.base[9 * b + m] = P.W[o + m]
            for c in range(3):
                P.q[i + c], y[i + c], k[i + c] = 0.0, 0.0, y[n + i + c]


@native
def write_dense(P: Problem, L: Plan, w: int, t: float) -> bool:
    """Write every asked time up to ``t``, the end of the step."""
    C, K = P.control, P.history
    following, ready, h = int(C[FOLLOWING]), False, C[H]
    while following < P.times.size and P.times[following] <= t + 1e-9 * h:
        y = K[NEXT_STATE * w :]
        if P.times[following] < t - 1e-9 * h:
            if not ready and not late_stages(P, L, w, h):
                return False
            ready = True
            y = K[BETWEEN * w :]
            interpolated(P, w, h, (P.times[following] - C[CLOCK]) / h, y)
        if ready and not exact_rates(P, L, P.times[following], y, P.trial):
            return False
        write_record(P, following)
        following += 1
    C[FOLLOWING] = float(following)
    return True


@native
def late_stages(P: Problem, L: Plan, w: int, h: float) -> bool:
    """Three more stages for the interpolation."""
    K, y = P.history, P.history[BETWEEN * w :]
    for i in range(K_NEW + 1, K_NEW + 4):
        combine(P, LATE + i - K_NEW - 1, w, h, K[OLD * w :], y)
        at = P.control[CLOCK] + h * P.tableau[ROW * TIMES + i]
        if not rates_at(P, L, at, y, K[i * int(P.control[WIDTH]) :]):
            return False
    return True


@native
def interpolated(P: Problem, w: int, h: float, x: float, y: Reals) -> None:
    """The state at t + x h: order 7."""
    K, z = P.history, 1.0 - x
    old, new = K[OLD * w :], K[NEXT_STATE * w :]
    a, b, c = x, x * z, x * x * z
    for i in range(w):
        y[i] = old[i] + (a - b + 2.0 * c) * (new[i] - old[i])
    width = int(P.control[WIDTH])
    for i in range(width):
        y[w - width + i] += h * ((b - c) * K[i] - c * K[K_NEW * width + i])
    for i in range(w - width):
        y[i] += h * ((b - c) * old[width + i] - c * new[width + i])
    weight = h * x * x * z * z
    for j in range(4):
        add_combined(P, POWERS + j, w, weight, y)
        weight *= x if j % 2 == 0 else z
