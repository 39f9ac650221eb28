"""What columns of results are: quantity, unit and title."""

from __future__ import annotations

import pickle

import numpy as np
import pytest

import adamslite
from adamslite.results.channels import describe
from adamslite.results.results import Results, UnknownChannel

DECK = """\
a pendulum and a spring
UNITS/FORCE=NEWTON, MASS=KILOGRAM, LENGTH=MILLIMETER, TIME=SECOND
PART/1, GROUND
MARKER/1, PART=1
! adams_view_name='the boom'
PART/2, MASS=1, CM=2, IP=1,1,1
MARKER/2, PART=2
MARKER/3, PART=2
JOINT/1, REVOLUTE, I=3, J=1
SFORCE/1, ROTATION, I=3, J=1, FUNCTION=-AZ(3,1)
SFORCE/2, I=2, J=1, FUNCTION=0
VARIABLE/V, FUNCTION=TIME
REQUEST/1, DISPLACEMENT, I=2, COMMENT=the tip
REQUEST/2, F2=TIME\\ F3=TIME, CUNITS="","hPa"
SIMULATE/DYNAMIC, END=1, STEPS=2
END
"""
UNITS = {
    "time": "s", "PART/2.x": "mm", "PART/2.psi": "rad", "PART/2.vy": "mm/s", "PART/2.wz": "rad/s",
    "PART/2.az": "mm/s^2", "PART/2.alx": "rad/s^2", "JOINT/1.fx": "N", "JOINT/1.tz": "N mm",
    "SFORCE/1.f": "N mm", "SFORCE/2.f": "N", "VARIABLE/V": "", "REQUEST/1.F2": "mm",
    "REQUEST/1.F8": "rad", "REQUEST/2.F2": "hPa", "REQUEST/2.F3": "",
}  # fmt: skip


@pytest.fixture(scope="module")
def results() -> Results:
    return adamslite.simulate(adamslite.read(DECK))


@pytest.mark.parametrize("name", UNITS)
def test_units_are_those_of_the_deck(results: Results, name: str) -> None:
    assert results.channel(name).unit == UNITS[name]


def test_a_title_has_the_name_that_the_deck_gives(results: Results) -> None:
    assert results.channel("part/2.vx").long_name == "velocity vx of PART/2 (the boom)"
    assert results.channel("REQUEST/1.F2").long_name == "displacement F2 of REQUEST/1 (the tip)"
    assert results.channel("VARIABLE/V").long_name == "VARIABLE/V"


def test_units_are_known_after_pickling(results: Results) -> None:
    again = pickle.loads(pickle.dumps(results))
    assert again.channel("SFORCE/1.f") == results.channel("SFORCE/1.f")


def test_a_wrong_name_has_no_unit(results: Results) -> None:
    with pytest.raises(UnknownChannel, match="did you mean PART/2.x"):
        results.channel("PART/2.xx")


def test_a_table_alone_knows_bodies_but_not_the_kind_of_a_force() -> None:
    """Nothing is made up where the deck is not at hand, or names no units."""
    names = ("PART/2.x", "SFORCE/1.f", "REQUEST/1.F2", "odd", ".", "a.b")
    meta = {"units": "NEWTON KILOGRAM METER SECOND"}
    table = Results(time=np.zeros(0), names=names, values=np.zeros((0, 6)), meta=meta)
    assert [table.channel(name).unit for name in names] == ["m", "", "", "", "", ""]
    assert describe("PART/2.x", {}).unit == ""
    assert describe("PART/2.psi", {}).unit == "rad"
    assert describe("PART/2.wx", {}).unit == ""


def test_components_of_a_request_have_the_names_that_the_deck_gives() -> None:
    deck = adamslite.read(
        DECK.replace(
            "SIMULATE",
            'REQUEST/3, F2=TIME\\F3=TIME\\F4=TIME, CNAMES="","tension", TITLE=a:b:c:depth\n'
            "REQUEST/4, F2=TIME, COMMENT=rope, TITLE=a:pull\nSIMULATE",
        )
    )
    names = ("REQUEST/3.F2", "REQUEST/3.F3", "REQUEST/3.F4", "REQUEST/4.F2", "REQUEST/4.F8")
    found = {name: describe(name, {}, deck).title for name in names}
    assert found == {
        "REQUEST/3.F2": "tension", "REQUEST/3.F3": "c", "REQUEST/3.F4": "depth",
        "REQUEST/4.F2": "rope, pull", "REQUEST/4.F8": "rope",
    }  # fmt: skip


def test_what_has_the_unit_of_a_force_is_a_force() -> None:
    deck = adamslite.read(DECK.replace('CUNITS="","hPa"', 'CUNITS="N","hPa"'))
    units = {"force": "N", "length": "m"}
    assert describe("REQUEST/2.F1", units, deck)[4:] == ("force", "N")
    assert describe("REQUEST/2.F2", units, deck)[4:] == ("", "hPa")
    assert describe("REQUEST/2.F1", {}, deck)[4:] == ("", "N")
