"""Linearisation: eigenvalues, modes and state matrices about the present, moving or resting, state.

Small motions are those that an :class:`~adamslite.analyses.linearization.observer.Observer` sees;
how they follow from the equations of motion, constraints and all, says
:mod:`adamslite.analyses.linearization.first_order`.  For an observer to whom nothing of that
changes with time the eigenvalues are the exponents of small motions.  Otherwise they are those of
the coefficients of this instant, and the result says so.

Undamped frequencies come from the columns of y and p' alone.

A free motion drifts: its eigenvalue zero belongs to a chain A v2 = v1, A v1 = 0, and a general
eigenvalue routine splits it into two of size sqrt(round-off).  So the null space is taken out
first, over and over (the staircase of Kublanovskaya)

    Q^T A Q = [0, A12; 0, A22],    Q = [null space, rest]

until A22 is regular.  An eigenvector y of A22 is one of A with A12 y / s on the null space.
Reference: G. H. Golub, J. H. Wilkinson, SIAM Review 18 (1976) 578.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from adamslite.analyses.initial.conditions import consistent_velocities
from adamslite.analyses.linearization.first_order import Ports
from adamslite.analyses.linearization.observer import Observer
from adamslite.analyses.linearization.stationarity import Trajectory
from adamslite.elements.pinput import Pinput
from adamslite.elements.poutput import Poutput
from adamslite.errors import UsageError
from adamslite.model.model import PART
from adamslite.results.linearization import Linearization, SecondOrder
from adamslite.results.results import Linearized

if TYPE_CHECKING:
    from adamslite.analyses.linearization.first_order import FirstOrder
    from adamslite.elements.linear import Linear
    from adamslite.equations.system import System
    from adamslite.language.interfaces import Key

# Displacements that differ by less than this share are equally large: the first one counts.
ALIKE = 1e-6
NO_SECOND_ORDER = (
    "LINEAR/MKB cannot write this model as M y'' + B y' + K y: it has states that are no motions "
    "(DIFF, LSE, TFSISO, GSE, FRICTION, MOTION/ACCELERATION) or constraints of velocities. "
    "LINEAR/STATEMAT writes its matrices A, B, C, D."
)


def carried_out(command: Linear, system: System, time: float) -> Linearized:
    """What a LINEAR command finds at the state that ``system`` holds."""
    deck = system.model.deck
    given = None if command.pinput is None else deck.find(Pinput, command.pinput)
    seen = None if command.poutput is None else deck.find(Poutput, command.poutput)
    inputs, outputs = (port.variables if port else () for port in (given, seen))
    found = linear(system, inputs, outputs, not command.nodamping, command.rm)
    if command.kind == "MKB" and found.second_order is None:
        raise UsageError(NO_SECOND_ORDER)
    return Linearized(
        command.kind, command.file, time, found,
        form=command.format, shapes=command.shapes, energies=command.energies,
    )  # fmt: skip


def linear(
    system: System,
    inputs: tuple[Key, ...] = (),
    outputs: tuple[Key, ...] = (),
    damping: bool = True,
    relative_to: Key | None = None,
) -> Linearization:
    """Linearise ``system`` at the state it holds.

    Parameters
    ----------
    inputs, outputs : tuple of ids
        VARIABLEs, those of a PINPUT and of a POUTPUT.
    damping : bool
        Without it, what depends on velocities is left out.
    relative_to : id
        A MARKER: motions are those that an observer on its body sees, with its axes.
    """
    taken, seen = (
        tuple(system.starts[system.node_at["VARIABLE", key]] for key in keys)
        for keys in (inputs, outputs)
    )
    system.elimination.unfold()
    consistent_velocities(system)
    observer = Observer(system, relative_to)
    trajectory = Trajectory(system, Ports(taken, seen, damping))
    found, steady = trajectory.seen(observer)
    steady_for = "" if steady else trajectory.steady_observer(observer)
    nx = found.whole.shape[1] - len(inputs)
    a, b, c, d = (
        found.whole[rows, columns]
        for rows in (slice(0, nx), slice(nx, None))
        for columns in (slice(0, nx), slice(nx, None))
    )
    n, speeds = found.basis.positions[0], found.basis.speeds[0]
    f, g = speeds.shape
    values, vectors = eigen(a)
    order = np.lexsort((-values.imag, np.round(np.abs(values), 12)))
    moved, speed = found.q @ vectors[:f], found.q @ speeds @ vectors[f : f + g]
    modes = (n @ vectors[:f] * _factors(moved, speed))[:, order]
    modes[observer.own] = 0.0
    return Linearization(
        eigenvalues=values[order], undamped=_undamped(found.minus_stiffness), modes=modes,
        state_matrix=a, coordinates=_names(system), input_matrix=b, output_matrix=c, feedthrough=d,
        inputs=tuple(f"VARIABLE/{key}" for key in inputs),
        outputs=tuple(f"VARIABLE/{key}" for key in outputs),
        kinetic=_kinetic_shares(system, found.instant.attitude, speed)[:, order],
        bodies=tuple(body.statement.label for body in system.model.bodies),
        second_order=_second_order(found, b), steady=steady, steady_for=steady_for,
    )  # fmt: skip


def _second_order(found: FirstOrder, inputs: np.ndarray) -> SecondOrder | None:
    """M, and B, K, F from p' = -M^-1 (B p + K y - F w); None where x is more than (y, p)."""
    f, g = found.basis.speeds[0].shape
    if f != g or found.held.shape[1] > f:
        return None
    moved = found.q @ found.basis.speeds[0]
    n = len(moved)
    mass = moved.T @ (found.instant.by_acceleration[:n, :n] @ moved)
    pushed = found.whole[f : 2 * f]
    return SecondOrder(
        mass, -mass @ pushed[:, f : 2 * f], -mass @ pushed[:, :f], mass @ inputs[f : 2 * f],
        found.basis.positions[0],
    )  # fmt: skip


def _kinetic_shares(system: System, attitude: np.ndarray, speed: np.ndarray) -> np.ndarray:
    """Shares (nb, nx) of bodies in m |v|^2 + w* R I R^T w, from speeds (n, nx) in ground axes and
    attitudes (nb, 3, 3).
    """
    energy = np.zeros((len(system.mass), speed.shape[1]))
    inertia = system.inertia.reshape(-1, 3, 3)
    for b, body in enumerate(system.model.bodies):
        i = system.starts[b]
        energy[b] = system.mass[b] * (np.abs(speed[i : i + 3]) ** 2).sum(axis=0)
        if body.width == PART:
            spin = attitude[b].T @ speed[i + 3 : i + 6]
            energy[b] += (spin.conj() * (inertia[b] @ spin)).sum(axis=0).real
    whole = energy.sum(axis=0)
    return energy / np.where(whole > 0.0, whole, 1.0)


def _factors(places: np.ndarray, speeds: np.ndarray) -> np.ndarray:
    """What to scale eigenvectors (nx,) with, given their motion in ground axes (n, nx): to unit
    size, their largest displacement real and positive.
    """
    size = np.sqrt((np.abs(places) ** 2 + np.abs(speeds) ** 2).sum(axis=0))
    factors = 1.0 / np.where(size > 0.0, size, 1.0) + 0j
    for k, column in enumerate(places.T):
        far = np.abs(column)
        if far.any():
            largest = column[np.flatnonzero(far > (1.0 - ALIKE) * far.max())[0]]
            factors[k] *= largest.conjugate() / abs(largest)
    return factors


def _undamped(minus_stiffness: np.ndarray) -> np.ndarray:
    """Signed roots of the eigenvalues of M^-1 K, smallest first."""
    squares = np.sort(np.linalg.eigvals(-minus_stiffness).real)
    return np.sign(squares) * np.sqrt(np.abs(squares))


def _names(system: System) -> tuple[str, ...]:
    words = ("x", "y", "z", "rx", "ry", "rz")
    return tuple(
        f"{body.statement.label}.{word}"
        for body in system.model.bodies
        for word in words[: body.width]
    )


# Singular values below this share of the largest are round-off of the entries.
ROUND_OFF = 32.0 * np.finfo(float).eps


def eigen(a: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Eigenvalues (nx,) and vectors (nx, nx) of ``a``.

    Of a chain every vector is the free motion that it ends in.
    """
    values, vectors = _eigen(a, balance(a))
    size = np.linalg.norm(vectors, axis=0)
    return values, vectors / np.where(size > 0.0, size, 1.0)


def balance(a: np.ndarray) -> np.ndarray:
    """Powers of two d (nx,) for which diag(1/d) A diag(d) has rows and columns of one size."""
    from scipy.linalg import matrix_balance

    if not len(a):
        return np.ones(0)
    # scipy also makes integers of the scales, for a permutation that is not asked for.
    with np.errstate(invalid="ignore"):
        return matrix_balance(a, permute=False, separate=True)[1][0]


def _eigen(a: np.ndarray, scale: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    values, vectors = _staircase(a * scale / scale[:, None])
    return values, scale[:, None] * vectors


def _staircase(a: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    if _is_regular(a):
        return np.linalg.eig(a)
    _, size, vt = np.linalg.svd(a)
    free = int((size <= ROUND_OFF * size[0]).sum())
    if free == 0:
        return np.linalg.eig(a)
    if free == len(a):
        return np.zeros(free, complex), np.eye(free, dtype=complex)
    kernel, rest = vt[len(a) - free :].T, vt[: len(a) - free].T
    values, within = _staircase(rest.T @ a @ rest)
    down = kernel.T @ a @ rest @ within
    chained = values == 0.0
    on_kernel = np.where(chained, down, down / np.where(chained, 1.0, values))
    vectors = kernel @ on_kernel + np.where(chained, 0.0, rest @ within)
    return (
        np.concatenate([np.zeros(free, complex), values]),
        np.hstack([kernel.astype(complex), vectors]),
    )


def _is_regular(a: np.ndarray) -> bool:
    """Whether an estimate of the condition shows, for little, that no singular value vanishes."""
    from scipy.linalg import get_lapack_funcs

    if not len(a):
        return True
    getrf, gecon = get_lapack_funcs(("getrf", "gecon"), (a,))
    factors, _, singular = getrf(a)
    if singular:
        return False
    share, _ = gecon(factors, np.abs(a).sum(axis=0).max())
    return bool(share > len(a) * ROUND_OFF)
