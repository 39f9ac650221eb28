"""Step sizes: at the start, after a failure, after an event."""

from __future__ import annotations

from adamslite.integrators.accelerations import accelerations
from adamslite.integrators.contract import Problem
from adamslite.integrators.events.stops import longest_step
from adamslite.integrators.implicit.formulation import is_stabilised
from adamslite.integrators.linalg.plan import Plan
from adamslite.integrators.motion_equations import vector_rates
from adamslite.integrators.stepping.control import StepControl
from adamslite.native.translate import copy, native, rare

# Fixed steps begin with this part of the step, because order 1 starts.
START_PARTS = 1024.0
# The first step is at most this share of the longest one.
FIRST = 0.05
# Of positions, as a share of the largest.
ROUND_OFF = 1e-14
# Relative accelerations below this are none.
AT_REST = 1e-12
# The error of a step of order 1 goes with the square of the step.
ROOT_OF_TENTH = 0.3


@native
@rare
def first_step(P: Problem) -> float:
    """A step whose first-order error is a tenth of ERROR, judged by the accelerations."""
    n = P.sizes.n
    tol = P.settings.error
    fastest, reach, speed = 0.0, 1.0, 1.0
    for i in range(n):
        reach, speed = max(reach, abs(P.q[i])), max(speed, abs(P.u[i]))
        fastest = max(
            fastest, abs(P.a[i]) / max(1.0, abs(P.u[i])), abs(P.u[i]) / max(1.0, abs(P.q[i]))
        )
    for k in range(P.sizes.ns):
        fastest = max(fastest, abs(P.rd[k]))
    span = P.settings.t_end - P.settings.t
    h = min(longest_step(P), span)
    if P.settings.fixed_step > 0.0:
        return P.settings.fixed_step / START_PARTS
    if P.settings.h_init > 0.0:
        return min(h, P.settings.h_init)
    if P.settings.h_min >= FIRST * h:
        return min(h, P.settings.h_min)
    # Constraints hand round-off of positions on to the velocities: reach/h
    # times as much, which is below ERROR of the fastest for steps above this.  In other units of
    # length both, reach and speed, are others: the step is the same.
    noise = ROUND_OFF * reach / (tol * speed) if is_stabilised(P) else 0.0
    noise = max(noise, P.settings.h_min)
    return min(FIRST * h, max(noise, tol**0.5 / max(fastest, AT_REST) * ROOT_OF_TENTH))


# Cuts of the step after corrector failures before other lengths are tried.
CUTS = 3
# The first cut of a step, and the later ones.
FIRST_CUT, CUT = 0.6, 0.25


@native
def retry_factor(C: StepControl) -> float:
    """Change of the step after a failed corrector: smaller at first.

    Near a singular posture (dead centre, flattened parallelogram) ever smaller steps do not help,
    but a step across does: after some cuts a few other lengths around the last good one are tried.
    """
    tried = C.retries
    if tried == 1:
        return FIRST_CUT
    if C.h_last > 0.0 and tried > CUTS and tried <= CUTS + 5:
        leap = 0.7
        if tried == CUTS + 1:
            leap = 1.3
        if tried == CUTS + 2:
            leap = 1.9
        if tried == CUTS + 3:
            leap = 2.7
        if tried == CUTS + 4:
            leap = 4.0
        return leap * C.h_last / C.h
    return CUT


# A rejected step is not shortened by more than this at once.
MOST_SHRINK = 0.2
# An estimate below this share of ERROR is as good as none.
LEAST_ERROR = 1e-10


@native
def step_ratio(error: float, order: int) -> float:
    """The step, against the present one with this error over ERROR, that has the error ERROR."""
    return max(error, LEAST_ERROR) ** (-1.0 / (order + 1))


@native
def shrunk(error: float, order: int) -> float:
    """The same after a rejection."""
    return max(MOST_SHRINK, step_ratio(error, order))


# Where accelerations are evaluated after an event, as a share of the step that is thought of.
LOOK_AHEAD = 0.1


@native
def jerk(P: Problem, L: Plan, t: float, ahead: float) -> float:
    """|a'| against max(1, |u|) at the start of a history, from accelerations a little further on.

    The state, accelerations and algebraic unknowns are the accepted ones (q, u, ra, rz).
    """
    n, ns, first = P.sizes.n, P.sizes.ns, P.sizes.m + P.sizes.nv
    w = 2 * n + ns
    y, rates, top = P.trial[0:], P.trial[w:], 0.0
    vector_rates(P, P.q, P.u, y)
    for i in range(n):
        y[i], y[n + i] = P.q[i] + ahead * y[i], P.u[i] + ahead * P.ra[i]
    for k in range(ns):
        rates[k] = P.rd[k]
        P.z[first + k] = P.rz[first + k] + ahead * P.rd[k]
    if accelerations(P, L, t + ahead, y, y[n:], P.a, P.z, P.rd):
        for i in range(n):
            top = max(top, abs(P.a[i] - P.ra[i]) / max(1.0, abs(P.u[i])))
        for k in range(ns):
            top = max(top, abs(P.rd[k] - rates[k]) / max(1.0, abs(P.rz[first + k])))
    copy(P.a, P.ra, n)
    for k in range(first + ns):
        P.z[k] = P.rz[k]
    copy(P.rd, rates, ns)
    return top / ahead


# A jump at a stop that moves velocities by less than this share of ERROR within a step is none.
SMOOTH = 0.02


@native
def jumped(P: Problem, C: StepControl) -> bool:
    """Whether accelerations jumped at the event just passed, so that the past is worthless."""
    return P.search.jump * C.h_last > SMOOTH * P.settings.error
