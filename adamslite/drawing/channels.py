"""Channels for plots: every column of the results, with its unit and the name of its statement."""

from __future__ import annotations

from typing import Any

import numpy as np

from adamslite.deck.deck import Deck
from adamslite.drawing.arrays import Block
from adamslite.drawing.decimation import points
from adamslite.elements.units import Units
from adamslite.results.results import Results

SYMBOLS = {
    "NEWTON": "N", "KNEWTON": "kN", "CENTINEWTON": "cN", "DYNE": "dyn", "MEGANEWTON": "MN",
    "MICRONEWTON": "uN", "MILLINEWTON": "mN", "NANONEWTON": "nN", "KILOGRAM_FORCE": "kgf",
    "POUND_FORCE": "lbf", "KPOUND_FORCE": "klbf", "OUNCE_FORCE": "ozf", "POUNDAL": "pdl",
    "KILOGRAM": "kg", "GRAM": "g", "MILLIGRAM": "mg", "MICROGRAM": "ug", "NANOGRAM": "ng",
    "TONNE": "t", "US_TON": "ton", "POUND_MASS": "lb", "KPOUND_MASS": "klb", "OUNCE_MASS": "oz",
    "SLUG": "slug", "SLINCH": "slinch",
    "METER": "m", "CENTIMETER": "cm", "MILLIMETER": "mm", "MICROMETER": "um", "NANOMETER": "nm",
    "KILOMETER": "km", "ANGSTROM": "A", "INCH": "in", "FOOT": "ft", "YARD": "yd", "MILE": "mi",
    "MILS": "mil", "MICROINCH": "uin",
    "SECOND": "s", "MILLISECONDS": "ms", "MICROSECOND": "us", "NANOSECOND": "ns", "MINUTE": "min",
    "HOUR": "h", "DAY": "d",
}  # fmt: skip
"""Names of units in a deck, and how they are written on an axis."""

EXACT = 150_000
"""Numbers of all channels up to which each has seven digits."""
LEVELS = 8191
"""Steps of the range of a channel, where there are more: no screen shows them."""
LISTED = 300
"""Channels that are listed in plain text; more are compressed."""


def unit_symbols(deck: Deck) -> dict[str, str]:
    """Symbols of length, mass, time, force and angle; empty where the deck does not name them."""
    names = deck.single(Units).names or ("", "", "", "")
    force, mass, length, time = (SYMBOLS.get(name, name.lower()) for name in names)
    return {"length": length, "mass": mass, "time": time, "force": force, "angle": "rad"}


def channels(deck: Deck, results: Results, block: Block) -> dict[str, Any]:
    """All columns over times of their own."""
    symbols = unit_symbols(deck)
    statements = {each.label: each for each in deck.statements}
    time, values = points(results.time, results.values)
    fits = values.size <= EXACT
    named = []
    for column, name in enumerate(results.names):
        label, _, suffix = name.partition(".")
        statement = statements.get(label)
        own = values[:, column]
        named.append({
            "name": name,
            "unit": unit_of(getattr(statement, "keyword", ""), statement, suffix, symbols),
            "label": (statement.name if statement else None) or "",
            "values": block.f32(own) if fits or not _is_finite(own) else block.i16(own, LEVELS),
        })  # fmt: skip
    listed = block.json(named) if len(named) > LISTED else named
    return {"times": block.f32(time), "list": listed}


def _is_finite(values: np.ndarray) -> bool:
    return bool(len(values)) and bool(np.isfinite(values).all())


def unit_of(keyword: str, statement: object, suffix: str, symbols: dict[str, str]) -> str:
    """The unit of a column, as text; empty where the program does not know it."""
    length, time, force = symbols["length"], symbols["time"], symbols["force"]
    if not (length and time and force):
        return ""
    if keyword in BODIES:
        pattern = OF_BODY[suffix.rstrip("xyz") or "x"]
        return pattern.format(length=length, time=time)
    if keyword in ALONG_LINE and suffix == "f":
        suffix = "tx" if getattr(statement, "kind", "") == "ROTATIONAL" else "fx"
    return {"f": force, "t": f"{force} {length}"}.get(suffix[0], "") if suffix in WRENCH else ""


BODIES, ALONG_LINE = ("PART", "POINT_MASS"), ("SFORCE", "SPRINGDAMPER")
OF_BODY = {
    "": "", "x": "{length}", "psi": "rad", "theta": "rad", "phi": "rad", "v": "{length}/{time}",
    "w": "rad/{time}", "a": "{length}/{time}^2", "al": "rad/{time}^2",
}  # fmt: skip
"""Units of the columns of a body, by name without the axis."""
WRENCH = ("fx", "fy", "fz", "tx", "ty", "tz")
