"""Dimensions of expressions: what cannot be added, whatever the units are.

    [e] = length^a time^b force^c

Measures of markers and forces have dimensions, TIME is a time, angles have none.  A number may have
any dimension: in a product it hides that of the whole, in a sum it takes that of the other side.
Only what contradicts itself without the help of a number is reported, so that

    DX(2,1) + VX(2,1)           a length and a velocity
    200*DX(2,1) + VX(2,1)       nothing: 200 may be a stiffness
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

from adamslite.checks.rule import Rule
from adamslite.deck.deck import Deck
from adamslite.deck.statement_diagnostics import diagnose_inside
from adamslite.elements.variable import Variable
from adamslite.functions.forces import MEASURES, NET
from adamslite.language.diagnostics import Diagnostic
from adamslite.language.expression import (
    NEGATE,
    Call,
    Node,
    Num,
    Op,
    Ref,
    Time,
    calls,
    fold,
    to_text,
    walk,
)
from adamslite.language.interfaces import Key

Dimension = tuple[float, float, float]
"""Exponents of length, time and force."""

NONE: Dimension = (0.0, 0.0, 0.0)
LENGTH: Dimension = (1.0, 0.0, 0.0)
TIME: Dimension = (0.0, 1.0, 0.0)
FORCE: Dimension = (0.0, 0.0, 1.0)
TORQUE: Dimension = (1.0, 0.0, 1.0)
VELOCITY: Dimension = (1.0, -1.0, 0.0)
ACCELERATION: Dimension = (1.0, -2.0, 0.0)
TURN_RATE: Dimension = (0.0, -1.0, 0.0)
TURN_ACCELERATION: Dimension = (0.0, -2.0, 0.0)
NAMES = {
    NONE: "an angle", LENGTH: "a length", TIME: "a time", FORCE: "a force", TORQUE: "a torque",
    VELOCITY: "a velocity", ACCELERATION: "an acceleration", TURN_RATE: "an angular velocity",
    TURN_ACCELERATION: "an angular acceleration",
}  # fmt: skip
MEASURED: dict[str, Dimension] = {
    **dict.fromkeys(("DM", "DX", "DY", "DZ"), LENGTH),
    **dict.fromkeys(("AX", "AY", "AZ", "PSI", "THETA", "PHI", "YAW", "PITCH", "ROLL"), NONE),
    **dict.fromkeys(("VM", "VR", "VX", "VY", "VZ"), VELOCITY),
    **dict.fromkeys(("WM", "WX", "WY", "WZ"), TURN_RATE),
    **dict.fromkeys(("ACCM", "ACCX", "ACCY", "ACCZ"), ACCELERATION),
    **dict.fromkeys(("WDTM", "WDTX", "WDTY", "WDTZ"), TURN_ACCELERATION),
}
# Components 1 to 4 of a measured element are forces, 5 to 8 torques; of the net force as well.
FORCES, TORQUES = range(1, 5), range(5, 9)
# Arguments that have to be alike, and those that the value is like: all where none are named.
ALIKE: dict[str, tuple[tuple[int, ...], tuple[int, ...]]] = {
    **dict.fromkeys(("ABS", "MAX", "MIN", "DIM"), ((), ())),
    "SIGN": ((0,), (0,)), "MOD": ((), ()),
    "IF": ((1, 2, 3), (1,)),
    **dict.fromkeys(("STEP", "STEP5", "HAVSIN"), ((0, 1, 3), (2, 4))),
}  # fmt: skip
# Stops: the way, its rate, and further ways.
STOPS = {"IMPACT": (2, 6), "BISTOP": (2, 3, 7)}
LONGEST_TEXT = 40
# The value of a VARIABLE, and its rate.
VALUES = ("VARVAL", "DDT")


class Contradiction(NamedTuple):
    """Two parts of an expression, with what they are."""

    first: str
    second: str


def contradictions(deck: Deck) -> Iterator[Diagnostic]:
    """Expressions that combine what has different dimensions."""
    reader = Reader(deck)
    for statement in deck.statements:
        for field, argument in statement.arguments.items():
            node = getattr(statement, field) if argument.kind == "expression" else None
            if node is None:
                continue
            reader.found = None
            reader.dimension(node)
            if reader.found:
                first, second = reader.found
                words = {"word": argument.key, "first": first, "second": second}
                yield diagnose_inside(statement, reader.name, "dimensions", field, **words)


class Reader:
    """Finds the dimensions of expressions of one deck, and the first contradiction in each."""

    def __init__(self, deck: Deck) -> None:
        self.deck = deck
        self.found: Contradiction | None = None
        self.name = ""
        """The function, or TIME, that the second part begins with."""
        self._variables: dict[Key, Dimension | None] = {}
        self._begun: set[Key] = set()

    def dimension(self, node: Node) -> Dimension | None:
        """The dimension of an expression; None where numbers, or the unknown, hide it."""
        match node:
            case Time():
                return TIME
            case Op():
                return self._operation(node)
            case Call():
                return self._call(node)
        return None

    def _operation(self, node: Op) -> Dimension | None:
        first = self.dimension(node.args[0])
        if node.op == NEGATE:
            return first
        second = self.dimension(node.args[1])
        if node.op in "+-":
            return self._like((node.args[0], first), (node.args[1], second))
        if first is None:
            return None
        if node.op == "**":
            return _power(first, fold(node.args[1]))
        if second is None:
            return None
        return _times(first, second, 1.0 if node.op == "*" else -1.0)

    def _like(self, *parts: tuple[Node, Dimension | None]) -> Dimension | None:
        """The dimension that all parts have which have one."""
        known = [(node, found) for node, found in parts if found is not None]
        for node, found in known[1:]:
            if found != known[0][1] and self.found is None:
                self.found = Contradiction(_described(*known[0]), _described(node, found))
                self.name = _first_name(node)
        return known[0][1] if known else None

    def _call(self, call: Call) -> Dimension | None:
        if call.name in MEASURED:
            return MEASURED[call.name]
        if call.name in NET:
            return FORCE if NET[call.name] in FORCES else TORQUE
        if call.name in MEASURES.values():
            return _of_component(call)
        if call.name in VALUES:
            ref = call.args[0]
            found = self._variable(ref.id) if isinstance(ref, Ref) else None
            rate = found and call.name == "DDT"
            return _times(found, TIME, -1.0) if found and rate else found
        return self._of_arguments(call, [self.dimension(arg) for arg in call.args])

    def _of_arguments(self, call: Call, found: list[Dimension | None]) -> Dimension | None:
        """The dimension of a function of numbers, from those of its arguments."""
        parts = list(zip(call.args, found, strict=True))
        if call.name == "SQRT":
            return found[0] and _power(found[0], 0.5)
        if call.name in STOPS:
            self._stop(parts, STOPS[call.name])
        if call.name not in ALIKE:
            return None
        compared, valued = ALIKE[call.name]
        alike = self._like(*(parts[k] for k in compared or range(len(parts))))
        return self._like(*(parts[k] for k in valued)) if valued else alike

    def _stop(self, parts: list[tuple[Node, Dimension | None]], ways: tuple[int, ...]) -> None:
        """Whether the second argument is the rate of the first, and others are like this."""
        self._like(parts[0], *(parts[k] for k in ways))
        (way, is_way), (rate, is_rate) = parts[:2]
        if is_way is None or is_rate is None or self.found:
            return
        if is_rate != _times(is_way, TIME, -1.0):
            self.name = _first_name(rate)
            self.found = Contradiction(
                f"the way {_described(way, is_way)}", f"the rate {_described(rate, is_rate)}"
            )

    def _variable(self, key: Key) -> Dimension | None:
        """The dimension of a VARIABLE; what depends on itself is unknown."""
        if key not in self._begun:
            self._work_out(key)
        return self._variables.get(key)

    def _work_out(self, key: Key) -> None:
        """Find what a VARIABLE refers to, then itself, one behind the other: chains are long."""
        waiting = [key]
        while waiting:
            key = waiting[-1]
            further = [] if key in self._begun else self._referred(key)
            self._begun.add(key)
            if not further:
                waiting.pop()
                if key not in self._variables:
                    self._variables[key] = self._of_variable(key)
            waiting += further

    def _referred(self, key: Key) -> list[Key]:
        """The VARIABLEs to which one refers and that are not begun yet."""
        variable = self.deck.find(Variable, key)
        refs = (call.args[0] for call in calls(variable.function, *VALUES)) if variable else ()
        return [ref.id for ref in refs if isinstance(ref, Ref) and ref.id not in self._begun]

    def _of_variable(self, key: Key) -> Dimension | None:
        variable = self.deck.find(Variable, key)
        if variable is None:
            return None
        before, self.found = (self.found, self.name), None
        dimension = self.dimension(variable.function)
        contradicts, (self.found, self.name) = self.found is not None, before
        return None if contradicts else dimension


def _of_component(call: Call) -> Dimension | None:
    """NAME(id, jflag, comp, rm): a force or a torque."""
    component = call.args[2] if len(call.args) > 2 else None
    if not isinstance(component, Num):
        return None
    return FORCE if component.value in FORCES else TORQUE if component.value in TORQUES else None


def _first_name(node: Node) -> str:
    names = (
        "TIME" if isinstance(each, Time) else each.name
        for each in walk(node)
        if isinstance(each, Time | Call)
    )
    return next(names, "")


def _times(a: Dimension, b: Dimension, sign: float) -> Dimension:
    return a[0] + sign * b[0], a[1] + sign * b[1], a[2] + sign * b[2]


def _power(a: Dimension, exponent: float | None) -> Dimension | None:
    return None if exponent is None else (exponent * a[0], exponent * a[1], exponent * a[2])


def _described(node: Node, found: Dimension) -> str:
    text = to_text(node)
    short = text if len(text) <= LONGEST_TEXT else text[: LONGEST_TEXT - 3] + "..."
    return f"{short}, {named(found)},"


def named(found: Dimension) -> str:
    """A dimension in words."""
    if found in NAMES:
        return NAMES[found]
    words = zip(("length", "time", "force"), found, strict=True)
    return " ".join(word if power == 1 else f"{word}^{power:g}" for word, power in words if power)


DIMENSION_RULES: list[Rule] = [contradictions]
