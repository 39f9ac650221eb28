"""Sensitivities by the three stages of the Radau formula, on the steps of the run.

The formula of RADAU (:mod:`adamslite.integrators.radau.stages`) is applied to the derivatives of
the equations,

    y'_i = sum_j w_ij (y_j - y_0)/h,    F_q dq + F_u du + F_a da + F_z dz + F_s' ds' + F_p = 0

at the stages of the run.  Derivatives differ from stage to stage, so that the systems do not fall
apart in modes exactly: as in the run the matrices at the middle stage serve for increments, until
these are round-off against the sensitivities, or nothing against ERROR.  Turns are rates of
theta' = dw + w x theta.
"""

from __future__ import annotations

from adamslite.integrators.accelerations import factor_accelerations
from adamslite.integrators.audit_record import (
    AT_STEP,
    TAPE_HEAD,
    TAPE_KIND,
    TAPE_STEP,
    TAPE_TIME,
)
from adamslite.integrators.contract import DONE, SINGULAR_MASS, Problem
from adamslite.integrators.implicit.formulation import equations_kept, is_stabilised
from adamslite.integrators.linalg.norms import largest_of
from adamslite.integrators.linalg.plan import HUGE, TINY, Plan
from adamslite.integrators.motion_equations import project_on_constraints, track
from adamslite.integrators.radau.coefficients import INVERSE, NODE
from adamslite.integrators.radau.control import RATES, Z_ROWS, Control
from adamslite.integrators.radau.stages import (
    put_stage,
    radau_jacobian,
    radau_matrices,
    stage_increments,
    stage_z,
)
from adamslite.integrators.radau.state import collocated
from adamslite.integrators.stepping.output import WITHIN
from adamslite.native.translate import Reals, copy, native
from adamslite.sensitivity.contract import Forward, Tangents
from adamslite.sensitivity.corrector import WORST_RATE, largest_gap
from adamslite.sensitivity.stage_error import note_stage_errors
from adamslite.sensitivity.start import at_start, jump, reset_states
from adamslite.sensitivity.tangents import clear, put_direction, spun, tangent, write_outputs

# Rows of a history: the start of the step, three stages, their rates, and behind them z.
RATE_ROWS, ROWS = 3, 7
# Increments stop where they leave this share of ERROR of sensitivities and of what velocities are
# in a step, or where they are round-off; and after so many.
SHARE, LEAST, MOST = 3e-3, 1e-15, 30
# Increments that shrink no further than this are round-off, below that share.
STALLED, ROUND_OFF = 0.95, 1e-6
# Derivatives serve for so many steps, while increments take no more iterations than this.
# the step is done again with new ones where it takes many.
KEEP_STEPS, QUICK, SLOW = 20, 5, 12
# Factors made for a step that differs by this share serve.
SAME_STEP = 1e-6
# A step is predicted by the polynomial of one that is not much shorter.
LONGER = 4.0


@native
def by_stages(P: Problem, L: Plan, D: Tangents, S: Forward) -> int:
    """Follow the tape; the record of derivatives is filled."""
    T = P.tape
    if not at_start(P, L, D, S):
        return SINGULAR_MASS
    S.h, S.age, S.factored = 0.0, KEEP_STEPS, 0.0
    for row in range(1, T.rows):
        here, before = T.data[row * T.width :], T.data[(row - 1) * T.width + TAPE_HEAD :]
        if here[TAPE_KIND] != AT_STEP:
            jump(P, L, D, S, before, here[TAPE_HEAD:], here[TAPE_STEP])
            S.h, S.age = 0.0, KEEP_STEPS
            continue
        reset_states(P, D, S, before, here[TAPE_HEAD:])
        lay_stages(P, S, here)
        if not by_matrices(P, L, D, S, here[TAPE_STEP]):
            return SINGULAR_MASS
        note_stage_errors(P, L, D, S, before, ROWS * S.width, z_width(P), here[TAPE_STEP])
        if not record(P, L, D, S, here):
            return SINGULAR_MASS
        for number in range(D.count):
            H = S.history[number * S.room :]
            copy(H[ROWS * S.width + 3 * z_width(P) :], H, S.width)
            copy(H, H[3 * S.width :], S.width)
        S.h = here[TAPE_STEP]
        copy(P.W, here[TAPE_HEAD:], P.W.size)
        track(P)
    return DONE


@native
def z_width(P: Problem) -> int:
    """Multipliers, variables, states and multipliers of velocity rows of a stage."""
    return P.sizes.m + P.sizes.nv + P.sizes.ns + P.sizes.holonomic


@native
def lay_stages(P: Problem, S: Forward, here: Reals) -> None:
    """Workspaces of the stages of the run, and its history at the step."""
    C = Control(P.control)
    size, h = P.W.size, here[TAPE_STEP]
    C.t = here[TAPE_TIME] - h
    copy(P.W, here[TAPE_HEAD:], size)
    copy(P.base, here[TAPE_HEAD + size :], 9 * P.sizes.nb)
    restore_history(P, here[TAPE_HEAD + size + 9 * P.sizes.nb :], h)
    for stage in range(3):
        put_stage(P, stage + 1, h)
        copy(S.stages[stage * size :], P.W, size)


@native
def restore_history(P: Problem, kept: Reals, h: float) -> None:
    """The history of the run at a step, of which the tape keeps all but the rates of stages."""
    T, w, Y = P.tape, 2 * P.sizes.n + P.sizes.ns, P.history
    copy(Y, kept, T.kept)
    copy(Y[T.further :], kept[T.kept :], T.more)
    rate_rows(P, Y, w, RATES, 0, w, h, False)


@native
def by_matrices(P: Problem, L: Plan, D: Tangents, S: Forward, h: float) -> bool:
    """Sensitivities at the stages by all numbers, with new matrices where old ones are slow."""
    number, slowest, again = 0, 0, False
    while number < D.count:
        if not ready(P, L, S, h):
            return False
        guess(P, S, S.history[number * S.room :], h, again)
        turns = solve_stages(P, L, D, S, number, h)
        again = turns >= SLOW and S.age > 0
        if again:
            S.age = KEEP_STEPS
        elif turns > MOST:
            return False
        else:
            number, slowest = number + 1, max(slowest, turns)
    S.age += 1 if slowest <= QUICK else KEEP_STEPS
    return True


@native
def ready(P: Problem, L: Plan, S: Forward, h: float) -> bool:
    """Derivatives and factors for a step of size ``h``."""
    if S.age >= KEEP_STEPS:
        radau_jacobian(P, 2, h)
        S.age, S.factored = 0, 0.0
    if not abs(h - S.factored) <= SAME_STEP * h:
        S.factored = h if radau_matrices(P, L, h) else 0.0
    return S.factored != 0.0


@native
def solve_stages(P: Problem, L: Plan, D: Tangents, S: Forward, number: int, h: float) -> int:
    """Sensitivities at the stages from a guess; the iterations that they took, beyond ``MOST`` when
    increments do not come to nothing.
    """
    H, w, last, before = S.history[number * S.room :], S.width, HUGE, HUGE
    motion(P, S, H, h)
    for turn in range(MOST):
        stage_tangents(P, D, S, number, H)
        stage_increments(P, L)
        size = apply(P, H, w)
        moved = change_velocities(P, S, H, h)
        reach = max(scale(P, H, 0, P.sizes.n), scale(P, H, 2 * P.sizes.n, w))
        if S.exact:
            if size <= LEAST * reach:
                return turn + 1
        elif is_little(P, H, h, reach, size * left_of(size, last), moved * left_of(moved, before)):
            return turn + 1
        if turn > 1 and not size < STALLED * last and (S.exact or not moved < STALLED * before):
            return turn + 1 if size <= max(ROUND_OFF * reach, S.floor[number]) else MOST + 1
        last, before = size, moved
    return MOST


@native
def change_velocities(P: Problem, S: Forward, H: Reals, h: float) -> float:
    """Rates and velocities from places, turns and states; the largest change of a velocity."""
    n, w, largest = P.sizes.n, S.width, 0.0
    for stage in range(3):
        copy(S.y[stage * n :], H[(1 + stage) * w + n :], n)
    motion(P, S, H, h)
    for stage in range(3):
        largest = max(largest, largest_gap(H[(1 + stage) * w + n :], S.y[stage * n :], n))
    return largest


@native
def is_little(P: Problem, H: Reals, h: float, reach: float, left: float, moved: float) -> bool:
    """Whether what the last increments leave of places and states, and of velocities, is little;
    mu moves velocities alone.
    """
    share, least = SHARE * P.settings.error, LEAST * reach
    speed = scale(P, H, P.sizes.n, 2 * P.sizes.n)
    if left > max(share * min(reach, h * speed), least):
        return False
    return moved <= max(share * speed, LEAST * speed)


@native
def left_of(size: float, last: float) -> float:
    """What an increment leaves, as a share of it, where increments go on to shrink as they did from
    the last one.
    """
    rate = size / max(last, TINY)
    return rate / (1.0 - rate) if rate < WORST_RATE and last < HUGE else 1.0


@native
def guess(P: Problem, S: Forward, H: Reals, h: float, again: bool) -> None:
    """Stages on the polynomial of the last step, else where it ended, and z as it was; what it was
    is lost where the step is done ``again``.  Places, turns and states count from the start.
    """
    n, w = P.sizes.n, S.width
    if again:
        clear(H[ROWS * w :], 3 * z_width(P))
    if S.h > 0.0 and h < LONGER * S.h and not again:
        old = H[ROWS * w + 3 * z_width(P) :]
        for stage in range(3):
            collocated(P, old, H, w, 1.0 + P.tableau[NODE + stage] * h / S.h, S.y[stage * w :])
        copy(H[w:], S.y, 3 * w)
        continue_z(P, S, H, h)
    else:
        for stage in range(3):
            copy(H[(1 + stage) * w :], H, w)
    for stage in range(3):
        y = H[(1 + stage) * w :]
        for i in range(w):
            y[i] -= 0.0 if n <= i and i < 2 * n else H[i]


@native
def put_values(P: Problem, S: Forward, H: Reals, stage: int, y: Reals) -> None:
    """Sensitivities at a stage, whose places, turns and states count from the start."""
    n, w = P.sizes.n, S.width
    for i in range(w):
        y[i] = H[(1 + stage) * w + i] + (0.0 if n <= i and i < 2 * n else H[i])


@native
def continue_z(P: Problem, S: Forward, H: Reals, h: float) -> None:
    """Multipliers and variables of the stages on the parabola through those of the last step; mu
    as it was, which is nothing but error.
    """
    e, Z = z_width(P), H[ROWS * S.width :]
    a, b = P.tableau[NODE], P.tableau[NODE + 1]
    x, y, z = 1.0 + a * h / S.h, 1.0 + b * h / S.h, 1.0 + h / S.h
    for k in range(P.sizes.m + P.sizes.nv):
        first, second, third = Z[k], Z[e + k], Z[2 * e + k]
        slope = (third - second) / (1.0 - b)
        bend = (slope - (second - first) / (b - a)) / (1.0 - a)
        Z[k] = third + (x - 1.0) * (slope + (x - b) * bend)
        Z[e + k] = third + (y - 1.0) * (slope + (y - b) * bend)
        Z[2 * e + k] = third + (z - 1.0) * (slope + (z - b) * bend)


@native
def rate_rows(
    P: Problem, H: Reals, w: int, at: int, first: int, last: int, h: float, counted: bool
) -> None:
    """y' of the stages, of entries ``first`` .. ``last``, into the rows from ``at`` + 1 on;
    ``counted``: from the start.
    """
    for stage in range(3):
        row, d = INVERSE + 3 * stage, H[(1 + at + stage) * w :]
        a, b, c = P.tableau[row] / h, P.tableau[row + 1] / h, P.tableau[row + 2] / h
        for i in range(first, last):
            s = 0.0 if counted else H[i]
            d[i] = a * (H[w + i] - s) + b * (H[2 * w + i] - s) + c * (H[3 * w + i] - s)


@native
def motion(P: Problem, S: Forward, H: Reals, h: float) -> None:
    """Rates and velocities of the stages from places, turns and states."""
    n, w, size = P.sizes.n, S.width, P.W.size
    rate_rows(P, H, w, RATE_ROWS, 0, n, h, True)
    rate_rows(P, H, w, RATE_ROWS, 2 * n, w, h, True)
    for stage in range(3):
        y, d = H[(1 + stage) * w :], H[(1 + RATE_ROWS + stage) * w :]
        copy(P.W, S.stages[stage * size :], size)
        put_values(P, S, H, stage, S.y[3 * w :])
        spun(P, S.y[3 * w :], d, -1.0, y[n:])
        if is_stabilised(P):
            z = H[ROWS * w + stage * z_width(P) + P.sizes.m + P.sizes.nv + P.sizes.ns :]
            project_on_constraints(P, z, P.F)
            for i in range(n):
                y[n + i] += P.F[i]
    rate_rows(P, H, w, RATE_ROWS, n, 2 * n, h, False)


@native
def stage_tangents(P: Problem, D: Tangents, S: Forward, number: int, H: Reals) -> None:
    """What the equations at the stages are off by, where increments are solved for."""
    n, w, nz, size, at = P.sizes.n, S.width, P.sizes.nz, P.W.size, stage_z(P, Z_ROWS)
    for stage in range(3):
        y, d = S.y[3 * w :], H[(1 + RATE_ROWS + stage) * w :]
        put_values(P, S, H, stage, y)
        copy(P.W, S.stages[stage * size :], size)
        z = H[ROWS * w + stage * z_width(P) :]
        put_direction(P, D, y, d[n:], z, d[2 * n :], 0.0)
        tangent(P, D, number, equations_kept(P), P.F)
        copy(P.history[at + stage * nz :], P.F, nz)


@native
def apply(P: Problem, H: Reals, w: int) -> float:
    """Subtract the increments; the largest of places, turns and states."""
    n, ns, first, nz = P.sizes.n, P.sizes.ns, P.sizes.m + P.sizes.nv, P.sizes.nz
    R, largest = P.history[stage_z(P, Z_ROWS) :], 0.0
    for stage in range(3):
        y, z, dz = H[(1 + stage) * w :], H[ROWS * w + stage * z_width(P) :], R[stage * nz :]
        for i in range(n):
            y[i] -= dz[i]
            largest = max(largest, abs(dz[i]))
        for k in range(nz - n):
            z[k] -= dz[n + k]
        for k in range(ns):
            y[2 * n + k] -= dz[n + first + k]
            largest = max(largest, abs(dz[n + first + k]))
    return largest


@native
def scale(P: Problem, H: Reals, first: int, last: int) -> float:
    """The largest of the start and the stages, of entries ``first`` .. ``last``."""
    w, largest = 2 * P.sizes.n + P.sizes.ns, 1e-300
    for row in range(4):
        largest = max(largest, largest_of(H[row * w + first :], last - first))
    return largest


@native
def record(P: Problem, L: Plan, D: Tangents, S: Forward, here: Reals) -> bool:
    """Every output time of the step; the record of the run has its states."""
    t, h, size = here[TAPE_TIME], here[TAPE_STEP], P.sizes.nw + P.sizes.n_out
    while S.row < P.times.size and P.times[S.row] <= t + WITHIN * h:
        copy(P.W, here[TAPE_HEAD:], P.W.size)
        copy(P.W, P.record[S.row * size :], P.sizes.nw)
        if not factor_accelerations(P, L):
            return False
        for number in range(D.count):
            H = S.history[number * S.room :]
            share = min(1.0, 1.0 + (P.times[S.row] - t) / h)
            collocated(P, H, H, S.width, share, S.y)
            write_outputs(P, L, D, S, number, S.y)
        S.row += 1
    return True
