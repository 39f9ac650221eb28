"""What a column of results holds, and in which unit."""

from __future__ import annotations

import pytest

import adamslite
from adamslite.language import units
from adamslite.language.function import FUNCTIONS
from adamslite.results.quantities import (
    SYMBOLS,
    UNKNOWN,
    UnitSymbols,
    quantity_of,
    unit_symbols,
)

MKS = unit_symbols({"units": "NEWTON KILOGRAM METER SECOND"})
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


@pytest.mark.parametrize(
    ("column", "name", "unit"),
    [
        ("time", "time", "s"),
        ("PART/2.x", "position", "m"),
        ("part/2.PSI", "angle", "rad"),
        ("POINT_MASS/2.vy", "velocity", "m/s"),
        ("PART/2.wz", "angular velocity", "rad/s"),
        ("PART/2.az", "acceleration", "m/s^2"),
        ("PART/2.alz", "angular acceleration", "rad/s^2"),
        ("JOINT/3.fx", "force", "N"),
        ("JOINT/3.ty", "torque", "N m"),
        ("CONTACT/1.depth", "depth", "m"),
        ("FRICTION/1.mux", "ratio", ""),
        ("FRICTION/1.creep_ax", "angle", "rad"),
        ("SFORCE/5.f", "force or torque", "N or N m"),
        ("GCON/1.f", "", ""),
        ("VARIABLE/Dm", "", ""),
        ("VARIABLE/a.x", "", ""),
        ("REQUEST/1.F2", "", ""),
        ("", "", ""),
        ("PART/2", "", ""),
        ("PART/2.q", "", ""),
    ],
)
def test_columns_without_the_deck(column: str, name: str, unit: str) -> None:
    found = quantity_of(column)
    assert (found.name, MKS.of(found)) == (name, unit)


@pytest.mark.parametrize(
    ("column", "name"),
    [
        ("REQUEST/1.F1", "displacement"),
        ("REQUEST/1.F2", "velocity"),
        ("REQUEST/1.F3", ""),  # the number 2 may have any dimension
        ("REQUEST/1.F4", "angular velocity"),
        ("REQUEST/1.F5", "displacement"),
        ("REQUEST/2.F1", "displacement"),
        ("REQUEST/2.F5", ""),  # no component, always 0
        ("REQUEST/2.F8", "angle"),
        ("REQUEST/3.F4", "force"),
        ("REQUEST/3.F5", "torque"),
        ("REQUEST/4.F1", "force"),
        ("REQUEST/4.F2", "torque"),
        ("REQUEST/4.F3", ""),  # a length and a speed
        ("REQUEST/4.F4", ""),  # two variables that refer to one another
        ("REQUEST/4.F5", ""),
        ("REQUEST/5.F1", "displacement"),
        ("REQUEST/99.F1", ""),  # of another deck
        ("REQUEST/5.F2", ""),  # likewise
        ("REQUEST/5.X", ""),
        ("VARIABLE/7", "displacement"),
        ("SPRINGDAMPER/1.f", "force"),
        ("SPRINGDAMPER/2.f", "torque"),
        ("SFORCE/3.f", "torque"),
    ],
)
def test_columns_with_the_deck(column: str, name: str) -> None:
    assert quantity_of(column, DECK).name == name


@pytest.mark.parametrize("meta", [{}, {"units": "as in the deck"}, {"units": "meter kilogram"}])
def test_units_that_are_not_named_are_not_invented(meta: dict[str, str]) -> None:
    assert unit_symbols(meta) == UnitSymbols()
    assert unit_symbols(meta).of(quantity_of("PART/2.vx")) == ""
    assert unit_symbols(meta).of(quantity_of("PART/2.wx")) == ""  # rad per what?
    assert unit_symbols(meta).of(quantity_of("PART/2.psi")) == "rad"


def test_every_unit_of_the_language_has_a_symbol_of_its_own() -> None:
    names = {*units.FORCE, *units.MASS, *units.LENGTH, *units.TIME}
    assert names == SYMBOLS.keys()
    assert len(set(SYMBOLS.values())) == len(SYMBOLS)


def test_the_documented_dimensions_are_understood() -> None:
    """A function that measures a marker's motion or a force states a dimension that is known."""
    from adamslite.results.quantities import _BY_DIMENSION, _dimension

    known = {name for name in FUNCTIONS if _dimension(name) in _BY_DIMENSION}
    assert {"DM", "DX", "VM", "VZ", "ACCX", "AX", "PSI", "WM", "WDTZ", "FX", "TZ"} <= known
    assert quantity_of("REQUEST/1.F1") is UNKNOWN
