"""The work of loads and motions along the path of an accepted step.

    W = int_0^1 -(f, lam_t G) . u h ds

by Gauss's formula with five points on panels of the step.  A panel is divided where a guard of an
expression (IF, MAX, ABS, IMPACT ...) changes between two of its points, at the change, so that a
force which lives for less than a step is met at the place where its expression breaks; and in the
middle where a formula of order 4 on the same points differs by too much.

Reference: Davis, Rabinowitz, Methods of Numerical Integration, 1984, sections 2.7 and 6.2.
"""

from __future__ import annotations

from math import floor

from adamslite.integrators.audit.path import put_on_path, solve_on_path
from adamslite.integrators.audit_record import POINTS, ROWS_OF_GUARDS
from adamslite.integrators.contract import ELASTIC, LOADS, REACTIONS, Problem
from adamslite.integrators.event_rows import NARROW, POLE, ROOT, STRICT, WEAK, ZONE
from adamslite.integrators.linalg.plan import TINY, Plan
from adamslite.integrators.motion_equations import CLOCK, PART, WATCH, guard_values, run_groups
from adamslite.native.translate import Reals, copy, native

# Nodes and weights of Gauss's formula on (-1, 1), and weights of the formula on three of them.
FAR, NEAR = 0.9061798459386640, 0.5384693101056831
OUTER, INNER, MIDDLE = 0.2369268850561891, 0.4786286704993665, 0.5688888888888889
ROUGH_OUTER, ROUGH_MIDDLE = 0.4059280294219, 1.1881439411562
# A change nearer to the end of a panel than this share of the step is at that end; guards are
# evaluated within, where they have left it.
SAME_PLACE = 1e-9
# Panels of one step, their least size, and the share of what ERROR explains that is given to them.
MOST_PANELS, LEAST_PANEL, SHARE_OF_ERROR = 400, 1e-7, 0.01


@native
def gauss_place(i: int) -> float:
    """Place of a row of guards on (-1, 1): the ends and the five points."""
    place = 0.0
    if i == 0 or i == 6:
        place = 1.0
    elif i == 1 or i == 5:
        place = FAR
    elif i == 2 or i == 4:
        place = NEAR
    return 0.0 - place if i < 3 else place


@native
def work_on_panel(P: Problem, L: Plan, a: float, b: float) -> float:
    """Work between the shares ``a`` and ``b`` of the step."""
    A, points = P.audit.now, P.audit.points
    count, half, top = P.guard.size - P.sizes.nw, 0.5 * (b - a), 0.0
    A.budget -= 1
    for i in range(ROWS_OF_GUARDS):
        s = a + half * (1.0 + gauss_place(i))
        s = min(max(s, a + 2.0 * SAME_PLACE), b - 2.0 * SAME_PLACE)
        if i > 0 and i < 6:
            points[i + 4] = 0.0
            points[i - 1] = power_at(P, L, s, points[i + 4 :])
            top = max(top, abs(points[i - 1]))
        elif count > 0:
            put_on_path(P, s)
        if count > 0:
            look_at_guards(P, i)
    if count > 0 and A.budget > 0:
        s = first_change(P, a, b)
        if s > a + SAME_PLACE and s < b - SAME_PLACE:
            return work_on_panel(P, L, a, s) + work_on_panel(P, L, s, b)
    fine = OUTER * (points[0] + points[4]) + INNER * (points[1] + points[3]) + MIDDLE * points[2]
    rough = ROUGH_OUTER * (points[0] + points[4]) + ROUGH_MIDDLE * points[2]
    size, width = 2.0 * top, half * A.span
    # Orders 10 and 4: the square of the relative difference is a safe estimate of the better one.
    error = width * abs(fine - rough) * min(1.0, abs(fine - rough) / max(size, TINY))
    if error > SHARE_OF_ERROR * P.settings.error * A.size and b - a > LEAST_PANEL:
        if A.budget > 0:
            s = 0.5 * (a + b)
            return work_on_panel(P, L, a, s) + work_on_panel(P, L, s, b)
        A.missed += 1
    A.quadrature += error
    elastic = OUTER * (points[5] + points[9]) + INNER * (points[6] + points[8])
    A.created += width * (elastic + MIDDLE * points[7])
    return width * fine


@native
def look_at_guards(P: Problem, row: int) -> None:
    """Guards and places in zones at the workspace's state, into a row behind the points."""
    first, count = P.sizes.nw, P.guard.size - P.sizes.nw
    kept = P.audit.points[POINTS + row * count :]
    guard_values(P, CLOCK)
    copy(kept, P.guard[first:], count)
    guard_values(P, WATCH)
    for k in range(count):
        kept[k] += P.guard[first + k]


@native
def branch_side(kind: int, value: float) -> float:
    """The branch of a guard: a sign, or a whole number; before, in or behind a zone; poles have
    one, and arguments of tables.
    """
    if kind < 0 or kind == POLE or kind == ROOT:
        return 0.0
    if kind == STRICT or kind == WEAK:
        return 1.0 if value > 0.0 else -1.0
    if kind == ZONE or kind == NARROW:
        return max(-1.0, min(1.0, floor(value)))
    return floor(value)


@native
def first_change(P: Problem, a: float, b: float) -> float:
    """A place inside the panel where a guard changes its side, ``b`` when there is none."""
    count, half = P.guard.size - P.sizes.nw, 0.5 * (b - a)
    rows = P.audit.points[POINTS:]
    for i in range(ROWS_OF_GUARDS - 1):
        low, high = a + half * (1.0 + gauss_place(i)), a + half * (1.0 + gauss_place(i + 1))
        for k in range(count):
            before = branch_side(P.kind[k], rows[i * count + k])
            if before != branch_side(P.kind[k], rows[(i + 1) * count + k]):
                s = place_of_change(P, k, before, low, high)
                if s > a + SAME_PLACE and s < b - SAME_PLACE:
                    return s
    return b


@native
def place_of_change(P: Problem, k: int, before: float, a: float, b: float) -> float:
    """By halving: where guard ``k`` leaves the side on which it is at ``a``."""
    rows, count = P.audit.points[POINTS:], P.guard.size - P.sizes.nw
    low, high = a, b
    while high - low > 0.1 * SAME_PLACE:
        s = 0.5 * (low + high)
        put_on_path(P, s)
        look_at_guards(P, ROWS_OF_GUARDS)
        if branch_side(P.kind[k], rows[ROWS_OF_GUARDS * count + k]) == before:
            low = s
        else:
            high = s
    return 0.5 * (low + high)


@native
def power_at(P: Problem, L: Plan, s: float, elastic: Reals) -> float:
    """Power of loads and of constraints that move at the share ``s`` of the step.

    Into ``elastic`` goes that of elastic elements, into ``forces`` the largest sum of
    (f max(1, |x|))^2 seen.
    """
    A, W, F, n = P.audit, P.W, P.F, P.sizes.n
    put_on_path(P, s)
    if A.solved and not solve_on_path(P, L, s):
        A.now.missed += 1
    u = A.vectors
    if A.elastic:
        elastic[0] = delivered(P, ELASTIC, u)
    for i in range(n):
        F[i] = 0.0
    run_groups(P, LOADS, F)
    note_external(P)
    squares = 0.0
    for b in range(P.sizes.nb):
        i, o, m = P.body[b].first, P.body[b].at, P.mass[b]
        for k in range(P.body[b].width):
            size = F[i + k] - m * P.gravity[k] if k < 3 else F[i + k]
            reach = max(1.0, abs(W[o + k])) if k < 3 else 1.0
            squares += size * size * reach * reach
    A.now.forces = max(A.now.forces, squares)
    if A.solved and P.sizes.m > 0:
        for k in range(P.sizes.m):
            W[P.scalar[k]] *= A.moving[k]
        run_groups(P, REACTIONS, F)
    total = 0.0
    for i in range(n):
        total -= F[i] * u[i]
    return total


@native
def note_external(P: Problem) -> None:
    """Which share of the loads in ``P.F`` does not add up to nothing, as force and as torque."""
    F, W, net, size = P.F, P.W, P.work, 0.0
    for k in range(8):
        net[k] = 0.0
    for b in range(P.sizes.nb):
        i, o = P.body[b].first, P.body[b].at
        for k in range(3):
            n, p = (k + 1) % 3, (k + 2) % 3
            net[k] += F[i + k]
            net[3 + k] += W[o + n] * F[i + p] - W[o + p] * F[i + n]
            net[6] += abs(F[i + k])
            net[7] += (abs(W[o + n]) + abs(W[o + p])) * abs(F[i + k])
            if P.body[b].width == PART:
                net[3 + k] += F[i + 3 + k]
                net[7] += abs(F[i + 3 + k])
    for k in range(3):
        size = max(size, abs(net[k]) / max(net[6], TINY), abs(net[3 + k]) / max(net[7], TINY))
    P.audit.now.external = max(P.audit.now.external, size)


@native
def delivered(P: Problem, phases: int, u: Reals) -> float:
    """Power of some loads at the workspace's state."""
    F, total = P.F, 0.0
    for i in range(P.sizes.n):
        F[i] = 0.0
    run_groups(P, phases, F)
    for i in range(P.sizes.n):
        total -= F[i] * u[i]
    return total
