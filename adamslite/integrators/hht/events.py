"""HHT and NEWMARK at events: dense output of the tried step, and the restart after a jump."""

from __future__ import annotations

from adamslite.integrators.accelerations import mass_signature, put_state
from adamslite.integrators.contract import INDEX3, NEWTON_FAILED, Problem
from adamslite.integrators.events.events import change_here, pass_event
from adamslite.integrators.events.harmless import take_harmless
from adamslite.integrators.events.search import judge, open_search
from adamslite.integrators.hht.control import Control
from adamslite.integrators.hht.newmark_formula import back_to_accepted, bodies_between
from adamslite.integrators.implicit.control import keep_algebraic
from adamslite.integrators.implicit.step_size import LOOK_AHEAD, SMOOTH, first_step, jerk
from adamslite.integrators.linalg.plan import Plan
from adamslite.integrators.motion_equations import vector_rates
from adamslite.integrators.stepping.control import RUNNING
from adamslite.native.translate import native

# The first step behind an event: where its estimated error is this share of ERROR.
CAREFUL = 0.02


@native
def locate_in_step(P: Problem, L: Plan) -> None:
    """Look for the first change of a branch within the step that has passed its test."""
    C = Control(P.control)
    n = P.sizes.n
    t, h, end = C.t, C.h, P.trial[0:]
    open_search(P, t, h)
    take_harmless(P, L, INDEX3, C.cu)
    vector_rates(P, P.q, P.u, end[n:])
    while P.search.open:
        put_share(P, t, h, P.search.share)
        judge(P)
    put_state(P, t + h, P.q, P.u, P.a, P.z, P.rd)


@native
def put_share(P: Problem, t: float, h: float, x: float) -> None:
    """The tried step from ``t`` at the share ``x`` into the workspace: cubics, and straight lines
    for accelerations, multipliers and variables.

    Velocities have a cubic of their own: in steps that end at an event the derivative of that of
    positions is round-off over the step.
    """
    n, ns, first = P.sizes.n, P.sizes.ns, P.sizes.m + P.sizes.nv
    D, y, a, z = P.history, P.trial[2 * n + ns :], P.x, P.F
    bodies_between(P, h, x, P.trial[0:], y)
    along, w0, w1 = x * x * (3.0 - 2.0 * x), h * x * (1.0 - x) * (1.0 - x), h * x * x * (x - 1.0)
    for i in range(n):
        a[i] = P.ra[i] + x * (P.a[i] - P.ra[i])
        y[n + i] = D[n + i] + along * (P.u[i] - D[n + i]) + w0 * P.ra[i] + w1 * P.a[i]
    for k in range(first):
        z[k] = P.rz[k] + x * (P.z[k] - P.rz[k])
    for k in range(ns):
        o = 4 * n + k
        step = P.z[first + k] - D[o]
        z[first + k] = D[o] + along * step + w0 * D[o + ns] + w1 * P.rd[k]
    put_state(P, t + x * h, y, y[n:], a, z, P.rd)


@native
def change_at_start(P: Problem, L: Plan) -> int:
    """A branch changes just after the start of the step: change it there and restart."""
    C = Control(P.control)
    back_to_accepted(P)
    if not change_here(P, L, C.t):
        return NEWTON_FAILED
    start_over(P, L)
    return RUNNING


@native
def step_on(P: Problem, L: Plan) -> int:
    """After an event: continue when nothing jumped, else restart."""
    C = Control(P.control)
    n, ns = P.sizes.n, P.sizes.ns
    if not pass_event(P, L, C.t):
        return NEWTON_FAILED
    if P.search.jump * C.h_last > SMOOTH * P.settings.error:
        start_over(P, L)
        return RUNNING
    C.factored = 0.0
    for i in range(n):
        P.ra[i] = P.a[i]
    for k in range(ns):
        P.history[4 * n + ns + k] = P.rd[k]
    keep_algebraic(P)
    return RUNNING


@native
def start_over(P: Problem, L: Plan) -> None:
    """Forget earlier accelerations: those in place are the first."""
    C = Control(P.control)
    D, n, ns = P.history, P.sizes.n, P.sizes.ns
    P.count.restarts += 1
    C.h_last, C.equal, C.factored = 0.0, 0, 0.0
    for i in range(n):
        P.ra[i], D[2 * n + i] = P.a[i], P.a[i]
    for k in range(ns):
        for row in range(1, 4):
            D[4 * n + row * ns + k] = P.rd[k]
    keep_algebraic(P)
    h = first_step(P, 0)
    change = abs(P.settings.beta - 1.0 / 6.0) * jerk(P, L, C.t, LOOK_AHEAD * h)
    C.h = P.settings.h_max
    if change > 0.0:
        C.h = min(C.h, (CAREFUL * P.settings.error / change) ** (1.0 / 3.0))
    put_state(P, C.t, P.q, P.u, P.ra, P.z, P.rd)
    if P.sizes.implicit_mass:
        C.signature = mass_signature(P, L, P.x)
