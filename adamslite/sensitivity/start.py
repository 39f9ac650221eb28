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
from adamslite.integrators.contract import POSITION_ROWS, Problem
from adamslite.integrators.linalg.plan import Plan
from adamslite.integrators.motion_equations import PART
from adamslite.integrators.projection import RATES
from adamslite.kernels.code.workspace import ACCELERATION, ALPHA
from adamslite.native.translate import Reals, call_address, copy, native, rare, seldom
from adamslite.sensitivity.contract import Forward, Tangents
from adamslite.sensitivity.outputs import write_outputs
from adamslite.sensitivity.rates import forget_rates, sensitive_accelerations, take_state
from adamslite.sensitivity.tangents import clear, put_direction, put_signals, tangent

# A guard that changes by less than this of what it changes by with a number has no time.
GRAZING = 1e-9


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
def jump(P: Problem, L: Plan, D: Tangents, S: Forward, before: Reals, behind: Reals) -> None:
    """Sensitivities behind an event, with the workspaces on both its sides."""
    n, ns, nw = P.sizes.n, P.sizes.ns, P.sizes.nw
    guard = changed_guard(P, before, behind)
    if guard < 0:
        return
    copy(P.W, before, P.W.size)
    take_state(P)
    if not accelerations(P, L, before[0], P.q, P.u, P.a, P.z, P.rd):
        return
    note_jump(P, S, behind)
    note_rates(P, S)
    forget_rates(P, S)
    put_direction(P, D, S.rate, S.a, S.z, S.sd, 1.0)
    put_signals(P, D, -1)
    guards(P, D, S, -1)
    speed = S.guard[nw + guard]
    for number in range(D.count):
        y = S.history[number * S.room :]
        sensitive_accelerations(P, L, D, S, number, y)
        guards(P, D, S, number)
        change = S.guard[nw + guard]
        if abs(speed) <= GRAZING * abs(change):
            S.grazed += 1
        elif speed != 0.0:
            shift = 0.0 - change / speed
            for i in range(n + ns):
                y[n + i] += S.jump[i] * shift


@native
def note_jump(P: Problem, S: Forward, behind: Reals) -> None:
    """How much larger accelerations and rates of states are in place than behind the event."""
    n, ns = P.sizes.n, P.sizes.ns
    for b in range(P.sizes.nb):
        i, o = P.body[b].first, P.body[b].at
        for k in range(3):
            S.jump[i + k] = P.a[i + k] - behind[o + ACCELERATION + k]
            if P.body[b].width == PART:
                S.jump[i + 3 + k] = P.a[i + 3 + k] - behind[o + ALPHA + k]
    for k in range(ns):
        S.jump[n + k] = P.rd[k] - behind[P.scalar[P.sizes.m + P.sizes.nv + k] + 1]


@native
def note_rates(P: Problem, S: Forward) -> None:
    """The rates of the state in place."""
    for i in range(P.sizes.n):
        S.rate[i], S.rate[P.sizes.n + i] = P.u[i], P.a[i]
    for k in range(P.sizes.ns):
        S.rate[2 * P.sizes.n + k] = P.rd[k]


@native
def changed_guard(P: Problem, before: Reals, behind: Reals) -> int:
    """The first guard whose branch has changed, -1 for none."""
    for k in range(P.sizes.clocks + P.sizes.watched):
        old, new = before[P.sizes.nw + k], behind[P.sizes.nw + k]
        if old != new and old != 0.0:
            return k
    return -1


@native
def guards(P: Problem, D: Tangents, S: Forward, number: int) -> None:
    """Derivatives of all guards in the direction in ``dW`` and by a number (-1: none)."""
    g = P.group
    clear(S.guard, P.W.size)
    for k in range(P.sizes.ng):
        for which in range(2):
            address = D.group[k].clock if which == 0 else D.group[k].watch
            if address != 0:
                call_address(
                    address, g[k].count, g[k].ints, g[k].reals, P.W, D.nothing, D.dW, S.guard
                )
    if number < 0:
        return
    for p in range(D.piece_at[number], D.piece_at[number + 1]):
        k, first = D.piece[p].group, D.piece[p].first
        for which in range(2):
            address = D.group[k].clock if which == 0 else D.group[k].watch
            if address != 0:
                call_address(
                    address, D.piece[p].count, g[k].ints + 8 * first * D.group[k].of_ints,
                    g[k].reals + 8 * first * D.group[k].of_reals, P.W, D.piece[p].reals, D.none,
                    S.guard,
                )  # fmt: skip
