"""States of DIFFs whose equation has no rate of its own: they start where that equation holds."""

from __future__ import annotations

from math import isfinite, nan
from typing import TYPE_CHECKING

from adamslite.elements.diff import Diff
from adamslite.elements.variable import Variable
from adamslite.integrators import contract
from adamslite.language.expression import Ref, calls

if TYPE_CHECKING:
    from adamslite.deck.deck import Deck
    from adamslite.equations.system import System

ROUNDS = 50
# Step of a difference, and correction that is round-off, as shares of the value.
STEP, SETTLED = 1e-6, 1e-14


def settle_states(system: System) -> None:
    """Start a DIFF whose equation has no rate of its own where that equation holds.

    Newton for each state by itself, with the slope from a difference; what does not settle stays
    as the deck starts it.
    """
    deck = system.model.deck
    for diff in deck.of(Diff):
        if not diff.implicit or diff.dynamic_hold or not is_algebraic(deck, diff):
            continue
        row = system.starts[system.node_at["DIFF", diff.key]]
        start = float(system.z[row - system.n])
        for _ in range(ROUNDS):
            y = float(system.z[row - system.n])
            h = STEP * max(1.0, abs(y))
            g, beside = (_at_rest(system, row, value) for value in (y, y + h))
            change = g * h / (beside - g) if beside != g else nan
            system.z[row - system.n] = y - change if isfinite(change) else start
            if not abs(change) > SETTLED * max(1.0, abs(y)):
                break


def _at_rest(system: System, row: int, y: float) -> float:
    """What is left of the equation of a state with the value y; it stays in ``system``."""
    system.z[row - system.n] = y
    system.run(contract.RESIDUAL_AT_REST, contract.ROWS)
    return float(system.F[row])


def is_algebraic(deck: Deck, diff: Diff) -> bool:
    """Whether FUNCTION does without the rate of its own state, also through VARIABLEs."""
    pending, seen = [diff.function], set()
    while pending:
        for call in calls(pending.pop(), "DIF1", "VARVAL", "DDT"):
            (ref,) = call.args
            if call.name == "DIF1" and ref == Ref("DIFF", diff.key):
                return False
            if call.name != "DIF1" and isinstance(ref, Ref) and ref not in seen:
                seen.add(ref)
                pending.append(deck.get(Variable, ref.id).function)
    return True
