"""The balance of energy of a run, on its accepted steps.

    gap = T - T_0 - sum m g . (x - x_0) - W,      T = sum m v.v/2 + w.J w/2

with W the work of all loads, motions and constraints that move (:mod:`.work`) along the path
of each step (:mod:`.path`), evaluated again: the audit may see what a step did not.  Elastic
elements with a law of small angles (BUSHING, FIELD, BEAM) are watched on their own: their work and
the growth of what they store add up to what they created, which is never above zero.

An integrator calls :func:`audit` at every accepted step, with its end in the workspace, and
:func:`audit_from` when the state or its accelerations have changed where it stands.
"""

from __future__ import annotations

from adamslite.integrators.audit.path import lay_path
from adamslite.integrators.audit.tape import tape_event, tape_step
from adamslite.integrators.audit.work import MOST_PANELS, power_at, work_on_panel
from adamslite.integrators.contract import STORED_ENERGY, Problem
from adamslite.integrators.linalg.plan import Plan
from adamslite.integrators.motion_equations import PART, rotated_inertia, run_groups
from adamslite.native.translate import copy, native, rare, seldom


@native
def audit(P: Problem, L: Plan, t: float) -> None:
    """Add the step to ``t``, whose accepted end is in the workspace, to the balance, if any."""
    if P.audit.on and t > P.audit.now.t:
        add_step(P, L, t)


@native
@seldom
def add_step(P: Problem, L: Plan, t: float) -> None:
    """Add the step to ``t`` to the balance, or to the tape."""
    if P.tape.width > 0:
        tape_step(P, t)
        return
    A, old, new = P.audit.now, P.audit.previous, P.audit.present
    copy(new, P.W, P.W.size)
    for k in range(P.sizes.nw, P.W.size):
        P.W[k] = 0.0
    weight = lifted(P)
    before, kept = A.kinetic, A.stored[0]
    A.span = t - A.t
    take_stock(P)
    lay_path(P, A.span)
    keep_matrix(P)
    if A.forces == 0.0:
        power_at(P, L, 0.5, P.audit.points)
    A.size = (A.size + A.forces) ** 0.5
    A.budget, A.forces = MOST_PANELS, 0.0
    work = work_on_panel(P, L, 0.0, 1.0)
    bring_matrix_back(P)
    A.gap += A.kinetic - before - weight - work
    A.pushes += A.push * P.settings.error * P.settings.error
    A.turns += A.turn * P.settings.error * P.settings.error
    A.squares += (P.settings.error * A.size) * (P.settings.error * A.size)
    if not abs(A.gap) <= A.worst:
        A.worst, A.worst_at = abs(A.gap), t
    note_creation(P, A.stored[0] - kept, t)
    for k in range(P.W.size):
        P.W[k], old[k] = new[k], new[k]
    A.t = t


@native
@rare
def start_balance(P: Problem) -> None:
    """The workspace's state is the first."""
    audit_from(P, P.settings.t)
    A = P.audit.now
    for k in range(6):
        A.first_momenta[k] = A.momenta[k]
    A.drift, A.spin_drift = 0.0, 0.0


@native
@rare
def audit_from(P: Problem, t: float) -> None:
    """Go on from the workspace's state: accelerations or velocities have changed there."""
    if not P.audit.on:
        return
    if P.tape.width > 0:
        tape_event(P, t)
        return
    copy(P.audit.previous, P.W, P.W.size)
    P.audit.now.t = t
    take_stock(P)


@native
def keep_matrix(P: Problem) -> None:
    """Remember the acceleration matrix and the counts: an audit changes nothing."""
    copy(P.audit.matrix, P.LA, P.LA.size)
    for k in range(P.pivots_a.size):
        P.audit.pivots[k] = P.pivots_a[k]
    P.uncounted[:] = P.count


@native
def bring_matrix_back(P: Problem) -> None:
    """What :func:`keep_matrix` kept."""
    copy(P.LA, P.audit.matrix, P.LA.size)
    for k in range(P.pivots_a.size):
        P.pivots_a[k] = P.audit.pivots[k]
    P.count[:] = P.uncounted


@native
def audit_leap(P: Problem, L: Plan, t: float, h: float) -> None:
    """The same for a leap-frog: velocities in the workspace are those of half a step before, and
    its forces, in ``P.F``, are those of ``t``, the end of a step of size ``h``; the start of the
    first for ``h`` of zero.
    """
    if P.audit.on:
        add_leap(P, L, t, h)


@native
@seldom
def add_leap(P: Problem, L: Plan, t: float, h: float) -> None:
    """Add the leap to ``t`` to the balance."""
    W, F, n, spare = P.W, P.x, P.sizes.n, P.audit.vectors
    for b in range(P.sizes.nb):
        i, o = P.body[b].first, P.body[b].at
        for k in range(3):
            F[i + k], spare[n + i + k] = P.F[i + k], W[o + 3 + k]
            W[o + 6 + k] = 0.0 - P.F[i + k] / P.mass[b]
            W[o + 3 + k] += 0.5 * h * W[o + 6 + k]
    if h > 0.0:
        audit(P, L, t)
    else:
        audit_from(P, t)
    for b in range(P.sizes.nb):
        i, o = P.body[b].first, P.body[b].at
        for k in range(3):
            P.F[i + k], W[o + 3 + k] = F[i + k], spare[n + i + k]


@native
def note_creation(P: Problem, growth: float, t: float) -> None:
    """What elastic elements delivered and stored beyond the least that it was so far."""
    A = P.audit.now
    A.created += growth
    A.least_created = min(A.least_created, A.created)
    if A.created - A.least_created > A.most_created:
        A.most_created, A.created_at = A.created - A.least_created, t


@native
def lifted(P: Problem) -> float:
    """The work of gravity from one end of the step to the other."""
    old, new, total = P.audit.previous, P.audit.present, 0.0
    for b in range(P.sizes.nb):
        o = P.body[b].at
        for k in range(3):
            total += P.mass[b] * P.gravity[k] * (new[o + k] - old[o + k])
    return total


@native
def take_stock(P: Problem) -> None:
    """Kinetic and stored energy and momenta of the workspace.

    Into ``size``, ``push`` and ``turn`` the squares of what an error of 1 in every component,
    weighted with max(1, |y|), does to energy, momentum and angular momentum.
    """
    A, W, J = P.audit.now, P.W, P.work
    kinetic, squares, A.push, A.turn = 0.0, 0.0, 0.0, 0.0
    for k in range(6):
        A.momenta[k] = 0.0
    for b in range(P.sizes.nb):
        o, m = P.body[b].at, P.mass[b]
        for k in range(3):
            n, p, v = (k + 1) % 3, (k + 2) % 3, W[o + 3 + k]
            kinetic += 0.5 * m * v * v
            c, d = m * max(1.0, abs(v)), m * max(1.0, abs(W[o + k]))
            squares += c * v * c * v
            A.push += c * c
            for j in range(3):
                if j != k:
                    A.turn += c * c * W[o + j] * W[o + j] + d * d * W[o + 3 + j] * W[o + 3 + j]
            A.momenta[k] += m * v
            A.momenta[3 + k] += m * (W[o + n] * W[o + 3 + p] - W[o + p] * W[o + 3 + n])
        if P.body[b].width == PART:
            rotated_inertia(P, b, o, J)
            for k in range(3):
                w = W[o + 9 + k]
                turn = J[3 * k] * W[o + 9] + J[3 * k + 1] * W[o + 10] + J[3 * k + 2] * W[o + 11]
                kinetic += 0.5 * turn * w
                c = max(1.0, abs(w))
                squares += c * turn * c * turn
                A.turn += turn * turn + 3.0 * (J[4 * k] * c) * (J[4 * k] * c)
                A.momenta[3 + k] += turn
    A.kinetic, A.size = kinetic, squares
    A.stored[0] = 0.0
    if P.audit.elastic:
        run_groups(P, STORED_ENERGY, A.stored)
    A.largest = max(A.largest, kinetic, A.stored[0])
    note_momenta(P)


@native
def note_momenta(P: Problem) -> None:
    """How far the momenta of all bodies have moved from the first."""
    A, drift, spin_drift = P.audit.now, 0.0, 0.0
    for k in range(3):
        drift = max(drift, abs(A.momenta[k] - A.first_momenta[k]))
        spin_drift = max(spin_drift, abs(A.momenta[3 + k] - A.first_momenta[3 + k]))
    A.drift, A.spin_drift = max(A.drift, drift), max(A.spin_drift, spin_drift)
