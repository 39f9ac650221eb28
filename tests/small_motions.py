"""Exponents of small motions from the program's own simulation: differences of the flow.

The state is disturbed in many directions, put back onto the constraints and integrated for a short
time; an observer on the ground or on a body notes what he sees of every body, nonlinearly:

    place      E^T (x - x_b)                 rate   d/dt of it
    attitude   log(S S0^T), S = E^T R        spin   E^T (w - w_b)

and of the own body its pose against that of the undisturbed run, v and w along the own axes; last
the states of DIFFs.  With X0, X1 the central differences of what is seen before and after, and U a
basis of X0, the exponents are log(eig(U^T X1 (U^T X0)^+))/time.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
from scipy.spatial.transform import Rotation

from adamslite.analyses.dynamics.dynamic import integrate, make_ready
from adamslite.analyses.initial.conditions import initial_conditions, move
from adamslite.analyses.session.session import Session
from adamslite.model.model import PART
from adamslite.results.outcomes import Outcome

STATE = ("q", "u", "a", "z", "rd", "mu", "ra", "rz", "pz", "base", "W")


class Flow:
    """Short runs from disturbed states of a session that stands in a steady state, with ``error``
    as ERROR.
    """

    def __init__(self, session: Session, error: float, observer: Any = None) -> None:
        self.session, self.system = session, session.system
        self.settings = replace(session.chosen.settings, error=error)
        self.system.elimination.unfold()
        self.start = {name: getattr(self.system, name).copy() for name in STATE}
        place = None if observer is None else self.system.model.marker(observer)
        self.body = None if place is None or place.kind == "ground" else place.body
        self.axes = np.eye(3) if place is None else place.axes

    def exponents(self, count: int, time: float, size: float, seed: int) -> np.ndarray:
        """(rank,) from ``count`` directions of ``size`` followed for ``time``."""
        rng = np.random.default_rng(seed)
        width = 2 * self.system.n + self.system.ns
        ends = self._run(np.zeros(width), time)
        pairs = []
        for direction in rng.standard_normal((count, width)):
            both = [self._run(sign * size * direction, time) for sign in (1.0, -1.0)]
            pairs.append([
                (self._seen(both[0][k], ends[k]) - self._seen(both[1][k], ends[k])) / (2.0 * size)
                for k in range(2)
            ])  # fmt: skip
        before, after = (np.array(each).T for each in zip(*pairs, strict=True))
        left, sizes, _ = np.linalg.svd(before)
        basis = left[:, : int((sizes > 1e-6 * sizes[0]).sum())]
        assert np.abs(after - basis @ basis.T @ after).max() < 1e-5 * np.abs(after).max()
        flow = basis.T @ after @ np.linalg.pinv(basis.T @ before)
        return np.log(np.linalg.eigvals(flow).astype(complex)) / time

    def _run(self, change: np.ndarray, time: float) -> tuple[dict, dict]:
        """Poses, velocities and states at both ends of a run from a disturbed state."""
        system, n, t = self.system, self.system.n, self.session.time
        for name, values in self.start.items():
            getattr(system, name)[:] = values
        self._count_anew()
        system.settings.t = t
        move(system, -change[:n])
        system.u[:n] += change[n : 2 * n] * 5.0
        first = system.m + system.nv
        system.z[first : first + system.ns] += change[2 * n :]
        assert initial_conditions(system) is None
        before = self._state()
        times = np.array([t, t + time])
        make_ready(system, times, time, self.settings)
        outcome = integrate(system, self.settings, None)
        assert outcome is Outcome.DONE
        return before, self._state()

    def _count_anew(self) -> None:
        """Attitudes as they are, rotation vectors zero."""
        system = self.system
        for b, attitude in enumerate(self._attitudes()):
            i = system.starts[b] + 3
            if attitude is not None:
                system.q[i : i + 3], system.base[9 * b : 9 * b + 9] = 0.0, attitude.ravel()

    def _attitudes(self) -> list[np.ndarray | None]:
        found: list[np.ndarray | None] = []
        for b, body in enumerate(self.system.model.bodies):
            if body.width != PART:
                found.append(None)
                continue
            c = self.system.q[self.system.starts[b] + 3 :][:3]
            skew = np.cross(np.eye(3), -c)
            turned = np.linalg.solve(np.eye(3) - skew / 2, np.eye(3) + skew / 2)
            found.append(turned @ self.system.base[9 * b : 9 * b + 9].reshape(3, 3))
        return found

    def _state(self) -> dict[str, Any]:
        system, first = self.system, self.system.m + self.system.nv
        bodies = []
        for b, attitude in enumerate(self._attitudes()):
            i = system.starts[b]
            spin = None if attitude is None else system.u[i + 3 : i + 6].copy()
            bodies.append((system.q[i : i + 3].copy(), system.u[i : i + 3].copy(), attitude, spin))
        return {"bodies": bodies, "states": system.z[first : first + system.ns].copy()}

    def _seen(self, state: dict[str, Any], undisturbed: dict[str, Any]) -> np.ndarray:
        """What the observer notes of a state, as differences from the undisturbed one."""
        found = [state["states"] - undisturbed["states"]]
        frame, frame0 = self._frame(state), self._frame(undisturbed)
        for b, pair in enumerate(zip(state["bodies"], undisturbed["bodies"], strict=True)):
            if b == self.body:
                found += self._own(*pair)
                continue
            now, before = (
                self._relative(each, at) for each, at in zip(pair, (frame, frame0), strict=True)
            )
            found += [now[0] - before[0], now[1] - before[1]]
            if now[2] is not None:
                found += [_log(now[2] @ before[2].T), now[3] - before[3]]
        return np.concatenate(found)

    def _frame(self, state: dict[str, Any]) -> tuple:
        if self.body is None:
            return np.zeros(3), np.zeros(3), self.axes, np.zeros(3)
        x, v, attitude, spin = state["bodies"][self.body]
        return x, v, attitude @ self.axes, spin

    @staticmethod
    def _relative(body: tuple, frame: tuple) -> tuple:
        (x, v, attitude, spin), (x0, v0, axes, w) = body, frame
        rate = axes.T @ (v - v0 - np.cross(w, x - x0))
        if attitude is None:
            return axes.T @ (x - x0), rate, None, None
        return axes.T @ (x - x0), rate, axes.T @ attitude, axes.T @ (spin - w)

    def _own(self, body: tuple, undisturbed: tuple) -> list[np.ndarray]:
        axes, axes0 = body[2] @ self.axes, undisturbed[2] @ self.axes
        return [
            axes0.T @ (body[0] - undisturbed[0]), axes.T @ body[1] - axes0.T @ undisturbed[1],
            _log(axes0.T @ axes), axes.T @ body[3] - axes0.T @ undisturbed[3],
        ]  # fmt: skip


def _log(rotation: np.ndarray) -> np.ndarray:
    return Rotation.from_matrix(rotation).as_rotvec()


def distance(found: np.ndarray, expected: np.ndarray) -> float:
    """Largest difference of eigenvalues in the best pairing, as a share of their size, small ones
    against a hundredth of the largest.
    """
    from scipy.optimize import linear_sum_assignment

    assert found.shape == expected.shape
    apart = np.abs(found[:, None] - expected[None, :])
    rows, columns = linear_sum_assignment(apart)
    floor = 0.01 * np.abs(expected).max()
    return float((apart[rows, columns] / np.maximum(np.abs(expected[columns]), floor)).max())
