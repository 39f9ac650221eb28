"""The same for the three stages of the Radau formula.

Of the stages Z_i = (q, lam, V, s, mu)_i of a step, with w = A^-1/h,

    u_i = sum_j w_ij (q_j - q_0) - w x theta_i + W G^T mu_i,   a_i = sum_j w_ij (u_j - u_0),
    s'_i = sum_j w_ij (s_j - s_0),    F_q q_i + F_u u_i + F_a a_i + F_z z_i + F_s' s'_i + F_p = 0

(:mod:`adamslite.sensitivity.stages`) is a linear system M Z = ... with the derivatives at each
stage.  Weights of the stages, M^T nu = r, are found as stages are: with the matrices at the middle
stage, transposed, for increments of nu, until they are round-off.  One of

    r_i <- r_i - (M^T dnu)_i,    (M^T nu)_i = F_q^T nu_i + sum_j w_ji g_j + w_i x g_i, ...,
    g_i = F_u^T nu_i + sum_k w_ki F_a^T nu_k

takes weights of the equations at three states; all that hangs on nu is added up with them.
Weights of the start are, with r_i = sum_j w_ij and gbar_i = ubar_i - g_i,

    q_0bar = -sum r_i gbar_i,   u_0bar = sum r_i F_a^T nu_i,   s_0bar = sum r_i F_s'^T nu_i

which are differences of what is 1/(h f)^2 as large, for motion of the frequency f.  By M^T nu = r
they are

    q_0bar = sum p_i,   p_i = qbar_i - F_q^T nu_i + w_i x gbar_i,   gbar_i = -h sum a_ji p_j,
    u_0bar = sum ubar_i - F_u^T nu_i - gbar_i,   s_0bar = sum sbar_i - F_s^T nu_i
"""

from __future__ import annotations

from dataclasses import fields
from typing import TYPE_CHECKING

import numpy as np

from adamslite.errors import UsageError
from adamslite.integrators.radau.coefficients import INVERSE, NODE
from adamslite.integrators.radau.control import Y_ROWS, Z_ROWS
from adamslite.sensitivity import taped
from adamslite.sensitivity.adjoint_columns import Seed
from adamslite.sensitivity.adjoint_sweep import Sweep
from adamslite.sensitivity.adjoint_tape import SINGULAR, Row
from adamslite.sensitivity.adjoint_weights import Slopes
from adamslite.sensitivity.stages import SHARE
from adamslite.sensitivity.transposed import BLOCKS, FACTOR_STAGES, LAY, PUT_STAGE, SOLVE_STAGES

if TYPE_CHECKING:
    from adamslite.equations.system import System

# Increments stop where the next one would be this share of what they have added up to, or what
# those of forward sensitivities leave; those that shrink no further than STALLED are round-off
# below ROUND_OFF; and after so many.
ENOUGH, STALLED, ROUND_OFF, MOST = 1e-10, 0.5, 1e-7, 40
STAGES = range(3)


class StageSweep(Sweep):
    """From the end of a run by RADAU to its beginning; the first row of ``bar`` is that of y."""

    def __init__(self, system: System) -> None:
        super().__init__(system)
        self.at_stages = np.zeros((4, self.w))
        self.enough = ENOUGH if taped.EXACT else max(ENOUGH, SHARE * system.settings.error)
        self.inverse = system.tableau[INVERSE : INVERSE + 9].reshape(3, 3)
        self.formula = np.linalg.inv(self.inverse)
        self.nodes = system.tableau[NODE : NODE + 2]
        e = self.first + system.ns + system.holonomic
        at = Y_ROWS * self.w + Z_ROWS * e
        self.residuals = system.history[at : at + 3 * system.nz].reshape(3, system.nz)

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
        n, w = self.n, self.inverse / row.h
        weights = self.at_stages[1:]
        weights[2] += self.bar[0]
        states = self._stages(k, row)
        r = self._to_unknowns(states, w, weights[:, n : 2 * n])
        self._add(r, weights[:, :n], weights[:, 2 * n :])
        sl = self._solved_all(states, w, r)
        u = weights[:, n : 2 * n] + sl.u
        places = weights[:, :n] + sl.q
        self._turn(states, u + w.T @ sl.a, places)
        y = self.at_stages[0].copy()
        y[:n] += places.sum(axis=0)
        y[n : 2 * n] += (u + row.h * self.formula.T @ places).sum(axis=0)
        y[2 * n :] += (weights[:, 2 * n :] + sl.z[:, self.first :]).sum(axis=0)
        self.bar[0], self.at_stages = y, np.zeros((4, self.w))

    def _stages(self, k: int, row: Row) -> np.ndarray:
        """Workspaces of the stages of a step (3, W.size), the matrices at the middle one factored;
        G at all of them.
        """
        system = self.system
        self._put(k)
        self._do(LAY, float(k))
        self._do(FACTOR_STAGES, row.h)
        states, self.blocks = np.empty((3, system.W.size)), []
        for stage in STAGES:
            self._do(PUT_STAGE + stage, row.h)
            states[stage] = system.W
            if self.held:
                system.coef[:] = (1.0, 0.0, 0.0, 0.0, 0.0)
                self._do(BLOCKS, float(self.phases))
                self.blocks.append(system.J.copy())
        return states

    def _to_unknowns(self, states: np.ndarray, w: np.ndarray, u: np.ndarray) -> np.ndarray:
        """Weights of the unknowns (3, nz) behind those of velocities (3, n)."""
        found = np.zeros((3, self.system.nz))
        found[:, : self.n] = w.T @ u
        self._turn(states, u, found)
        if self.ties is not None:
            for each, J, mine in zip(found, self.blocks, self.weight * u, strict=True):
                each += self.ties.mu(J, mine)
        return found

    def _turn(self, states: np.ndarray, g: np.ndarray, found: np.ndarray) -> None:
        """Add w x g of parts."""
        if len(self.phi):
            spun = np.cross(states.take(self.spin, axis=1), g.take(self.phi, axis=1))
            found[:, self.phi] += spun

    def _add(self, found: np.ndarray, q: np.ndarray, s: np.ndarray) -> None:
        """Weights of places and states to those of the unknowns."""
        found[:, : self.n] += q
        at = self.n + self.first
        found[:, at : at + self.system.ns] += s

    def _solved_all(self, states: np.ndarray, w: np.ndarray, r: np.ndarray) -> Slopes:
        """Slopes (3, .) of -nu . F."""
        n, end, dead, size = self.n, self.n + self.first, self.system.elimination.dead, 1.0
        total, found = np.zeros_like(r), Slopes(*[np.zeros(1)] * 5)
        for _ in range(MOST):
            r[:, dead] = 0.0
            self.residuals[:] = r
            self._do(SOLVE_STAGES)
            change = -self.residuals
            change[:, dead] = 0.0
            total += change
            sl, last, size = self._more(states, change, found), size, _share(change, total, n)
            if size * min(1.0, size / last) <= self.enough or STALLED * last < size < ROUND_OFF:
                self.weights.count_inertia(total, states)
                return found
            r += self._to_unknowns(states, w, sl.u + w.T @ sl.a)
            r[:, n:end] += sl.z[:, : self.first]
            self._add(r, sl.q, sl.z[:, self.first :] + w.T @ sl.rd)
        raise UsageError(SINGULAR)

    def _more(self, states: np.ndarray, change: np.ndarray, found: Slopes) -> Slopes:
        """Slopes of an increment, which are added to those that were found."""
        sl = self.weights.of_stages(self.phases, states, change)
        for each in fields(Slopes):
            setattr(found, each.name, getattr(found, each.name) + getattr(sl, each.name))
        return sl


def _share(change: np.ndarray, total: np.ndarray, n: int) -> float:
    """The largest change against the largest of its kind: of rows of forces, and of the others."""
    found = 0.0
    for part in (slice(0, n), slice(n, None)):
        top = np.abs(total[:, part]).max(initial=0.0)
        found = max(found, float(np.abs(change[:, part]).max(initial=0.0) / top) if top else 0.0)
    return found
