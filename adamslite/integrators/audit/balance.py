"""The balance of energy of a run, on its accepted steps.

    gap = T - T_0 - sum m g . (x - x_0) - W,      T = sum m v.v/2 + w.J w/2

with W the work of all loads, motions and constraints that move (:mod:`audit_work`) along the path
of each step (:mod:`audit_path`), evaluated afresh: what a step did not see, its audit may.  Elastic
elements with a law of small angles (BUSHING, FIELD, BEAM) are watched on their own: their work and
the growth of what they store add up to what they created, which is never above zero.

An integrator calls :func:`audit` at every accepted step, with its end in the workspace, and
:func:`audit_from` when the state or its accelerations have changed where it stands.
"""

from __future__ import annotations

from adamslite.integrators.audit.path import (
    AT_KEPT,
    AT_POINTS,
    AT_PRESENT,
    AT_PREVIOUS,
    AT_SPARE,
    AT_VECTORS,
    BUDGET,
    CREATED,
    CREATED_AT,
    DRIFT,
    ELASTIC_THERE,
    FIRST_MOMENTUM,
    FORCES,
    GAP,
    HEAD,
    KINETIC,
    LARGEST,
    LEAST_CREATED,
    MOMENTUM,
    MOST_CREATED,
    PUSH,
    PUSHES,
    SIZE,
    SPAN,
    SPIN,
    SPIN_DRIFT,
    SQUARES,
    STORED,
    TIME,
    TURN,
    TURNS,
    WORST,
    WORST_AT,
    lay_path,
)
from adamslite.integrators.audit.work import MOST_PANELS, power_at, work_on_panel
from adamslite.integrators.contract import ERROR, NB, NW, STORED_ENERGY, N, Problem, T
from adamslite.integrators.linalg.plan import Plan
from adamslite.integrators.motion_equations import BODY, PART, rotated_inertia, run_groups
from adamslite.native.translate import native


@native
def audit(P: Problem, L: Plan, t: float) -> None:
    """Add the step to ``t``, whose accepted end stands in the workspace, to the balance."""
    A = P.audit
    if P.audit.size < HEAD or not t > A[TIME]:
        return
    old, new = A[int(A[AT_PREVIOUS]) :], A[int(A[AT_PRESENT]) :]
    for k in range(P.W.size):
        new[k] = P.W[k]
    for k in range(P.sizes[NW], P.W.size):
        P.W[k] = 0.0
    weight = lifted(P)
    before, kept = A[KINETIC], A[STORED]
    A[SPAN] = t - A[TIME]
    take_stock(P)
    lay_path(P, A[SPAN])
    keep_matrix(P)
    if A[FORCES] == 0.0:
        power_at(P, L, 0.5, A[int(A[AT_POINTS]) :])
    A[SIZE] = (A[SIZE] + A[FORCES]) ** 0.5
    A[BUDGET], A[FORCES] = MOST_PANELS, 0.0
    work = work_on_panel(P, L, 0.0, 1.0)
    bring_matrix_back(P)
    A[GAP] += A[KINETIC] - before - weight - work
    A[PUSHES] += A[PUSH] * P.settings[ERROR] * P.settings[ERROR]
    A[TURNS] += A[TURN] * P.settings[ERROR] * P.settings[ERROR]
    A[SQUARES] += (P.settings[ERROR] * A[SIZE]) * (P.settings[ERROR] * A[SIZE])
    if not abs(A[GAP]) <= A[WORST]:
        A[WORST], A[WORST_AT] = abs(A[GAP]), t
    note_creation(P, A[STORED] - kept, t)
    for k in range(P.W.size):
        P.W[k], old[k] = new[k], new[k]
    A[TIME] = t


@native
def start_balance(P: Problem) -> None:
    """The workspace's state is the first."""
    audit_from(P, P.settings[T])
    for k in range(6):
        P.audit[FIRST_MOMENTUM + k] = P.audit[MOMENTUM + k]
    P.audit[DRIFT], P.audit[SPIN_DRIFT] = 0.0, 0.0


@native
def audit_from(P: Problem, t: float) -> None:
    """Go on from the workspace's state: accelerations or velocities have changed there."""
    A = P.audit
    if P.audit.size < HEAD:
        return
    old = A[int(A[AT_PREVIOUS]) :]
    for k in range(P.W.size):
        old[k] = P.W[k]
    A[TIME] = t
    take_stock(P)


@native
def keep_matrix(P: Problem) -> None:
    """Remember the acceleration matrix and the counts: an audit changes nothing."""
    kept, m = P.audit[int(P.audit[AT_KEPT]) :], P.LA.size
    for k in range(m):
        kept[k] = P.LA[k]
    for k in range(P.pivots_a.size):
        kept[m + k] = float(P.pivots_a[k])
    for k in range(P.count.size):
        kept[m + P.pivots_a.size + k] = float(P.count[k])


@native
def bring_matrix_back(P: Problem) -> None:
    """What :func:`keep_matrix` kept."""
    kept, m = P.audit[int(P.audit[AT_KEPT]) :], P.LA.size
    for k in range(m):
        P.LA[k] = kept[k]
    for k in range(P.pivots_a.size):
        P.pivots_a[k] = int(kept[m + k])
    for k in range(P.count.size):
        P.count[k] = int(kept[m + P.pivots_a.size + k])


@native
def audit_leap(P: Problem, L: Plan, t: float, h: float) -> None:
    """The same for a leap-frog: velocities in the workspace are those of half a step before, and
    its forces, in ``P.F``, are those of ``t``, the end of a step of size ``h``; the start of the
    first for ``h`` of zero.
    """
    if P.audit.size < HEAD:
        return
    W, F, n, spare = P.W, P.x, P.sizes[N], P.audit[int(P.audit[AT_VECTORS]) :]
    for b in range(P.sizes[NB]):
        i, o = P.body[BODY * b + 1], P.body[BODY * b + 2]
        for k in range(3):
            F[i + k], spare[n + i + k] = P.F[i + k], W[o + 3 + k]
            W[o + 6 + k] = 0.0 - P.F[i + k] / P.mass[b]
            W[o + 3 + k] += 0.5 * h * W[o + 6 + k]
    if h > 0.0:
        audit(P, L, t)
    else:
        audit_from(P, t)
    for b in range(P.sizes[NB]):
        i, o = P.body[BODY * b + 1], P.body[BODY * b + 2]
        for k in range(3):
            P.F[i + k], W[o + 3 + k] = F[i + k], spare[n + i + k]


@native
def keep_audit(P: Problem) -> None:
    """Remember the balance before steps that may have to be taken back."""
    if P.audit.size > HEAD:
        spare = P.audit[int(P.audit[AT_SPARE]) :]
        for k in range(HEAD + P.W.size):
            spare[k] = P.audit[k]


@native
def bring_audit_back(P: Problem) -> None:
    """What :func:`keep_audit` kept."""
    if P.audit.size > HEAD:
        spare = P.audit[int(P.audit[AT_SPARE]) :]
        for k in range(HEAD + P.W.size):
            P.audit[k] = spare[k]


@native
def note_creation(P: Problem, growth: float, t: float) -> None:
    """What elastic elements delivered and stored beyond the least that it was so far."""
    A = P.audit
    A[CREATED] += growth
    A[LEAST_CREATED] = min(A[LEAST_CREATED], A[CREATED])
    if A[CREATED] - A[LEAST_CREATED] > A[MOST_CREATED]:
        A[MOST_CREATED], A[CREATED_AT] = A[CREATED] - A[LEAST_CREATED], t


@native
def lifted(P: Problem) -> float:
    """The work of gravity from one end of the step to the other."""
    A, total = P.audit, 0.0
    old, new = A[int(A[AT_PREVIOUS]) :], A[int(A[AT_PRESENT]) :]
    for b in range(P.sizes[NB]):
        o = P.body[BODY * b + 2]
        for k in range(3):
            total += P.mass[b] * P.gravity[k] * (new[o + k] - old[o + k])
    return total


@native
def take_stock(P: Problem) -> None:
    """Kinetic and stored energy and momenta of the workspace.

    Into ``SIZE``, ``PUSH`` and ``TURN`` the squares of what an error of 1 in every component,
    weighted with max(1, |y|), does to energy, momentum and angular momentum.
    """
    A, W, J = P.audit, P.W, P.work
    kinetic, squares, A[PUSH], A[TURN] = 0.0, 0.0, 0.0, 0.0
    for k in range(6):
        A[MOMENTUM + k] = 0.0
    for b in range(P.sizes[NB]):
        o, m = P.body[BODY * b + 2], P.mass[b]
        for k in range(3):
            n, p, v = (k + 1) % 3, (k + 2) % 3, W[o + 3 + k]
            kinetic += 0.5 * m * v * v
            c, d = m * max(1.0, abs(v)), m * max(1.0, abs(W[o + k]))
            squares += c * v * c * v
            A[PUSH] += c * c
            for j in range(3):
                if j != k:
                    A[TURN] += c * c * W[o + j] * W[o + j] + d * d * W[o + 3 + j] * W[o + 3 + j]
            A[MOMENTUM + k] += m * v
            A[SPIN + k] += m * (W[o + n] * W[o + 3 + p] - W[o + p] * W[o + 3 + n])
        if P.body[BODY * b] == PART:
            rotated_inertia(P, b, o, J)
            for k in range(3):
                w = W[o + 9 + k]
                turn = J[3 * k] * W[o + 9] + J[3 * k + 1] * W[o + 10] + J[3 * k + 2] * W[o + 11]
                kinetic += 0.5 * turn * w
                c = max(1.0, abs(w))
                squares += c * turn * c * turn
                A[TURN] += turn * turn + 3.0 * (J[4 * k] * c) * (J[4 * k] * c)
                A[SPIN + k] += turn
    A[KINETIC], A[SIZE] = kinetic, squares
    A[STORED] = 0.0
    if A[ELASTIC_THERE] != 0.0:
        run_groups(P, STORED_ENERGY, A[STORED:])
    A[LARGEST] = max(A[LARGEST], kinetic, A[STORED])
    note_momenta(P)


@native
def note_momenta(P: Problem) -> None:
    """How far the momenta of all bodies have moved from the first."""
    A, drift, spin_drift = P.audit, 0.0, 0.0
    for k in range(3):
        drift = max(drift, abs(A[MOMENTUM + k] - A[FIRST_MOMENTUM + k]))
        spin_drift = max(spin_drift, abs(A[SPIN + k] - A[FIRST_MOMENTUM + 3 + k]))
    A[DRIFT], A[SPIN_DRIFT] = max(A[DRIFT], drift), max(A[SPIN_DRIFT], spin_drift)
