"""Linearisation: eigenvalues, modes and state matrices about the present state.

With N an orthonormal basis of the velocities all constraints allow, x = (y, y', s) the states
(q = N y, u = N y', s those of DIFF) and inputs w added to the VARIABLEs of a PINPUT

    [F_a N, F_lam, F_V, F_s'] (y'', lam, V, s') = E w - [F_q N, F_u N, F_s] x

are the equations of motion, of VARIABLEs and of DIFFs; solved for the left vector they are
x' = A x + B w and, with the rows of V of a POUTPUT, v = C x + D w.

F_q holds the forces' derivatives and those of G^T lam, so tension and reactions stiffen as they
should. Undamped frequencies come from the columns of y and y'' alone.
Reference: Negrut, Ortiz, J. Comput. Nonlinear Dynam. 1 (2006) 230.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import pi
from typing import Any

import numpy as np

from adamslite.analyses.initial import constraint_gradient
from adamslite.engine import ACCELERATIONS, JACOBIAN
from adamslite.integrators import base
from adamslite.model import PART
from adamslite.system import System

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
        A of x' = A x + B w with x = (y, y', s).
    input_matrix, output_matrix, feedthrough : (nx, nw), (nv, nx), (nv, nw) arrays
        B, C, D; w is added to the VARIABLEs of PINPUT, v = C x + D w is those of POUTPUT.
    coordinates, inputs, outputs : tuple of str
        Names of the rows of ``modes``, of w and of v.
    """

    eigenvalues: np.ndarray
    undamped: np.ndarray
    modes: np.ndarray
    state_matrix: np.ndarray
    coordinates: tuple[str, ...]
    input_matrix: np.ndarray
    output_matrix: np.ndarray
    feedthrough: np.ndarray
    inputs: tuple[str, ...]
    outputs: tuple[str, ...]

    @property
    def frequencies(self) -> np.ndarray:
        """|eigenvalue|/(2 pi) [cycles per time]."""
        return np.abs(self.eigenvalues) / (2 * pi)

    @property
    def damping_ratios(self) -> np.ndarray:
        """-Re/|eigenvalue|; zero where the eigenvalue vanishes."""
        size = np.abs(self.eigenvalues)
        return np.where(size > 0.0, -self.eigenvalues.real / np.where(size > 0.0, size, 1.0), 0.0)


def linear(
    system: System,
    inputs: tuple[Any, ...] = (),
    outputs: tuple[Any, ...] = (),
    damping: bool = True,
    relative_to: Any = None,
) -> Linearization:
    """Linearise ``system`` at the state it holds.

    Parameters
    ----------
    inputs, outputs : tuple of ids
        VARIABLEs, those of a PINPUT and of a POUTPUT.
    damping : bool
        Without it, what depends on velocities is left out.
    relative_to : id
        A MARKER: modes show the motion relative to its body, in ground axes.
    """
    system.run(ACCELERATIONS)
    free = _free_directions(system)
    places = [system.starts[system.node_at["VARIABLE", key]] for key in inputs]
    seen = [system.starts[system.node_at["VARIABLE", key]] - system.n for key in outputs]
    solved = _solved(system, free, places, damping)
    f, ns, nx = free.shape[1], system.ns, 2 * free.shape[1] + system.ns
    rows = np.r_[0:f, len(solved) - ns : len(solved)]
    whole = np.vstack([np.zeros((f, nx + len(places))), solved[rows]])
    whole[:f, f : 2 * f] = np.eye(f)
    a, b = whole[:, :nx], whole[:, nx:]
    values, vectors = np.linalg.eig(a)
    order = np.lexsort((-values.imag, np.round(np.abs(values), 12)))
    told = solved[[f + k for k in seen]]
    modes = _relative(system, free @ vectors[:f, order], relative_to)
    return Linearization(
        values[order], _undamped(a[f : 2 * f, :f]), modes, a, _names(system),
        b, told[:, :nx], told[:, nx:],
        tuple(f"VARIABLE/{key}" for key in inputs), tuple(f"VARIABLE/{key}" for key in outputs),
    )  # fmt: skip


def _solved(system: System, free: np.ndarray, places: list[int], damping: bool) -> np.ndarray:
    """Derivatives (f + m + nv + ns, nx + nw) of (y'', lam, V, s') with respect to (x, w)."""
    n, m = system.n, system.m
    fq, fu, fa, fz, fd = (_matrix(system, kind) for kind in range(5))
    z, s = slice(n, n + m + system.nv), slice(n + m + system.nv, n + m + system.nv + system.ns)
    rows = np.r_[0:n, n + m : s.stop]
    left = np.hstack([fa[:, :n] @ free, fz[:, z], fd[:, s]])[rows]
    right = -np.hstack([fq[:, :n] @ free, damping * fu[:, :n] @ free, fq[:, s]])[rows]
    pushes = np.zeros((len(fq), len(places)))
    pushes[places, range(len(places))] = 1.0
    # Least squares: multipliers of redundant rows are not determined.
    return np.linalg.lstsq(left, np.hstack([right, pushes[rows]]), rcond=None)[0]


def _undamped(minus_stiffness: np.ndarray) -> np.ndarray:
    """Signed roots of the eigenvalues of M^-1 K, smallest first."""
    squares = np.sort(np.linalg.eigvals(-minus_stiffness).real)
    return np.sign(squares) * np.sqrt(np.abs(squares))


def _relative(system: System, modes: np.ndarray, marker: Any) -> np.ndarray:
    """Modes less the rigid motion of the marker's body."""
    place = None if marker is None else system.model.marker(marker)
    if place is None or place.kind == "ground":
        return modes
    i = system.starts[place.body]
    moves, origin = modes.copy(), system.q[i : i + 3]
    shift = modes[i : i + 3]
    turn = modes[i + 3 : i + 6] if system.model.bodies[place.body].width == PART else 0.0 * shift
    for b, body in enumerate(system.model.bodies):
        k = system.starts[b]
        arm = system.q[k : k + 3] - origin
        moves[k : k + 3] -= shift + np.cross(turn.T, arm).T
        if body.width == PART:
            moves[k + 3 : k + 6] -= turn
    return moves


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
