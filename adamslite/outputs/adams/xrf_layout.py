"""What the XML results files of ADAMS call elements, components and units."""

from __future__ import annotations

import base64
import json
import zlib

from adamslite.language.units import SYMBOLS
from adamslite.results.untrusted import from_json, inflated

NAMESPACE = "http://www.mscsoftware.com/:xrf10"
#: A line that holds the texts of the run, in base64 of compressed JSON.
OWN = "adamslite texts of the run:"
NUMBERS_PER_LINE = 6
#: From so many on, numbers have all their digits.
ALL_DIGITS = 17
#: By keyword what ADAMS calls an element; others have their keyword.
KINDS = {
    "PART": "Part", "POINT_MASS": "Point_Mass", "JOINT": "Joint", "MOTION": "Motion",
    "SFORCE": "Single_Component_Force", "VARIABLE": "ADAMS_Variable", "REQUEST": "Request",
    "CONTACT": "Contact", "FRICTION": "Friction",
}  # fmt: skip
MOTION_WORDS = {
    **{f"bcs_{name}": name.upper() for name in ("x", "y", "z", "psi", "theta", "phi")},
    **{f"bcs_v{axis}": f"V{axis.upper()}" for axis in "xyz"},
    **{f"w{axis}": f"W{axis.upper()}" for axis in "xyz"},
    **{f"bcs_a{axis}": f"ACC{axis.upper()}" for axis in "xyz"},
    **{f"al{axis}": f"WD{axis.upper()}" for axis in "xyz"},
}
"""Components of bodies, and those of ADAMS."""
REQUEST_NAMES = ("mag", "x", "y", "z", "amag", "r1", "r2", "r3")
REACTIONS = ("JOINT", "JPRIM", "MOTION", "GEAR", "COUPLER", "GCON", "PTCV", "CVCV")
APPLIED = ("SFORCE", "GFORCE", "VFORCE", "VTORQUE", "NFORCE", "BEAM", "BUSHING", "FIELD",
           "SPRINGDAMPER", "FRICTION")  # fmt: skip
SYSTEM = ("VARIABLE", "DIFF")
LEFT_OUT = {
    "NOREACTIONFORCES": REACTIONS, "NOAPPLIEDFORCES": APPLIED, "NOREQUESTS": ("REQUEST",),
    "NOCONTACTS": ("CONTACT",), "NOSYSTEMELEMENTS": SYSTEM,
}  # fmt: skip
"""Statements that words of RESULTS leave out."""
COMPONENTS_LEFT_OUT = {
    "NODISPLACEMENTS": ("X", "Y", "Z", "PSI", "THETA", "PHI"),
    "NOVELOCITIES": ("VX", "VY", "VZ", "WX", "WY", "WZ"),
    "NOACCELERATIONS": ("ACCX", "ACCY", "ACCZ", "WDX", "WDY", "WDZ"),
}
"""Components of bodies that words of RESULTS leave out."""
LENGTHS = {"METER": "meter", "MILLIMETER": "mm", "CENTIMETER": "cm", "KILOMETER": "km"}
UNITS = {
    **LENGTHS, "KILOGRAM": "kg", "NEWTON": "newton", "SECOND": "sec", "MILLISECONDS": "millisec",
    "MINUTE": "min",
}  # fmt: skip
"""Units as ADAMS writes them; those of which no file was seen are the words of the deck."""
#: Symbols by the words that files of ADAMS have for units.
SYMBOL_OF = {
    **{word.lower(): SYMBOLS[word] for word in SYMBOLS},
    **{word: SYMBOLS[name] for name, word in UNITS.items()},
    "radian": "rad", "second": "s", "degree": "deg", "kilogram": "kg", "newtons": "N",
}  # fmt: skip


def packed(texts: dict[str, str]) -> str:
    """Texts as one line of a comment."""
    return f"{OWN} {base64.b64encode(zlib.compress(json.dumps(texts).encode())).decode()}"


def unpacked(text: str) -> dict[str, str]:
    """The texts that :func:`packed` has put into a comment; empty of another comment."""
    marker, _, packed = text.strip().rpartition(" ")
    if marker != OWN:
        return {}
    return dict(from_json(inflated(base64.b64decode(packed))))
