"""States of point masses by component, so that loops over bodies have no place to look up.

    y = x of all bodies, y, z, then vx, vy, vz        k = their accelerations, the same way

in rows of equal length, a multiple of ``history.LINE``; what is beyond the bodies stays zero.
Loads come from :mod:`adamslite.kernels.code.lane_writer`.
"""

from __future__ import annotations

from adamslite.integrators.contract import Problem
from adamslite.integrators.explicit.control import INVERSE, Control
from adamslite.integrators.lanes import run_lanes, run_masses
from adamslite.integrators.linalg.plan import TINY
from adamslite.integrators.motion_equations import put_time
from adamslite.native.translate import Alone, Reals, maximum, native

# Of the mass, its square and its third power: minors above this share are not round-off.
CLEAR = 1e-6


@native
def lane_tables(P: Problem, C: Control) -> None:
    """Inverse masses, accelerations of gravity and masses of all bodies."""
    inverse = P.history[INVERSE * C.size :]
    fall, mass = inverse[C.half :], inverse[3 * C.half :]
    for i in range(C.half):
        inverse[i], fall[i] = 0.0, 0.0
    for b in range(C.lane):
        mass[b] = P.mass[b] if b < P.sizes.nb else 1.0
    for k in range(3):
        for b in range(P.sizes.nb):
            inverse[k * C.lane + b], fall[k * C.lane + b] = 1.0 / P.mass[b], P.gravity[k]


@native
def lane_accelerations(P: Problem, C: Control, t: float, y: Reals, k: Reals) -> bool:
    """Accelerations at a state; False when an effective mass vanishes."""
    inverse = P.history[INVERSE * C.size :]
    fall, F, mass = inverse[C.half :], inverse[2 * C.half :], inverse[3 * C.half :]
    put_time(P, t)
    for i in range(C.half):
        F[i] = 0.0
    run_lanes(P, y, C.lane, F)
    P.count.residuals += 1
    if P.sizes.added_mass:
        E = mass[C.lane :]
        if P.sizes.along_axes:  # the other rows are neither written nor read
            put_diagonal(mass, C.lane, E)
            run_masses(P, y, C.lane, E)
            return divide_along_axes(E, F, fall, mass, C.lane, k) < 1.0 / TINY
        put_masses(mass, C.lane, E)
        run_masses(P, y, C.lane, E)
        return divide_by_masses(E, F, fall, mass, C.lane, k) < 1.0 / TINY
    divide(F, inverse, fall, C.half, k)
    return True


@native
def lane_masses_clear(P: Problem, C: Control) -> bool:
    """Whether all effective masses of the state evaluated last are clearly above zero: three
    pivots each, by leading minors.
    """
    n = C.lane
    mass = P.history[INVERSE * C.size + 3 * C.half :]
    E = mass[n:]
    for b in range(P.sizes.nb):
        m, first = mass[b], E[b]
        second = first * E[4 * n + b]
        if not P.sizes.along_axes:
            second -= E[n + b] * E[3 * n + b]
        third = second * E[8 * n + b]
        if not P.sizes.along_axes:
            c, f, g, h = E[2 * n + b], E[5 * n + b], E[6 * n + b], E[7 * n + b]
            third += c * (E[3 * n + b] * h - E[4 * n + b] * g) - f * (first * h - E[n + b] * g)
        if not (first > CLEAR * m and second > CLEAR * m * m and third > CLEAR * m * m * m):
            return False
    return True


@native
def put_masses(mass: Alone, row: int, E: Alone) -> None:
    """Masses on the diagonals of nine rows."""
    for i in range(9 * row):
        E[i] = 0.0
    put_diagonal(mass, row, E)


@native
def put_diagonal(mass: Alone, row: int, E: Alone) -> None:
    """Masses into the first, fifth and last row."""
    for b in range(row):
        E[b], E[4 * row + b], E[8 * row + b] = mass[b], mass[b], mass[b]


@native
def divide_along_axes(E: Alone, F: Alone, fall: Alone, mass: Alone, row: int, a: Alone) -> float:
    """a = E^-1 (m fall - F) where E is diagonal, with one division; the largest 1/|det E|."""
    top = 0.0
    for i in range(row):
        p, q, r = E[i], E[4 * row + i], E[8 * row + i]
        w = 1.0 / (p * q * r)
        top = maximum(top, abs(w))
        a[i] = w * q * r * (mass[i] * fall[i] - F[i])
        a[row + i] = w * r * p * (mass[i] * fall[row + i] - F[row + i])
        a[2 * row + i] = w * p * q * (mass[i] * fall[2 * row + i] - F[2 * row + i])
    return top


@native
def divide_by_masses(E: Alone, F: Alone, fall: Alone, mass: Alone, row: int, a: Alone) -> float:
    """a = E^-1 (m fall - F) by Cramer's rule; the largest 1/|det E|."""
    top = 0.0
    for i in range(row):
        b, c, d, f = E[row + i], E[2 * row + i], E[3 * row + i], E[5 * row + i]
        e, j, g, h = E[4 * row + i], E[8 * row + i], E[6 * row + i], E[7 * row + i]
        p, q, r = e * j - f * h, f * g - d * j, d * h - e * g
        w = 1.0 / (E[i] * p + b * q + c * r)
        top = maximum(top, abs(w))
        x = w * (mass[i] * fall[i] - F[i])
        y = w * (mass[i] * fall[row + i] - F[row + i])
        z = w * (mass[i] * fall[2 * row + i] - F[2 * row + i])
        a[i] = p * x + (c * h - b * j) * y + (b * f - c * e) * z
        a[row + i] = q * x + (E[i] * j - c * g) * y + (c * d - E[i] * f) * z
        a[2 * row + i] = r * x + (b * g - E[i] * h) * y + (E[i] * e - b * d) * z
    return top


@native
def divide(F: Alone, inverse: Alone, fall: Alone, n: int, a: Alone) -> None:
    """a = fall - F/m"""
    for i in range(n):
        a[i] = fall[i] - inverse[i] * F[i]


@native
def into_lanes(P: Problem, row: int, x: Reals, y: Reals) -> None:
    """Three numbers of each body by component."""
    for i in range(3 * row):
        y[i] = 0.0
    for b in range(P.sizes.nb):
        i = P.body[b].first
        for k in range(3):
            y[k * row + b] = x[i + k]


@native
def from_lanes(P: Problem, row: int, y: Reals, x: Reals) -> None:
    """Three numbers of each body from those by component."""
    for b in range(P.sizes.nb):
        i = P.body[b].first
        x[i], x[i + 1], x[i + 2] = y[b], y[row + b], y[2 * row + b]


@native
def unknown_of(P: Problem, row: int, i: int) -> int:
    """The number among q and u of a number by component."""
    half = 3 * row
    rest = i % half
    b = min(rest % row, P.sizes.nb - 1)
    return P.sizes.n * (i // half) + P.body[b].first + rest // row
