"""The state of the explicit formula between steps: control numbers, history, accepted state."""

from __future__ import annotations

from adamslite.integrators.accelerations import put_state
from adamslite.integrators.contract import Problem
from adamslite.integrators.explicit.control import LANES, MASSES, Control
from adamslite.integrators.explicit.history import OLD
from adamslite.integrators.explicit.lanes import from_lanes
from adamslite.integrators.motion_equations import PART
from adamslite.integrators.stepping.accepted import count_from_here
from adamslite.native.translate import Reals, native


@native
def restore_state(P: Problem, C: Control) -> None:
    """The accepted state back into q, u, a, z and the workspace after records were made."""
    w = C.size
    n, first = P.sizes.n, P.sizes.m + P.sizes.nv
    y = P.history[OLD * w :]
    take_state(P, C, y, P.q, P.u)
    if C.kind == LANES:
        from_lanes(P, C.lane, P.history, P.a)
    else:
        for i in range(n):
            P.a[i] = P.ra[i]
    for i in range(first):
        P.z[i] = P.rz[i]
    for i in range(P.sizes.ns):
        P.z[first + i], P.rd[i] = y[2 * n + i], P.history[2 * n + i]
    put_state(P, C.t, P.q, P.u, P.a, P.z, P.rd)


@native
def take_state(P: Problem, C: Control, y: Reals, q: Reals, u: Reals) -> None:
    """Positions and velocities (n,) of a state."""
    if C.kind == LANES:
        from_lanes(P, C.lane, y, q)
        from_lanes(P, C.lane, y[C.half :], u)
    else:
        for i in range(P.sizes.n):
            q[i], u[i] = y[i], y[P.sizes.n + i]


@native
def base_here(P: Problem, C: Control) -> None:
    """Count rotation vectors from the accepted attitude."""
    if C.kind >= MASSES:
        return
    count_from_here(P)
    n, y, k = P.sizes.n, P.history[OLD * C.size :], P.history[0:]
    for b in range(P.sizes.nb):
        if P.body[b].width == PART:
            for i in range(P.body[b].first + 3, P.body[b].first + 6):
                y[i], k[i] = 0.0, y[n + i]
