"""A payout law or the force of an engine: an expression of the deck, also evaluated here."""

import math
from collections.abc import Callable, Mapping

from adamslite.cables.messages import LARGEST, Faults
from adamslite.cables.toml_places import Path
from adamslite.language.expression import Call, Node, Num, Op, Ref, Time, operate


class Unknown(Exception):
    """The value of this expression is not known before the run."""


class NoValue(Unknown):
    """There is none, before the run or in it: a division by zero, the root of a negative number."""


def _step(shape: Callable[[float], float]) -> Callable[..., float]:
    def value(x: float, x0: float, h0: float, x1: float, h1: float) -> float:
        return h0 + (h1 - h0) * shape(min(max((x - x0) / (x1 - x0), 0.0), 1.0))

    return value


def _if(x: float, *values: float) -> float:
    return values[1 + (x > 0) - (x < 0)]


FUNCTIONS: dict[str, Callable[..., float]] = {
    "ABS": abs, "MIN": min, "MAX": max, "IF": _if,
    **{n: getattr(math, n.lower()) for n in ("SIN", "COS", "TAN", "EXP", "SQRT", "TANH", "LOG")},
    "STEP": _step(lambda d: d * d * (3 - 2 * d)),
    "STEP5": _step(lambda d: d**3 * (10 - 15 * d + 6 * d * d)),
    "HAVSIN": _step(lambda d: (1 - math.cos(math.pi * d)) / 2),
}  # fmt: skip


def parse(text: str, path: Path, faults: Faults) -> Node | None:
    """The expression; None after saying what is wrong with it."""
    from adamslite.elements.variable import Variable
    from adamslite.language.diagnostics import DeckError
    from adamslite.reading.read import read

    moved = path[-1] in ("force", "torque", "pull")
    names = "VARIABLE/S, FUNCTION=0\nVARIABLE/SD, FUNCTION=0\n" if moved else ""
    deck = f"a law\nPART/1, GROUND\n{names}VARIABLE/1, FUNCTION={text}\n"
    try:
        return read(deck).of(Variable)[-1].function
    except DeckError as fault:
        for each in fault.errors:
            faults.add("expression", path, word=path[-1], why=each.message, hint=each.hint)
        return None


def value(node: Node, time: float, named: Mapping[str, float]) -> float:
    """What the expression is at a time; raises :class:`Unknown`."""

    def look(leaf: Node) -> float:
        match leaf:
            case Time():
                return time
            case Call("VARVAL", (Ref(_, name),)) if str(name).upper() in named:
                return named[str(name).upper()]
        raise Unknown

    found = evaluate(node, look)
    if not abs(found) <= LARGEST:
        raise NoValue
    return found


def evaluate(node: Node, look: Callable[[Node], float]) -> float:
    """Arithmetic and functions of numbers; `look` gives everything else or raises
    :class:`Unknown`.
    """
    if type(node) is Num:
        return node.value
    if type(node) is Op:
        found = operate(node.op, [evaluate(arg, look) for arg in node.args])
    elif type(node) is Call and node.name in FUNCTIONS:
        found = _called(node.name, [evaluate(arg, look) for arg in node.args])
    else:
        return look(node)
    if found is None:
        raise NoValue
    return found


def _called(name: str, args: list[float]) -> float | None:
    try:
        return FUNCTIONS[name](*args)
    except (ArithmeticError, ValueError):
        return None
