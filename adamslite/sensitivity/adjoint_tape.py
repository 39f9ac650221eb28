"""The tape of a run for those who go it back: its rows, coefficients of a step, rows that tie
velocities, and states in the workspace.
"""

from __future__ import annotations

import ctypes
from dataclasses import dataclass
from functools import cache, lru_cache
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from adamslite.equations.engine import address_of
from adamslite.errors import UsageError
from adamslite.integrators.audit_record import (
    AT_STEP,
    TAPE_HEAD,
    TAPE_KIND,
    TAPE_ORDER,
    TAPE_RESTARTS,
    TAPE_STEP,
    TAPE_TIME,
)
from adamslite.integrators.bdf.history import ROWS
from adamslite.integrators.contract import DONE, INDEX3, STABILISED
from adamslite.integrators.stepping.output import WITHIN
from adamslite.kernels.code.workspace import OMEGA
from adamslite.sensitivity.adjoint_weights import Weights
from adamslite.sensitivity.transposed import ENTRY, TRACK

if TYPE_CHECKING:
    from adamslite.equations.system import System

KIND = ctypes.CFUNCTYPE(
    ctypes.c_int64, ctypes.c_void_p, ctypes.c_void_p, ctypes.c_int64, ctypes.c_double
)
SINGULAR = "derivatives are not determined where the equations are singular"


@dataclass
class Row:
    """A row of the tape: what happens there.

    ``h_before``: the step for which differences are there, ``fresh``: the history begins anew;
    ``outputs``: output times within the step; ``memory``: what kernels remember before it.
    """

    is_step: bool
    t: float
    h: float
    order: int
    h_before: float
    fresh: bool
    outputs: range
    memory: tuple[np.ndarray, ...]


class Way(NamedTuple):
    """The way of weights of differences through a step: ybar = ``own`` . Dbar of what the corrector
    finds, and ``past`` Dbar + ``rate`` psibar + ``level`` y_pbar before it.
    """

    own: np.ndarray
    past: np.ndarray
    rate: np.ndarray
    level: np.ndarray


@cache
def gammas(k: int) -> np.ndarray:
    """gamma_0 .. gamma_k."""
    return np.concatenate([[0.0], np.cumsum(1.0 / np.arange(1, k + 1))])


@lru_cache(maxsize=4096)
def way_of(k: int, ratio: float) -> Way:
    g, back = gammas(k), np.eye(ROWS)
    for j in range(k + 1):
        back[j + 1] += back[j]
    own = back[k + 1] + back[k + 2]
    back[k + 1], back[k + 2] = -back[k + 2], 0.0
    change = resized(k, ratio).T
    back[: k + 1] = change @ back[: k + 1]
    return Way(own, back, change @ (g / g[k]), change.sum(axis=1))


def resized(k: int, ratio: float) -> np.ndarray:
    """R (k + 1, k + 1): differences on steps of ``ratio`` times the size are R D."""
    size = k + 1

    def factors(f: float) -> np.ndarray:
        r = np.zeros((size, size))
        r[0] = 1.0
        for i in range(1, size):
            r[i, 1:] = r[i - 1, 1:] * (i - 1 - f * np.arange(1, size)) / i
        return r

    return (factors(ratio) @ factors(1.0)).T


def vector_rates(c: np.ndarray, w: np.ndarray) -> np.ndarray:
    """c' = (I - [c]/2 + c c^T/4) w."""
    return w - 0.5 * np.cross(c, w) + 0.25 * c * np.einsum("bi,bi->b", c, w)[:, None]


class Ties:
    """G of the velocity rows, from the blocks of the matrix of a step."""

    def __init__(self, system: System) -> None:
        entries, self.nz = [], system.nz
        node_at, nodes = system.node_at, system.nodes
        for (row, column), at in system.blocks.offsets.items():
            if column < len(system.model.bodies) and ("MU", nodes[row]) in node_at:
                mu, wide = node_at["MU", nodes[row]], system.widths[column]
                entries += [
                    (system.starts[mu] + i, system.starts[column] + j, at + i * wide + j)
                    for i in range(system.widths[row])
                    for j in range(wide)
                ]
        self.rows, self.columns, self.places = np.array(entries, dtype=int).reshape(-1, 3).T

    def mu(self, J: np.ndarray, u: np.ndarray) -> np.ndarray:
        """G u at the places of mu (nz,)."""
        return np.bincount(self.rows, J[self.places] * u[self.columns], self.nz)


class Taken:
    """A taped run, row by row, and what native code does at its states.

    Attributes
    ----------
    rows : list of Row
        What happens along the tape.
    weights : Weights
        Carries weights of equations back.
    """

    def __init__(self, system: System) -> None:
        self.system = system
        self.weights = Weights(system)
        self.n, self.first, self.w = system.n, system.m + system.nv, 2 * system.n + system.ns
        self.held = bool(system.sizes.si2 and system.holonomic)
        self.phases = STABILISED if self.held else INDEX3
        self.ties = Ties(system) if self.held else None
        problem, plan = system.records()
        self.native, self.at = KIND(address_of(ENTRY)), (problem.address, plan.address)
        tape = system.tape
        self.tape = tape.data[: tape.rows * tape.width].reshape(tape.rows, tape.width)
        pairs = zip(system.kernels.groups, system.instances.keep[1::2], strict=True)
        self.memories = [
            (reals[:-1].reshape(len(each.instances), -1), len(each.instances.columns.params), count)
            for each, reals in pairs
            if (count := each.meta["angles"] + each.meta["limits"])
        ]
        self.phi, self.spin = self.weights.phi, self.weights.wphi + OMEGA
        weight = np.array(system.weight, dtype=float)
        self.weight = np.ones(system.n)
        self.weight[self.phi] = weight[self.weights.parts][:, None]
        self.rows = self._rows()

    def _rows(self) -> list[Row]:
        """What happens along the tape."""
        tape, times = self.tape, self.system.times
        started = int(np.searchsorted(times, tape[0, TAPE_TIME], "right"))
        found = [Row(False, float(tape[0, TAPE_TIME]), 0.0, 0, 0.0, False, range(started), ())]
        fresh, before = True, 0.0
        for k in range(1, len(tape)):
            t, h, order = (float(tape[k, at]) for at in (TAPE_TIME, TAPE_STEP, TAPE_ORDER))
            is_step, first = bool(tape[k, TAPE_KIND] == AT_STEP), found[-1].outputs.stop
            last = int(np.searchsorted(times, t + WITHIN * h, "right")) if is_step else first
            row = Row(is_step, t, h, int(order), h if fresh else before, fresh and is_step,
                      range(first, max(first, last)), self._memory())  # fmt: skip
            found.append(row)
            if is_step:
                fresh, before = False, h
                if self.memories:
                    self._put(k)
                    self._do(TRACK)
            elif k + 1 < len(tape):
                fresh = bool(tape[k - 1, TAPE_RESTARTS] != tape[k + 1, TAPE_RESTARTS])
        return found

    def _memory(self) -> tuple[np.ndarray, ...]:
        return tuple(reals[:, p : p + count].copy() for reals, p, count in self.memories)

    def _remember(self, memory: tuple[np.ndarray, ...]) -> None:
        for (reals, p, count), values in zip(self.memories, memory, strict=True):
            reals[:, p : p + count] = values

    def _workspace(self, k: int) -> np.ndarray:
        return self.tape[k, TAPE_HEAD : TAPE_HEAD + self.system.W.size]

    def _put(self, k: int) -> None:
        """The workspace of a row; of the first one with the branches of the second."""
        self.system.W[:] = self._workspace(k)
        if k == 0:
            nw = self.system.nw
            self.system.W[nw:] = self._workspace(1)[nw:] if len(self.tape) > 1 else 0.0

    def _do(self, task: int, cu: float = 0.0) -> None:
        if self.native(*self.at, task, cu) != DONE:
            raise UsageError(SINGULAR)
