"""Quantity and dimension of expressions: of a REQUEST, of a VARIABLE.

What a measuring function returns is known from its documentation, and passes through sums and
bounds. A product may have any dimension, since a deck states no units for its numbers.
"""

from __future__ import annotations

import re
from functools import cache
from typing import TYPE_CHECKING

if TYPE_CHECKING:  # to compare tables no statement is needed
    from adamslite.deck.deck import Deck
    from adamslite.language.expression import Node

ANGLE, LENGTH, TIME, FORCE, TORQUE = "angle", "length", "time", "force", "torque"
UNKNOWN = ("", "")
#: Quantity and dimension by the words after "Unit:" in the documentation of a function.
DOCUMENTED = {
    "length": ("displacement", LENGTH),
    "length/time": ("velocity", "length/time"),
    "length/time**2": ("acceleration", "length/time^2"),
    "rad": ("angle", ANGLE),
    "rad/time": ("angular velocity", "angle/time"),
    "rad/time**2": ("angular acceleration", "angle/time^2"),
    "force": ("force", FORCE),
    "force times length": ("torque", TORQUE),
}
#: Of functions like SFORCE(id, jflag, component, rm): 1 to 4 are a force, 5 to 8 a torque.
BY_COMPONENT = "force, or force times length"


def quantity_of(
    node: Node | None, deck: Deck, within: frozenset[int | str] = frozenset()
) -> tuple[str, str]:
    """Quantity and dimension of an expression, both empty where they are not known.

    A number in a sum or a bound has the dimension of the other terms.

    Parameters
    ----------
    node : Node or None
    deck : Deck
        Knows the variables that the expression refers to.
    within : frozenset
        Keys of the variables whose expression this is.
    """
    from adamslite.language.expression import NEGATE, Call, Op

    if isinstance(node, Op) and node.op in ("+", "-", NEGATE):
        return _shared(node.args, deck, within)
    if not isinstance(node, Call):
        return UNKNOWN
    if node.name in ("ABS", "MAX", "MIN"):
        return _shared(node.args, deck, within)
    if node.name == "VARVAL":
        return _of_variable(node.args[0], deck, within)
    return _of_function(node.name, node.args)


def _of_variable(ref: Node, deck: Deck, within: frozenset[int | str]) -> tuple[str, str]:
    from adamslite.language.expression import Ref

    variable = deck.find("VARIABLE", ref.id) if isinstance(ref, Ref) else None
    if variable is None or variable.key in within:
        return UNKNOWN
    return quantity_of(variable.function, deck, within | {variable.key})


def _shared(nodes: tuple[Node, ...], deck: Deck, within: frozenset[int | str]) -> tuple[str, str]:
    from adamslite.language.expression import Num

    found = {quantity_of(node, deck, within) for node in nodes if not isinstance(node, Num)}
    return found.pop() if len(found) == 1 else UNKNOWN


def _of_function(name: str, args: tuple[Node, ...]) -> tuple[str, str]:
    from adamslite.language.expression import Num

    words = documented(name)
    if words != BY_COMPONENT:
        return DOCUMENTED.get(words, UNKNOWN)
    component = args[2] if len(args) > 2 else None
    if not isinstance(component, Num):
        return UNKNOWN
    return DOCUMENTED["force" if component.value <= 4 else "force times length"]


@cache
def documented(name: str) -> str:
    """The words after "Unit:" in the documentation of a function of the deck language."""
    from adamslite.language.function import FUNCTIONS

    doc = " ".join(FUNCTIONS[name].doc.split()) if name in FUNCTIONS else ""
    match = re.search(r"Unit: ([^;.]*)", doc)
    return match[1].strip() if match else ""
