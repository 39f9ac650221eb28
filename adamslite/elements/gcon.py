"""GCON: a constraint given by an expression.

Equation::

    FUNCTION = 0
    force on the model   -(d FUNCTION/dq)^T lam

The force acts between the markers i and j of the measures in FUNCTION: FX(i, j) and REQUEST/FORCE
include it, GCON(id, 0, comp) is what acts on the first of them, or on I where that is given.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from adamslite.elements.bases.constraint import Constraint
from adamslite.language.expression import Call, Ref, measure, walk
from adamslite.language.function import FUNCTIONS
from adamslite.language.statement import expression, reference, statement

if TYPE_CHECKING:
    from adamslite.language.expression import Node
    from adamslite.language.interfaces import DrawnModel, Key
    from adamslite.symbolic.scope import Scope
    from adamslite.symbolic.types import Expr, Seen

# Measures of velocity: a GCON that uses one constrains velocities only.
RATES = frozenset(("VM", "VR", "VX", "VY", "VZ", "WM", "WX", "WY", "WZ"))


@statement("GCON")
class Gcon(Constraint):
    """Makes an expression in displacements (holonomic) or velocities (nonholonomic) vanish."""

    function: Node = expression(
        "FUNCTION", required=True, unit="the user's", help="the expression that is kept at zero"
    )
    i: int | str | None = reference(
        "I", to="MARKER", help="marker of FUNCTION whose reaction GCON(id, 0, comp) is"
    )
    j: int | str | None = reference("J", to="MARKER", help="marker of FUNCTION it is relative to")
    rm: int | str | None = reference(
        "RM", to="MARKER", inert=True, help="axes of reactions; functions name their own"
    )

    @property
    def n_rows(self) -> int:
        """Constraint equations."""
        return 1

    @property
    def row_names(self) -> tuple[str, ...]:
        """What the row keeps at zero."""
        return ("FUNCTION",)

    def is_rate(self, model: DrawnModel) -> bool:
        """Whether FUNCTION measures velocities, itself or through variables."""
        return measures_rates(self.function, model)

    def pairs(self, model: DrawnModel) -> list[tuple[Key, Key]]:
        """Markers (i, j) of the measures in FUNCTION, both ways round; those of I and J first."""
        found = self.measured(lambda id: model.variable(id).function)
        wanted = self.i, self.j
        return sorted(found, key=lambda pair: tuple(map(_differs, pair, wanted)))

    def measured(self, variable: Callable[[Key], Node]) -> list[tuple[Key, Key]]:
        """Pairs of markers in the order of FUNCTION, itself and through variables."""
        found: dict[tuple[Key, Key], None] = {}
        pending, seen = [self.function], set()
        while pending:
            for node in walk(pending.pop()):
                if isinstance(node, Ref) and node.kind == "VARIABLE" and node.id not in seen:
                    seen.add(node.id)
                    pending.append(variable(node.id))
                if isinstance(node, Call):
                    ends = _ends(node)
                    if len(ends) == 2 and ends[0] != ends[1]:
                        found |= dict.fromkeys(((ends[0], ends[1]), (ends[1], ends[0])))
        return list(found)

    def sides(self, model: DrawnModel) -> list[tuple[Key, Key | None]]:
        """What the function GCON measures by its jflag: (marker, what it is measured against).

        First the pairs, where ``None`` stands for the only partner of a marker; then each marker
        of several pairs with all of them.
        """
        pairs = self.pairs(model)
        partners: dict[Key, list[Key]] = {}
        for at, against in pairs:
            partners.setdefault(at, []).append(against)
        several = [at for at, others in partners.items() if len(others) > 1]
        return [(a, b if a in several else None) for a, b in pairs] + [(a, None) for a in several]

    def flags(self, model: DrawnModel, i: Key, j: Key) -> list[int]:
        """The jflag of what acts at marker i, from marker j or (j = 0) from all."""
        if j == 0:
            return [n for n, side in enumerate(self.sides(model)) if side == (i, None)]
        return [n for n, pair in enumerate(self.pairs(model)) if pair == (i, j)]

    def derived(self, model: DrawnModel) -> dict[str, object]:
        """The markers of ``sides`` as frames."""
        return {
            "sides": tuple(
                (Ref("MARKER", at), None if against is None else Ref("MARKER", against))
                for at, against in self.sides(model)
            )
        }

    def constraints(self: Seen, scope: Scope) -> list[Expr]:
        """The row that vanishes."""
        return [self.function]

    @property
    def result_names(self) -> tuple[str, ...]:
        """``f``: the strength of the constraint, see the function GCON."""
        return ("f",)

    def outputs(self, model: DrawnModel) -> list[Node]:
        """Values of ``result_names``."""
        return [measure("GCON", Ref("GCON", self.key), 0)]


def measures_rates(function: Node, model: DrawnModel) -> bool:
    """Whether an expression measures velocities, itself or through variables."""
    pending, seen = [function], set()
    while pending:
        for node in walk(pending.pop()):
            if isinstance(node, Call) and node.name in RATES:
                return True
            if isinstance(node, Ref) and node.kind == "VARIABLE" and node.id not in seen:
                seen.add(node.id)
                pending.append(model.variable(node.id).function)
    return False


def _differs(marker: Key, wanted: Key | None) -> bool:
    """Whether a marker is another than the one that is given."""
    return wanted is not None and marker != wanted


def _ends(call: Call) -> tuple[Key, ...]:
    """The markers i and j of a measure."""
    taken = zip(call.args, FUNCTIONS[call.name].parameters, strict=False)
    return tuple(
        each.id
        for each, parameter in taken
        if parameter.name in ("i", "j") and isinstance(each, Ref)
    )
