"""`simulate` and `linearize` for paths, texts and decks give what the command line gives."""

from __future__ import annotations

import json
import os
from math import pi, sqrt
from pathlib import Path

import numpy as np
import pytest

import adamslite as al
from adamslite.cli.main import main
from adamslite.errors import UsageError

FALL = """A mass that falls
UNITS/SYSTEM=MKS
ACCGRAV/JGRAV=-9.81
PART/1, GROUND
MARKER/1, PART=1
POINT_MASS/2, MASS=2, CM=2
MARKER/2, POINT_MASS=2
INTEGRATOR/GSTIFF, ERROR=1E-8
"""
RUN = "SIMULATE/DYNAMIC, END=2, STEPS=4"
# m x'' = -k x: frequency sqrt(k/m)/(2 pi)
SWING = FALL + "SPRINGDAMPER/1, TRANSLATIONAL, I=2, J=1, K=8, LENGTH=1\n"


@pytest.fixture
def fall(tmp_path: Path) -> Path:
    """fall.adm with fall.acf beside it, which runs it for 2 s."""
    (tmp_path / "fall.adm").write_text(FALL + "END\n")
    (tmp_path / "fall.acf").write_text(f"{RUN}\n")
    return tmp_path / "fall.adm"


def needs_free_fall(results: al.Results, end: float = 2.0) -> None:
    """y = -g t^2/2 at five times up to the end."""
    times = np.linspace(0.0, end, 5)
    np.testing.assert_allclose(results.time, times, rtol=1e-14)
    np.testing.assert_allclose(results["POINT_MASS/2.y"], -9.81 * times**2 / 2, atol=1e-4)


@pytest.mark.parametrize("given", [str, Path, al.read])
def test_the_command_file_beside_a_deck_runs_it(fall: Path, given: type) -> None:
    needs_free_fall(al.simulate(given(fall)))


def test_python_and_the_command_line_give_the_same_table(fall: Path, tmp_path: Path) -> None:
    assert main(["solve", str(fall), "-o", str(tmp_path / "shell.csv"), "--quiet"]) == 0
    al.simulate(fall).save(tmp_path / "python.csv")
    assert (tmp_path / "python.csv").read_text() == (tmp_path / "shell.csv").read_text()


def test_a_text_is_a_deck(fall: Path) -> None:
    needs_free_fall(al.simulate(f"{FALL}{RUN}\nEND\n"))


@pytest.mark.parametrize(
    "commands",
    [RUN, f"{RUN}\n", [RUN], ["INTEGRATOR/WSTIFF, ERROR=1E-9", RUN], RUN.lower()],
    ids=["a line", "a text", "a list", "several", "lower case"],
)
@pytest.mark.parametrize("given", [str, al.read, lambda text: al.assemble(al.read(text))])
def test_commands_may_be_written_in_the_call(given: type, commands: object) -> None:
    needs_free_fall(al.simulate(given(FALL + "END\n"), commands=commands))


def test_commands_may_be_another_file_or_none(fall: Path) -> None:
    other = fall.with_name("one second.acf")
    other.write_text("SIMULATE/DYNAMIC, END=1, STEPS=4\n")
    needs_free_fall(al.simulate(fall, commands=other), 1.0)
    needs_free_fall(al.simulate(fall, commands=str(other)), 1.0)
    deck = al.read(fall)
    needs_free_fall(al.simulate(deck, commands=al.read_commands(other, deck)), 1.0)
    with pytest.raises(UsageError, match="no end time"):
        al.simulate(fall, commands=())


def test_arguments_win_over_the_file_beside(fall: Path) -> None:
    needs_free_fall(al.simulate(fall, end=0.5, steps=4), 0.5)


def test_routines_are_bound_by_a_mapping(tmp_path: Path) -> None:
    """A VARIABLE that is 3 pushes 2 kg without gravity: x = 3/2 t^2/2 = 3 at t = 2."""
    push = "VARIABLE/1, FUNCTION=USER(1)\nVFORCE/1, I=2, J_PART=1, FX=VARVAL(1)\\FY=0\\FZ=0\n"
    text = FALL.replace("JGRAV=-9.81", "JGRAV=0") + f"{push}{RUN}\nEND\n"
    with pytest.warns(al.DeckWarning, match="by user=: VARIABLE/1 = 3"):
        results = al.simulate(text, user={"VARIABLE/1": 3.0})
    np.testing.assert_allclose(results["POINT_MASS/2.x"][-1], 3.0, atol=1e-4)
    with pytest.raises(UsageError, match=r"give it to adamslite\.read"):
        al.simulate(al.read(text, user={"VARIABLE/1": 3.0}), user={"VARIABLE/1": 1.0})


def test_mistakes_of_both_files_come_at_once(fall: Path) -> None:
    fall.write_text(FALL + "MARKER/3, PART=7\nEND\n")
    fall.with_suffix(".acf").write_text("SIMULATE/DYNAMIC, EMD=2\n")
    with pytest.raises(al.DeckError) as caught:
        al.simulate(fall)
    assert {each.span.file for each in caught.value.errors} == {
        str(fall),
        str(fall.with_suffix(".acf")),
    }


def test_warnings_of_a_deck_are_warnings_of_python(tmp_path: Path) -> None:
    """Gravity in mm/s^2 where lengths are metres; the warning names the line of the caller."""
    wrong = FALL.replace("-9.81", "-9806.65") + f"{RUN}\nEND\n"
    with pytest.warns(al.DeckWarning, match="gravity-units") as caught:
        al.simulate(wrong)
    assert [each.filename for each in caught] == [__file__]


def test_a_file_that_is_not_there(tmp_path: Path) -> None:
    for missing in ("pend.adm", tmp_path / "pend.adm"):
        with pytest.raises(FileNotFoundError, match=r"pend\.adm"):
            al.simulate(missing)
    with pytest.raises(FileNotFoundError, match=r"pend\.acf"):
        al.simulate(FALL + "END\n", commands="pend.acf")


@pytest.mark.parametrize("given", [str, al.read])
def test_linearize_takes_a_text(given: type) -> None:
    """2 kg at 8 N/m along the spring, from rest at its free length."""
    deck = SWING.replace("MASS=2, CM=2", "MASS=2, CM=2, QG=1,0,0").replace("-9.81", "0") + "END\n"
    found = al.linearize(given(deck))
    assert max(found.frequencies) == pytest.approx(sqrt(8 / 2) / (2 * pi), rel=1e-9)


def test_linearize_takes_the_file_beside(fall: Path) -> None:
    """An equilibrium under gravity: the spring is stretched to L, and sideways it swings like a
    pendulum of that length, omega^2 = g/L, L = 1 + m g/k."""
    fall.write_text(SWING.replace("MASS=2, CM=2", "MASS=2, CM=2, QG=0,-1,0") + "END\n")
    fall.with_suffix(".acf").write_text("SIMULATE/STATICS\n")
    length = 1 + 2 * 9.81 / 8
    wanted = sorted([sqrt(9.81 / length) / (2 * pi)] * 4 + [sqrt(8 / 2) / (2 * pi)] * 2)
    np.testing.assert_allclose(sorted(al.linearize(str(fall)).frequencies), wanted, rtol=1e-6)


@pytest.mark.parametrize(
    "wrong",
    [
        {"end": -1.0}, {"end": float("nan")}, {"end": "2"}, {"steps": 0}, {"steps": 1.5},
        {"error": 0.0}, {"hmax": float("inf")}, {"integrator": "EULER"}, {"formulation": "I4"},
        {"no_reduction": ["all"]},
    ],
    ids=str,
)  # fmt: skip
def test_a_wrong_argument_is_named(wrong: dict[str, object]) -> None:
    with pytest.raises(UsageError, match=next(iter(wrong)).split("_")[-1]):
        al.simulate(FALL + "END\n", **{"end": 1.0, **wrong})


def test_what_is_no_deck_is_refused_in_a_sentence(tmp_path: Path) -> None:
    for wrong in (None, 3, [FALL]):
        for function in (al.simulate, al.linearize, al.check, al.chart):
            with pytest.raises(UsageError, match="a deck is a path, a text, or what"):
                function(wrong)
    with pytest.raises(UsageError, match="this is empty"):
        al.simulate("")
    with pytest.raises(IsADirectoryError):
        al.simulate(tmp_path)


@pytest.mark.parametrize("wrong", [3, [3], [RUN, 3]], ids=str)
def test_what_is_no_command_is_refused_in_a_sentence(wrong: object) -> None:
    with pytest.raises(UsageError, match="commands= takes a file, a text, lines"):
        al.simulate(FALL + "END\n", commands=wrong)


@pytest.mark.parametrize("time", [-1.0, float("nan"), float("inf"), "1"])
def test_a_time_of_linearisation_is_a_time(time: object) -> None:
    with pytest.raises(UsageError, match=f"time={time}: it must be a time, zero or above"):
        al.linearize(FALL + "END\n", time=time)


def test_single_texts_stand_for_lists_of_one() -> None:
    text = FALL + f"VARIABLE/1, FUNCTION=USER(1)\nREQUEST/1, F2=VARVAL(1)\n{RUN}\nEND\n"
    with pytest.warns(al.DeckWarning, match="VARIABLE/1 = 3"):
        results = al.simulate(text, user="VARSUB=3", no_reduction="variables")
    np.testing.assert_array_equal(results["REQUEST/1.F2"], 3.0)


def test_names_of_methods_are_read_in_any_case() -> None:
    needs_free_fall(al.simulate(f"{FALL}{RUN}\nEND\n", integrator="gstiff", formulation="i3"))


def test_the_command_line_names_a_wrong_integrator(fall: Path, capsys) -> None:
    assert main(["solve", str(fall), "--integrator", "EULER"]) == 2
    assert "--integrator EULER: there are" in capsys.readouterr().err


def test_saved_states_are_kept_in_a_folder(fall: Path, tmp_path: Path) -> None:
    folder = tmp_path / "states"
    folder.mkdir()
    al.simulate(fall, commands=[RUN, "SAVE/SYSTEM, FILE=two"], files=folder)
    assert [each.name for each in folder.iterdir()] == ["two"]
    later = "SIMULATE/DYNAMIC, END=3, STEPS=1"
    results = al.simulate(fall, commands=["RELOAD/SYSTEM, FILE=two", later], files=str(folder))
    assert results["POINT_MASS/2.y"][-1] == pytest.approx(-9.81 * 3**2 / 2, abs=1e-3)


def test_results_tell_json_what_the_command_line_tells(fall: Path, capsys, monkeypatch) -> None:
    monkeypatch.chdir(fall.parent)
    assert main(["solve", fall.name, "--summary", "json"]) == 0
    told = json.loads(capsys.readouterr().out)
    summary = al.simulate(os.fspath(fall)).summary
    same = [name for name in summary if not name.endswith("cpu_s")]
    assert {name: told[name] for name in same} == {name: summary[name] for name in same}
