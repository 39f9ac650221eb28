"""Derivatives on the graph of an expression, by the chain rule from node to node.

    gradient   by all symbols at once, from the result to the symbols (reverse mode):
               the weight of a node is the sum over those it is part of,  w_b = sum w_a da/db
    along      in one direction, from the symbols to the result (forward mode):
               a' = sum da/db b'

Each visits every node once, so that the effort grows with the graph and not with the tree that it
stands for.  The slopes da/db of single functions are those of sympy (:mod:`.slopes`).  A choice is
differentiated piece by piece and chosen between afterwards: what has no value in a piece that does
not hold stays there.

Reference: Griewank, Walther, Evaluating Derivatives, 2008, chapters 3 and 6.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence

from adamslite.symbolic.graph import ONE, TRUE, ZERO, Given, Node, add, choice, mul, node
from adamslite.symbolic.slopes import slopes
from adamslite.symbolic.structure import ordered


class Derivatives:
    """Differentiates expressions that share parts; ``constant``: by which symbols never."""

    def __init__(self, constant: Callable[[Node], bool] = lambda symbol: False) -> None:
        self.constant = constant
        self._numbers: dict[Node, int] = {}
        self._masks: dict[Node, int] = {}
        self._sets: dict[int, frozenset[Node]] = {0: frozenset()}
        self._varies: dict[Node, bool] = {}
        self._gradients: dict[Node, dict[Node, Node]] = {}

    def symbols(self, expr: Given) -> frozenset[Node]:
        """The symbols in an expression.

        Those of a node are bits of a whole number: a sum of n terms is n sums, and a set for each
        of them would take a hundred times the memory.
        """
        expr, known = node(expr), self._masks
        for top in _new(expr, known):
            own = self._bit(top) if top.kind == "symbol" else 0
            for each in top.args:
                own |= known[each]
            known[top] = own
        mask = known[expr]
        if mask not in self._sets:
            bits = reversed(f"{mask:b}")
            pairs = zip(self._numbers, bits, strict=False)
            self._sets[mask] = frozenset(symbol for symbol, bit in pairs if bit == "1")
        return self._sets[mask]

    def _bit(self, symbol: Node) -> int:
        """The bit of a symbol: symbols are numbered as they come."""
        return 1 << self._numbers.setdefault(symbol, len(self._numbers))

    def varies(self, expr: Node) -> bool:
        """Whether an expression has symbols that are no constants."""
        known = self._varies
        for top in _new(expr, known):
            own = top.kind == "symbol" and not self.constant(top)
            known[top] = own or any(known[each] for each in top.args)
        return known[expr]

    def gradient(self, expr: Given) -> Mapping[Node, Node]:
        """The derivatives by the symbols that an expression depends on."""
        expr = node(expr)
        if expr not in self._gradients:
            self._gradients[expr] = self._gradient(expr) if self.varies(expr) else {}
        return self._gradients[expr]

    def _gradient(self, expr: Node) -> dict[Node, Node]:
        weights: dict[Node, Node] = {expr: ONE}
        found: dict[Node, Node] = {}
        for top in reversed(ordered([expr], self._below)):
            weight = weights.pop(top)
            if top.kind == "symbol":
                found[top] = add(found.get(top, ZERO), weight)
            elif top.kind == "choice":
                for symbol, its_slope in self._of_choice(top).items():
                    found[symbol] = add(found.get(symbol, ZERO), mul(weight, its_slope))
            else:
                for each, slope in slopes(top):
                    if self._varies[each]:
                        weights[each] = add(weights.get(each, ZERO), mul(weight, slope()))
        return {symbol: slope for symbol, slope in found.items() if slope is not ZERO}

    def _below(self, top: Node) -> Iterable[Node]:
        """What a weight is passed on to."""
        if top.kind == "choice":
            return ()
        return [each for each, _ in slopes(top) if self._varies[each]] if top.args else ()

    def _of_choice(self, top: Node) -> dict[Node, Node]:
        """The gradient of a choice: of its pieces, chosen between."""
        pieces = [(self.gradient(value), condition) for value, condition in top.pieces]
        pieces.append((self.gradient(top.args[-1]), TRUE))
        symbols = dict.fromkeys(symbol for slope, _ in pieces for symbol in slope)
        return {
            symbol: choice([(slope.get(symbol, ZERO), c) for slope, c in pieces], top.order)
            for symbol in symbols
        }


def along(expr: Given, found: dict[Node, Node]) -> Node:
    """The derivative in the direction in which symbols change at rates that are ``found``, others
    not at all; the rates of all parts are added to these.
    """
    expr = node(expr)
    for top in ordered([expr], lambda top: () if top in found else _values(top)):
        if top in found:
            continue
        if top.kind == "choice":
            pieces = [(found[value], condition) for value, condition in top.pieces]
            found[top] = choice([*pieces, (found[top.args[-1]], TRUE)], top.order)
        else:
            found[top] = _rate(top, found)
    return found[expr]


def _values(top: Node) -> Sequence[Node]:
    """What the value of a node changes with: its arguments, of a choice no conditions."""
    return top.args[:: 1 + (top.kind == "choice")]


def _rate(top: Node, rates: Mapping[Node, Node]) -> Node:
    total = ZERO
    if all(rates[each] is ZERO for each in top.args):
        return total
    for each, slope in slopes(top):
        if rates[each] is not ZERO:
            total = add(total, mul(slope(), rates[each]))
    return total


def _new(expr: Node, known: Mapping[Node, object]) -> list[Node]:
    """The nodes of an expression that nothing is known of, each behind those it is made of."""
    if expr in known:
        return []
    return [top for top in ordered([expr], lambda top: () if top in known else top.args)
            if top not in known]  # fmt: skip
