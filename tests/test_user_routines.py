"""Routines of users: calls of programs that are no part of a deck, and what is bound to them."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from decklets import told

import adamslite as al
from adamslite.cli.main import main
from adamslite.errors import UsageError
from adamslite.language.diagnostics import DeckError
from adamslite.language.messages import START
from adamslite.reading.read import read_commands

FALL = """a mass that a routine pushes
UNITS/SYSTEM=MKS
PART/1, GROUND
MARKER/1, PART=1
POINT_MASS/2, MASS=2, QG=0,0,0
MARKER/2, POINT_MASS=2
VARIABLE/7, FUNCTION=USER(3, 4.5)
VFORCE/1, I=2, J_PART=1, FUNCTION=USER(1)\\, ROUTINE=wind::gust
SFORCE/2, I=2, J=1, ACTIONONLY, FUNCTION=VARVAL(7)
INTEGRATOR/GSTIFF, ERROR=1E-8
SIMULATE/DYNAMIC, END=2, STEPS=4
END
"""


def test_constants_stand_in_for_routines() -> None:
    """A force of (4, 0, -6) and one of 10 along z: x = t^2, z = t^2 for a mass of 2."""
    deck = al.read(FALL, user={"VARIABLE/7": 10.0, "VFORCE/1": (4.0, 0.0, -6.0)})
    results = al.simulate(deck)
    assert results["POINT_MASS/2.x"] == pytest.approx(results.time**2, abs=1e-6)
    assert results["POINT_MASS/2.z"] == pytest.approx(results.time**2, abs=1e-6)


def test_results_say_what_stood_in_for_a_routine(tmp_path: Path) -> None:
    deck = al.read(FALL, user=["VARSUB=1.5", "wind::gust=0"])
    (warning,) = al.check(deck)
    assert (
        warning.message == "not as the deck has it, but by --user: VARIABLE/7 = 1.5; VFORCE/1 = 0"
    )
    assert [place.line for place in warning.places] == [7, 8]
    results = al.simulate(deck)
    results.save(tmp_path / "out.csv")
    text = (tmp_path / "out.csv").read_text()
    assert "# user: not as the deck has it: VARIABLE/7 = 1.5; VFORCE/1 = 0\n" in text


def test_every_missing_routine_is_told_once_with_all_its_calls() -> None:
    extra = "VARIABLE/9, FUNCTION=USER()\nREQUEST/1, FUNCTION=USER(1,2)\n"
    found = told(FALL.replace("SIMULATE", extra + "SIMULATE"))
    assert [(each.code, each.message) for each in found] == [
        ("missing-routine", "the routine VARSUB is no part of the deck"),
        ("missing-routine", "the routine wind::gust is no part of the deck"),
        ("request-left-out", "left out, as the routine REQSUB is no part of the deck: REQUEST/1"),
    ]
    assert found[0].hint.splitlines()[1:] == [
        "      <text>:7: VARIABLE/7, USER(3, 4.5)",
        "      <text>:11: VARIABLE/9, USER()",
    ]


@pytest.mark.parametrize(
    ("option", "message"),
    [
        ("VARIABLE/1=0", "no statement"),
        ("VARIABLE/70=0", "there is no VARIABLE/70"),
        ("VARIABEL/7=0", "there is no statement VARIABEL; did you mean VARIABLE?"),
        ("VARIABLE/7=0, x", "write a number"),
        ("VARIABLE/7", "write KIND/ID=VALUE"),
        ("VARSUB=math:cosh2", "there is no cosh2; did you mean cosh"),
        ("VARSUB=no_such_module:f", "importing no_such_module failed"),
        ("VARSUB=math:pi", "pi is no function"),
    ],
)
def test_a_binding_that_cannot_be_is_told(option: str, message: str) -> None:
    try:
        al.read(FALL, user=[option])
    except (UsageError, DeckError) as fault:
        assert message in str(fault) or message == "no statement"
    else:
        raise AssertionError("nothing was said")


def test_a_binding_without_use_is_told(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "fall.adm"
    path.write_text(FALL)
    given = ["VARSUBS=0", "SFORCE/2=1", "VARSUB=0", "gust=0"]
    code = main(["check", str(path), *(word for each in given for word in ("--user", each))])
    said = capsys.readouterr().out
    assert code == 3
    assert "--user VARSUBS: no statement calls this routine" in said
    assert "did you mean VARSUB?" in said
    assert "--user SFORCE/2: SFORCE/2 has no FUNCTION=USER(...)" in said


def test_commands_call_routines_too() -> None:
    """A command gives SFORCE/2 a routine: 600 N at 2 kg are 300 m/s^2."""
    deck = al.read(FALL, user=["VARSUB=0", "gust=0", "SFORCE/2=6E2"])
    assert deck.user.unused() == ["SFORCE/2"]
    commands = read_commands("SFORCE/2, FUNCTION=USER(1)\nSIM/DYN, END=1, STEPS=1\n", deck)
    (warning,) = commands.warnings
    assert warning.message == "not as the deck has it, but by --user: SFORCE/2 = 6E2"
    assert deck.user.unused() == []
    results = al.simulate(deck, commands=commands)
    assert results["POINT_MASS/2.z"][-1] == pytest.approx(150.0, rel=1e-6)
    with pytest.raises(DeckError, match="the routine SFOSUB is no part of the deck"):
        read_commands("SFORCE/2, FUNCTION=USER(1)\n", al.read(FALL, user=["VARSUB=0", "gust=0"]))


def test_a_request_of_a_routine_that_is_missing_writes_nothing() -> None:
    deck = al.read(START + "REQUEST/1, FUNCTION=USER(1)\nREQUEST/2, F2=TIME\n")
    names = al.simulate(deck, end=1.0, steps=1).names
    assert [name for name in names if name.startswith("REQUEST")] == ["REQUEST/2.F2"]


def test_a_sensor_and_a_motion_take_constants() -> None:
    deck = al.read(
        START
        + "JOINT/1, TRANSLATIONAL, I=2, J=1\nMOTION/1, JOINT=1, TRANSLATION, FUNCTION=USER(2)\n"
        "SENSOR/1, HALT, VALUE=1, FUNCTION=USER(1.0)\n",
        user=["MOTION/1=0.25", "SENSOR/1=0"],
    )
    results = al.simulate(deck, end=1.0, steps=2)
    assert results.outcome.name == "DONE"
    assert results["PART/2.z"] == pytest.approx(np.full(3, 0.25), abs=1e-9)
