"""Blocks of the Newton matrix: derived products, the order of elimination, redundant rows."""

from __future__ import annotations

import numpy as np

from adamslite.compiled import Kernels
from adamslite.engine import ints
from adamslite.instances import Instances
from adamslite.model import PART
from adamslite.ordering import analyse
from adamslite.topology import prerequisites


class Elimination(Instances):
    """Where every block of the Jacobian stands in the factors."""

    def __init__(self, kernels: Kernels, stabilised: bool, pivoting: bool) -> None:
        super().__init__(kernels, stabilised)
        self.pivoting = pivoting
        self._elimination()

    def drop(self, rows: list[int]) -> None:
        """Leave out redundant constraint rows (counted from the first multiplier): lam = mu = 0."""
        self.dropped = rows
        self.z[rows] = 0.0
        dead = [self.n + r for r in rows]
        if self.stabilised:
            dead += [self.nz - self.holonomic + r for r in rows if r < self.holonomic]
        self.dead = ints(dead)
        cut: list[int] = []
        for (row, column), (at, lead) in self.places.items():
            inside = range(self.widths[row]), range(self.widths[column])
            r0, c0 = self.starts[row], self.starts[column]
            for d in dead:
                if d - r0 in inside[0]:
                    cut += [at + (d - r0) * lead + c for c in inside[1]]
                if d - c0 in inside[1]:
                    cut += [at + r * lead + d - c0 for r in inside[0]]
        self.cut = ints(cut)
        self.ones = ints([self._diagonal(d) for d in dead])

    def _diagonal(self, unknown: int) -> int:
        """Place of a diagonal entry in the factor arrays."""
        node = max(k for k, start in enumerate(self.starts) if start <= unknown)
        at, lead = self.places[node, node]
        return at + (unknown - self.starts[node]) * (lead + 1)

    def _elimination(self) -> None:
        """Derived blocks, the elimination plan and where blocks are copied to."""
        self.mixed = ints(self._mixed_products() if self.stabilised else [])
        self.turning = ints(self._turning_blocks())
        mu = {k for k, node in enumerate(self.nodes) if node[0] == "MU"}
        late = self._late_nodes()
        for k in mu:
            late[k] = {self.node_at[self.nodes[k][1]]}
        pairs = set(self.blocks) | {(k, k) for k in range(len(self.nodes))}
        found = analyse(self.widths, self.starts, pairs, late, self.pivoting)
        self.plan, self.places = found.plan, found.places
        copies = []
        for (row, column), offset in self.blocks.items():
            copies += [offset, self.widths[row], self.widths[column], *found.places[row, column]]
        self.copies = ints(copies)
        self.product = ints(
            [
                value
                for (row, column), offset in self.blocks.items()
                if max(row, column) < len(self.model.bodies)
                for value in (
                    offset,
                    self.widths[row],
                    self.widths[column],
                    self.starts[row],
                    self.starts[column],
                )  # fmt: skip
            ]
        )
        self.unit = ints(
            [
                found.places[k, k][0] + c * (found.places[k, k][1] + 1)
                for k in sorted(mu)
                for c in range(self.widths[k])
            ]
        )
        self.J, self.D = np.zeros(self.size_j + 1), np.zeros(self.size_j + 1)
        self.LV, self.LA = np.zeros(found.size + 1), np.zeros(found.size + 1)
        self.pivots, self.pivots_a = ints([0] * (self.nz + 1)), ints([0] * (self.nz + 1))
        self.work = np.zeros(max(80, found.widest**2))

    def _late_nodes(self) -> dict[int, set[int]]:
        """For each constraint's node, what must be eliminated before it."""
        held: dict[int, set[int]] = {}
        for row, column in self.blocks:
            if self._is_multiplier(row) and self.nodes[column][0] == "BODY":
                held.setdefault(row, set()).add(column)
        constraints = [(k, frozenset(b), self.widths[k]) for k, b in sorted(held.items())]
        return prerequisites(constraints, self.widths[: len(self.model.bodies)])

    def _is_multiplier(self, node: int) -> bool:
        return self.nodes[node] in self.model.held

    def _mixed_products(self) -> list[int]:
        """Columns of mu: D[row, body] W G[constraint, body]^T for every block of D."""
        touched: dict[int, list[int]] = {}
        for row, column in self.blocks:
            if self._is_multiplier(row) and ("MU", self.nodes[row]) in self.node_at:
                if self.nodes[column][0] == "BODY":
                    touched.setdefault(column, []).append(row)
        products = []
        for (row, body), offset in list(self.blocks.items()):
            if self.nodes[body][0] != "BODY":
                continue
            for constraint in touched.get(body, ()):
                mu = self.node_at["MU", self.nodes[constraint]]
                target, gradient = self.block(row, mu), self.blocks[constraint, body]
                products += [target, self.widths[mu], offset, self.widths[row]]
                products += [self.widths[body], gradient, body]
        return products

    def _turning_blocks(self) -> list[int]:
        found = []
        for (row, column), offset in self.blocks.items():
            if self.nodes[column][0] == "BODY" and self.widths[column] == PART:
                found += [offset, self.widths[row], column]
        return found
