"""ARRAY with ARYVAL: constants are numbers, inputs are VARIABLEs; STRING is inert."""

from __future__ import annotations

import pytest
from decklets import deck_with, function
from scenes import GROUND

import adamslite as al
from adamslite.language.expression import Call, Num, Op, Ref
from adamslite.reading.read import read, read_commands

ARRAYS = """ARRAY/1, IC, SIZE=3, NUMBERS=2,-3D,1E3
ARRAY/named, NUMBERS=5
VARIABLE/7, FUNCTION=TIME
VARIABLE/8, FUNCTION=2*TIME
ARRAY/2, U, VARIABLES=8,7"""


def test_constants_are_numbers_and_inputs_are_variables() -> None:
    assert function("ARYVAL(1,3)", ARRAYS) == Num(1000.0)
    assert function("ARYVAL(NAMED,1)", ARRAYS) == Num(5.0)
    assert function("ARYVAL(2,1)", ARRAYS) == Call("VARVAL", (Ref("VARIABLE", 8),))
    product = function("2*ARYVAL(1,1+1)", ARRAYS)
    assert isinstance(product, Op) and product.args[1] == Num(pytest.approx(-0.05235987755982989))


def test_inputs_and_outputs_of_the_plant_are_variables() -> None:
    lists = "PINPUT/3, VARIABLES=8,7\nPOUTPUT/4, VARIABLES=7\n" + ARRAYS
    assert function("PINVAL(3,1)", lists) == Call("VARVAL", (Ref("VARIABLE", 8),))
    assert function("PINVAL(3,2)", lists) == Call("VARVAL", (Ref("VARIABLE", 7),))
    assert function("POUVAL(4,1)", lists) == Call("VARVAL", (Ref("VARIABLE", 7),))


def test_an_array_may_follow_the_expression_that_uses_it() -> None:
    deck = deck_with("VARIABLE/1, FUNCTION=ARYVAL(1,2)\nARRAY/1, IC, NUMBERS=1,4")
    assert deck.find("VARIABLE", 1).function == Num(4.0)


def test_a_motion_may_follow_an_input_of_time() -> None:
    deck_with(ARRAYS + "\nJOINT/1, REVOLUTE, I=2, J=1\nMOTION/1, JOINT=1, FUNCTION=ARYVAL(2,1)")


def test_a_command_changes_the_constants() -> None:
    deck = deck_with("ARRAY/1, IC, NUMBERS=1,4\nVARIABLE/1, FUNCTION=ARYVAL(1,2)")
    commands = read_commands("ARRAY/1, NUMBERS=1,9\nVARIABLE/1, FUNCTION=-ARYVAL(1,2)\n", deck)
    after = deck.after(commands[0])
    assert after.find("VARIABLE", 1).function == Num(9.0)
    after = after.after(commands[1])
    assert after.find("VARIABLE", 1).function == Op("neg", (Num(9.0),))


def test_a_run_follows_the_change() -> None:
    """1 kg under 2 N for one second, then under -6 N."""
    deck = GROUND + "ARRAY/1, IC, NUMBERS=2\nPOINT_MASS/2, MASS=1, CM=2\nMARKER/2, POINT_MASS=2\n"
    deck += "STRING/1, STRING=c:/data/a file.txt (old)\n"
    deck += "VFORCE/1, I=2, J_PART=1, FX=ARYVAL(1,1)\\FY=0\\FZ=0\nEND\n"
    deck = read(deck)
    lines = "SIMULATE/DYNAMIC, END=1, STEPS=1", "ARRAY/1, NUMBERS=-6", "SIM/DYN, END=2, STEPS=1"
    results = al.simulate(deck, commands=read_commands("\n".join(lines) + "\n", deck))
    assert results["POINT_MASS/2.vx"][-1] == pytest.approx(-4.0, abs=1e-6)
