"""Guards of an expression: where its branches change, with time or with the state.

A *guard* is a relation that decides a choice in an expression (IF, MAX, ABS, IMPACT, STEP ...), or
a floor (MOD, AINT).  Within one step of an integrator its branch stays what it was, so that the
equations are smooth; see :mod:`adamslite.integrators.events.events`.

==========  =====================================================================================
clock       depends on nothing but time: its changes are known before the run
watch       depends on the state, and the value or the slope of the choice breaks there
zone        no guard but the place D = (x - x0)/(x1 - x0) of the state within the zone of a smooth
            step (STEP, STEP5, HAVSIN, the damping of IMPACT), of which a step of the integrator
            crosses a share at most
==========  =====================================================================================

Other guards are evaluated every time: they depend on the state, but the choice is smooth
enough (the borders of a zone), or they only keep a formula from 0/0.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field

from adamslite.symbolic.derivatives import Derivatives
from adamslite.symbolic.types import Expr, Leaf, Symbol

# How a guard is read: a relation > 0, a relation >= 0, a floor; a place within a zone.  Added to
# that of a relation of the state where the value itself jumps, not only its slope.
STRICT, WEAK, FLOOR, ZONE = range(4)
JUMPS = 4
CLOCK_LEAVES = ("t", "sig")
FIXED_LEAVES = ("p", "mode", "run", "nan")
RELATIONS = ("<", ">", "<=", ">=")


@dataclass
class Guards:
    """The guards of one shape, in the order of their branches, and its zones."""

    clock: list[Expr] = field(default_factory=list)
    watch: list[Expr] = field(default_factory=list)
    zone: list[Expr] = field(default_factory=list)
    jumps: set[Expr] = field(default_factory=set)

    def __bool__(self) -> bool:
        return bool(self.clock or self.watch or self.zone)

    @property
    def kinds(self) -> dict[str, list[int]]:
        """How each guard is read."""
        return {
            "clock": [_kind(g) for g in self.clock],
            "watch": [_kind(g) + JUMPS * (g in self.jumps) for g in self.watch],
            "zone": [ZONE for _ in self.zone],
        }


def guards(expressions: Iterable[Expr], leaves: dict[Symbol, Leaf]) -> Guards:
    """The guards in expressions; ``leaves``: what their symbols stand for."""
    found: dict[Expr, int] = {}
    zones: dict[Expr, None] = {}
    for expression in expressions:
        _collect(expression, found, zones)
    result, symbols = Guards(), Derivatives().symbols
    for place in zones:
        kinds = _changing(symbols(place), leaves)
        if kinds and not kinds <= set(CLOCK_LEAVES):
            result.zone.append(place)
    for guard, order in found.items():
        kinds = _changing(symbols(guard), leaves)
        if kinds and kinds <= set(CLOCK_LEAVES):
            result.clock.append(guard)
        elif kinds and order < 1:
            result.watch.append(guard)
            if order < 0 and guard.is_relation:
                result.jumps.add(guard)
    return result


def _changing(symbols: Iterable[Symbol], leaves: dict[Symbol, Leaf]) -> set[str]:
    """Kinds of those that are not fixed for a run."""
    return {leaves[symbol][0] for symbol in symbols} - set(FIXED_LEAVES)


def _collect(expression: Expr, found: dict[Expr, int], zones: dict[Expr, None]) -> None:
    """Guards below ``expression`` with the least order of the choices they decide; its zones."""
    pending, seen = [expression], set()
    while pending:
        node = pending.pop()
        if node in seen or not node.args:
            continue
        seen.add(node)
        order = node.order
        if order is not None and node.kind == "floor":
            found[node] = order
        elif order is not None and node.kind == "choice":
            for relation in _relations(node):
                found[relation] = min(order, found.get(relation, order))
            place = _zone(node) if order >= 1 else None
            if place is not None:
                zones[place] = None
        pending.extend(reversed(node.args))


def _zone(choice: Expr) -> Expr:
    """The place within the zone between ``(x - x0) w <= 0`` and ``(x - x1) w >= 0``, w = x1 - x0:
    0 at x0 and 1 at x1; None where a choice is none between two borders.
    """
    borders = [condition for _, condition in choice.pieces]
    if [border.kind for border in borders] != ["<=", ">="]:
        return None
    before, behind = (border.args[0] - border.args[1] for border in borders)
    return before / (before - behind)


def _relations(choice: Expr) -> list[Expr]:
    """The relations in the conditions of a choice, not those inside their sides."""
    found, pending = [], [condition for _, condition in choice.pieces]
    while pending:
        condition = pending.pop(0)
        if condition.kind in ("and", "or", "not"):
            pending += condition.args
        elif condition.kind in RELATIONS:
            found.append(condition)
    return found


def _kind(guard: Expr) -> int:
    if guard.kind == "floor":
        return FLOOR
    return STRICT if guard.kind in ("<", ">") else WEAK
