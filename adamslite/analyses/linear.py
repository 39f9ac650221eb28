"""Linearisation: eigenvalues, modes and state matrices about the present state.

With x = (y, y', s) in the directions y that all constraints leave free (N spans the null space of
G, V eliminated)

    M y'' + C y' + K y + (coupling with s) = 0,      M = N^T F_a N,  C = N^T F_u N,  K = N^T F_q N

K holds the forces' derivatives and those of G^T lam, so tension and reactions stiffen as they
should. Undamped frequencies come from (K, M) alone.
Reference: Negrut, Ortiz, J. Comput. Nonlinear Dynam. 1 (2006) 230.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import pi

import numpy as np

from adamslite.analyses.initial import constraint_gradient
from adamslite.integrators import base
from adamslite.system import ACCELERATIONS, JACOBIAN, System

PHASES = base.LOADS | base.REACTIONS | base.ROWS
RANK = 1e-9


@dataclass(frozen=True)
class Linearization:
    """The model about one state.

    Parameters
    ----------
    eigenvalues : (nx,) complex array
        Of the state matrix, by frequency [1/time].
    undamped : (f,) array
        Natural frequencies without damping [1/time], imaginary parts as negative numbers for
        unstable directions (a negative stiffness gives -sqrt|k/m|).
    modes : (n, nx) complex array
        Body coordinates (translations and rotations in ground axes) of each eigenvector.
    state_matrix : (nx, nx) array
        x' = A x with x = (y, y', s).
    coordinates : tuple of str
        Names of the rows of ``modes``.
    """

    eigenvalues: np.ndarray
    undamped: np.ndarray
    modes: np.ndarray
    state_matrix: np.ndarray
    coordinates: tuple[str, ...]

    @property
    def frequencies(self) -> np.ndarray:
        """|eigenvalue|/(2 pi) [cycles per time]."""
        return np.abs(self.eigenvalues) / (2 * pi)

    @property
    def damping_ratios(self) -> np.ndarray:
        """-Re/|eigenvalue|; zero where the eigenvalue vanishes."""
        size = np.abs(self.eigenvalues)
        return np.where(size > 0.0, -self.eigenvalues.real / np.where(size > 0.0, size, 1.0), 0.0)


def linear(system: System) -> Linearization:
    """Linearise ``system`` at the state it holds."""
    system.run(ACCELERATIONS)
    n, first = system.n, system.m
    free = _free_directions(system)
    fq, fu, fa, fz, fd = (_matrix(system, kind) for kind in range(5))
    v = slice(n + first, n + first + system.nv)
    s = slice(n + first + system.nv, n + first + system.nv + system.ns)
    rows = np.r_[0:n, s]
    keep = {}
    bodies = slice(0, n)
    parts = {"q": (fq, bodies), "u": (fu, bodies), "a": (fa, bodies), "s": (fq, s), "d": (fd, s)}
    for name, (full, columns) in parts.items():
        part = full[:, columns]
        through = np.linalg.solve(fz[v, v], part[v]) if system.nv else np.zeros((0, part.shape[1]))
        keep[name] = (part - fz[:, v] @ through)[rows]
    return _assembled(system, free, keep, n)


def _assembled(
    system: System, free: np.ndarray, keep: dict[str, np.ndarray], n: int
) -> Linearization:
    """State matrix and its eigenvectors from the reduced matrices."""
    f, ns = free.shape[1], system.ns
    left = np.block([[free.T, np.zeros((f, ns))], [np.zeros((ns, n)), np.eye(ns)]])
    k, c, m = (left @ keep[name] @ free for name in ("q", "u", "a"))
    ks, cs = left @ keep["s"], left @ keep["d"]
    # Rows (y'', s'): [m cs] (y'', s') = -[k ks] (y, s) - c y'
    head = np.hstack([m, cs])
    solved = -np.linalg.solve(head, np.hstack([k, c, ks]))
    a = np.zeros((2 * f + ns, 2 * f + ns))
    a[:f, f : 2 * f] = np.eye(f)
    a[f:] = solved
    values, vectors = np.linalg.eig(a)
    order = np.lexsort((-values.imag, np.round(np.abs(values), 12)))
    stiffness = np.linalg.eigvals(np.linalg.solve(m[:f], k[:f])) if f else np.zeros(0)
    real = np.sort(stiffness.real)
    undamped = np.sign(real) * np.sqrt(np.abs(real))
    modes = free @ vectors[:f, order]
    return Linearization(values[order], undamped, modes, a, _names(system))


def _free_directions(system: System) -> np.ndarray:
    """Orthonormal basis (n, f) of the velocities all constraints allow."""
    if system.m == 0:
        return np.eye(system.n)
    _, size, vt = np.linalg.svd(constraint_gradient(system))
    rank = int((size > RANK * max(size[0], 1e-300)).sum())
    return vt[rank:].T


def _matrix(system: System, kind: int) -> np.ndarray:
    """Dense derivative of all equations: kind 0 q and s, 1 u, 2 a, 3 lam and V, 4 s'."""
    system.coef[:5] = 0.0
    system.coef[kind] = 1.0
    system.run(JACOBIAN, PHASES)
    return system.dense_jacobian()


def _names(system: System) -> tuple[str, ...]:
    words = ("x", "y", "z", "rx", "ry", "rz")
    return tuple(
        f"{body.statement.label}.{word}"
        for body in system.model.bodies
        for word in words[: body.width]
    )
