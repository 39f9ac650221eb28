"""A shape: what its instances share, and what is evaluated for each."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

from adamslite.symbolic.graph import node
from adamslite.symbolic.guards import Guards
from adamslite.symbolic.scope import Load, Scope, Slot
from adamslite.symbolic.types import Expr


@dataclass
class Shape:
    """The structure shared by all instances of a shape.

    ``slots``: markers.  ``widths``: unknowns of each node, bodies first (3 point, 6 part), then
    scalar nodes.  ``n_bodies``: how many nodes are bodies.  ``n_params``, ``n_angles``,
    ``n_limits``, ``n_signals``, ``n_tables``: counts.  ``outputs``: writes loads and rows with a
    scope.  ``guards``: found when they are written.
    """

    slots: list[Slot]
    widths: list[int]
    n_bodies: int
    n_params: int
    n_angles: int
    n_limits: int
    n_signals: int
    n_tables: int
    outputs: Callable[[Scope], Outputs]
    guards: Guards = field(default_factory=Guards)

    def marker_reals(self) -> list[int]:
        """First real of each marker."""
        first, at = [], self.n_params + self.n_angles + self.n_limits
        for slot in self.slots:
            first.append(at)
            at += 3 * slot.offset + 9 * slot.turned
        return [*first, at]

    @property
    def n_reals(self) -> int:
        return self.marker_reals()[-1]

    def row_at(self, node: int) -> int:
        """The integer that holds the row of a node."""
        return len(self.widths) + self.n_signals + node

    @property
    def tables_at(self) -> int:
        """The integer that holds the address of the first table."""
        return 2 * len(self.widths) + self.n_signals

    @property
    def branches_at(self) -> int:
        """The integer that holds where the branches of the clock begin; the next two: of the watch,
        the zones.
        """
        return self.tables_at + self.n_tables

    @property
    def blocks_at(self) -> int:
        return self.branches_at + 3 * bool(self.guards)


@dataclass
class Outputs:
    """Loads on bodies and scalar rows (node, component, expression) of one shape.

    ``rates_only``: only derivatives with respect to accelerations and multipliers are needed, as
    from the second derivative of a constraint; the others would be most of the code.
    """

    loads: list[Load] = field(default_factory=list)
    rows: list[tuple[int, int, Expr]] = field(default_factory=list)
    rates_only: bool = False

    @property
    def expressions(self) -> list[Expr]:
        """Everything that is evaluated."""
        loads = [e for load in self.loads for e in (*load.force, *load.torque)]
        return [node(e) for e in (*loads, *(row[2] for row in self.rows))]
