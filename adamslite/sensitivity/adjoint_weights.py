"""Weights of equations, carried back to the state and to all numbers in the equations.

With weights nu (nz,) of the rows of F, phi = nu . F is one number, and

    phi_x, phi_phi, phi_u, phi_a, phi_(lam, V, s), phi_s'     (rotations in ground axes)

are its derivatives at the state in the workspace; those by reals of kernels, masses, inertias and
gravity are added up over a run.
"""

from __future__ import annotations

import ctypes
from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from adamslite.integrators.contract import SIGNALS
from adamslite.kernels.code.workspace import (
    ACCELERATION,
    ALPHA,
    ATTITUDE,
    OMEGA,
    POSITION,
    TIME,
    VELOCITY,
)
from adamslite.kernels.pullback import pullback
from adamslite.model.model import PART

if TYPE_CHECKING:
    from adamslite.equations.system import System


def _called(address: int) -> Any:
    """A native function of an address, None of 0."""
    return KIND(address) if address else None


def _stacked(vectors: np.ndarray) -> np.ndarray:
    """Vectors of bodies at several states (., nb, 3), at one of them too."""
    return vectors.reshape(-1, *vectors.shape[-2:])


KIND = ctypes.CFUNCTYPE(None, ctypes.c_int64, *[ctypes.c_void_p] * 6)
THREE = np.arange(3)


@dataclass
class Slopes:
    """Derivatives of a weighted sum of equations: by q (rotations in ground axes), u, a (n,),
    multipliers, variables and states ``z``, rates of states ``rd``.
    """

    q: np.ndarray
    u: np.ndarray
    a: np.ndarray
    z: np.ndarray
    rd: np.ndarray


@dataclass
class Numbers:
    """Derivatives by the numbers of the equations.

    ``reals``: of each group of kernels (instances, reals); ``mass`` (nb,), ``inertia`` (nb, 3, 3),
    ``gravity`` (3,).
    """

    reals: list[np.ndarray]
    mass: np.ndarray
    inertia: np.ndarray
    gravity: np.ndarray

    def arrays(self) -> list[np.ndarray]:
        """All of them."""
        return [*self.reals, self.mass, self.inertia, self.gravity]


class Weights:
    """Carries weights back for one system.

    Attributes
    ----------
    numbers : Numbers
        What has been added up.
    """

    def __init__(self, system: System) -> None:
        self.system = system
        kernels, keep = system.kernels, system.instances.keep
        reals = [
            np.zeros((len(group.instances), (keep[2 * k + 1].size - 1) // len(group.instances)))
            for k, group in enumerate(kernels.groups)
        ]
        nb = len(system.model.bodies)
        self.numbers = Numbers(reals, np.zeros(nb), np.zeros((nb, 3, 3)), np.zeros(3))
        self.calls = [
            (int(system.group[k].phases), *map(_called, pullback(kernels, group)), self._given(k))
            for k, group in enumerate(kernels.groups)
        ]
        self.active: dict[int, list[tuple[Any, tuple[int, int, int, int]]]] = {}
        self.of_time = any(own & SIGNALS for own, *_ in self.calls)
        self.slopes_of_w = np.zeros(system.nw + 1)
        starts, widths = np.array(system.starts[:nb], dtype=int), system.widths[:nb]
        at = np.array([system.w_at["BODY", b] for b in range(nb)], dtype=int)
        self.parts = np.array([w == PART for w in widths], dtype=bool)
        self.x, self.wx = starts[:, None] + THREE, at[:, None] + THREE
        self.phi, self.wphi = self.x[self.parts] + 3, self.wx[self.parts]
        self.from_w = [
            self._places(*pair)
            for pair in ((POSITION, ATTITUDE), (VELOCITY, OMEGA), (ACCELERATION, ALPHA))
        ]
        self.heavy = np.zeros(system.n)
        self.heavy[self.x] = system.mass[:, None]
        self.first = system.m + system.nv
        self.scalar = np.array(system.numbering.scalar, dtype=int)
        self.rate = self.scalar[self.first :] + 1

    def _places(self, place: int, turn: int) -> np.ndarray:
        """Where each unknown of the bodies stands in the workspace."""
        found = np.zeros(self.system.n, dtype=int)
        found[self.x], found[self.phi] = self.wx + place, self.wphi + turn
        return found

    def _given(self, k: int) -> tuple[int, int, int, int]:
        ints, reals = self.system.instances.keep[2 * k : 2 * k + 2]
        count = len(self.system.kernels.groups[k].instances)
        return count, ints.ctypes.data, reals.ctypes.data, self.numbers.reals[k].ctypes.data

    def of_equations(self, phases: int, weights: np.ndarray) -> Slopes:
        """Slopes of weights . F at the state in the workspace: kernels of ``phases``, inertia."""
        self._run(phases, weights)
        slopes = self._collected()
        self._inertia(weights, slopes, self.system.W)
        self.count_inertia(weights, self.system.W)
        return slopes

    def of_stages(self, phases: int, states: np.ndarray, weights: np.ndarray) -> Slopes:
        """The same at several workspaces (3, W.size), of weights (3, nz): slopes (3, .); without
        what :meth:`count_inertia` counts.
        """
        G = np.zeros((len(states), self.slopes_of_w.size))
        for state, nu, target in zip(states, weights, G, strict=True):
            self._run(phases, nu, state, target)
        slopes = self._collected(G)
        self._inertia(weights, slopes, states)
        return slopes

    def of_rows(self, phases: int, weights: np.ndarray) -> Slopes:
        """The same without inertia."""
        self._run(phases, weights)
        return self._collected()

    def of_guard(self, k: int, weight: float) -> tuple[Slopes, float]:
        """Slopes of the guard with number ``k``, and that by the time."""
        G, weights = self.slopes_of_w, np.zeros(self.system.W.size)
        weights[self.system.nw + k] = weight
        G[:] = 0.0
        w, nu, g = self.system.W.ctypes.data, weights.ctypes.data, G.ctypes.data
        for _, _, call, (count, ints, reals, target) in self.calls:
            if call:
                call(count, ints, reals, w, nu, g, target)
        self._signals(w, G)
        return self._collected(), float(G[TIME])

    def of_outputs(self, phases: int, weights: np.ndarray, places: Mapping[int, float]) -> Slopes:
        """Slopes of what is written (n_out,), and of entries of the workspace."""
        self._run(phases if weights.size else 0, weights)
        for place, weight in places.items():
            self.slopes_of_w[place] += weight
        return self._collected()

    def _run(
        self,
        phases: int,
        weights: np.ndarray,
        state: np.ndarray | None = None,
        target: np.ndarray | None = None,
    ) -> None:
        """Kernels of the phases, at the workspace or another ``state``, into ``target`` (zeros)."""
        G, W = target, self.system.W if state is None else state
        if G is None:
            G = self.slopes_of_w
            G[:] = 0.0
        w, nu, g = W.ctypes.data, weights.ctypes.data, G.ctypes.data
        if phases not in self.active:
            self.active[phases] = [(call, g) for own, call, _, g in self.calls if own & phases]
        for call, (count, ints, reals, into) in self.active[phases]:
            call(count, ints, reals, w, nu, g, into)
        if self.of_time:
            self._signals(w, G)

    def _signals(self, w: int, G: np.ndarray) -> None:
        """Variables of time, at the workspace of the address ``w``: each before those that it
        reads.
        """
        for k in range(len(self.calls) - 1, -1, -1):
            own, call, _, (count, ints, reals, target) = self.calls[k]
            if not own & SIGNALS or call is None:
                continue
            n_ints = 8 * (self.system.instances.keep[2 * k].size // count)
            n_reals = 8 * self.numbers.reals[k].shape[1]
            for n in range(count - 1, -1, -1):
                g = G.ctypes.data
                call(1, ints + n * n_ints, reals + n * n_reals, w, g, g, target + n * n_reals)

    def _collected(self, G: np.ndarray | None = None) -> Slopes:
        """Slopes of the workspace's entries, or of those of several workspaces (3, .), sorted."""
        G = self.slopes_of_w if G is None else G
        q, u, a = (G.take(places, axis=-1) for places in self.from_w)
        return Slopes(q, u, a, G.take(self.scalar, axis=-1), G.take(self.rate, axis=-1))

    def _inertia(self, weights: np.ndarray, slopes: Slopes, W: np.ndarray) -> None:
        """M (a - gravity), and what turns; with a leading axis for several states ``W``."""
        slopes.a += self.heavy * weights[..., : self.system.n]
        if len(self.phi):
            self._spin(weights, slopes, W)

    def count_inertia(self, weights: np.ndarray, W: np.ndarray) -> None:
        """Derivatives by masses, inertias and gravity, which are linear in the weights."""
        system = self.system
        nu = weights.take(self.x, axis=-1)
        a = W.take(self.wx + ACCELERATION, axis=-1) - system.gravity
        self.numbers.mass += _stacked(nu * a).sum(axis=(0, 2))
        self.numbers.gravity -= system.mass @ _stacked(nu).sum(axis=0)
        if not len(self.phi):
            return
        attitude, alpha, omega = self._attitude(W)
        turn = weights.take(self.phi, axis=-1)
        inside = [
            _stacked(np.einsum("...bji,...bj->...bi", attitude, v))
            for v in (turn, alpha, np.cross(turn, omega), omega)
        ]
        both = np.einsum("sbi,sbj->bij", inside[0], inside[1])
        both += np.einsum("sbi,sbj->bij", inside[2], inside[3])
        self.numbers.inertia[self.parts] += both

    def _attitude(self, W: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """R (., 3, 3), alpha and w (., 3) of parts."""
        alpha, omega = (W.take(self.wphi + at, axis=-1) for at in (ALPHA, OMEGA))
        attitude = W.take(self.wphi[:, :1] + ATTITUDE + np.arange(9), axis=-1)
        return attitude.reshape(*omega.shape[:-1], 3, 3), alpha, omega

    def _spin(self, weights: np.ndarray, slopes: Slopes, W: np.ndarray) -> None:
        """J al + w x J w."""
        attitude, alpha, omega = self._attitude(W)
        turn = weights.take(self.phi, axis=-1)
        own = self.system.inertia.reshape(-1, 3, 3)[self.parts]
        J = attitude @ own @ attitude.swapaxes(-1, -2)

        def times(v: np.ndarray) -> np.ndarray:
            return np.einsum("...bij,...bj->...bi", J, v)

        cross = np.cross
        spun = cross(turn, omega)
        h, hs, hn = times(omega), times(spun), times(turn)
        slopes.a[..., self.phi] += hn
        slopes.u[..., self.phi] += cross(h, turn) + hs
        slopes.q[..., self.phi] += (
            cross(times(alpha), turn) + cross(hn, alpha) + cross(h, spun) + cross(hs, omega)
        )
