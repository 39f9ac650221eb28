"""Sensitivities at the start and behind events.

At the start they fulfil the constraints as the state does,

    [M, G^T; G, 0] (d, .) = (0, g_q dq + g_p),    dq <- dq - d,    and du alike,

the derivative of the projection that assembles.  At an event, where branches change at the time
t(p) at which a guard f vanishes and accelerations jump, velocities are continuous, and so

    dt/dp = -(f_y dy + f_p)/(f_t + f_y y'),    du <- du + (a_before - a_behind) dt/dp

and states of DIFF alike.
Reference: Galan, Feehery, Barton, Appl. Numer. Math. 31 (1999) 17, "Parametric sensitivity
functions for hybrid discrete/continuous systems".
"""

from __future__ import annotations

from adamslite.integrators.accelerations import (
    accelerations,
    factor_accelerations,
    solve_accelerations,
)
from adamslite.integrators.audit_record import TAPE_HEAD, TAPE_TIME
from adamslite.integrators.contract import POSITION_ROWS, STATE_ORIGIN, Problem
from adamslite.integrators.linalg.plan import Plan
from adamslite.integrators.motion_equations import WATCH, guard_values
from adamslite.integrators.projection import RATES
from adamslite.native.translate import Reals, copy, native, rare, seldom
from adamslite.sensitivity.contract import Forward, Tangents
from adamslite.sensitivity.tangents import (
    CLOCK_GUARDS,
    STATE_GUARDS,
    by_number,
    clear,
    directed,
    forget_rates,
    put_direction,
    sensitive_accelerations,
    take_state,
    tangent,
    write_outputs,
)

# A guard that changes by less than this of what it changes by with a number has no time.
GRAZING = 1e-9
# A guard leads an event when it is zero within this share of the step that ends there; others
# follow: their values jump.
NEAR = 0.01
# What a changed guard does: one of those that every number shifts alike leads; MEMBER and the
# number of the guard that leads.
LEADER, FOLLOWER, MEMBER = 1.0, 2.0, 3.0
# Times that differ by less than this share are one; jumps that differ by more than that one hang on
# the order of changes.
SAME, COUPLED = 1e-9, 1e-6
# Of events within this share of the time, or ERROR, the order is chance.
TOGETHER = 1e-6


@native
@rare
def project_start(P: Problem, L: Plan, D: Tangents, S: Forward, y: Reals, number: int) -> None:
    """Move derivatives of positions, then of velocities, onto the constraints; the matrix of
    accelerations is factored.
    """
    n, holonomic, mu = P.sizes.n, P.sizes.holonomic, P.sizes.nz - P.sizes.holonomic
    if P.sizes.m == 0:
        return
    for level in range(2):
        forget_rates(P, S)
        put_direction(P, D, y, S.a, S.z, S.sd, 0.0)
        tangent(P, D, number, POSITION_ROWS if level == 0 else RATES, P.F)
        clear(P.F, n)
        if P.sizes.si2 and level == 1:
            for k in range(holonomic):
                P.F[n + k], P.F[mu + k] = P.F[mu + k], 0.0
        clear(P.F[n + P.sizes.m :], P.sizes.nz - n - P.sizes.m)
        for k in range(P.dead.size):
            P.F[P.dead[k]] = 0.0
        solve_accelerations(P, L)
        for i in range(n):
            y[level * n + i] -= P.F[i]


@native
@rare
def at_start(P: Problem, L: Plan, D: Tangents, S: Forward) -> bool:
    """Consistent sensitivities at the start, and their records."""
    T = P.tape
    first, second = T.data[TAPE_HEAD:], T.data[T.width + TAPE_HEAD :]
    copy(P.W, first, P.W.size)
    for k in range(P.sizes.nw, P.W.size):
        P.W[k] = second[k] if T.rows > 1 else 0.0
    take_state(P)
    if not accelerations(P, L, first[0], P.q, P.u, P.a, P.z, P.rd):
        return False
    if not factor_accelerations(P, L):
        return False
    for number in range(D.count):
        project_start(P, L, D, S, S.history[number * S.room :], number)
    S.row = 0
    while S.row < P.times.size and P.times[S.row] <= T.data[TAPE_TIME]:
        for number in range(D.count):
            copy(S.y, S.history[number * S.room :], S.width)
            write_outputs(P, L, D, S, number, S.y)
        S.row += 1
    return True


@native
@seldom
def jump(
    P: Problem, L: Plan, D: Tangents, S: Forward, before: Reals, behind: Reals, h: float
) -> None:
    """Sensitivities behind an event, with the workspaces on both its sides and the step before.

    Of several guards that change at one time each has the mean of its jumps as the first and as
    the last of them; where these differ, order matters, and there is no derivative.
    """
    n, count, leaders = P.sizes.n, P.sizes.clocks + P.sizes.watched, 0
    clear(S.kind, count)
    known = has_changed(P, before, behind) and find_rates(P, L, S, behind, behind, -1, S.jump)
    if known and find_rates(P, L, S, before, before, -1, S.rate[n:]):
        leaders = shift_times(P, L, D, S, before, behind, h)
    S.several += 1 if leaders > 1 else 0
    for k in range(count if leaders > 0 else 0):
        if S.kind[k] == LEADER and find_jump(P, L, S, before, behind, k, leaders > 1):
            for number in range(D.count):
                y, shift = S.history[number * S.room :], S.shift[number * count + k]
                for i in range(n, S.width):
                    y[i] += S.state[i] * shift
            note_coincidence(P, D, S, before[0], k)
    reset_states(P, D, S, before, behind)


@native
def note_coincidence(P: Problem, D: Tangents, S: Forward, t: float, guard: int) -> None:
    """Count an event at the time of the last one that a number moves away from it, where both
    change accelerations.
    """
    n, count, jump, size, apart = P.sizes.n, P.sizes.clocks + P.sizes.watched, 0.0, 0.0, False
    for i in range(n, S.width):
        jump = max(jump, abs(S.state[i]))
        size = max(size, max(abs(S.rate[i]), abs(S.rate[i] - S.state[i])))
    counts = min(jump, S.last[D.count]) > COUPLED * size
    for number in range(D.count):
        shift, last = S.shift[number * count + guard], S.last[number]
        apart = apart or abs(shift - last) > COUPLED * max(abs(shift), abs(last))
        S.last[number] = shift
    together = t - S.last_t <= min(TOGETHER, P.settings.error) * P.settings.t_end
    S.several += 1 if counts and apart and together else 0
    S.last_t, S.last[D.count] = t, jump


@native
def has_changed(P: Problem, before: Reals, behind: Reals) -> bool:
    """Whether any guard has another branch behind an event."""
    for k in range(P.sizes.nw, P.sizes.nw + P.sizes.clocks + P.sizes.watched):
        if before[k] != behind[k] and before[k] != 0.0:
            return True
    return False


@native
def find_rates(
    P: Problem, L: Plan, S: Forward, here: Reals, there: Reals, guard: int, found: Reals
) -> bool:
    """Accelerations and rates of states at the workspace ``here``, one guard and those that change
    with it (-1: none) as ``there``, followers evaluated as they are; False without any.
    """
    copy(P.W, here, P.W.size)
    for k in range(P.sizes.clocks + P.sizes.watched):
        at = P.sizes.nw + k
        if k == guard or S.kind[k] == MEMBER + float(guard):
            P.W[at] = there[at]
        elif S.kind[k] == FOLLOWER:
            P.W[at] = 0.0
    take_state(P)
    known = accelerations(P, L, P.W[0], P.q, P.u, P.a, P.z, P.rd)
    copy(found, P.a, P.sizes.n)
    copy(found[P.sizes.n :], P.rd, P.sizes.ns)
    return known


@native
def shift_times(
    P: Problem, L: Plan, D: Tangents, S: Forward, before: Reals, behind: Reals, h: float
) -> int:
    """Derivatives by each number of the time at which each changed guard vanishes, the state
    before the event being in place; how many of these times move apart.
    """
    nw, count, leaders = P.sizes.nw, P.sizes.clocks + P.sizes.watched, 0
    copy(S.rate, P.u, P.sizes.n)
    sensitive_accelerations(P, L, D, S, -1, S.rate, 1.0)
    guards(P, D, S, -1)
    copy(S.speed, S.guard[nw:], count)
    sort_guards(P, S, before, behind, h)
    for number in range(D.count):
        shift = S.shift[number * count :]
        sensitive_accelerations(P, L, D, S, number, S.history[number * S.room :], 0.0)
        guards(P, D, S, number)
        for k in range(count):
            change, speed, shift[k] = S.guard[nw + k], S.speed[k], 0.0
            if S.kind[k] == LEADER and change != 0.0:
                if abs(speed) <= GRAZING * abs(change):
                    S.grazed += 1
                else:
                    shift[k] = 0.0 - change / speed
    for k in range(count):
        for first in range(k):
            if (
                S.kind[k] == LEADER
                and S.kind[first] == LEADER
                and moves_with(D, S, k, first, count)
            ):
                S.kind[k] = MEMBER + float(first)
        leaders += 1 if S.kind[k] == LEADER else 0
    return leaders


@native
def sort_guards(P: Problem, S: Forward, before: Reals, behind: Reals, h: float) -> None:
    """Sort changed guards: leaders vanish at the event, followers jump over zero with others."""
    count, leaders = P.sizes.clocks + P.sizes.watched, False
    guard_values(P, WATCH)
    for k in range(count):
        at = P.sizes.nw + k
        old, value, S.kind[k] = before[at], P.guard[at], 0.0
        if old != behind[at] and old != 0.0:
            value -= 0.5 * (old + behind[at])  # of relations nothing
            near = k < P.sizes.clocks or abs(value) <= NEAR * h * abs(S.speed[k])
            S.kind[k] = LEADER if near and S.speed[k] != 0.0 else FOLLOWER
            leaders = leaders or S.kind[k] == LEADER
    for k in range(0 if leaders else count):
        S.kind[k] = LEADER if S.kind[k] == FOLLOWER else 0.0


@native
def moves_with(D: Tangents, S: Forward, guard: int, other: int, count: int) -> bool:
    """Whether every number shifts the times of two guards alike."""
    for number in range(D.count):
        a, b = S.shift[number * count + guard], S.shift[number * count + other]
        if abs(a - b) > SAME * max(abs(a), abs(b)):
            return False
    return True


@native
def find_jump(
    P: Problem, L: Plan, S: Forward, before: Reals, behind: Reals, guard: int, several: bool
) -> bool:
    """The jump of accelerations and rates of states by one guard into ``S.state``, from n on; False
    where there are no accelerations between.
    """
    n, w, apart, size = P.sizes.n, S.width, 0.0, 0.0
    first, last = S.state[w:], S.state[2 * w :]
    copy(first, S.jump, w - n)
    copy(last, S.rate[n:], w - n)
    if several:
        if not find_rates(P, L, S, before, behind, guard, first):
            return False
        if not find_rates(P, L, S, behind, before, guard, last):
            return False
    for i in range(w - n):
        a, b = S.rate[n + i] - first[i], last[i] - S.jump[i]
        apart, size = max(apart, abs(a - b)), max(size, max(abs(a), abs(b)))
        S.state[n + i] = 0.5 * (a + b)
    S.coupled += 1 if apart > COUPLED * size else 0
    return True


@native
def reset_states(P: Problem, D: Tangents, S: Forward, before: Reals, behind: Reals) -> None:
    """States of DIFF that count from another value between two workspaces begin at zero, whatever
    a number is.
    """
    for k in range(P.sizes.ns):
        o = P.scalar[P.sizes.m + P.sizes.nv + k] + STATE_ORIGIN
        if before[o] != behind[o]:
            S.several += 1
            for number in range(D.count):
                y = S.history[number * S.room + 2 * P.sizes.n + k :]
                for row in range(S.order + 3):
                    y[row * S.width] = 0.0


@native
def guards(P: Problem, D: Tangents, S: Forward, number: int) -> None:
    """Derivatives of all guards in the direction in ``dW`` and by a number (-1: none)."""
    clear(S.guard, P.W.size)
    for phases in range(STATE_GUARDS, CLOCK_GUARDS + 1):
        directed(P, D, phases, S.guard)
        by_number(P, D, number, phases, S.guard)
