"""What expressions of a deck measure."""

from __future__ import annotations

import pytest

import adamslite
from adamslite.language import units
from adamslite.language.function import FUNCTIONS
from adamslite.results.channels import DOCUMENTED, describe, documented

DECK = adamslite.read("""\
requests of all kinds
PART/1, GROUND
MARKER/1, PART=1
PART/2, MASS=1, CM=2, IP=1,1,1
MARKER/2, PART=2
VARIABLE/7, FUNCTION=DM(1,2)-0.5
VARIABLE/8, FUNCTION=VARVAL(9)
VARIABLE/9, FUNCTION=VARVAL(8)+1
SPRINGDAMPER/1, TRANSLATIONAL, I=2, J=1, K=1, LENGTH=1
SPRINGDAMPER/2, ROTATIONAL, I=2, J=1, KT=1
SFORCE/3, ROTATIONAL, I=2, J=1, FUNCTION=1
REQUEST/1, F1=DM(2,1)\\F2=-VX(2)\\F3=2*VX(2)\\F4=MAX(0, WZ(2))\\F5=VARVAL(7)
REQUEST/2, DISPLACEMENT, I=2, J=1
REQUEST/3, FORCE, I=2, J=1
REQUEST/4, F1=SFORCE(3,0,2,0)\\F2=SFORCE(3,0,8,0)\\F3=DX(2)+VX(2)\\F4=VARVAL(8)\\F5=TIME
REQUEST/5, VARIABLES=7
END
""")
MM = {"force": "N", "mass": "kg", "length": "mm", "time": "s"}


@pytest.mark.parametrize(
    ("column", "quantity", "unit"),
    [
        ("REQUEST/1.F1", "displacement", "mm"),
        ("REQUEST/1.F2", "velocity", "mm/s"),
        ("REQUEST/1.F3", "", ""),  # the number 2 may have any dimension
        ("REQUEST/1.F4", "angular velocity", "rad/s"),
        ("REQUEST/1.F5", "displacement", "mm"),
        ("REQUEST/2.F1", "displacement", "mm"),
        ("REQUEST/2.F8", "angle", "rad"),
        ("REQUEST/3.F4", "force", "N"),
        ("REQUEST/3.F5", "torque", "N mm"),
        ("REQUEST/4.F1", "force", "N"),
        ("REQUEST/4.F2", "torque", "N mm"),
        ("REQUEST/4.F3", "", ""),  # a length and a speed
        ("REQUEST/4.F4", "", ""),  # two variables that refer to one another
        ("REQUEST/4.F5", "", ""),
        ("REQUEST/5.F1", "displacement", "mm"),
        ("REQUEST/99.F1", "", ""),  # of another deck
        ("REQUEST/5.F2", "", ""),  # likewise
        ("REQUEST/5.X", "", ""),
        ("VARIABLE/7", "displacement", "mm"),
        ("SPRINGDAMPER/1.f", "force", "N"),
        ("SPRINGDAMPER/2.f", "torque", "N mm"),
        ("SFORCE/3.f", "torque", "N mm"),
    ],
)
def test_columns_of_expressions(column: str, quantity: str, unit: str) -> None:
    found = describe(column, MM, DECK)
    assert (found.quantity, found.unit) == (quantity, unit)


@pytest.mark.parametrize(
    ("column", "quantity", "unit"),
    [
        ("FRICTION/1.mux", "coefficient", ""),
        ("FRICTION/1.creep_ax", "creep", "rad"),
        ("FRICTION/1.vx", "velocity", "mm/s"),
        ("CONTACT/1.depth", "depth", "mm"),
        ("SFORCE/5.f", "force or torque", ""),
        ("GCON/1.f", "", ""),
        ("REQUEST/1.F2", "", ""),
        ("VARIABLE/7", "", ""),
    ],
)
def test_columns_without_the_deck(column: str, quantity: str, unit: str) -> None:
    found = describe(column, MM)
    assert (found.quantity, found.unit) == (quantity, unit)


def test_every_unit_of_the_language_has_a_symbol_of_its_own() -> None:
    names = {*units.FORCE, *units.MASS, *units.LENGTH, *units.TIME}
    assert names == units.SYMBOLS.keys()
    assert len(set(units.SYMBOLS.values())) == len(units.SYMBOLS)


def test_the_documented_dimensions_are_understood() -> None:
    """A function that measures a motion or a force states a dimension that is known."""
    known = {name for name in FUNCTIONS if documented(name) in DOCUMENTED}
    assert {"DM", "DX", "VM", "VZ", "ACCX", "AX", "PSI", "WM", "WDTZ", "FX", "TZ"} <= known
