"""A state at one instant with the derivatives of its equations, and its neighbours in time.

The neighbours at t +- h lie on the trajectory: with j = (a(t + h) - a(t - h)) / 2h

    x(t + h) = x + h u + h^2 a/2,    u(t + h) = u + h a + h^2 j/2,    s(t + h) likewise

(attitudes turn by the vector h w + h^2 al/2), with accelerations and multipliers solved for.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from adamslite.analyses.initial.rows import velocity_rows
from adamslite.assembly.scope import skew
from adamslite.integrators import contract
from adamslite.integrators.contract import ACCELERATIONS, JACOBIAN
from adamslite.model.model import PART

if TYPE_CHECKING:  # few runs need sparse matrices
    from scipy.sparse import csr_array

    from adamslite.equations.system import System

PHASES = contract.LOADS | contract.REACTIONS | contract.ROWS
RATES = contract.VELOCITY_ROWS | contract.RATE_ROWS
# What solving for accelerations and moving on change.
STATE = ("q", "u", "a", "z", "rd", "base", "W", "F", "report", "count")


class NoDerivative(Exception):
    """The equations have a derivative that is not a number."""


@dataclass(frozen=True)
class Instant:
    """One state and the derivatives of the equations in ground axes.

    Parameters
    ----------
    q, u, a : (n,) arrays
        Places of mass centres (entries of rotations mean nothing), velocities, accelerations.
    attitude : (nb, 3, 3) array
    by_place, by_velocity, by_acceleration, by_algebraic, by_rate : sparse (nz, nz) matrices
        Of all equations, by the unknowns as (q, s), u, a, (lam, V) and s'.
    gradient, drift : (m, n) and sparse (m, nz) matrices
        Of the velocity conditions, holonomic ones first, by u and by (q, s).
    """

    q: np.ndarray
    u: np.ndarray
    a: np.ndarray
    attitude: np.ndarray
    by_place: csr_array
    by_velocity: csr_array
    by_acceleration: csr_array
    by_algebraic: csr_array
    by_rate: csr_array
    gradient: np.ndarray
    drift: csr_array


def present(system: System) -> Instant:
    """The state that ``system`` holds, with its accelerations and multipliers.

    Raises
    ------
    NoDerivative
        When the equations have no linear part there.
    """
    system.run(ACCELERATIONS)
    return _instant(system)


def neighbours(
    system: System, h: float, at_rest: bool = False
) -> tuple[Instant, Instant, Instant] | None:
    """The instants h before, now and h after, evaluated alike so that their round-off is; in the
    same place when ``at_rest``.  None where accelerations are not determined.
    """
    kept = {name: getattr(system, name).copy() for name in STATE}
    time, attitude = float(system.settings.t), _attitudes(system)
    jerk, curve = np.zeros_like(system.a), np.zeros_like(system.rd)
    start = {**kept, "a": np.zeros_like(system.a)} if at_rest else kept
    try:
        for _correction in range(2):
            found: list[tuple[np.ndarray, np.ndarray, Instant]] = []
            for step in (-h, 0.0, h):
                _advance(system, start, attitude, step, jerk, curve)
                system.settings.t = time + step
                if system.run(ACCELERATIONS) != contract.DONE:
                    return None
                found.append((system.a.copy(), system.rd.copy(), _instant(system)))
            (a0, rd0, before), (_, _, now), (a1, rd1, after) = found
            if not at_rest:
                jerk, curve = (a1 - a0) / (2.0 * h), (rd1 - rd0) / (2.0 * h)
    finally:
        system.settings.t = time
        for name, values in kept.items():
            getattr(system, name)[:] = values
    return before, now, after


def _advance(
    system: System,
    start: dict[str, np.ndarray],
    attitude: np.ndarray,
    h: float,
    jerk: np.ndarray,
    curve: np.ndarray,
) -> None:
    """Put the state at t + h into ``system``; attitudes are counted from the new ones."""
    u, a, first = start["u"], start["a"], system.m + system.nv
    moved = h * u + 0.5 * h * h * a
    system.q[:] = start["q"] + moved
    system.u[:] = u + h * a + 0.5 * h * h * jerk
    system.z[first : first + system.ns] = (
        start["z"][first:] + h * start["rd"] + 0.5 * h * h * curve
    )[: system.ns]
    for b, body in enumerate(system.model.bodies):
        if body.width == PART:
            i = system.starts[b] + 3
            turned = _rotation(moved[i : i + 3]) @ attitude[b]
            system.q[i : i + 3], system.base[9 * b : 9 * b + 9] = 0.0, turned.ravel()


def _rotation(vector: np.ndarray) -> np.ndarray:
    """exp [v] (3, 3)."""
    angle, turn = float(np.linalg.norm(vector)), skew(vector)
    half = 0.5 * np.sinc(0.5 * angle / np.pi) ** 2
    return np.eye(3) + np.sinc(angle / np.pi) * turn + half * turn @ turn


def _attitudes(system: System) -> np.ndarray:
    """(nb, 3, 3) of the workspace's state; those of a point mass mean nothing."""
    found = np.tile(np.eye(3), (len(system.model.bodies), 1, 1))
    for b, body in enumerate(system.model.bodies):
        if body.width == PART:
            at = system.w_at["BODY", b] + 15
            found[b] = system.W[at : at + 9].reshape(3, 3)
    return found


def _instant(system: System) -> Instant:
    """The workspace's state and its derivatives."""
    n = system.n
    attitude = _attitudes(system)
    places, velocities, accelerations, algebraic, rates = (
        _matrix(system, kind, PHASES) for kind in range(5)
    )
    rows = velocity_rows(system)
    drift, gradient = (_matrix(system, kind, RATES)[rows] for kind in range(2))
    return Instant(
        q=system.q[:n].copy(), u=system.u[:n].copy(), a=system.a[:n].copy(), attitude=attitude,
        by_place=places, by_velocity=velocities, by_acceleration=accelerations,
        by_algebraic=algebraic, by_rate=rates, gradient=gradient[:, :n].toarray(), drift=drift,
    )  # fmt: skip


def _matrix(system: System, kind: int, phases: int) -> csr_array:
    """Derivative of the equations of ``phases``: kind 0 by q and s, 1 u, 2 a, 3 lam and V, 4 s'."""
    system.coef[:5] = 0.0
    system.coef[kind] = 1.0
    system.run(JACOBIAN, phases)
    found = system.sparse_jacobian()
    if not np.isfinite(found.data).all():
        raise NoDerivative
    return found
