"""The gradient of one number of a run by backward differences, from its end to its beginning.

Sensitivities follow the tape of a run by linear operations
(:mod:`adamslite.sensitivity.differences`); here are their transposes, in the opposite order (a
discrete adjoint).  Weights of the history of sensitivities, Dbar, become those before

    output time  y(tau) = sum p_j D_j                       Dbar_j += p_j ybar
    differences  D' = (history of y)                        ybar = dbar, y_pbar = -dbar
    step         F_q dq + F_u du + ... + F_p = 0            N^T nu = r(ybar),  pbar -= F_p^T nu
    prediction   y_p = sum D_i, psi = sum gamma_i D_i/gamma_k
    step size    D = R D_before                             Dbar_before = R^T Dbar
    event        du += (a_before - a_behind) dt/dp          dt/dp = -(f_y dy + f_p)/(f_t + f_y y')
    start        D_1 = h y', y projected onto constraints

with r = (ybar_q + (cu - [w])^T ybar_u, 0, ybar_s, G W ybar_u).  As equations depend on psi and y_p
through y' alone,

    psibar_q = cu g,   g = ybar_u - (F_u + cu F_a)^T nu,
    psibar_u = -cu F_a^T nu,  psibar_s = -cu F_s'^T nu,  y_pbar = -(ybar + psibar)

References: Griewank, Walther, Evaluating Derivatives, 2008, chapter 15; Cao, Li, Petzold, Serban,
SIAM J. Sci. Comput. 24 (2003) 1076 (adjoint DAE).
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from adamslite.errors import UsageError
from adamslite.integrators.bdf.history import ROWS
from adamslite.integrators.contract import (
    ACCELERATION,
    ACCELERATIONS,
    DONE,
    OUTPUTS,
    POSITION_ROWS,
    STATE_ORIGIN,
)
from adamslite.integrators.projection import RATES
from adamslite.kernels.code.workspace import TIME
from adamslite.sensitivity.adjoint_columns import Seed
from adamslite.sensitivity.adjoint_tape import SINGULAR, Row, Taken, gammas, vector_rates, way_of
from adamslite.sensitivity.adjoint_weights import Numbers, Slopes
from adamslite.sensitivity.begin import AHEAD
from adamslite.sensitivity.transposed import (
    FACTOR_RATES,
    FACTOR_STEP,
    GUARDS,
    SOLVE_RATES,
    SOLVE_STEP,
    TAKE,
)

if TYPE_CHECKING:
    from adamslite.equations.system import System
    from adamslite.sensitivity.directions import Direction

GRAZES = "an event at t = {t:.6g} only just happens: its time has no derivative"
# A guard that changes by less than this share of its terms changes by round-off.
GRAZING = 1e-9
# As in :mod:`adamslite.sensitivity.start`.
NEAR, SAME, COUPLED, TOGETHER = 0.01, 1e-9, 1e-6, 1e-6


@dataclass
class Derivatives:
    """By the numbers of the equations, and by the state y = (places and turns, velocities, states)
    at the start.
    """

    numbers: Numbers
    start: np.ndarray

    def along(self, found: Direction) -> float:
        """The derivative by a number of the deck, which changes the arrays so."""
        numbers = self.numbers
        total = float(self.start @ found.start + numbers.mass @ found.mass)
        total += float(numbers.gravity @ found.gravity + numbers.inertia.ravel() @ found.inertia)
        for k, first, count, reals in found.pieces:
            weights = numbers.reals[k][first : first + count].ravel()
            total += float(weights @ reals[: weights.size])
        return total


class Sweep(Taken):
    """From the end of a taped run to its beginning."""

    def __init__(self, system: System) -> None:
        super().__init__(system)
        self.bar = np.zeros((ROWS, self.w))
        self.guards, self.several = system.sizes.clocks + system.sizes.watched, 0
        self.later: tuple[float, np.ndarray, bool] | None = None

    def back(self, seeds: Mapping[int, Seed]) -> Derivatives:
        """``seeds``: weights of what was written at output times, by their numbers."""
        last = max(seeds, default=-1)
        for k in range(len(self.rows) - 1, 0, -1):
            row = self.rows[k]
            if row.outputs.start > last:
                continue  # nothing was asked for from here on
            self._remember(row.memory)
            if not row.is_step:
                self._reset(k)
                self._event(k)
                continue
            for output in row.outputs:
                if output in seeds:
                    self._output(k, row, output, seeds[output])
            self._step(k, row)
            if row.fresh:
                self._begin(k - 1, row)
            self._reset(k)
        y = self.bar[0].copy()
        for output in self.rows[0].outputs:
            if output in seeds:
                self._put(0)
                self._settle(self.rows[0].t)
                y += self._written(seeds[output])
        self._project(y)
        return Derivatives(self.weights.numbers, y)

    def _output(self, k: int, row: Row, output: int, seed: Seed) -> None:
        """What was written within a step, on the polynomial of its history."""
        nw = self.system.nw
        self.system.W[:nw], self.system.W[nw:] = seed.state[:nw], self._workspace(k)[nw:]
        y = self._written(seed)
        p, at = 1.0, float(self.system.times[output])
        self.bar[0] += y
        for j in range(row.order):
            p *= (at - row.t + row.h * j) / (row.h * (j + 1))
            self.bar[j + 1] += p * y

    def _step(self, k: int, row: Row) -> None:
        """One step."""
        way, end = way_of(row.order, row.h / row.h_before), row.order + 3
        bar = self.bar[:end]  # no further difference is read or written
        self._put(k)
        psi, y = self._corrector(row, way.own[:end] @ bar)
        bar[:] = way.past[:end, :end] @ bar
        bar[: row.order + 1] += way.rate[:, None] * psi
        bar[: row.order + 1] += way.level[:, None] * y

    def _corrector(self, row: Row, y: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Weights of psi, and of y_p, from those of y.

        The latter are -(psibar + ybar) by y' alone.  Weights of differences of small steps behind
        which the steps grow are large, by their power of that growth, and so would be the round-off
        of that sum; by N^T nu = r, of places q and states it is sl.q + w x g and sl.s.
        """
        system, n, first, phi = self.system, self.n, self.first, self.phi
        cu = float(gammas(row.order)[-1] / row.h)
        self._do(FACTOR_STEP, cu)
        yu, F = y[n : 2 * n], system.F
        F[:] = 0.0
        F[:n] = y[:n] + cu * yu
        if len(phi):
            F[phi] += np.cross(system.W[self.spin], yu[phi])
        F[n + first : n + first + system.ns] = y[2 * n :]
        if self.ties is not None:
            F[: system.nz] += self.ties.mu(system.J, self.weight * yu)
        sl = self.weights.of_equations(self.phases, self._solved(SOLVE_STEP))
        psi, found = np.empty(self.w), np.empty(self.w)
        g = yu + sl.u + cu * sl.a
        psi[:n], psi[n : 2 * n], psi[2 * n :] = cu * g, cu * sl.a, cu * sl.rd
        found[:n], found[2 * n :] = sl.q, sl.z[first:]
        if len(phi):
            found[phi] += np.cross(system.W[self.spin], g[phi])
        found[n : 2 * n] = sl.u + (found[:n] + y[:n]) / cu
        return psi, found

    def _solved(self, task: int) -> np.ndarray:
        """-nu of the weights in F."""
        F, dead = self.system.F, self.system.elimination.dead
        F[dead] = 0.0
        self._do(task)
        nu = -F[: self.system.nz]
        nu[dead] = 0.0
        return nu

    def _accelerations(self, sl: Slopes) -> np.ndarray:
        """Weights of y behind those of accelerations, multipliers, variables and rates, at the
        state in the workspace.
        """
        n, first, F = self.n, self.first, self.system.F
        y = np.concatenate([sl.q, sl.u, sl.z[first:]])
        if not (sl.a.any() or sl.z[:first].any() or sl.rd.any()):
            return y
        self._do(FACTOR_RATES)
        F[:] = 0.0
        F[:n], F[n : n + first], F[n + first : n + first + len(sl.rd)] = sl.a, sl.z[:first], sl.rd
        found = self.weights.of_equations(ACCELERATION, self._solved(SOLVE_RATES))
        return y + np.concatenate([found.q, found.u, found.z[first:]])

    def _written(self, seed: Seed) -> np.ndarray:
        """Weights of y behind what was written of the workspace."""
        return self._accelerations(self.weights.of_outputs(OUTPUTS, seed.out, seed.places))

    # ---- starts and events --------------------------------------------------------------------

    def _settle(self, t: float) -> None:
        """Accelerations at the places, velocities and states in the workspace."""
        self._do(TAKE)
        self.system.settings.t = t
        if self.system.run(ACCELERATIONS) != DONE:
            raise UsageError(SINGULAR)

    def _rates_back(self, rates: np.ndarray, W: np.ndarray) -> np.ndarray:
        """Weights of y behind those of y' at a workspace: theta' = du + w x theta."""
        n, phi = self.n, self.phi
        self.system.W[:] = W
        nothing = np.zeros(self.first + self.system.ns)
        sl = Slopes(np.zeros(n), rates[:n].copy(), rates[n : 2 * n], nothing, rates[2 * n :])
        if len(phi):
            sl.q[phi] = np.cross(rates[:n][phi], W[self.spin])
        return self._accelerations(sl)

    def _begin(self, k: int, row: Row) -> None:
        """A history from derivatives of the motion, at the state of the tape's row ``k``.

        With rates R at the state, N at d, and with S = (N - R)/d for the second derivative N' and F
        at d and 2 d: second and third are (4 N' - 3 R - F)/(2 d) and (R - 2 N' + F)/d^2.
        """
        bar, h, d, y = self.bar, row.h, AHEAD * row.h, self.bar[0].copy()
        rate = h * bar[1]
        self._put(k)
        self._settle(float(self.system.W[0]))
        here = self.system.W.copy()
        if row.order > 1:
            second = h * h * (bar[2] - 0.5 * bar[1])
            third = h**3 * (bar[1] / 6.0 - bar[2] + bar[3])
            straight, near, far = self._ahead(d)
            rate += third / (d * d) - 1.5 * second / d
            found = self._rates_back(third / (d * d) - 0.5 * second / d, far)
            y, rate, curve = y + found, rate + 2.0 * d * found, 2.0 * d * d * found
            found = self._rates_back(2.0 * second / d - 2.0 * third / (d * d), near)
            y, rate, curve = y + found, rate + d * found, curve + 0.5 * d * d * found
            found = self._rates_back(curve / d, straight)
            y, rate = y + found, rate + d * found - curve / d
        self.bar = np.zeros((ROWS, self.w))
        self.bar[0] = y + self._rates_back(rate, here)

    def _ahead(self, d: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Workspaces at d on a straight line, at d and 2 d on the parabola, from the state that has
        just been settled.
        """
        n, origin, t = self.n, self._state(), float(self.system.settings.t)
        rate, second = self._rates(origin), np.zeros(self.w)
        found: list[np.ndarray] = []
        for ahead in (d, d, 2.0 * d):
            x = origin + ahead * (rate + 0.5 * ahead * second)
            self.system.q[:n], self.system.u[:n] = x[:n], x[n : 2 * n]
            self.system.z[self.first :][: self.system.ns] = x[2 * n :]
            self.system.settings.t = t + ahead
            if self.system.run(ACCELERATIONS) != DONE:
                raise UsageError(SINGULAR)
            if not found:
                second = (self._rates(x) - rate) / d
            found.append(self.system.W.copy())
        return found[0], found[1], found[2]

    def _state(self) -> np.ndarray:
        """(q, u, s) of the unknowns."""
        system, n = self.system, self.n
        states = system.z[self.first :][: system.ns]
        return np.concatenate([system.q[:n], system.u[:n], states])

    def _rates(self, x: np.ndarray) -> np.ndarray:
        """(q', u', s') at x, the state in place."""
        system, n = self.system, self.n
        rates = np.concatenate([system.u[:n], system.a[:n], system.rd[: system.ns]])
        rates[self.phi] = vector_rates(x[self.phi], system.u[self.phi])
        return rates

    def _event(self, k: int) -> None:
        """Sensitivities of velocities and states jump where branches change."""
        before, behind, row = self._workspace(k - 1), self._workspace(k), self.rows[k]
        old, new = (W[self.system.nw :][: self.guards] for W in (before, behind))
        changed = np.flatnonzero((old != new) & (old != 0.0)).tolist()
        if not changed:
            return
        after, rates = self._rates_with(behind), self._rates_with(before)
        here, found = self.system.W.copy(), np.zeros(self.w)
        self._do(GUARDS)
        value = self.system.guard[self.system.nw :][: self.guards] - 0.5 * (old + new)
        value[: self.system.sizes.clocks] = 0.0
        slopes = {g: self._slopes_of(g, row.t) for g in changed}
        moving = [g for g in changed if slopes[g][0] != 0.0]
        leaders = [g for g in moving if abs(value[g]) <= NEAR * row.h * abs(slopes[g][0])] or moving
        surfaces, jumps = _surfaces(slopes, leaders), [rates - after]
        if len(surfaces) > 1:
            self.several += 1
            follow = [g for g in changed if g not in leaders]
            jumps = [0.5 * (rates - self._rates_with(before, each, new, follow)
                            + self._rates_with(behind, each, old, follow) - after)
                     for each in surfaces]  # fmt: skip
        self.system.W[:] = here
        for (guard, *_), jump in zip(surfaces, jumps, strict=False):
            size = max(np.abs(rates).max(), np.abs(after).max())
            met = row.t, slopes[guard][1] / slopes[guard][0], np.abs(jump).max() > COUPLED * size
            self.several += int(self._coincides(*met))
            self.later = met
            if weight := float(self.bar[0, self.n :] @ jump):
                sl, _ = self.weights.of_guard(guard, -weight / slopes[guard][0])
                found += self._accelerations(sl)
        self.bar[0] += found

    def _coincides(self, t: float, slopes: np.ndarray, counts: bool) -> bool:
        """Whether the event that came later is at this time, a number moves both apart, and both
        change accelerations.
        """
        settings = self.system.settings
        within = min(TOGETHER, settings.error) * settings.t_end
        if not self.later or self.later[0] - t > within:
            return False
        if not (counts and self.later[2]):
            return False
        apart, size = (np.abs(each).max() for each in (slopes - self.later[1], slopes))
        return bool(apart > COUPLED * size)

    def _rates_with(
        self, W: np.ndarray, guards: Iterable[int] = (), branches: Any = (), free: Any = ()
    ) -> np.ndarray:
        """Accelerations and rates of states (n + ns,) at a workspace with other branches of some
        guards; those that are ``free`` are evaluated as they are.
        """
        system = self.system
        system.W[:] = W
        for g in guards:
            system.W[system.nw + g] = branches[g]
        for g in free:
            system.W[system.nw + g] = 0.0
        self._settle(float(W[0]))
        return np.concatenate([system.a[: self.n], system.rd[: system.ns]])

    def _slopes_of(self, guard: int, t: float) -> tuple[float, np.ndarray]:
        """How fast a guard changes; its slopes by the state, the time and all numbers."""
        system, G, n = self.system, self.weights.slopes_of_w, self.n
        kept = [each.copy() for each in self.weights.numbers.arrays()]
        sl, by_time = self.weights.of_guard(guard, 1.0)
        G[TIME] = 0.0
        y = self._accelerations(sl)
        slopes = [y, np.array([by_time + G[TIME]])]
        for each, before in zip(self.weights.numbers.arrays(), kept, strict=True):
            slopes.append((each - before).ravel())
            each[:] = before
        rates = np.concatenate([system.u[:n], system.a[:n], system.rd[: system.ns], [1.0]])
        terms = np.concatenate(slopes[:2]) * rates
        speed = float(terms.sum())
        if speed != 0.0 and abs(speed) <= GRAZING * float(np.abs(terms).sum()):
            raise UsageError(GRAZES.format(t=t))
        return speed, np.concatenate(slopes)

    def _reset(self, k: int) -> None:
        """States that count from another value behind row ``k`` than before it began at zero."""
        at = self.weights.rate - 1 + STATE_ORIGIN
        before, behind = self._workspace(k - 1), self._workspace(k)
        changed = before[at] != behind[at]
        self.bar[:, 2 * self.n :][:, changed] = 0.0
        self.several += int(changed.any())

    def _project(self, y: np.ndarray) -> None:
        """Velocities, then positions at the start were moved onto the constraints."""
        system, n = self.system, self.n
        if system.m == 0:
            return
        self._put(0)
        self._settle(self.rows[0].t)
        self._do(FACTOR_RATES)
        mu = system.nz - system.holonomic
        for level, phases in ((1, RATES), (0, POSITION_ROWS)):
            system.F[:] = 0.0
            system.F[:n] = y[level * n : level * n + n]
            nu = self._solved(SOLVE_RATES)
            nu[:n] = 0.0
            nu[n + system.m :] = 0.0
            if self.held and level:
                nu[mu:] = nu[n : n + system.holonomic]
                nu[n : n + system.holonomic] = 0.0
            sl = self.weights.of_rows(phases, nu)
            y += np.concatenate([sl.q, sl.u, sl.z[self.first :]])


def _surfaces(slopes: Mapping[int, tuple[float, np.ndarray]], guards: list[int]) -> list[list[int]]:
    """Guards whose times every number shifts alike, together."""
    found: list[list[int]] = []
    for g in guards:
        own = slopes[g][1] / slopes[g][0]
        size = np.abs(own).max()
        for each in found:
            speed, other = slopes[each[0]]
            if np.abs(own - other / speed).max() <= SAME * size:
                each.append(g)
                break
        else:
            found.append([g])
    return found
