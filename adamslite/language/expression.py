"""Function expressions: the resolved nodes.

A resolved expression contains no names to look up any more: constants are numbers, ids are
:class:`Ref`, bare names are calls of ``VARVAL``, omitted optional arguments are filled in.
Nodes are immutable, hashable and compare by content.
"""

from __future__ import annotations

import operator
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from typing import NamedTuple

from adamslite.language.traced import power

NEGATE = "neg"


class Operator(NamedTuple):
    """``level``: how strongly it binds; ``function``: what it does."""

    level: int
    function: Callable[..., float]


OPERATORS = {
    "+": Operator(1, operator.add),
    "-": Operator(1, operator.sub),
    NEGATE: Operator(1, operator.neg),
    "*": Operator(2, operator.mul),
    "/": Operator(2, operator.truediv),
    "**": Operator(3, power),
}


@dataclass(frozen=True, slots=True)
class Num:
    """A number; angles written in degrees are radians here.

    ``name`` is set where a statement gave the number a name (KGRAV), so that it can follow a
    change of that statement.
    """

    value: float
    name: str = field(default="", compare=False)

    def __reduce__(self) -> tuple[type[Num], tuple[float, str]]:
        # What slots do by themselves takes five times as long; so for the other nodes.
        return Num, (self.value, self.name)


@dataclass(frozen=True, slots=True)
class Time:
    """The time of the simulation."""


@dataclass(frozen=True, slots=True)
class Mode:
    """The kind of analysis being run, 4 in dynamics."""


@dataclass(frozen=True, slots=True)
class Ref:
    """A statement named by keyword and id; ``Ref("MARKER", 0)`` is the ground frame."""

    kind: str
    id: int | str

    def __reduce__(self) -> tuple[type[Ref], tuple[str, int | str]]:
        return Ref, (self.kind, self.id)


@dataclass(frozen=True, slots=True)
class Call:
    """A function of the deck language; ``name`` is in capitals."""

    name: str
    args: tuple[Node, ...]

    def __reduce__(self) -> tuple[type[Call], tuple[str, tuple[Node, ...]]]:
        return Call, (self.name, self.args)


@dataclass(frozen=True, slots=True)
class Op:
    """Arithmetic: ``op`` is one of :data:`OPERATORS`."""

    op: str
    args: tuple[Node, ...]

    def __reduce__(self) -> tuple[type[Op], tuple[str, tuple[Node, ...]]]:
        return Op, (self.op, self.args)


Node = Num | Time | Mode | Ref | Call | Op

GROUND_FRAME = Ref("MARKER", 0)
TIME = Time()
MODE = Mode()


# comp of FX FY FZ TX TY TZ in the functions that measure an element.
COMPONENTS = (2, 3, 4, 6, 7, 8)


def measure(name: str, element: Ref, comp: int, rm: Ref = GROUND_FRAME, jflag: int = 0) -> Call:
    """The call ``NAME(id, jflag, comp, rm)``."""
    return Call(name, (element, Num(jflag), Num(comp), rm))


def walk(node: Node) -> Iterator[Node]:
    """The node and everything below it, parents first."""
    pending = [node]
    while pending:
        top = pending.pop()
        yield top
        if type(top) is Call or type(top) is Op:
            pending.extend(reversed(top.args))


def calls(node: Node, *names: str) -> Iterator[Call]:
    """The calls inside ``node``; only those of the given functions when there are any."""
    for each in walk(node):
        if type(each) is Call and (not names or each.name in names):
            yield each


_called: dict[frozenset[str], frozenset[str]] = {}


def names_called(nodes: Iterable[Node]) -> frozenset[str]:
    """Names of the functions that expressions call; equal sets are one object."""
    found = frozenset(call.name for node in nodes for call in calls(node))
    return _called.setdefault(found, found)


def rebuild(node: Node, change: Callable[[Node], Node]) -> Node:
    """A copy in which ``change`` was applied to every node, leaves first."""
    if type(node) is Call:
        node = Call(node.name, tuple(rebuild(arg, change) for arg in node.args))
    elif type(node) is Op:
        node = Op(node.op, tuple(rebuild(arg, change) for arg in node.args))
    return change(node)


def operate(op: str, values: Sequence[float]) -> float | None:
    """The value of an operation on numbers; None where it has none (1/0, the root of -1)."""
    try:
        value = OPERATORS[op].function(*values)
    except (ArithmeticError, ValueError):
        return None
    return value if isinstance(value, float) else float(value)


def fold(node: Node) -> float | None:
    """The value of an expression of numbers only; None for any other."""
    if type(node) is Num:
        return node.value
    if type(node) is not Op:
        return None
    values = [value for value in map(fold, node.args) if value is not None]
    return operate(node.op, values) if len(values) == len(node.args) else None


def to_text(node: Node) -> str:
    """The expression in deck syntax; reading it again gives the same node."""
    return _text(node, 0)


def _text(node: Node, level: int) -> str:
    match node:
        case Num(value):
            text = f"{value:.17g}" if float(f"{value:.12g}") != value else f"{value:.12g}"
            return f"({text})" if value < 0 and level > 1 else text
        case Time() | Mode():
            return type(node).__name__.upper()
        case Ref(_, id):
            return str(id)
        case Call("IF", args):
            first, *rest = (_text(arg, 0) for arg in args)
            return f"IF({first}: {', '.join(rest)})"
        case Call(name, args):
            return f"{name}({', '.join(_text(arg, 0) for arg in args)})"
        case Op(op, args):
            text = _operation(op, args)
            return f"({text})" if OPERATORS[op].level < level else text
    raise TypeError(f"not an expression node: {node!r}")


def _operation(op: str, args: tuple[Node, ...]) -> str:
    own = OPERATORS[op].level
    if op == NEGATE:
        return f"-{_text(args[0], own + 1)}"
    # Operators group to the left, ** to the right: the other side needs brackets at equal level.
    sides = (own + 1, own) if op == "**" else (own, own + 1)
    left, right = (_text(arg, side) for arg, side in zip(args, sides, strict=True))
    blank = " " if own == 1 else ""
    return f"{left}{blank}{op}{blank}{right}"
