"""Routines of users: calls of programs that are no part of a deck, and what is bound to them."""

from __future__ import annotations

from importlib.metadata import EntryPoint
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import user_functions
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
    assert warning.message == "not as the deck has it, but by user=: VARIABLE/7 = 1.5; VFORCE/1 = 0"
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
        ("VARSUB=1e400", "a number is finite"),
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
    assert warning.message == "not as the deck has it, but by user=: SFORCE/2 = 6E2"
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


# ---- functions of Python -------------------------------------------------------------------------

MASS = """a mass at (1, 0, 0)
UNITS/SYSTEM=MKS
PART/1, GROUND
MARKER/1, PART=1
POINT_MASS/2, MASS=2, QG=1,0,0, {start}
MARKER/2, POINT_MASS=2
{law}
END
"""
METHODS = ("GSTIFF", "HHT", "RADAU", "RKF45")


def mass(law: str, start: str = "VX=0", **options: Any) -> al.Results:
    """The mass under a law, with what is bound to it."""
    deck = al.read(MASS.format(law=law, start=start), user=options.pop("user"))
    return al.simulate(deck, **options)


@pytest.mark.parametrize("function", ["spring", "exact_spring"])
@pytest.mark.parametrize("integrator", METHODS)
def test_a_spring_in_python_swings_as_one_in_the_deck(integrator: str, function: str) -> None:
    """m x'' = -k x - c v: x = exp(-t/2) (cos w t + sin(w t)/(2 w)), w^2 = 100 - 1/4."""
    law = "VARIABLE/1, FUNCTION=USER(200, 2)\nVFORCE/1, I=2, J_PART=1, FX=VARVAL(1)"
    found = mass(law, user={"VARSUB": f"user_functions:{function}"}, end=1.0, steps=10,
                 integrator=integrator, error=1e-7)  # fmt: skip
    t, w = found.time, np.sqrt(99.75)
    x = np.exp(-t / 2) * (np.cos(w * t) + np.sin(w * t) / (2 * w))
    assert found["POINT_MASS/2.x"] == pytest.approx(x, abs=1e-4)


@pytest.mark.parametrize("statement", ["VFORCE", "GFORCE"])
def test_components_come_from_one_call(statement: str) -> None:
    """A circle about marker 1: m v^2/r = k/r^2 with m = 2, k = 18, r = 1, v = 3."""

    def all_six(*given: Any) -> tuple[float, ...]:
        return (*user_functions.attraction(*given), 0.0, 0.0, 0.0)

    all_six.reads = user_functions.attraction.reads  # type: ignore[attr-defined]
    bound = {"GFORCE": all_six, "VFORCE": user_functions.attraction}[statement]
    law = f"{statement}/1, I=2, J_PART=1, FUNCTION=USER(18)"
    if statement == "GFORCE":  # its I has axes: a part, not a point
        law = law.replace("I=2", "I=30")
        law += "\nPART/3, MASS=2, IP=1,1,1, CM=30, QG=1,0,0, VY=3\nMARKER/30, PART=3"
    found = mass(law, "VY=3", user={f"{statement}/1": bound}, end=2.0, steps=4, error=1e-8)
    body = "PART/3" if statement == "GFORCE" else "POINT_MASS/2"
    assert found[f"{body}.x"] == pytest.approx(np.cos(3 * found.time), abs=1e-5)
    assert found[f"{body}.y"] == pytest.approx(np.sin(3 * found.time), abs=1e-5)


def test_a_motion_in_python_has_its_acceleration() -> None:
    """z = 0.3 sin 5t by differences of the function: velocity and acceleration follow."""
    law = "PART/3, MASS=1, IP=1,1,1, CM=3\nMARKER/3, PART=3\nJOINT/1, TRANSLATIONAL, I=3, J=1\n"
    law += "MOTION/1, JOINT=1, TRANSLATION, FUNCTION=USER(0.3, 5)"
    found = mass(law, user={"MOTSUB": user_functions.swing}, end=1.0, steps=10, error=1e-8)
    t = found.time
    assert found["PART/3.z"] == pytest.approx(0.3 * np.sin(5 * t), abs=1e-8)
    assert found["PART/3.vz"] == pytest.approx(1.5 * np.cos(5 * t), abs=1e-8)
    assert found["PART/3.az"] == pytest.approx(-7.5 * np.sin(5 * t), abs=1e-5)


def test_a_branch_that_python_decides_is_located() -> None:
    """IF of sin(2 t): a force of 2 N on 2 kg from t = pi/2 on."""
    law = "VARIABLE/1, FUNCTION=USER(1, 2)\nVFORCE/1, I=2, J_PART=1, FY=IF(VARVAL(1): 2, 2, 0)"
    found = mass(law, user={"VARSUB": user_functions.swing}, end=3.0, steps=6, error=1e-6)
    late = np.maximum(found.time - np.pi / 2, 0.0)
    assert found["POINT_MASS/2.vy"] == pytest.approx(late, abs=1e-5)


@pytest.mark.parametrize(
    ("function", "said"),
    [
        ("broken_later", "ArithmeticError: the table ends here"),
        ("two_values", "ValueError: it returned 2 values instead of 1"),
    ],
)
def test_a_function_that_fails_ends_the_run_by_name(function: str, said: str) -> None:
    law = "VARIABLE/1, FUNCTION=USER()\nVFORCE/1, I=2, J_PART=1, FX=VARVAL(1)"
    found = mass(law, user={"VARSUB": f"user_functions:{function}"}, end=1.0, steps=10)
    assert found.outcome is al.Outcome.ROUTINE_FAILED
    assert found.message.startswith("VARIABLE/1 (<text>:7:1): at t = 0")
    assert f"user_functions:{function} failed: {said}. " in found.message
    assert found.time.size == 0 or found.time[-1] <= 0.5


def test_a_deck_runs_again_after_a_function_has_failed() -> None:
    law = "VARIABLE/1, FUNCTION=USER()\nVFORCE/1, I=2, J_PART=1, FX=VARVAL(1)"
    text = MASS.format(law=law, start="VX=0")
    deck = al.read(text, user={"VARSUB": user_functions.broken_later})
    assert al.simulate(deck, end=1.0, steps=2).outcome is al.Outcome.ROUTINE_FAILED
    assert al.simulate(deck, end=0.4, steps=2).outcome is al.Outcome.DONE


def test_what_a_function_reads_may_depend_on_parameters() -> None:
    """VARIABLE/2 is what the third parameter of VARIABLE/1 names, 7: 3 t."""
    law = "VARIABLE/7, FUNCTION=3*TIME\nVARIABLE/1, FUNCTION=USER(0, 0, 7)"
    found = mass(law, user={"VARSUB": user_functions.reads_by_parameter}, end=1.0, steps=4)
    assert found["VARIABLE/1"] == pytest.approx(3 * found.time, abs=1e-12)


@pytest.fixture
def package(monkeypatch: pytest.MonkeyPatch) -> None:
    """An installed package that offers VARSUB."""
    entry = EntryPoint("VARSUB", "user_functions:swing", "adamslite.user")
    monkeypatch.setattr("adamslite.deck.user_bindings.offered", lambda: (entry,))


def test_the_function_of_a_package_is_bound_by_a_word_of_the_user(package: None) -> None:
    law = "VARIABLE/1, FUNCTION=USER(2, 3)"
    found = mass(law, user={"VARSUB": "installed"}, end=1.0, steps=4)
    assert found["VARIABLE/1"] == pytest.approx(2 * np.sin(3 * found.time), abs=1e-12)
    assert "user_functions:swing (adamslite.user VARSUB)" in found.meta["user"]


def test_a_deck_alone_gets_no_function_of_a_package(package: None) -> None:
    with pytest.raises(DeckError, match="bind it, user={'VARSUB': 'installed'}"):
        mass("VARIABLE/1, FUNCTION=USER(2, 3)", user=None, end=1.0, steps=4)


def test_what_no_package_offers_is_reported(package: None) -> None:
    with pytest.raises(UsageError, match="no installed package offers GFOSUB .* has VARSUB"):
        al.read(FALL, user={"GFOSUB": "installed"})


@pytest.mark.parametrize("value", [None, {}, "nan", [1.0, None], float("inf")])
def test_what_is_no_number_cannot_be_bound(value: Any) -> None:
    with pytest.raises((UsageError, DeckError), match="a number|takes 1 values and gets 0"):
        al.read(FALL, user={"VARIABLE/7": value, "gust": 0.0})
