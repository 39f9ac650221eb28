"""Instances of the kernels: the integers and reals that each reads, the blocks that it writes."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from itertools import chain, repeat
from math import inf
from typing import TYPE_CHECKING, Any

import numpy as np

from adamslite.elements.bases.constraint import Constraint
from adamslite.equations.engine import ints
from adamslite.integrators import contract
from adamslite.integrators.contract import KernelGroup
from adamslite.language.interfaces import Key
from adamslite.native.translate import Rows
from adamslite.native.translate.records import address_of

if TYPE_CHECKING:
    from adamslite.equations.layout import JacobianBlocks, Layout
    from adamslite.equations.numbering import Numbering
    from adamslite.kernels.groups import ShapeGroup
    from adamslite.language.statement import Statement
    from adamslite.model.model import MassCentre, NodeKey

PHASES = {
    "loads": contract.LOADS,
    "reactions": contract.REACTIONS,
    "position": contract.POSITION_ROWS,
    "velocity": contract.VELOCITY_ROWS,
    "acceleration": contract.ACCELERATION_ROWS,
    "equation": contract.ROWS,
    "signal": contract.SIGNALS,
    "output": contract.OUTPUTS,
    "stored": contract.STORED_ENERGY,
    "sensor": 0,
    "counted": 0,
    "since start": 0,
}


Measured = tuple[Any, ...]
"""A measure of an angle and its markers."""

Owner = tuple[str, str, Key]
"""Name of a kernel, keyword and id of the statement that it belongs to."""


class Instances:
    """Kernels bound to the numbered unknowns.

    ``groups``: the rows that native code goes through; ``outputs``: where the values of each
    statement stand among all ``n_out`` that are written.
    """

    def __init__(self, numbering: Numbering, layout: Layout) -> None:
        self.numbering, self.layout = numbering, layout
        self.blocks: JacobianBlocks = layout.blocks
        self.kernels, self.model = numbering.kernels, numbering.model
        self.keep: list[np.ndarray] = []
        self.outputs: dict[Statement, int] = {}
        self.n_out = 0
        own = np.arange(len(self.model.bodies))
        self.blocks.offsets_of(own, own)
        self.starts = ints(numbering.starts)
        self.body_w = ints([numbering.w_at["BODY", b] for b in own.tolist()])
        for statement, names in self.kernels.outputs:
            self.outputs[statement] = self.n_out
            self.n_out += len(names)
        rows = [self._group(k, group) for k, group in enumerate(self.kernels.groups)]
        self.groups = Rows(KernelGroup, ints([*chain.from_iterable(rows)]))

    def _is_rate(self, group: ShapeGroup) -> bool:
        first = group.instances.statements[0]
        return isinstance(first, Constraint) and first.is_rate(self.model)

    def _group(self, k: int, group: ShapeGroup) -> list[int]:
        phase = PHASES[group.face]
        if group.face == "velocity" and self._is_rate(group):
            phase = contract.RATE_ROWS
        if group.face == "loads" and hasattr(group.instances.statements[0], "stored"):
            phase |= contract.ELASTIC
        if group.face == "loads" and group.meta["mass"] and group.meta["added_mass"]:
            phase |= contract.ADDED_MASS
        integers, reals = self._known_integers(k, group), self._reals(group)
        self.keep += [integers, reals]
        at = self.kernels.addresses
        kinds = ("residual", "jacobian", "track", "clock", "watch")
        entry = [at.get(f"{group.name}_{kind}", 0) for kind in kinds]
        data = [len(group.instances), address_of(integers), address_of(reals)]
        return [phase, *entry[:3], *data, *entry[3:]]

    def one_instance(self, groups: Rows[KernelGroup], k: int, instance: int) -> Rows[KernelGroup]:
        """The row of ``groups`` of group ``k``, with one of its instances only."""
        row = Rows(KernelGroup, 1)
        one, count = row[0], groups[k].count
        one[:] = groups[k]
        of_ints, of_reals = self.keep[2 * k].size, self.keep[2 * k + 1].size - 1
        one.count = 1
        one.ints += 8 * instance * (of_ints // count)
        one.reals += 8 * instance * (of_reals // count)
        return row

    def memories(self) -> Iterator[tuple[Owner, np.ndarray]]:
        """Whose it is and what it remembers: angles, then times of leaving its law."""
        for group, reals in zip(self.kernels.groups, self.keep[1::2], strict=True):
            count = group.meta["angles"] + group.meta["limits"]
            if count:
                yield from _remembered(group, reals, 0, count)

    def times_of_leaving(self) -> Iterator[tuple[Owner, np.ndarray]]:
        """Whose they are, and times of leaving its law."""
        for group, reals in zip(self.kernels.groups, self.keep[1::2], strict=True):
            if group.meta["limits"]:
                yield from _remembered(group, reals, group.meta["angles"], group.meta["limits"])

    def counted(self) -> Iterator[tuple[Measured, np.ndarray]]:
        """Angles that are counted: what each is of, and where it is remembered."""
        for group, reals in zip(self.kernels.groups, self.keep[1::2], strict=True):
            at, rows = group.instances.columns, reals[:-1].reshape(len(group.instances), -1)
            for n, (kind, *slots) in group.meta["counted"]:
                markers = [at.markers[k] if k >= 0 else repeat(0) for k in slots]  # 0: global frame
                values = rows[:, len(at.params) + n :][:, :1]
                for row, *names in zip(values, *markers, strict=False):
                    yield (kind, *names), row

    def take_over(self, other: Instances) -> None:
        """Take over what another model remembers: angles belong to their markers, whichever
        expression they are part of, and times to their statements.
        """
        known = {of: float(row[0]) for of, row in other.counted()}
        for of, row in self.counted():
            row[:] = known.get(of, row)
        left = dict(other.times_of_leaving())
        for whose, times in self.times_of_leaving():
            times[:] = left.get(whose, times)

    def remember(self, known: Iterable[tuple[Owner, np.ndarray]]) -> None:
        """Take memories of the same model over."""
        found = dict(known)
        for whose, values in self.memories():
            values[:] = found.get(whose, values)

    def out_of_law(self) -> dict[str, str]:
        """Elements that were beyond what their law is meant for: how, and when first."""
        loads = {group.name for group in self.kernels.groups if group.face in ("loads", "position")}
        found = {}
        for (name, keyword, key), times in self.times_of_leaving():
            statement = self.model.element(keyword, key)
            time = min(times) if name in loads else inf
            if hasattr(statement, "beyond") and time < inf:
                found[statement.label] = f"{statement.beyond}, first at t = {time:.6g}"
        return found

    def _known_integers(self, k: int, group: ShapeGroup) -> np.ndarray:
        """The integers of group ``k``; addresses of tables belong to those who read them."""
        if group.instances.columns.tables:
            return self._integers(group)
        return self.layout.integers(k, lambda: self._integers(group))

    def _integers(self, group: ShapeGroup) -> np.ndarray:
        """What each instance of a group reads and writes, one instance behind the other: offsets
        in the workspace, first rows, addresses of tables, guards, blocks of the Jacobian.
        """
        count, at, w_at = len(group.instances), group.instances.columns, self.numbering.w_at
        bodies = [ints(column) for column in at.bodies]
        columns: list[np.ndarray] = [self.body_w[each] for each in bodies]
        columns += [ints([w_at.get(node, 0) for node in nodes]) for nodes in at.nodes]
        columns += [ints([w_at["SIGNAL", each] for each in signal]) for signal in at.signals]
        columns += [self.starts[each] for each in bodies]
        columns += [ints([self._row(group, node) for node in nodes]) for nodes in at.nodes]
        columns += [ints([each.data.ctypes.data for each in table]) for table in at.tables]
        guards = group.meta["guards"]
        if any(guards.values()):
            columns += [
                self.numbering.first_branch[place, group.name] + len(each) * np.arange(count)
                for place, each in guards.items()
            ]
        if group.meta["blocks"]:
            columns += self._blocks(group, bodies, at.nodes)
        return np.column_stack(columns).ravel() if columns else ints([])

    def _blocks(
        self, group: ShapeGroup, bodies: list[np.ndarray], others: list[Sequence[NodeKey]]
    ) -> list[np.ndarray]:
        """Where the blocks that each instance writes begin."""
        node_at = self.numbering.node_at
        rows = [*bodies, *(ints([self._row_node(group, k) for k in nodes]) for nodes in others)]
        columns = [*bodies, *(ints([node_at[k] for k in nodes]) for nodes in others)]
        pairs = group.meta["blocks"]
        of_rows = np.column_stack([rows[r] for r, _ in pairs])
        of_columns = np.column_stack([columns[c] for _, c in pairs])
        found = self.blocks.offsets_of(of_rows.ravel(), of_columns.ravel())
        return [*found.reshape(of_rows.shape).T]

    def _row_node(self, group: ShapeGroup, node: NodeKey) -> int:
        """Node whose rows an instance writes: velocity rows stand at mu."""
        if group.face == "velocity" and ("MU", node) in self.numbering.node_at:
            return self.numbering.node_at["MU", node]
        return self.numbering.node_at[node]

    def _row(self, group: ShapeGroup, node: NodeKey) -> int:
        if node[0] == "OUTPUT":
            return self.outputs[node[1]]
        if node[0] == "SIGNAL":
            return self.numbering.w_at[node]
        if node[0] in ("STORED", "SENSOR"):
            return 0  # all add up in one number, or are guards alone
        return self.numbering.starts[self._row_node(group, node)]

    def _reals(self, group: ShapeGroup) -> np.ndarray:
        """Parameters, what is remembered, and places of markers, one instance behind the other."""
        count, at = len(group.instances), group.instances.columns
        memory = [0.0] * group.meta["angles"] + [inf] * group.meta["limits"]
        columns: list[np.ndarray] = [np.asarray(column, dtype=float) for column in at.params]
        columns += [np.full(count, number) for number in memory]
        for markers in at.markers:
            if self._placed(markers[0]):
                columns += [*np.array([self._placed(each) for each in markers]).T]
        return np.append(np.column_stack(columns).ravel() if columns else [], 0.0)

    def _placed(self, marker: Key | MassCentre) -> list[float]:
        """Where a marker is on its body, and its axes, unless these are those of the body."""
        place = self.model.marker(marker)
        if place is None:
            return []
        offset = place.p.tolist() if place.offset else []
        return [*offset, *place.axes.ravel().tolist()] if place.turned else offset


def _remembered(
    group: ShapeGroup, reals: np.ndarray, first: int, count: int
) -> Iterator[tuple[Owner, np.ndarray]]:
    """Whose it is, and ``count`` of the numbers that each instance of a group remembers."""
    rows = reals[:-1].reshape(len(group.instances), -1)
    at = len(group.instances.columns.params) + first
    for statement, row in zip(group.instances.statements, rows, strict=False):
        yield (group.name, statement.keyword, statement.key), row[at : at + count]
