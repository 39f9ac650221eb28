"""Backward differences of past values: the history of a multistep method.

D_0 = y, D_i = D_{i-1} less D_{i-1} one step earlier, on steps of equal size h; a new step size
maps the differences by the matrices of Shampine and Reichelt (SIAM J. Sci. Comput. 18 (1997) 1,
section 2.2).

One more row keeps what D_0 loses to round-off: positions of some metres lose all of a step of
nanoseconds, velocities and differences do not (Higham, Accuracy and Stability, 2002, section 4.3).
"""

from __future__ import annotations

from adamslite.integrators.bdf.history import LOST, ROWS
from adamslite.integrators.contract import Problem
from adamslite.integrators.implicit.rotation_count import count_anew
from adamslite.integrators.motion_equations import PART, put_pose
from adamslite.native.translate import Reals, as_written, native

# Rotation vectors are counted from the present attitude again beyond this length (squared).
REBASE = 0.0025


@native
def gamma(k: int) -> float:
    """1 + 1/2 + ... + 1/k"""
    total = 0.0
    for j in range(1, k + 1):
        total += 1.0 / j
    return total


@native
def extrapolate(D: Reals, w: int, k: int, yp: Reals, psi: Reals) -> None:
    """Extrapolate the history: the change of the value and the known part of the derivative."""
    for i in range(w):
        yp[i] = D[LOST * w + i]
        psi[i] = 0.0
    g = 0.0
    for j in range(1, k + 1):
        g += 1.0 / j
        for i in range(w):
            yp[i] += D[j * w + i]
            psi[i] += g * D[j * w + i]
    for i in range(w):
        psi[i] /= g


@native
def change_step(D: Reals, w: int, k: int, factor: float) -> None:
    """Differences of the same polynomial on the step ``factor * h`` (Shampine, Reichelt, eq.
    2.5).
    """
    table = D[(LOST + 1) * w :]
    size = k + 1
    ru = table[0:]
    for i in range(size):
        for j in range(size):
            ru[i * size + j] = 0.0
    r = table[size * size :]
    u = table[2 * size * size :]
    difference_matrix(r, size, factor)
    difference_matrix(u, size, 1.0)
    for i in range(size):
        for m in range(size):
            for j in range(size):
                ru[i * size + j] += r[i * size + m] * u[m * size + j]
    column = table[3 * size * size :]
    for c in range(w):
        for i in range(size):
            total = 0.0
            for j in range(size):
                total += ru[j * size + i] * D[j * w + c]
            column[i] = total
        for i in range(size):
            D[i * w + c] = column[i]


@native
def difference_matrix(r: Reals, size: int, factor: float) -> None:
    """R_ij = prod_{m=1..i} (m - 1 - factor j)/m."""
    for j in range(size):
        r[j] = 1.0
    for i in range(1, size):
        for j in range(size):
            r[i * size + j] = 0.0 if j == 0 else r[(i - 1) * size + j] * (i - 1 - factor * j) / i


@native
def extend_history(D: Reals, d: Reals, w: int, k: int) -> None:
    """Differences of the accepted value: D_{k+1} = d, D_j += D_{j+1}."""
    row, above = (k + 1) * w, (k + 2) * w
    for i in range(w):
        D[above + i] = d[i] - D[row + i]
        D[row + i] = d[i]
    for j in range(k, 0, -1):
        for i in range(w):
            D[j * w + i] += D[(j + 1) * w + i]
    add_exactly(w, D[w:], D, D[LOST * w :])


@native
@as_written
def add_exactly(w: int, step: Reals, y: Reals, lost: Reals) -> None:
    """y += step, and what y is too coarse to take stays in ``lost`` until the next time."""
    for i in range(w):
        whole = step[i] + lost[i]
        total = y[i] + whole
        taken = total - y[i]
        lost[i] = (y[i] - (total - taken)) + (whole - taken)
        y[i] = total


@native
def rebase(P: Problem, D: Reals, w: int, k: int) -> None:
    """Count rotation vectors from the present attitude; the history follows exactly.

    Past values y_j = sum_i (-1)^i C(j,i) D_i; composition of Cayley vectors
    cay(a) cay(b) = cay((a + b + a x b/2)/(1 - a.b/4)), here with b = -c.
    """
    rows = min(k + 3, ROWS)
    for b in range(P.sizes.nb):
        i = P.body[b].first + 3
        if P.body[b].width != PART:
            continue
        c0, c1, c2 = D[i], D[i + 1], D[i + 2]
        if c0 * c0 + c1 * c1 + c2 * c2 < REBASE:
            continue
        o = P.body[b].at
        for c in range(3):
            P.q[i + c], D[LOST * w + i + c] = D[i + c], 0.0
        put_pose(P, P.q)
        for m in range(9):
            P.base[9 * b + m] = P.W[o + 15 + m]
        for c in range(3):
            to_values(D, w, i + c, rows)
        for j in range(rows):
            count_anew(D, j * w + i, c0, c1, c2)
        for c in range(3):
            to_values(D, w, i + c, rows)


@native
def to_values(D: Reals, w: int, i: int, rows: int) -> None:
    """Differences to past values and back: the map is its own inverse."""
    for m in range(1, rows):
        for j in range(rows - 1, m - 1, -1):
            D[j * w + i] = D[(j - 1) * w + i] - D[j * w + i]
