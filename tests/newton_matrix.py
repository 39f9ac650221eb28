"""The exact Newton matrix of a model against finite differences of its residual.

The engine runs as plain Python here, so that one evaluation can be looked at; the kernels are the
compiled ones.
"""

from __future__ import annotations

import numpy as np
import scenes

from adamslite.analyses.initial.conditions import initial_conditions
from adamslite.analyses.initial.rows import constraint_gradient
from adamslite.equations.system import System
from adamslite.integrators import contract, motion_equations, newton
from adamslite.integrators.bdf import corrector
from adamslite.model.model import PART

H = 0.02
STEP = 1e-6


def shaken(system: System, rng: np.random.Generator, size: float) -> None:
    """Move and turn every body by about ``size``."""
    for b, body in enumerate(system.model.bodies):
        at = system.starts[b]
        system.q[at : at + 3] += size * rng.standard_normal(3)
        if body.width == PART:
            turned = _rotation(size * rng.standard_normal(3))
            attitude = system.base[9 * b : 9 * b + 9].reshape(3, 3)
            system.base[9 * b : 9 * b + 9] = (turned @ attitude).ravel()
    system.u[: system.n] += size * rng.standard_normal(system.n)


def _rotation(c: np.ndarray) -> np.ndarray:
    skew = np.array([[0.0, -c[2], c[1]], [c[2], 0.0, -c[0]], [-c[1], c[0], 0.0]])
    return np.linalg.solve(np.eye(3) - skew / 2, np.eye(3) + skew / 2)


def rank_at_random_posture(text: str) -> tuple[int, int]:
    """Rows and rank of G at a consistent posture near a random one."""
    system = scenes.system(text)
    shaken(system, np.random.default_rng(3), 0.2)
    unclosed = initial_conditions(system)
    assert unclosed is None, unclosed
    gradient = constraint_gradient(system)
    return system.m, int(np.linalg.matrix_rank(gradient, tol=1e-7))


class Newton:
    """One corrector iteration of the BDF at a random state."""

    def __init__(self, system: System) -> None:
        self.system = s = system
        rng = np.random.default_rng(1)
        self.P, self.L = s.records()
        self.tied = s.numbering.stabilised and s.holonomic > 0
        self.phases = contract.STABILISED if self.tied else contract.INDEX3
        self.yp, self.psi = self.P.trial[: s.n * 2 + s.ns], self.P.trial[s.n * 2 + s.ns :]
        self.psi = self.psi[: self.yp.size]
        self.start = (
            s.q + 0.3 * rng.standard_normal(s.q.size),
            s.z + rng.standard_normal(s.z.size),
            np.zeros_like(s.mu),
        )
        self.yp[:] = 0.3 * rng.standard_normal(self.yp.size)
        self.predicted = self.start[0][: s.n] - 0.01 * rng.standard_normal(s.n)
        self.psi[:] = 0.02 * rng.standard_normal(self.psi.size)

    def residual(self, q: np.ndarray, z: np.ndarray, mu: np.ndarray) -> np.ndarray:
        """F (nz,) at trial values."""
        P = self.P
        n, w = self.system.n, self.yp.size
        P.q[:], P.z[:], P.mu[:] = q, z, mu
        P.trial[2 * w + n : 2 * w + 2 * n] = q[:n] - self.predicted
        motion_equations.put_time(P, 0.3)
        corrector.motion_from_increments(P, 1 / H, self.yp, self.psi, self.tied)
        motion_equations.residual(P, self.phases, P.F)
        return P.F[: self.system.nz].copy()

    def exact(self) -> np.ndarray:
        """dF/dz (nz, nz) as the kernels give it."""
        s, P = self.system, self.P
        self.residual(*self.start)
        newton.newton_matrix(P, self.L, self.phases, 1 / H, P.q, P.trial[2 * self.yp.size :], P.u)
        full = np.zeros((s.nz, s.nz))
        for (row, column), at in s.blocks.offsets.items():
            h, w = s.widths[row], s.widths[column]
            r, c = s.starts[row], s.starts[column]
            full[r : r + h, c : c + w] = P.J[at : at + h * w].reshape(h, w)
        return full

    def differences(self) -> np.ndarray:
        """The same by central differences."""
        s = self.system
        columns = []
        for k in range(s.nz):
            ends = []
            for sign in (1.0, -1.0):
                trial = [v.copy() for v in self.start]
                dz = np.zeros(s.nz + 1)
                dz[k] = -sign * STEP
                newton.apply_increment(self.P, dz, *trial, self.tied)
                ends.append(self.residual(*trial))
            columns.append((ends[0] - ends[1]) / (2 * STEP))
        return np.array(columns).T


def matrix_error(text: str, stabilised: bool) -> float:
    """Largest deviation of the Newton matrix from differences, relative to its column."""
    work = Newton(scenes.system(text, stabilised))
    numeric = work.differences()
    return float((np.abs(work.exact() - numeric) / (1.0 + np.abs(numeric).max(axis=0))).max())
