"""What a method remembers from step to step: its own numbers, the history and the accepted state.

D_0 = y and D_1 = h y' start a history of order 1, on a first step with h^2 |y''| = 0.09 ERROR.
"""

from __future__ import annotations

from adamslite.integrators.accelerations import put_state
from adamslite.integrators.bdf.differences import change_step
from adamslite.integrators.contract import (
    ERROR,
    FIXED_STEP,
    H_INIT,
    H_MIN,
    HOLONOMIC,
    NS,
    NV,
    SI2,
    T_END,
    M,
    N,
    Problem,
    T,
)
from adamslite.integrators.events.stops import least_step, longest_step
from adamslite.integrators.motion_equations import vector_rates
from adamslite.native.translate import Reals, native

# Fixed steps begin with this part of the step, because order 1 starts.
START_PARTS = 1024.0

RUNNING = -1
# Places in P.control.
(
    NOW, H, K, K_TOP, EQUAL, NEXT, H_LAST, FACTORED, RATE, FRESH, AGE, RETRIES, SIGNATURE, BLAMED,
) = range(14)  # fmt: skip
NORM, NOISY = 30, 31


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
    fastest, reach, speed = 0.0, 1.0, 1.0
    for i in range(n):
        reach, speed = max(reach, abs(P.q[i])), max(speed, abs(P.u[i]))
        fastest = max(
            fastest, abs(P.a[i]) / max(1.0, abs(P.u[i])), abs(P.u[i]) / max(1.0, abs(P.q[i]))
        )
    for k in range(P.sizes[NS]):
        fastest = max(fastest, abs(P.rd[k]))
    span = P.settings[T_END] - P.settings[T]
    h = min(longest_step(P), span)
    if P.settings[FIXED_STEP] > 0.0:
        return P.settings[FIXED_STEP] / START_PARTS
    if P.settings[H_INIT] > 0.0:
        return min(h, P.settings[H_INIT])
    if P.settings[H_MIN] >= 0.05 * h:
        return min(h, P.settings[H_MIN])
    # Constraints hand round-off of positions, 1e-14 of the longest, on to the velocities: reach/h
    # times as much, which is below ERROR of the fastest for steps above this.  In other units of
    # length both, reach and speed, are others: the step is the same.
    stabilised = P.sizes[SI2] == 1 and P.sizes[HOLONOMIC] > 0
    noise = 1e-14 * reach / (tol * speed) if stabilised else 0.0
    noise = max(noise, P.settings[H_MIN])
    return min(0.05 * h, max(noise, tol**0.5 / max(fastest, 1e-12) * 0.3))


@native
def cut(P: Problem, factor: float) -> float:
    """``factor`` of the step, but not below HMIN, unless a step of HMIN has failed."""
    C, h, least = P.control, P.control[H], P.settings[H_MIN]
    if h * factor >= least:
        return factor
    if h > least * 1.0000001:
        return least / h
    return factor if C[RETRIES] > 0.0 or C[NORM] > 0.0 else max(factor, 1.0)


@native
def too_small(P: Problem) -> bool:
    """Whether failed tries have come down below HMIN; a step that only reaches a stop may be as
    short.
    """
    C = P.control
    failed = C[RETRIES] > 0.0 or C[NORM] > 0.0
    # A step cut to HMIN is HMIN but for its last digit.
    return C[H] < (1.0 - 1e-12) * (P.settings[H_MIN] if failed else least_step(P))


@native
def resize(P: Problem, w: int, factor: float) -> None:
    """Change the step and with it the history."""
    change_step(P.history, w, int(P.control[K]), factor)
    P.control[H] *= factor
    P.control[EQUAL] = 0.0


@native
def tests_velocities(P: Problem) -> bool:
    """Whether errors of velocities are tested: they are not in index 3, where those of constrained
    directions are round-off over the step.
    """
    return P.sizes[SI2] == 1 or P.sizes[HOLONOMIC] == 0


@native
def keep_algebraic(P: Problem) -> None:
    """Remember multipliers and variables of the accepted state."""
    for i in range(P.z.size):
        P.rz[i] = P.z[i]


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
