"""What the columns of results are: their units, and a title for an axis.

Units are formed from those of the deck (``m``, ``m/s^2``, ``N m``); angles are in radians. They
are known for bodies, for forces, and for what expressions measure; CUNITS of a REQUEST names
others.

What a measuring function returns is known from its documentation, and passes through sums and
bounds.  A product may have any dimension, since a deck states no units for its numbers.
"""

from __future__ import annotations

import re
from functools import cache
from typing import TYPE_CHECKING, Any, NamedTuple

from adamslite.language.interfaces import key_of
from adamslite.language.units import SYMBOLS

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


QUANTITIES = {
    **dict.fromkeys(("x", "y", "z"), ("position", LENGTH)),
    **dict.fromkeys(("psi", "theta", "phi"), ("angle", ANGLE)),
    **dict.fromkeys(("vx", "vy", "vz"), ("velocity", "length/time")),
    **dict.fromkeys(("wx", "wy", "wz"), ("angular velocity", "angle/time")),
    **dict.fromkeys(("ax", "ay", "az"), ("acceleration", "length/time^2")),
    **dict.fromkeys(("alx", "aly", "alz"), ("angular acceleration", "angle/time^2")),
    **dict.fromkeys(("fx", "fy", "fz"), ("force", FORCE)),
    **dict.fromkeys(("tx", "ty", "tz"), ("torque", TORQUE)),
    "depth": ("depth", LENGTH),
    "incidents": ("touching points", ""),
}
"""Quantity and dimension by the last part of a column's name."""
SLIP = {
    **dict.fromkeys(("mux", "muy", "muz", "murx", "mury", "murz", "mu1"), ("coefficient", "")),
    **dict.fromkeys(("creep_x", "creep_y", "creep_z"), ("creep", LENGTH)),
    **dict.fromkeys(("creep_ax", "creep_ay", "creep_az"), ("creep", ANGLE)),
}
"""The same of FRICTION, beside forces and rates."""
REQUESTED = {
    "DISPLACEMENT": ("displacement", LENGTH, "angle", ANGLE),
    "VELOCITY": ("velocity", "length/time", "angular velocity", "angle/time"),
    "ACCELERATION": ("acceleration", "length/time^2", "angular acceleration", "angle/time^2"),
    "FORCE": ("force", FORCE, "torque", TORQUE),
}
ALONG = ("f",)


class Channel(NamedTuple):
    """A column: ``PART/2.x`` is component ``x`` of statement ``PART/2``.

    ``title``: a name given in the deck, or empty; ``quantity``: what the number is, in words;
    ``unit``: its symbol, empty without a dimension or where it is not known.
    """

    name: str
    statement: str
    component: str
    title: str = ""
    quantity: str = ""
    unit: str = ""

    @property
    def long_name(self) -> str:
        """``velocity vx of PART/2 (boom)``."""
        what = f"{self.quantity} {self.component}".strip()
        of = f"{self.statement} ({self.title})" if self.title else self.statement
        return f"{what} of {of}" if what else of


def describe(name: str, units: dict[str, str], deck: Deck | None = None) -> Channel:
    """What a column is.

    Parameters
    ----------
    units : dict
        Symbols by ``length``, ``time``, ``force``, as :func:`unit_symbols` has them.
    deck : Deck, optional
        Without it the kind of an SFORCE or REQUEST is not known.
    """
    label, _, component = name.rpartition(".")
    if not label or "/" not in label:
        label, component = name, ""
    keyword, _, _ = label.partition("/")
    found = statement_of(label, deck) if deck else None
    quantity, dimension = _quantity(keyword, component, found, deck)
    unit = _own_unit(found, component) or in_units(dimension, units)
    if not quantity and unit and unit == units.get(FORCE):
        quantity = "force"
    own = found.name or _comment(found) if found else ""
    title = ", ".join(filter(None, (own, _heading(found, component))))
    return Channel(name, label, component, title, quantity, unit)


def statement_of(label: str, deck: Deck) -> Any:
    """The statement that ``PART/2`` means; None where the deck has none."""
    keyword, _, id = label.partition("/")
    return deck.find(keyword, key_of(id))


def _quantity(keyword: str, component: str, found: Any, deck: Deck | None) -> tuple[str, str]:
    """Quantity and dimension."""
    if keyword in ("REQUEST", "VARIABLE"):
        return _expressed(found, component, deck) if found and deck else UNKNOWN
    if component in ALONG and keyword in ("SFORCE", "SPRINGDAMPER"):
        if found is None:
            return "force or torque", ""
        turns = getattr(found, "kind", "") == "ROTATIONAL"
        return ("torque", TORQUE) if turns else ("force", FORCE)
    known = {**QUANTITIES, **SLIP} if keyword == "FRICTION" else QUANTITIES
    return known.get(component, UNKNOWN)


def _is_request(found: Any) -> bool:
    return found is not None and found.keyword == "REQUEST"


def _expressed(found: Any, component: str, deck: Deck) -> tuple[str, str]:
    """Of a VARIABLE, or of a component of a REQUEST."""
    if found.keyword == "VARIABLE":
        return quantity_of(found.function, deck)
    if component not in found.result_names:  # of another deck
        return UNKNOWN
    number = int(component[1:])
    if found.variables:
        return quantity_of(deck.find("VARIABLE", found.variables[number - 1]).function, deck)
    if found.kind is None:
        return quantity_of(found.functions[number - 1], deck)
    at = 0 if number <= 4 else 2
    return REQUESTED[found.kind][at], REQUESTED[found.kind][at + 1]


def _own_unit(found: Any, component: str) -> str:
    """What CUNITS of a REQUEST names for a component."""
    named = found.cunits if _is_request(found) else ()
    number = int(component[1:]) if component[1:].isdecimal() else 0
    return named[number - 1] if 0 < number <= len(named) else ""


def _heading(found: Any, component: str) -> str:
    """What CLABELS, CNAMES or TITLE (eight headings with colons between) of a REQUEST name it."""
    if not _is_request(found) or not component[1:].isdecimal():
        return ""
    at = int(component[1:]) - 1
    for named in (found.clabels, found.cnames, (found.title or "").split(":")):
        if at < len(named) and named[at].strip():
            return str(named[at]).strip()
    return ""


def _comment(found: Any) -> str:
    return str(getattr(found, "comment", None) or "")


def in_units(dimension: str, units: dict[str, str]) -> str:
    """``length/time^2`` as ``m/s^2``; empty where a unit of it is not known."""
    if dimension == TORQUE:
        parts = [units.get(FORCE, ""), units.get(LENGTH, "")]
        return " ".join(parts) if all(parts) else ""
    top, _, bottom = dimension.partition("/")
    upper = "rad" if top == ANGLE else units.get(top, "")
    base, power, exponent = bottom.partition("^")
    lower = units.get(base, "") + power + exponent if units.get(base) else ""
    if not bottom:
        return upper
    return f"{upper}/{lower}" if upper and lower else ""


def of_argument(dimension: str, units: dict[str, str]) -> str:
    """The unit of an argument, ``force time/length``, as ``N s/m``; empty where it has none, or one
    that depends on others.
    """
    known = {**units, ANGLE: "rad", TORQUE: in_units(TORQUE, units)}
    words = set(re.findall(r"[a-z]+", dimension))
    if not words or not all(known.get(word) for word in words) or "," in dimension:
        return ""
    return re.sub(r"[a-z]+", lambda word: known[word[0]], dimension)


def unit_symbols(names: str) -> dict[str, str]:
    """Symbols of the units that the comment ``units`` of results names: force, mass, length, time.

    Empty where the deck names none.
    """
    words = names.split()
    if len(words) != 4 or any(word not in SYMBOLS for word in words):
        return {}
    symbols = (SYMBOLS[word] for word in words)
    return dict(zip((FORCE, "mass", LENGTH, TIME), symbols, strict=True))


def with_units(units: dict[str, str]) -> dict[str, Channel]:
    """Columns by name, of which a file knows the unit."""
    return {name: describe(name, {})._replace(unit=unit) for name, unit in units.items() if unit}
