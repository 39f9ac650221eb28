"""The equations of small motions as x' = A x + B w, v = C x + D w, seen by an observer.

The observer's coordinates of a small motion, (dx, phi) = P (xi, sigma), are those that holonomic
constraints allow: N(t) a basis of the null space of G P,

    (dx, phi) = Q y,    Q = P N,    Q' = P'N + P N',    Q'' = P''N + 2 P'N' + P N''.

From dR = [phi] R and R' = [w] R follows the change of the angular velocity, dw = phi' - w x phi.
With W the matrix of these products (zero for translations) changes of velocity and acceleration are

    du = Q y' + (Q' - W Q) y,
    da = Q y'' + (2 Q' - W Q) y' + (Q'' - W Q' - W' Q) y,

which fulfil the linearised conditions of velocity and acceleration, d(G u + g_t) and its rate, as
they stand.  What constrains velocities only (rows r, by u, q and s) leaves

    y' = B p + H (y, s),    G_r Q B = 0,    G_r Q H = -(G_r (Q' - W Q) + D_r Q, S_r)

so that x = (y, p, s), with p = y' where there is no such row.  The equations F = 0 of motion, of
VARIABLEs and of DIFFs, with inputs w added to some VARIABLEs,

    F_q (dx, phi) + F_u du + F_a da + F_s ds + F_lam dlam + F_V dV + F_s' ds' = E w

are then solved for (p', dlam, dV, s').  F_q holds the derivatives of G^T lam too, so reactions
stiffen as they should.  References: P. E. Nikravesh, Computer-Aided Analysis of Mechanical Systems,
1988, chapter 11; Negrut, Ortiz, J. Comput. Nonlinear Dynam. 1 (2006) 230.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from adamslite.analyses.linearization.instant import skew
from adamslite.integrators.linalg.plan import TINY
from adamslite.model.model import PART

if TYPE_CHECKING:
    from adamslite.analyses.linearization.instant import Instant
    from adamslite.analyses.linearization.observer import Jet
    from adamslite.equations.system import System

# Singular values below this share of the largest are redundant rows.
RANK = 1e-9


@dataclass(frozen=True)
class Ports:
    """Unknowns of inputs and outputs (VARIABLEs), and what is left out.

    ``damping`` False leaves out what depends on velocities.
    """

    inputs: tuple[int, ...] = ()
    outputs: tuple[int, ...] = ()
    damping: bool = True


@dataclass(frozen=True)
class Basis:
    """N (n, f) and B (f, g) with their derivatives by time, and that of H (f, f + ns)."""

    positions: Jet
    speeds: tuple[np.ndarray, np.ndarray]
    slope: np.ndarray | float = 0.0


@dataclass(frozen=True)
class Rates:
    """y' = [H_y, B, H_s] x, its derivative without p' and s', and H (f, f + ns) alone."""

    now: np.ndarray
    next: np.ndarray
    held: np.ndarray


def null_space(rows: np.ndarray, unit: np.ndarray, like: np.ndarray | None = None) -> np.ndarray:
    """Basis of what ``rows`` (m, n) allow, orthonormal when coordinates are counted in ``unit``
    (n,); the nearest one to the basis ``like``.
    """
    if not rows.size:
        return np.eye(rows.shape[1])
    _, size, vt = np.linalg.svd(rows * unit)
    rank = int((size > RANK * max(size[0], TINY)).sum())
    basis = vt[rank:].T
    if like is not None and like.shape == basis.shape:
        left, _, right = np.linalg.svd(basis.T @ (like / unit[:, None]))
        basis = basis @ left @ right
    return unit[:, None] * basis


class FirstOrder:
    """Small motions at one instant.

    Attributes
    ----------
    basis : Basis
    held : (f, f + ns) array
        H.
    whole : (nx + nv, nx + nw) array
        [A, B; C, D].
    """

    def __init__(
        self, system: System, instant: Instant, view: Jet, basis: Basis, ports: Ports
    ) -> None:
        self.system, self.instant, self.basis = system, instant, basis
        n = basis.positions
        self.q = view[0] @ n[0]
        self.q1 = view[1] @ n[0] + view[0] @ n[1]
        self.q2 = view[2] @ n[0] + 2.0 * view[1] @ n[1] + view[0] @ n[2]
        self.by_y = self.q1 - self._cross(instant.u, self.q)
        rates = self._rates()
        self.held = rates.held
        self.whole = self._whole(rates, ports)

    @property
    def minus_stiffness(self) -> np.ndarray:
        """-M^-1 K (g, g), of p' by the motion that is free."""
        f, g = self.basis.speeds[0].shape
        return self.whole[f : f + g, :f] @ self.basis.speeds[0]

    def _cross(self, spin: np.ndarray, columns: np.ndarray) -> np.ndarray:
        """W times columns."""
        found = np.zeros_like(columns)
        for b, body in enumerate(self.system.model.bodies):
            if body.width == PART:
                i = self.system.starts[b] + 3
                found[i : i + 3] = skew(spin[i : i + 3]) @ columns[i : i + 3]
        return found

    def _rates(self) -> Rates:
        system, instant, f = self.system, self.instant, self.q.shape[1]
        b, b1 = self.basis.speeds
        held = np.zeros((f, f + system.ns))
        gradient, drift = instant.gradient[system.holonomic :], instant.drift[system.holonomic :]
        if len(gradient):
            of_y = gradient @ self.by_y + drift[:, : system.n] @ self.q
            forced = np.hstack([of_y, drift[:, self._states].toarray()])
            held = -np.linalg.lstsq(gradient @ self.q, forced, rcond=RANK)[0]
        now = np.hstack([held[:, :f], b, held[:, f:]])
        slope = self.basis.slope + np.zeros_like(held)
        later = held[:, :f] @ now + np.hstack([slope[:, :f], b1, slope[:, f:]])
        return Rates(now, later, held)

    @property
    def _states(self) -> slice:
        first = self.system.n + self.system.m + self.system.nv
        return slice(first, first + self.system.ns)

    def _whole(self, rates: Rates, ports: Ports) -> np.ndarray:
        system, instant, q = self.system, self.instant, self.q
        n, (f, g) = system.n, self.basis.speeds[0].shape
        s, z = self._states, slice(n, n + system.m + system.nv)
        rows = np.r_[0:n, n + system.m : s.stop]
        of_y = np.zeros((n, rates.now.shape[1]))
        place, speed, push = of_y.copy(), of_y.copy(), of_y
        place[:, :f], speed[:, :f], push[:, :f] = q, self.by_y, self._acceleration_by_y()
        speed += q @ rates.now
        push += (2.0 * self.q1 - self._cross(instant.u, q)) @ rates.now + q @ rates.next
        by_q, by_u, by_a, by_z, by_sd = (
            each[rows]
            for each in (
                instant.by_place, instant.by_velocity, instant.by_acceleration,
                instant.by_algebraic, instant.by_rate,
            )
        )  # fmt: skip
        by_a = by_a[:, :n]
        free, driven = q @ self.basis.speeds[0], q @ rates.held[:, f:]
        left = np.hstack([by_a @ free, by_z[:, z].toarray(), by_sd[:, s].toarray() + by_a @ driven])
        right = -(by_q[:, :n] @ place + by_u[:, :n] @ speed + by_a @ push)
        right[:, f : f + g] *= ports.damping
        right[:, f + g :] -= by_q[:, s].toarray()
        pushes = np.zeros((system.nz, len(ports.inputs)))
        pushes[list(ports.inputs), range(len(ports.inputs))] = 1.0
        # Least squares: multipliers of redundant rows are not determined.
        solved = np.linalg.lstsq(left, np.hstack([right, pushes[rows]]), rcond=None)[0]
        first = np.hstack([rates.now, np.zeros((f, len(ports.inputs)))])
        outputs = [g + k - n for k in ports.outputs]
        return np.vstack([first, solved[:g], solved[len(solved) - system.ns :], solved[outputs]])

    def _acceleration_by_y(self) -> np.ndarray:
        """Q'' - W Q' - W' Q."""
        u, a = self.instant.u, self.instant.a
        return self.q2 - self._cross(u, self.q1) - self._cross(a, self.q)


def still(
    system: System, instant: Instant, view: Jet, unit: np.ndarray, like: Basis | None = None
) -> Basis:
    """The basis at one instant as if it stood still for the observer; near ``like``.

    ``unit`` (n,) makes rotations comparable with translations.
    """
    holonomic = instant.gradient[: system.holonomic] @ view[0]
    n = null_space(holonomic, unit, None if like is None else like.positions[0])
    rows = instant.gradient[system.holonomic :] @ view[0] @ n
    b = null_space(rows, np.ones(n.shape[1]), None if like is None else like.speeds[0])
    return Basis((n, 0.0 * n, 0.0 * n), (b, 0.0 * b))


def moving(before: FirstOrder, now: FirstOrder, after: FirstOrder, h: float) -> Basis:
    """The basis of ``now`` with its derivatives by differences; of three :class:`FirstOrder`."""
    n = [each.basis.positions[0] for each in (before, now, after)]
    b = [each.basis.speeds[0] for each in (before, now, after)]
    middle = (n[2] - n[0]) / (2.0 * h), (n[2] - 2.0 * n[1] + n[0]) / h**2
    slope = (after.held - before.held) / (2.0 * h)
    return Basis((n[1], *middle), (b[1], (b[2] - b[0]) / (2.0 * h)), slope)
