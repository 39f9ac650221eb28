"""The base of all constraint statements.

Equation::

    g(q, t) = 0           n_rows rows, or g(u, q, t) = 0 when is_rate
    force on the model    -G^T lam

Sign: the reaction is what acts **on I**, torque about I's origin; J gets the opposite force::

    reaction on I  <---- I o = = = o J ---->  opposite
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import TYPE_CHECKING

from adamslite.language.expression import COMPONENTS, Ref, measure
from adamslite.language.statement import Statement

if TYPE_CHECKING:
    from adamslite.language.expression import Node
    from adamslite.language.interfaces import DrawnModel
    from adamslite.symbolic.scope import Scope
    from adamslite.symbolic.types import Expr, Seen

# What each kind of row keeps at zero, for messages.
TOGETHER = ("x of I - J", "y of I - J", "z of I - J")
ON_LINE = ("offset along x_J", "offset along y_J")
PARALLEL = ("rotation about y_J (z_I . x_J)", "rotation about x_J (z_I . y_J)")
SAME_TURN = ("rotation about z_J (x_I . y_J)",)


class Constraint(Statement, ABC):
    """Statements with rows that vanish."""

    @abstractmethod
    def constraints(self: Seen, scope: Scope) -> list[Expr]:
        """The rows, of I and J as ``scope`` has them."""

    @property
    def n_rows(self) -> int:
        """Constraint equations."""
        return 1

    def is_rate(self, model: DrawnModel) -> bool:
        """Whether the rows constrain velocities only."""
        return False

    @property
    def counts_from_start(self) -> bool:
        """Whether the rows hold a change since the start: any posture will do to start from."""
        return False

    @property
    def row_names(self) -> tuple[str, ...]:
        """What each row keeps at zero."""
        return tuple(f"condition {n + 1}" for n in range(self.n_rows))

    @property
    def result_names(self) -> tuple[str, ...]:
        """Reaction on I, ground axes, torque about I's origin."""
        return ("fx", "fy", "fz", "tx", "ty", "tz")

    def outputs(self, model: DrawnModel) -> list[Node]:
        """Values of ``result_names``."""
        own = Ref(self.keyword, self.key)
        return [measure(self.keyword, own, component) for component in COMPONENTS]
