"""Quantities and units of result columns: what the axes of a plot and the heads of a table show.

The components of bodies and of forces have fixed quantities. Those of a REQUEST, a VARIABLE or a
rotational force follow from the deck; without it, and where an expression multiplies or divides,
the quantity is not known.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from adamslite.deck.deck import Deck
    from adamslite.language.expression import Node


class Quantity(NamedTuple):
    """A name for people, and the dimension in the words of the functions' documentation."""

    name: str = ""
    dimension: str = ""


UNKNOWN = Quantity()
NONE = Quantity("ratio", "none")
POSITION = Quantity("position", "length")
ANGLE = Quantity("angle", "rad")
VELOCITY = Quantity("velocity", "length/time")
SPIN = Quantity("angular velocity", "rad/time")
ACCELERATION = Quantity("acceleration", "length/time**2")
SPIN_UP = Quantity("angular acceleration", "rad/time**2")
FORCE = Quantity("force", "force")
TORQUE = Quantity("torque", "force times length")
EITHER = Quantity("force or torque", "force, or force times length")
DISPLACEMENT = Quantity("displacement", "length")
COUNT = Quantity("number of contacts", "none")

BODIES = ("PART", "POINT_MASS")
_OF_BODIES = {
    **dict.fromkeys(("x", "y", "z"), POSITION),
    **dict.fromkeys(("psi", "theta", "phi"), ANGLE),
    **dict.fromkeys(("vx", "vy", "vz"), VELOCITY),
    **dict.fromkeys(("wx", "wy", "wz"), SPIN),
    **dict.fromkeys(("ax", "ay", "az"), ACCELERATION),
    **dict.fromkeys(("alx", "aly", "alz"), SPIN_UP),
}
_OF_ELEMENTS = {
    **dict.fromkeys(("fx", "fy", "fz"), FORCE),
    **dict.fromkeys(("tx", "ty", "tz"), TORQUE),
    **dict.fromkeys(("vx", "vy", "vz"), VELOCITY),
    **dict.fromkeys(("wx", "wy", "wz"), SPIN),
    **dict.fromkeys(("mux", "muy", "muz", "murx", "mury", "murz", "mu1", "beta"), NONE),
    **dict.fromkeys(("creep_x", "creep_y", "creep_z"), DISPLACEMENT),
    **dict.fromkeys(("creep_ax", "creep_ay", "creep_az"), ANGLE),
    "depth": Quantity("depth", "length"),
    "incidents": COUNT,
}
#: Quantities of functions of the deck language, by the dimension in their documentation.
_BY_DIMENSION = {
    q.dimension: q
    for q in (DISPLACEMENT, VELOCITY, ACCELERATION, ANGLE, SPIN, SPIN_UP, FORCE, TORQUE)
}

SYMBOLS = {
    "CENTINEWTON": "cN", "DYNE": "dyn", "KILOGRAM_FORCE": "kgf", "KNEWTON": "kN",
    "KPOUND_FORCE": "kip", "MEGANEWTON": "MN", "MICRONEWTON": "uN", "MILLINEWTON": "mN",
    "NANONEWTON": "nN", "NEWTON": "N", "OUNCE_FORCE": "ozf", "POUND_FORCE": "lbf",
    "POUNDAL": "pdl",
    "GRAM": "g", "KILOGRAM": "kg", "KPOUND_MASS": "klb", "MILLIGRAM": "mg", "MICROGRAM": "ug",
    "NANOGRAM": "ng", "OUNCE_MASS": "oz", "POUND_MASS": "lb", "SLINCH": "slinch", "SLUG": "slug",
    "TONNE": "t", "US_TON": "ton",
    "ANGSTROM": "angstrom", "CENTIMETER": "cm", "FOOT": "ft", "KILOMETER": "km", "INCH": "in",
    "METER": "m", "MICROINCH": "uin", "MICROMETER": "um", "MILE": "mi", "MILLIMETER": "mm",
    "MILS": "mil", "NANOMETER": "nm", "YARD": "yd",
    "DAY": "d", "HOUR": "h", "MICROSECOND": "us", "MILLISECONDS": "ms", "MINUTE": "min",
    "NANOSECOND": "ns", "SECOND": "s",
}  # fmt: skip


@dataclass(frozen=True)
class UnitSymbols:
    """Symbols of the units of results; empty where the deck does not name them."""

    force: str = ""
    mass: str = ""
    length: str = ""
    time: str = ""
    angle: str = "rad"

    def of(self, quantity: Quantity) -> str:
        """The unit of a quantity (``m/s^2``, ``N m``), empty where it is not known or a number."""
        if quantity == EITHER:
            force, torque = self.of(FORCE), self.of(TORQUE)
            return f"{force} or {torque}" if force else ""
        known = {"length": self.length, "time": self.time, "force": self.force, "rad": self.angle}
        top, _, below = quantity.dimension.partition("/")
        factors = [known.get(word, "") for word in top.split(" times ")]
        base, _, power = below.partition("**")
        under = known.get(base, "")
        if not all(factors) or (base and not under):
            return ""
        return " ".join(factors) + (f"/{under}" if under else "") + (f"^{power}" if power else "")


def unit_symbols(meta: Mapping[str, str]) -> UnitSymbols:
    """The units of results, from the comment ``units`` of their file."""
    words = meta.get("units", "").upper().split()
    if len(words) != 4 or not set(words) <= SYMBOLS.keys():
        return UnitSymbols()
    force, mass, length, time = (SYMBOLS[word] for word in words)
    return UnitSymbols(force, mass, length, time)


def parts_of(column: str) -> tuple[str, str, str]:
    """Keyword, id and component of a column: ``PART``, ``2``, ``x``; empty where there is none."""
    keyword, slash, rest = column.partition("/")
    if not slash:
        return "", "", ""
    if keyword.upper() in ("VARIABLE", "DIFF"):
        return keyword.upper(), rest, ""
    name, dot, component = rest.rpartition(".")
    return (keyword.upper(), name, component) if dot else (keyword.upper(), rest, "")


def quantity_of(column: str, deck: Deck | None = None) -> Quantity:
    """What a column holds.

    Parameters
    ----------
    column : str
        As results name it: ``PART/2.x``, ``REQUEST/1.F2``, ``time``.
    deck : Deck, optional
        That of the run: without it nothing is known of a REQUEST or a VARIABLE.
    """
    if column.casefold() == "time":
        return Quantity("time", "time")
    keyword, name, component = parts_of(column)
    if keyword in BODIES:
        return _OF_BODIES.get(component.casefold(), UNKNOWN)
    if keyword in ("SFORCE", "SPRINGDAMPER"):
        return _along_a_line(keyword, name, deck)
    if keyword in ("REQUEST", "VARIABLE"):
        return _of_expression(keyword, name, component, deck) if deck else UNKNOWN
    return _OF_ELEMENTS.get(component.casefold(), UNKNOWN)


def _key(name: str) -> int | str:
    return int(name) if name.isdecimal() else name


def _along_a_line(keyword: str, name: str, deck: Deck | None) -> Quantity:
    statement = deck.find(keyword, _key(name)) if deck else None
    if statement is None:
        return EITHER
    return TORQUE if statement.kind == "ROTATIONAL" else FORCE


def _of_expression(keyword: str, name: str, component: str, deck: Deck) -> Quantity:
    statement = deck.find(keyword, _key(name))
    if statement is None:
        return UNKNOWN
    if keyword == "VARIABLE":
        return expressed(statement.function, deck)
    if component.upper() not in statement.result_names:  # results of another deck
        return UNKNOWN
    at = int(component[1:]) - 1
    if statement.variables:
        return _of_expression("VARIABLE", str(statement.variables[at]), "", deck)
    if statement.kind:
        return measured(statement.kind, at)
    return expressed(statement.functions[at], deck)


def measured(kind: str, at: int) -> Quantity:
    """Component F(at + 1) of a REQUEST of a marker's motion or of a force."""
    linear, angular = {
        "DISPLACEMENT": (DISPLACEMENT, ANGLE), "VELOCITY": (VELOCITY, SPIN),
        "ACCELERATION": (ACCELERATION, SPIN_UP), "FORCE": (FORCE, TORQUE),
    }[kind]  # fmt: skip
    if kind == "DISPLACEMENT" and at == 4:  # no component: always 0
        return UNKNOWN
    return linear if at < 4 else angular


def expressed(node: Node | None, deck: Deck, within: frozenset[str] = frozenset()) -> Quantity:
    """The quantity of an expression: of a measured value, or of sums and bounds of such values.

    A number in a sum or a bound has the dimension of the others. ``within`` are the variables that
    are being looked into.
    """
    from adamslite.language.expression import NEGATE, Call, Op, Ref

    if isinstance(node, Op) and node.op in ("+", "-", NEGATE):
        return _shared(node.args, deck, within)
    if not isinstance(node, Call):
        return UNKNOWN
    if node.name in ("ABS", "MAX", "MIN"):
        return _shared(node.args, deck, within)
    if node.name == "VARVAL" and isinstance(node.args[0], Ref):
        key = str(node.args[0].id)
        statement = deck.find("VARIABLE", node.args[0].id)
        if statement is None or key in within:
            return UNKNOWN
        return expressed(statement.function, deck, within | {key})
    return _of_function(node.name, node.args)


def _shared(nodes: tuple[Node, ...], deck: Deck, within: frozenset[str]) -> Quantity:
    from adamslite.language.expression import Num

    found = {expressed(node, deck, within) for node in nodes if not isinstance(node, Num)}
    return found.pop() if len(found) == 1 else UNKNOWN


def _of_function(name: str, args: tuple[Node, ...]) -> Quantity:
    from adamslite.language.expression import Num

    dimension = _dimension(name)
    if dimension == EITHER.dimension:  # SFORCE(id, jflag, component, rm) and its like
        third = args[2] if len(args) > 2 else None
        if not isinstance(third, Num):
            return UNKNOWN
        return FORCE if third.value <= 4 else TORQUE
    return _BY_DIMENSION.get(dimension, UNKNOWN)


@cache
def _dimension(name: str) -> str:
    """The words after "Unit:" in the documentation of a function of the deck language."""
    from adamslite.language.function import FUNCTIONS

    doc = " ".join(FUNCTIONS[name].doc.split()) if name in FUNCTIONS else ""
    match = re.search(r"Unit: ([^;.]*)", doc)
    return match[1].strip() if match else ""
