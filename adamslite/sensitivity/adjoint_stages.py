"""The same for the three stages of the Radau formula.

Of the stages Z_i = (q, lam, V, s, mu)_i of a step, with w = A^-1/h,

    u_i = sum_j w_ij (q_j - q_0) - w x theta_i + W G^T mu_i,   a_i = sum_j w_ij (u_j - u_0),
    s'_i = sum_j w_ij (s_j - s_0),    F_q q_i + F_u u_i + F_a a_i + F_z z_i + F_s' s'_i + F_p = 0

(:mod:`adamslite.sensitivity.stages`) one sparse matrix M is made, with the exact derivatives at
each stage.  From weights of the stages M^T nu = r, and those of the start are, r_i = sum_j w_ij,

    q_0bar = -sum r_i gbar_i,   gbar_i = ubar_i - F_u^T nu_i - sum_k w_ki F_a^T nu_k,
    u_0bar = sum r_i F_a^T nu_i,   s_0bar = sum r_i F_s'^T nu_i
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from adamslite.errors import UsageError
from adamslite.integrators.radau.coefficients import INVERSE, NODE
from adamslite.sensitivity.adjoint_columns import Seed
from adamslite.sensitivity.adjoint_formula import Row
from adamslite.sensitivity.adjoint_sweep import SINGULAR, Sweep
from adamslite.sensitivity.transposed import BLOCKS, LAY, PUT_STAGE

if TYPE_CHECKING:  # few runs need sparse matrices
    from scipy.sparse import csc_array, csr_array

    from adamslite.equations.system import System

STAGES = range(3)


class StageSweep(Sweep):
    """From the end of a run by RADAU to its beginning; the first row of ``bar`` is that of y."""

    def __init__(self, system: System) -> None:
        super().__init__(system)
        self.at_stages = np.zeros((4, self.w))
        self.inverse = system.tableau[INVERSE : INVERSE + 9].reshape(3, 3)
        self.nodes = system.tableau[NODE : NODE + 2]
        live = np.ones(system.nz, dtype=bool)
        live[system.elimination.dead] = False
        self.live = np.flatnonzero(np.tile(live, 3))

    def _output(self, k: int, row: Row, output: int, seed: Seed) -> None:
        nw = self.system.nw
        self.system.W[:nw], self.system.W[nw:] = seed.state[:nw], self._workspace(k)[nw:]
        x = min(1.0, 1.0 + (float(self.system.times[output]) - row.t) / row.h)
        self.at_stages += np.outer(self._collocated(x), self._written(seed))

    def _collocated(self, x: float) -> np.ndarray:
        """Shares of the start and the stages in the cubic through them."""
        a, b = self.nodes
        return np.array([
            (x - a) * (x - b) * (x - 1.0) / (-a * b),
            x * (x - b) * (x - 1.0) / (a * (a - b) * (a - 1.0)),
            x * (x - a) * (x - 1.0) / (b * (b - a) * (b - 1.0)),
            x * (x - a) * (x - b) / ((1.0 - a) * (1.0 - b)),
        ])  # fmt: skip

    def _begin(self, k: int, row: Row) -> None:
        """A step of its own has no history."""

    def _step(self, k: int, row: Row) -> None:
        n, first, nz, system = self.n, self.first, self.system.nz, self.system
        w = self.inverse / row.h
        weights = self.at_stages[1:]
        weights[2] += self.bar[0]
        states = self._stages(k, row)
        matrix, motion = self._matrix(states, w)
        r = (motion.T @ weights[:, n : 2 * n].ravel()).reshape(3, nz)
        r[:, :n] += weights[:, :n]
        r[:, n + first : n + first + system.ns] += weights[:, 2 * n :]
        nu = self._solved_all(matrix, r)
        found = []
        for state, each in zip(states, nu, strict=True):
            system.W[:] = state
            found.append(self.weights.of_equations(self.phases, each))
        a, rd = np.array([each.a for each in found]), np.array([each.rd for each in found])
        g = weights[:, n : 2 * n] + np.array([each.u for each in found]) + w.T @ a
        rows, y = w.sum(axis=1), self.at_stages[0].copy()
        y[:n] -= rows @ g
        y[n : 2 * n] -= rows @ a
        y[2 * n :] -= rows @ rd
        self.bar[0], self.at_stages = y, np.zeros((4, self.w))

    def _stages(self, k: int, row: Row) -> list[np.ndarray]:
        """Workspaces of the stages of a step."""
        self._put(k)
        self._do(LAY, float(k))
        found = []
        for stage in STAGES:
            self._do(PUT_STAGE + stage, row.h)
            found.append(self.system.W.copy())
        return found

    def _matrix(self, states: list[np.ndarray], w: np.ndarray) -> tuple[csr_array, csr_array]:
        """M (3 nz, 3 nz), and how velocities hang on the unknowns of all stages (3 n, 3 nz)."""
        from scipy.sparse import block_diag, csr_array, eye_array, kron

        n, nz, first, ns = self.n, self.system.nz, self.first, self.system.ns
        by, local = [], []
        for state in states:
            self.system.W[:] = state
            parts = [self._jacobian(c) for c in ((0, 3), (1,), (2,), (4,))]
            by.append(parts)
            local.append(self._local(parts[0]))
        places = csr_array(eye_array(n, nz))
        column = np.arange(ns)
        of_states = csr_array((np.ones(ns), (column, n + first + column)), shape=(ns, nz))
        motion = csr_array(kron(w, places) + block_diag(local))
        spread = places.T
        total = block_diag([p[0] for p in by]) + block_diag([p[1] @ spread for p in by]) @ motion
        rates = csr_array(kron(w, eye_array(n))) @ motion
        total = total + block_diag([p[2] @ spread for p in by]) @ rates
        if ns:
            total = total + block_diag([p[3] @ of_states.T for p in by]) @ kron(w, of_states)
        return csr_array(total), motion

    def _jacobian(self, kinds: tuple[int, ...]) -> csr_array:
        """Derivatives of the equations by what has these coefficients, at the workspace's state."""
        system = self.system
        system.coef[:] = 0.0
        system.coef[[*kinds]] = 1.0
        self._do(BLOCKS, float(self.phases))
        return system.sparse_jacobian()

    def _local(self, by_places: csr_array) -> csr_array:
        """-w x theta + W G^T mu, (n, nz)."""
        from scipy.sparse import csr_array

        n, nz, hol, system = self.n, self.system.nz, self.system.holonomic, self.system
        found = csr_array((n, nz))
        if len(self.phi):
            omega, rows, columns, values = system.W[self.spin], [], [], []
            for c, (i, j, sign) in enumerate(_CROSS):
                rows.append(self.phi[:, i])
                columns.append(self.phi[:, j])
                values.append(-sign * omega[:, c // 2])
            index = (np.concatenate(rows), np.concatenate(columns))
            found = found + csr_array((np.concatenate(values), index), shape=(n, nz))
        if self.held:
            ties = csr_array(by_places[n : n + hol, :n].T.multiply(self.weight[:, None]))
            mu = csr_array((np.ones(hol), (np.arange(hol), nz - hol + np.arange(hol))), (hol, nz))
            found = found + ties @ mu
        return csr_array(found)

    def _solved_all(self, matrix: csr_array, r: np.ndarray) -> np.ndarray:
        """-nu (3, nz)."""
        from scipy.sparse.linalg import splu

        live, found = self.live, np.zeros(r.size)
        part: csc_array = matrix[live][:, live].tocsc()
        try:
            found[live] = -splu(part).solve(r.ravel()[live], trans="T")
        except RuntimeError:
            raise UsageError(SINGULAR) from None
        return found.reshape(r.shape)


#: Of the entries of w x: row, column and sign, two for each component of w.
_CROSS = ((1, 2, -1.0), (2, 1, 1.0), (2, 0, -1.0), (0, 2, 1.0), (0, 1, -1.0), (1, 0, 1.0))
