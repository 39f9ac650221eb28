"""How the arrays of a model hang on numbers of its deck.

Kernels are refilled and the start is assembled again at four values beside the present one,

    f' = (8 (f(p+d) - f(p-d)) - (f(p+2d) - f(p-2d)))/(12 d),    d = SHARE |p|,

exact for polynomials up to the fourth degree.  Arrays are products, powers and rotations of numbers
of the deck: what is left out is some 1e-13 of them, and so is round-off.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np

from adamslite.equations.engine import ints
from adamslite.integrators import contract
from adamslite.model.model import PART
from adamslite.native.translate import Rows
from adamslite.sensitivity import contract as records

if TYPE_CHECKING:
    from adamslite.equations.system import System

# Distance of the values from the present one, as a share of it, or as it is where that is zero.
SHARE = 1e-3
STENCIL = (-2, -1, 1, 2)


@dataclass
class Snapshot:
    """The arrays of a model about to run.

    ``names``: of the shapes of its kernels; ``tables``: of each group; ``reals``: those of each
    group; ``places`` (nb, 3), ``attitudes`` (nb, 3, 3), velocities ``u`` (n,) and states ``s``
    (ns,).
    """

    names: list[str]
    tables: list[bytes]
    reals: list[np.ndarray]
    mass: np.ndarray
    inertia: np.ndarray
    gravity: np.ndarray
    places: np.ndarray
    attitudes: np.ndarray
    u: np.ndarray
    s: np.ndarray

    @classmethod
    def of(cls, system: System) -> Snapshot:
        """The present arrays."""
        system.run(contract.RESIDUAL, 0)
        bodies = system.model.bodies
        at = [system.w_at["BODY", b] for b in range(len(bodies))]
        turned = [
            system.W[o + 15 : o + 24].reshape(3, 3) if body.width == PART else np.eye(3)
            for o, body in zip(at, bodies, strict=True)
        ]
        first = system.m + system.nv
        return cls(
            [group.name for group in system.kernels.groups],
            [b"".join(map(_in_bytes, group.instances.columns.tables))
             for group in system.kernels.groups],
            [each.copy() for each in system.instances.keep[1::2]],
            system.mass.copy(), system.inertia.copy(), system.gravity.copy(),
            np.array([system.W[o : o + 3] for o in at]).reshape(-1, 3),
            np.array(turned).reshape(-1, 3, 3), system.u[: system.n].copy(),
            system.z[first : first + system.ns].copy(),
        )  # fmt: skip


Piece: TypeAlias = tuple[int, int, int, np.ndarray]
"""A group of kernels, the first instance, how many, derivatives of their reals."""


@dataclass
class Direction:
    """Derivatives of a model's arrays by one number.

    ``start``: of places and turns (n,), velocities (n,) and states (ns,) at the start; ``size``:
    how large the number is.
    """

    mass: np.ndarray
    inertia: np.ndarray
    gravity: np.ndarray
    start: np.ndarray
    size: float
    pieces: list[Piece] = field(default_factory=list)

    def moves(self, system: System) -> bool:
        """Whether an equation hangs on the number, or the start; else what is written, at most."""
        arrays = (self.mass, self.inertia, self.gravity, self.start)
        faces = {system.kernels.groups[k].face for k, *_ in self.pieces}
        return bool(faces - {"output"}) or any(each.any() for each in arrays)


def direction(system: System, base: Snapshot, around: dict[int, Snapshot], h: float) -> Direction:
    """The derivatives by a number, from snapshots at multiples of ``h`` beside its value."""

    def slope(name: str) -> np.ndarray:
        return slope_around({k: getattr(each, name) for k, each in around.items()}, h)

    turned = turns(slope("attitudes") @ base.attitudes.transpose(0, 2, 1))
    places, start = slope("places"), np.zeros(2 * system.n + system.ns)
    for b, body in enumerate(system.model.bodies):
        i = system.starts[b]
        start[i : i + 3] = places[b]
        if body.width == PART:
            start[i + 3 : i + 6] = turned[b]
    start[system.n : 2 * system.n], start[2 * system.n :] = slope("u"), slope("s")
    found = Direction(slope("mass"), slope("inertia"), slope("gravity"), start, h / SHARE)
    found.pieces = [*_pieces(system, base, around, h)]
    return found


def _in_bytes(tables: Iterable[Any]) -> bytes:
    return b"".join(each.data.tobytes() for each in tables)


def slope_around(around: dict[int, Any], h: float) -> Any:
    """The derivative; what does not change has none."""
    return (8.0 * (around[1] - around[-1]) - (around[2] - around[-2])) / (12.0 * h)


def turns(rates: np.ndarray) -> np.ndarray:
    """The vectors (..., 3) of small rotations dR R^T (..., 3, 3), in ground axes."""
    pairs = ((2, 1), (0, 2), (1, 0))
    return 0.5 * np.stack([rates[..., i, j] - rates[..., j, i] for i, j in pairs], axis=-1)


def _pieces(
    system: System, base: Snapshot, around: dict[int, Snapshot], h: float
) -> Iterator[Piece]:
    for k, group in enumerate(system.kernels.groups):
        given = [each.reals[k] for each in around.values()]
        if all(each.tobytes() == base.reals[k].tobytes() for each in given):
            continue
        with np.errstate(invalid="ignore"):
            rates = slope_around({n: each.reals[k] for n, each in around.items()}, h)
        rows = np.where(np.isfinite(rates), rates, 0.0)[:-1].reshape(len(group.instances), -1)
        params = len(group.instances.columns.params)
        rows[:, params : params + group.meta["angles"] + group.meta["limits"]] = 0.0  # memories
        touched = np.flatnonzero(rows.any(axis=1))
        if not touched.size:
            continue
        whole = group.face == "signal"
        first, last = (0, len(rows) - 1) if whole else (int(touched[0]), int(touched[-1]))
        yield k, first, last - first + 1, np.append(rows[first : last + 1].ravel(), 0.0)


class Collected:
    """Derivatives by several numbers as native code takes them."""

    def __init__(self, system: System, found: Iterable[Direction], group: Rows) -> None:
        found = [*found]
        T = self.record = records.Tangents.zeros()
        rows: list[int] = []
        self.keep = [each[3] for one in found for each in one.pieces]
        for one in found:
            for k, first, count, reals in one.pieces:
                rows += [k, first, count, reals.ctypes.data]
        ends = np.cumsum([0, *(len(one.pieces) for one in found)])
        faces = [each.face for each in system.kernels.groups]
        largest = max((each.size for each in system.instances.keep[1::2]), default=0)
        self.zeros = np.zeros(largest + 1)
        T.count, T.group = len(found), group
        T.piece, T.piece_at = Rows(records.Piece, ints(rows)), ints(ends)
        T.signals = ints([any(faces[k] == "signal" for k, *_ in one.pieces) for one in found])
        T.mass = _joined([one.mass for one in found])
        T.inertia = _joined([one.inertia for one in found])
        T.gravity = _joined([one.gravity for one in found])
        T.none, T.nothing, T.dW = (
            np.zeros(system.W.size), self.zeros.ctypes.data, np.zeros(system.W.size),
        )  # fmt: skip
        T.top, T.out = np.zeros(len(found) + 1), np.zeros(len(found) + 1)
        self.start = np.array([one.start for one in found]).reshape(len(found), -1)


def _joined(arrays: list[np.ndarray]) -> np.ndarray:
    return np.append(np.concatenate(arrays) if arrays else [], 0.0)


def tangent_groups(system: System) -> Rows:
    """Addresses of the tangents of all kernels, compiled where they are not there yet."""
    from adamslite.kernels.compile import tangents

    rows: list[int] = []
    for k, group in enumerate(system.kernels.groups):
        sizes = [system.instances.keep[2 * k].size, system.instances.keep[2 * k + 1].size - 1]
        count = max(len(group.instances), 1)
        rows += [*tangents(system.kernels, group), *(size // count for size in sizes)]
    return Rows(records.TangentGroup, ints(rows))
