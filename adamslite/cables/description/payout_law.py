"""A payout law or the force of an engine: an expression of the deck, also evaluated here."""

import math
from collections.abc import Callable, Mapping
from functools import cache
from typing import Any

from adamslite.cables.description.messages import LARGEST, Faults
from adamslite.cables.description.toml_places import Path
from adamslite.language.expression import Call, Node, Num, Op, Ref, Time, operate
from adamslite.language.function import find_function
from adamslite.symbolic.duals import Dual
from adamslite.symbolic.formulas import with_numbers


class Unknown(Exception):
    """The value of this expression is not known before the run."""


class NoValue(Unknown):
    """There is none, before the run or in it: a division by zero, the root of a negative number."""


class _NoRun:
    """The scope of functions that numbers alone decide."""

    def touch(self, relation: Any, in_length: bool = True) -> Any:
        """Nothing is remembered."""
        return relation


def _if(x: float, *values: float) -> float:
    return values[1 + (x > 0) - (x < 0)]


# What most expressions of springs consist of, as plain arithmetic; all others by their definitions.
PLAIN: dict[str, Callable[..., float]] = {
    "ABS": abs, "MIN": min, "MAX": max, "IF": _if,
    **{n: getattr(math, n.lower()) for n in ("SIN", "COS", "TAN", "EXP", "SQRT", "TANH", "LOG")},
}  # fmt: skip
# Arguments of functions that depend on these alone.
NUMBERS = ("number", "exponent", "constant")


def parse(text: str, path: Path, faults: Faults) -> Node | None:
    """The expression; None after saying what is wrong with it."""
    from adamslite.elements.variable import Variable
    from adamslite.language.diagnostics import DeckError
    from adamslite.reading.read import read

    moved = path[-1] in ("force", "torque", "pull", "speed", "brake")
    names = "VARIABLE/S, FUNCTION=0\nVARIABLE/SD, FUNCTION=0\n" if moved else ""
    deck = f"a law\nPART/1, GROUND\n{names}VARIABLE/1, FUNCTION={text}\n"
    try:
        return read(deck).get(Variable, 1).function
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
    elif type(node) is Call and (node.name in PLAIN or _is_of_numbers(node.name)):
        found = _called(node.name, [evaluate(arg, look) for arg in node.args])
    else:
        return look(node)
    if found is None:
        raise NoValue
    return found


@cache
def _is_of_numbers(name: str) -> bool:
    """Whether it is a function that its arguments alone decide."""
    function = find_function(name)
    kinds = [parameter.kind for parameter in function.parameters]
    return bool(kinds) and all(kind in NUMBERS for kind in kinds)


def _called(name: str, args: list[float]) -> float | None:
    """The value of a function, by the definition that a run has; None where there is none."""
    try:
        if name in PLAIN:
            return PLAIN[name](*args)
        function = find_function(name)
        kinds = (function.parameter(k).kind for k in range(len(args)))
        given = [int(x) if kind == "constant" else x for x, kind in zip(args, kinds, strict=True)]
        with with_numbers():
            numbers = [Dual(x) if type(x) is float else x for x in given]
            found = function.body(_NoRun(), *numbers)
        return found.value if isinstance(found, Dual) else float(found)
    except (ArithmeticError, ValueError):
        return None
    except AttributeError:  # it reads something else of the run, by its scope
        raise Unknown from None
