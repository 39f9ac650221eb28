"""Units of force, mass, length and time, and the factor UCF that relates them.

Equation::

    force * UCF = mass * acceleration

With newton, kilogram, millimetre and second UCF is 1000; with pound-force, pound-mass, inch and
second it is 386.0886.
"""

from __future__ import annotations

G0 = 9.80665  # m/s^2, defines kilogram-force and pound-force (CGPM 1901)
POUND = 0.45359237  # kg, international pound (1959)
INCH = 0.0254  # m, international inch (1959)

FORCE = {
    "CENTINEWTON": 1e-2,
    "DYNE": 1e-5,
    "KILOGRAM_FORCE": G0,
    "KNEWTON": 1e3,
    "KPOUND_FORCE": 1e3 * POUND * G0,
    "MEGANEWTON": 1e6,
    "MICRONEWTON": 1e-6,
    "MILLINEWTON": 1e-3,
    "NANONEWTON": 1e-9,
    "NEWTON": 1.0,
    "OUNCE_FORCE": POUND * G0 / 16,
    "POUND_FORCE": POUND * G0,
    "POUNDAL": POUND * 12 * INCH,
}
MASS = {
    "GRAM": 1e-3,
    "KILOGRAM": 1.0,
    "KPOUND_MASS": 1e3 * POUND,
    "MILLIGRAM": 1e-6,
    "MICROGRAM": 1e-9,
    "NANOGRAM": 1e-12,
    "OUNCE_MASS": POUND / 16,
    "POUND_MASS": POUND,
    "SLINCH": POUND * G0 / INCH,
    "SLUG": POUND * G0 / (12 * INCH),
    "TONNE": 1e3,
    "US_TON": 2e3 * POUND,
}
LENGTH = {
    "ANGSTROM": 1e-10,
    "CENTIMETER": 1e-2,
    "FOOT": 12 * INCH,
    "KILOMETER": 1e3,
    "INCH": INCH,
    "METER": 1.0,
    "MICROINCH": 1e-6 * INCH,
    "MICROMETER": 1e-6,
    "MILE": 63360 * INCH,
    "MILLIMETER": 1e-3,
    "MILS": 1e-3 * INCH,
    "NANOMETER": 1e-9,
    "YARD": 36 * INCH,
}
TIME = {
    "DAY": 86400.0,
    "HOUR": 3600.0,
    "MICROSECOND": 1e-6,
    "MILLISECONDS": 1e-3,
    "MINUTE": 60.0,
    "NANOSECOND": 1e-9,
    "SECOND": 1.0,
}
SYSTEMS = {
    "CGS": ("DYNE", "GRAM", "CENTIMETER", "SECOND"),
    "FPS": ("POUND_FORCE", "POUND_MASS", "FOOT", "SECOND"),
    "IPS": ("POUND_FORCE", "POUND_MASS", "INCH", "SECOND"),
    "MKS": ("NEWTON", "KILOGRAM", "METER", "SECOND"),
}
NO_SYSTEM = "NONE"
SYMBOLS = {
    "CENTINEWTON": "cN", "DYNE": "dyn", "KILOGRAM_FORCE": "kgf", "KNEWTON": "kN",
    "KPOUND_FORCE": "klbf", "MEGANEWTON": "MN", "MICRONEWTON": "uN", "MILLINEWTON": "mN",
    "NANONEWTON": "nN", "NEWTON": "N", "OUNCE_FORCE": "ozf", "POUND_FORCE": "lbf",
    "POUNDAL": "pdl", "GRAM": "g", "KILOGRAM": "kg", "KPOUND_MASS": "klb", "MILLIGRAM": "mg",
    "MICROGRAM": "ug", "NANOGRAM": "ng", "OUNCE_MASS": "oz", "POUND_MASS": "lb",
    "SLINCH": "slinch", "SLUG": "slug", "TONNE": "t", "US_TON": "ton", "ANGSTROM": "angstrom",
    "CENTIMETER": "cm", "FOOT": "ft", "KILOMETER": "km", "INCH": "in", "METER": "m",
    "MICROINCH": "uin", "MICROMETER": "um", "MILE": "mi", "MILLIMETER": "mm", "MILS": "mil",
    "NANOMETER": "nm", "YARD": "yd", "DAY": "d", "HOUR": "h", "MICROSECOND": "us",
    "MILLISECONDS": "ms", "MINUTE": "min", "NANOSECOND": "ns", "SECOND": "s",
}  # fmt: skip
"""How the units are written beside numbers."""


def conversion(force: str, mass: str, length: str, time: str) -> float:
    """The factor UCF for the named units.

    Rounded to 12 digits, so that a system meant to be coherent gives exactly 1.
    """
    factor = FORCE[force] * TIME[time] ** 2 / (MASS[mass] * LENGTH[length])
    return float(f"{factor:.12g}")
