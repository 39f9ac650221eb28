"""The explicit formula at events: dense output of the tried step, and the restart.

Within the tried step a cubic goes through both ends with their rates; it only has to say which
branch changes first and about where, because the step is taken again to end there.
"""

from __future__ import annotations

from adamslite.integrators.accelerations import mass_signature, put_state
from adamslite.integrators.contract import NEWTON_FAILED, Problem
from adamslite.integrators.events.events import change_here, pass_event
from adamslite.integrators.events.search import judge, open_search
from adamslite.integrators.explicit.control import Control
from adamslite.integrators.explicit.error import LEAST_ERROR, starting_step
from adamslite.integrators.explicit.history import OLD
from adamslite.integrators.explicit.stages import exact_rates
from adamslite.integrators.explicit.state import keep_solution, stand_again
from adamslite.integrators.linalg.plan import Plan
from adamslite.integrators.stepping.control import RUNNING
from adamslite.native.translate import native


@native
def locate_between(P: Problem, t: float, h: float, width: int, old: int, late: int) -> None:
    """Look for the first change of a branch within the tried step, whose end is in the workspace.

    ``width``: rates of a stage; in ``P.history`` stages from 0, stage ``late`` belonging to the
    end, the state at the start from ``old`` and behind it the one at the end.
    """
    open_search(P, t, h)
    while P.search.open:
        put_cubic(P, t, h, P.search.share, width, old, late)
        judge(P)
    put_state(P, t + h, P.q, P.u, P.a, P.z, P.rd)


@native
def put_cubic(P: Problem, t: float, h: float, x: float, width: int, old: int, late: int) -> None:
    """The tried step at the share ``x`` into the workspace, with straight lines for accelerations,
    multipliers and variables.
    """
    n, ns, first = P.sizes.n, P.sizes.ns, P.sizes.m + P.sizes.nv
    w = 2 * n + ns
    y0, y1, k0, k1 = P.history[old:], P.history[old + w :], P.history, P.history[late * width :]
    y, a, z = P.trial, P.x, P.F
    along = x * x * (3.0 - 2.0 * x)
    w0, w1 = h * x * (1.0 - x) * (1.0 - x), h * x * x * (x - 1.0)
    for i in range(w):
        y[i] = y0[i] + along * (y1[i] - y0[i])
    for i in range(width):
        y[w - width + i] += w0 * k0[i] + w1 * k1[i]
    for i in range(w - width):
        y[i] += w0 * y0[width + i] + w1 * y1[width + i]
    for i in range(n):
        a[i] = P.ra[i] + x * (P.a[i] - P.ra[i])
    for k in range(first):
        z[k] = P.rz[k] + x * (P.z[k] - P.rz[k])
    for k in range(ns):
        z[first + k] = y[2 * n + k]
    put_state(P, t + x * h, y, y[n:], a, z, P.rd)


@native
def change_where_it_stands(P: Problem, L: Plan, w: int) -> int:
    """A branch changes just after the start of the step: change it there and restart."""
    C = Control(P.control)
    stand_again(P, w)
    if not change_here(P, L, C.t):
        return NEWTON_FAILED
    return rates_anew(P, L, w, True)


@native
def pass_by(P: Problem, L: Plan, w: int) -> int:
    """Behind an event: rates of the new branches, another step when something jumped."""
    C = Control(P.control)
    if not pass_event(P, L, C.t):
        return NEWTON_FAILED
    return rates_anew(P, L, w, P.search.jump > 0.0)


@native
def rates_anew(P: Problem, L: Plan, w: int, restart: bool) -> int:
    """The first stage again; with ``restart`` the step is chosen as at the start of a run."""
    C = Control(P.control)
    y, k = P.history[OLD * w :], P.history[0:]
    P.undoing.undoable = False
    if not exact_rates(P, L, C.t, y, k):
        return NEWTON_FAILED
    if restart:
        P.count.restarts += 1
        keep_solution(P)
        if P.sizes.implicit_mass:
            # What it leaves in P.LA is no factored matrix: the next rates make one of their own.
            C.signature, C.stale = mass_signature(P, L, P.x), True
        C.h, C.last_error = starting_step(P, L, w), LEAST_ERROR
        if not exact_rates(P, L, C.t, y, k):
            return NEWTON_FAILED
    keep_solution(P)
    return RUNNING
