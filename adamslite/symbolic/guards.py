"""Guards of an expression: where its branches change, with time or with the state.

A *guard* is a relation that decides a choice in an expression (IF, MAX, ABS, IMPACT, STEP ...), or
a floor (MOD, AINT).  Within one step of an integrator its branch stays what it was, so that the
equations are smooth; see :mod:`adamslite.integrators.events.events`.

==========  =====================================================================================
clock       depends on nothing but time: its changes are known before the run
watch       depends on the state, and the value or the slope of the choice breaks there
zone        no guard but the place D = (x - x0)/(x1 - x0) of the state within the zone of a smooth
            step (STEP, STEP5, HAVSIN, the damping of IMPACT) or of a narrow function (EXP, TANH,
            ATAN, COSH), of which a step of the integrator crosses a share at most; or a *pole*, a
            denominator or the argument of LOG, which a step does not bring close to zero; or a
            *root*, the argument of SQRT, which does not change its sign within a step; or the
            argument of a table, of which a step passes only pieces that are one smooth curve
            (:func:`adamslite.symbolic.interpolant.reach`)
==========  =====================================================================================

Other guards are evaluated every time: they depend on the state, but the choice is smooth
enough (the borders of a zone), or they only keep a formula from 0/0.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, field

from adamslite.symbolic.derivatives import Derivatives
from adamslite.symbolic.graph import NAN, ONE, TRUE, ZERO, choice, joined, made, opposite
from adamslite.symbolic.structure import ordered
from adamslite.symbolic.types import Expr, Leaf, Symbol

# How a guard is read: a relation > 0, a relation >= 0, a floor; a place within a zone.  Added to
# that of a relation of the state where the value itself jumps, not only its slope.
STRICT, WEAK, FLOOR, ZONE = range(4)
JUMPS = 4
POLE, ROOT, NARROW = 5, 6, 7
# How an argument of a table is read: this, the order of the derivative (at most 2), ``CLOSED``
# where the argument wraps from 1 to 0, and ``TABLES`` times the number of the table.
TABLE, CLOSED, TABLES = 8, 4, 16
CLOCK_LEAVES = ("t", "sig")
FIXED_LEAVES = ("p", "mode", "run", "nan")
RELATIONS = ("<", ">", "<=", ">=")
# Faces whose tables of the state bound the step; those of rates have the same arguments.
WITH_TABLES = ("loads", "equation", "position", "sensor")
# Tables whose pieces along x are evaluated as they are: positions of x and of the order by it.
TABLES_OF_X = {"Lookup": (3, 2), "LookupBetween": (3, 1), "LookupBetweenHeld": (4, 1)}
# What functions of a deck change within: borders of zones of their argument.  EXP is compared with
# its value at 0; of EXP(-s**n) the sides of the hump lie within ``FLANK`` of s**n, its foot at the
# first of ``FEET``; 1/(1 + s**n) goes down more slowly.
BORDERS = {
    "exp": ((-16.0, -3.0), (-3.0, 5.0)),
    "tanh": ((-3.0, 3.0),),
    "atan": ((-6.0, 6.0), (-1.5, 1.5)),
    "cosh": ((-4.0, 4.0),),
}
FEET, FLANK = (16.0, 256.0, 4096.0), (0.1, 5.0)
# Functions that are zero where their argument is, and as slowly.
LINEAR_AT_ZERO = ("neg", "sin", "tan", "asin", "atan", "sinh", "tanh")


@dataclass
class Guards:
    """The guards of one shape, in the order of their branches, and its zones."""

    clock: list[Expr] = field(default_factory=list)
    watch: list[Expr] = field(default_factory=list)
    zone: dict[Expr, int] = field(default_factory=dict)
    tables: dict[tuple[Expr, int], int] = field(default_factory=dict)
    jumps: set[Expr] = field(default_factory=set)

    def __bool__(self) -> bool:
        return bool(self.clock or self.watch or self.zone or self.tables)

    @property
    def places(self) -> list[Expr]:
        """Places within zones and arguments of tables."""
        return [*self.zone, *(x for x, _ in self.tables)]

    @property
    def kinds(self) -> dict[str, list[int]]:
        """How each guard is read."""
        return {
            "clock": [_kind(g) for g in self.clock],
            "watch": [_kind(g) + JUMPS * (g in self.jumps) for g in self.watch],
            "zone": [*self.zone.values(), *(k + order for (_, k), order in self.tables.items())],
        }


def guards(
    expressions: list[Expr], leaves: dict[Symbol, Leaf], face: str, written: Iterable[Expr] = ()
) -> Guards:
    """The guards in expressions of a face; ``leaves``: what their symbols stand for; ``written``:
    what operations and functions of the deck have given.
    """
    found: dict[Expr, int] = {}
    zones: dict[Expr, None] = {}
    for expression in expressions:
        _collect(expression, found, zones)
    result, symbols = Guards(), Derivatives().symbols
    if face in WITH_TABLES:
        for (x, kind), order in _arguments(expressions).items():
            if not _changing(symbols(x), leaves) <= {*CLOCK_LEAVES, "now"}:
                result.tables[x, kind] = order

    def moves(expr: Expr) -> bool:
        kinds = _changing(symbols(expr), leaves)
        return bool(kinds) and not kinds <= set(CLOCK_LEAVES)

    result.zone.update((place, ZONE) for place in zones if moves(place))
    narrow = _Narrow(
        set(_parts_written(written)), moves, lambda e: not _changing(symbols(e), leaves)
    )
    result.zone.update(narrow.zones(expressions))
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


def _arguments(expressions: Iterable[Expr]) -> dict[tuple[Expr, int], int]:
    """Arguments x of tables, how they are read, and the least order of the derivatives by them."""
    found: dict[tuple[Expr, int], int] = {}
    nodes = ordered(expressions)
    numbers = {node.args[0] for node in nodes if node.kind == "floor"}
    for node in nodes:
        if node.kind not in TABLES_OF_X or node in numbers:
            continue
        at, position = TABLES_OF_X[node.kind]
        x, kind = node.args[at], TABLE + TABLES * int(node.args[0])
        if x.kind == "-" and x.args[1].kind == "floor" and x.args[1].args[0] is x.args[0]:
            x, kind = x.args[0], kind + CLOSED
        order = min(int(node.args[position]), CLOSED - 1)
        found[x, kind] = min(order, found.get((x, kind), order))
    return found


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


def _parts_written(written: Iterable[Expr]) -> Iterator[Expr]:
    """Functions, quotients and powers in what operations and functions of the deck have given."""
    pending, seen = list(written), set()
    while pending:
        node = pending.pop()
        if node not in seen:
            seen.add(node)
            pending += node.args if node.kind in ("neg", "*") else ()
            if node.kind in (*BORDERS, "/", "**", "log", "tan"):
                yield node


class _Narrow:
    """Zones of the functions of a deck that change within a small part of the range of their
    argument, poles and roots.

    ``written``: the nodes that count; ``moves``, ``is_fixed``: whether a node depends on the state,
    or on nothing that changes in a run.
    """

    def __init__(
        self, written: set[Expr], moves: Callable[[Expr], bool], is_fixed: Callable[[Expr], bool]
    ) -> None:
        self.written, self.moves, self.is_fixed = written, moves, is_fixed
        self.found: dict[Expr, int] = {}

    def zones(self, expressions: list[Expr]) -> dict[Expr, int]:
        """Zones, poles and roots in expressions, and how they are read."""
        if not self.written:
            return {}
        holding: set[Expr] = set()
        for node in ordered(expressions):
            if node in self.written or not holding.isdisjoint(node.args):
                holding.add(node)
        pending, seen = [(each, TRUE) for each in expressions], set()
        while pending:
            node, where = pending.pop()
            if (node, where) in seen or node not in holding:
                continue
            seen.add((node, where))
            factors = list(self._factors(node))
            self._poles(factors, where)
            for factor, *_ in factors:
                if factor in self.written and self.moves(factor):
                    self._function(factor, where)
                pending += _below(factor, where)
        return self.found

    def _factors(self, product: Expr) -> Iterator[tuple[Expr, float, bool]]:
        """Factors of a product, their exponents, and whether the deck divides by them or has them
        to a power.
        """
        pending = [(product, 1.0, False)]
        while pending:
            node, n, ours = pending.pop()
            if node.kind in ("neg", "*"):
                pending += [(each, n, ours) for each in node.args]
            elif node.kind == "/":
                above, below = node.args
                pending += [(above, n, ours), (below, -n, ours or node in self.written)]
            elif node.kind == "**" and node.args[1].kind == "number":
                exponent = float(node.args[1])
                pending.append((node.args[0], n * exponent, ours or node in self.written))
            else:
                yield node, n, ours

    def _poles(self, factors: list[tuple[Expr, float, bool]], where: Expr) -> None:
        """The factors that make a product infinite or undefined where they are zero."""
        for base in dict.fromkeys(factor for factor, _, ours in factors if ours):
            if base.kind in BORDERS or not self.moves(base):
                continue
            orders = _orders([factor for factor, *_ in factors], base)
            power = sum(n * order for (_, n, _), order in zip(factors, orders, strict=True))
            if power < 0.0:
                self._add(base, POLE, where)
                s, shift, factor, n = self._peeled(base)
                if n % 2.0 == 0.0 and shift is not ZERO:
                    self._hump(s, factor / shift, n, FEET)
            elif power % 1.0 and self._peeled(base)[0].least < 0.0 and self._peeled(base)[3] % 2.0:
                self._add(base, ROOT, where)

    def _add(self, value: Expr, kind: int, where: Expr) -> None:
        """Add a pole or root; it is none where the branch that has it is not taken."""
        self.found[choice([(value, where), (NAN, TRUE)], None)] = kind

    def _function(self, function: Expr, where: Expr) -> None:
        """Zones of the argument of a function."""
        x = function.args[0]
        if function.kind in ("log", "tan"):
            self._add(x if function.kind == "log" else made("cos", x), POLE, where)
            return
        base, _, factor, n = self._peeled(x)
        if function.kind == "exp" and n % 2.0 == 0.0:
            self._hump(base, factor, n)
        elif function.kind == "exp" and base is not x and base.least >= 0.0:
            self._add(1 + (factor**2) ** 0.5 * base, POLE, TRUE)
        else:
            self._borders(x, BORDERS.get(function.kind, ()))

    def _hump(self, base: Expr, factor: Expr, n: float, feet: tuple[float, ...] = FEET[:1]) -> None:
        """Zones of a function of k s**n that is large or small about s = 0, as EXP(-k s**n)."""
        low, high, *ends = (each ** (1.0 / n) for each in (*FLANK, *feet))
        borders = [*((-foot, foot) for foot in ends), (low, high), (-high, -low)]
        if n <= 2.0:  # the top of a bell is not flat: steps there are as short as at its sides
            borders.append((0.5 * (low - high), 0.5 * (high - low)))
        self._borders((factor**2) ** (0.5 / n) * base, borders)

    def _borders(self, place: Expr, borders: Iterable[tuple[float, float]]) -> None:
        for low, high in borders:
            self.found[(place - low) * (1.0 / (high - low))] = NARROW

    def _peeled(self, x: Expr) -> tuple[Expr, Expr, Expr, float]:
        """s, c, k and n of x = c + k s**n with fixed c and k."""
        shift, factor = ZERO, ONE
        while True:
            above, below = (x.args + x.args)[:2] if x.args else (x, x)
            if x.kind == "neg":
                x, factor = above, -factor
            elif x.kind in ("+", "-") and self.is_fixed(below):
                x, shift = above, shift + factor * below * (1 if x.kind == "+" else -1)
            elif x.kind in ("+", "-") and self.is_fixed(above):
                shift += factor * above
                x, factor = below, factor if x.kind == "+" else -factor
            elif x.kind == "*" and self.is_fixed(above):
                x, factor = below, factor * above
            elif x.kind == "*" and self.is_fixed(below):
                x, factor = above, factor * below
            elif x.kind == "/" and self.is_fixed(below):
                x, factor = above, factor / below
            elif x.kind == "**" and below.kind == "number":
                return above, shift, factor, float(below)
            else:
                return x, shift, factor, 1.0


def _below(node: Expr, where: Expr) -> Iterator[tuple[Expr, Expr]]:
    """Arguments of a node, and the conditions, held in a step, under which they matter."""
    if node.kind != "choice" or node.order is None or node.order > 0:
        yield from ((each, where) for each in node.args)
        return
    for value, condition in node.pieces:
        yield condition, where
        yield value, joined("and", (where, condition))
        where = joined("and", (where, opposite(condition)))
    yield node.args[-1], where


def _orders(factors: list[Expr], base: Expr) -> list[float]:
    """How fast factors go to zero with ``base``: 1 as it does; 1/2 a component of a vector of which
    it is the square.
    """
    pending, terms = [base], []
    while pending:
        node = pending.pop()
        pending += node.args if node.kind == "+" else ()
        terms += [node] if node.kind != "+" else []
    squares = all(t.kind == "**" and t.args[1].value == 2.0 for t in terms)
    known = {term.args[0]: 0.5 for term in terms} if squares else {}
    known[base] = 1.0
    for node in ordered(factors, lambda top: () if top in known else top.args):
        if node not in known:
            known[node] = _order(node, [known.get(each, 0.0) for each in node.args])
    return [known[factor] for factor in factors]


def _order(node: Expr, orders: list[float]) -> float:
    """How fast a node goes to zero, by its arguments."""
    if node.kind in LINEAR_AT_ZERO:
        return orders[0]
    if node.kind in ("+", "-"):
        return min(orders)
    if node.kind == "choice":
        return min(orders[::2])
    if node.kind in ("*", "/"):
        return orders[0] + orders[1] if node.kind == "*" else orders[0] - orders[1]
    if node.kind == "**" and node.args[1].kind == "number":
        return orders[0] * float(node.args[1])
    return 0.0
