"""The numbering of unknowns: nodes of the elimination, first unknowns, offsets in the workspace."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, cast

import numpy as np

from adamslite.elements.variable import Variable
from adamslite.equations.engine import ints
from adamslite.integrators.contract import STATE_SIZE
from adamslite.kernels.code.workspace import HEAD, PART_SIZE, POINT_SIZE
from adamslite.model.model import PART
from adamslite.symbolic.guards import CLOSED, TABLE, TABLES
from adamslite.symbolic.interpolant import reach, reach_size

if TYPE_CHECKING:
    from adamslite.elements.sensor import Sensor
    from adamslite.kernels.groups import Binding, Kernels
    from adamslite.language.statement import Statement
    from adamslite.model.model import NodeKey
    from adamslite.symbolic.interpolant import Interpolant

# Share of the range of a table of the state that may be passed unseen, over ERROR^(2/3).
TABLE_SHARE = 0.01


class Numbering:
    """The unknowns of a model in one formulation.

    ``nodes``, ``widths``, ``starts``: what is eliminated together, how many unknowns it has and
    its first one; ``node_at``: its number.  ``w_at``: where it begins in the workspace.
    """

    def __init__(self, kernels: Kernels, stabilised: bool) -> None:
        self.kernels = kernels
        self.model = kernels.model
        self.stabilised = stabilised
        self._number()

    def _number(self) -> None:
        """Nodes, first unknowns and workspace offsets."""
        model = self.model
        self.nodes: list[NodeKey] = [("BODY", b) for b in range(len(model.bodies))]
        self.widths = [body.width for body in model.bodies]
        self.n = sum(self.widths)
        constraints = [(c.keyword, c.key) for c in model.constraints]
        loops = [v for v in model.deck.of(Variable) if model.variable_kind(v.key) == "loop"]
        states = model.deck.of("DIFF")
        scalars = constraints + [("VARIABLE", v.key) for v in loops]
        scalars += [("DIFF", d.key) for d in states]
        self.nodes += scalars
        self.widths += [model.node_width(node) for node in scalars]
        self.m = sum(c.n_rows for c in model.constraints)
        self.nv, self.ns = len(loops), len(states)
        self.holonomic = sum(c.n_rows for c in model.constraints if not c.is_rate(model))
        if self.stabilised:
            with_mu = [c for c in model.constraints if not c.is_rate(model)]
            self.nodes += [("MU", (c.keyword, c.key)) for c in with_mu]
            self.widths += [c.n_rows for c in with_mu]
        self.starts = np.concatenate([[0], np.cumsum(self.widths)]).astype(int)[:-1].tolist()
        self.nz = sum(self.widths)
        self.node_at = {node: k for k, node in enumerate(self.nodes)}
        self._workspace(scalars)

    def _workspace(self, scalars: list[NodeKey]) -> None:
        model = self.model
        at = HEAD
        self.w_at: dict[NodeKey, int] = {}
        for variable in model.deck.of(Variable):
            if model.variable_kind(variable.key) == "signal":
                self.w_at["SIGNAL", variable.key] = at
                at += 3
        self.n_head = at
        for b, body in enumerate(model.bodies):
            self.w_at["BODY", b] = at
            at += PART_SIZE if body.width == PART else POINT_SIZE
        offsets: list[int] = []
        for node in scalars:
            self.w_at[node] = at
            width = model.node_width(node)
            offsets += range(at, at + width)
            at += STATE_SIZE if node[0] == "DIFF" else width
        self.nw = at
        self.scalar = ints(offsets)
        self._branches()

    def _branches(self) -> None:
        """Guards and zones of all instances; branches stand behind the workspace."""
        self.guarded: dict[str, list[tuple[Statement, int]]] = {
            "clock": [],
            "watch": [],
            "zone": [],
        }
        self.first_branch: dict[tuple[str, str], int] = {}
        self.reaches: dict[tuple[Interpolant, int, bool], int] = {}
        self.reach_size = 0
        at = self.nw
        for place, found in self.guarded.items():
            for group in self.kernels.groups:
                self.first_branch[place, group.name] = at + len(found)
                kinds = group.meta["guards"][place]
                for statement, binding in group.instances if kinds else ():
                    found += [(statement, self._kind(kind, binding)) for kind in kinds]
            at += len(found)
        self.unchanging: list[Sensor] = []
        self.sensors = list(self._sensors())
        self.reach, self._reach_for = np.zeros(self.reach_size), -1.0
        self.kind = ints([kind for found in self.guarded.values() for _, kind in found])

    def _kind(self, kind: int, binding: Binding) -> int:
        """How a guard is read; of an argument of a table -1 - k, where its reach begins at k."""
        if kind < TABLE:
            return kind
        table, closed = binding.tables[kind // TABLES], bool(kind & CLOSED)
        key = table, kind % CLOSED, closed
        if key not in self.reaches:
            self.reaches[key] = self.reach_size
            self.reach_size += reach_size(table, closed)
        return -1 - self.reaches[key]

    def limit_tables(self, error: float) -> None:
        """Let steps pass as many pieces of tables of the state as are one smooth curve at ERROR."""
        if self.reaches and error != self._reach_for:
            tight = TABLE_SHARE * error ** (2.0 / 3.0)
            self.reach = np.concatenate([reach(*key, tight) for key in self.reaches])
            self._reach_for = error

    def _sensors(self) -> Iterator[tuple[Sensor, int, int]]:
        """Sensors that act, with the offsets of the branches of their relations, which come before
        other guards in FUNCTION; those whose relations never change are set aside.
        """
        for group in self.kernels.groups:
            guards = group.meta["guards"]
            place = "watch" if guards["watch"] else "clock"
            for n, (each, _) in enumerate(group.instances if group.face == "sensor" else ()):
                sensor = cast("Sensor", each)
                first = self.first_branch[place, group.name] + n * len(guards[place])
                last = first + sensor.relation_count - 1
                if len(guards[place]) >= sensor.relation_count:
                    yield sensor, first, last
                else:
                    self.unchanging.append(sensor)
