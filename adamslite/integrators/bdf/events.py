"""The BDF at events: the search within a tried step, and the restart after it.

Within the tried step, at the share x of it, with pi_j = prod_{m=0..j-1} (x + m)/(m + 1)

    y = sum_{j=0..k} D_j pi_j + d pi_k

goes through the new value and k past ones; accelerations, multipliers and variables in between are
taken from a straight line, for guards that depend on them.
"""

from __future__ import annotations

from adamslite.integrators.accelerations import mass_signature, put_state
from adamslite.integrators.bdf.control import Control
from adamslite.integrators.bdf.state import restore_state, start_values
from adamslite.integrators.contract import INDEX3, NEWTON_FAILED, STABILISED, Problem
from adamslite.integrators.events.events import change_here, pass_event
from adamslite.integrators.events.harmless import take_harmless
from adamslite.integrators.events.search import judge, open_search
from adamslite.integrators.implicit.control import keep_algebraic
from adamslite.integrators.implicit.step_size import LOOK_AHEAD, SMOOTH, first_step, jerk
from adamslite.integrators.linalg.plan import Plan
from adamslite.integrators.stepping.control import RUNNING
from adamslite.native.translate import native

# The first step behind an event in multiples of (ERROR/|a'|)^(1/2).
CAREFUL = 0.8


@native
def put_between(P: Problem, k: int, t: float, h: float, x: float) -> None:
    """The tried step from ``t`` of size ``h`` at the share ``x`` into the workspace; d stands in
    the second part of ``P.trial``.
    """
    n, ns, first = P.sizes.n, P.sizes.ns, P.sizes.m + P.sizes.nv
    w = 2 * n + ns
    D, d, y = P.history, P.trial[w:], P.trial[2 * w :]
    for i in range(w):
        y[i] = D[i]
    p = 1.0
    for j in range(k):
        p *= (x + j) / (j + 1)
        for i in range(w):
            y[i] += p * D[(j + 1) * w + i]
    a, z = P.x, P.F
    for i in range(w):
        y[i] += p * d[i]
    for i in range(n):
        a[i] = P.ra[i] + x * (P.a[i] - P.ra[i])
    for i in range(first):
        z[i] = P.rz[i] + x * (P.z[i] - P.rz[i])
    for i in range(ns):
        z[first + i] = y[2 * n + i]
    put_state(P, t + x * h, y, y[n:], a, z, P.rd)


@native
def restart_step(P: Problem, L: Plan, t: float, h: float) -> float:
    """``h``, or less where a step of order 1 would err too much in the velocities: h^2 |a'|/2."""
    change = jerk(P, L, t, LOOK_AHEAD * h)
    if not change > 0.0:
        return h
    return min(h, CAREFUL * (P.settings.error / change) ** 0.5)


@native
def locate(P: Problem, L: Plan, cu: float) -> None:
    """Look for the first change of a branch within the step that has passed its test."""
    C = Control(P.control)
    t, h = C.t, C.h
    stabilised = P.sizes.si2 and P.sizes.holonomic > 0
    open_search(P, t, h)
    take_harmless(P, L, STABILISED if stabilised else INDEX3, cu)
    while P.search.open:
        put_between(P, C.order, t, h, P.search.share)
        judge(P)
    put_state(P, t + h, P.q, P.u, P.a, P.z, P.rd)


@native
def switch_at_start(P: Problem, L: Plan, w: int) -> int:
    """A branch changes just after the start of the step: change it there and restart."""
    C = Control(P.control)
    P.undoing.undoable = False
    restore_state(P, P.history, w, C.t)
    for i in range(P.sizes.n):
        P.a[i] = P.ra[i]
    if not change_here(P, L, C.t):
        return NEWTON_FAILED
    begin_anew(P, L, w)
    return RUNNING


@native
def pass_on(P: Problem, L: Plan, w: int) -> int:
    """After an event: the history continues when nothing jumped, else a new one begins."""
    C = Control(P.control)
    # A step that is taken back must not lead across an event.
    P.undoing.undoable = False
    restore_state(P, P.history, w, C.t)
    for i in range(P.sizes.n):
        P.a[i] = P.ra[i]
    if not pass_event(P, L, C.t):
        return NEWTON_FAILED
    if P.search.jump * C.h_last > SMOOTH * P.settings.error:
        begin_anew(P, L, w)
        return RUNNING
    C.factored = 0.0
    for i in range(P.sizes.n):
        P.ra[i] = P.a[i]
    keep_algebraic(P)
    restore_state(P, P.history, w, C.t)
    return RUNNING


@native
def begin_anew(P: Problem, L: Plan, w: int) -> None:
    """A history of order 1 from the state and the accelerations in place."""
    C = Control(P.control)
    P.count.restarts += 1
    for i in range(P.sizes.n):
        P.ra[i] = P.a[i]
    keep_algebraic(P)
    for i in range(P.z.size):
        P.pz[i] = P.rz[i]
    C.h, C.order, C.equal = restart_step(P, L, C.t, first_step(P, w)), 1, 0
    C.h_last, C.factored = 0.0, 0.0
    cap = C.cap
    cap.travelled, cap.bad, cap.tries, cap.suspect = 0.0, 0.0, 0.0, 0.0
    start_values(P, P.history, w, C.h)
    put_state(P, C.t, P.q, P.u, P.ra, P.z, P.rd)
    if P.sizes.implicit_mass:
        C.signature = mass_signature(P, L, P.x)
