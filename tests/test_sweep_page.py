"""The page of a sweep: its runs are those of the file, computed again.

The mass falls from rest at y = 5: after t seconds it is at 5 + g t^2/2, whatever it weighs.
"""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from page_scenes import decoded, plain_list, scene_of

import adamslite as al
from adamslite.cli.main import main
from adamslite.drawing import decimation
from adamslite.errors import DeckWarning, UsageError
from adamslite.sweeps import motions
from adamslite.sweeps.motions import numbers_of_runs, page_of_sweep
from adamslite.sweeps.record import Sweep

DECK = """a mass that falls
UNITS/SYSTEM=MKS
ACCGRAV/JGRAV=-10
PART/1, GROUND
MARKER/1, PART=1
POINT_MASS/2, MASS=2, CM=2, QG=0,5,0
MARKER/2, POINT_MASS=2
REQUEST/1, F2=DM(2,1)
SIMULATE/DYNAMIC, END=1, STEPS=20
END
"""
G, MASS = "ACCGRAV.JGRAV", "POINT_MASS/2.MASS"
LOWEST = "min POINT_MASS/2.y"


@pytest.fixture
def path(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "fall.adm").write_text(DECK)
    return tmp_path / "fall.adm"


def swept(scene: Any = DECK, **given: Any) -> Sweep:
    varied = given.pop("varied", {G: [-1, -2, -3], MASS: [-1, 1]})
    return al.sweep(scene, varied, measures=[LOWEST], workers=1, **given)


def described(text: str) -> tuple[Any, Any, Any]:
    """The scene of a page, its table of runs, and the scenes of them, whole."""
    scene = scene_of(text)
    table: Any = plain_list(scene, scene.plain["runs"])
    whole = [None if each is None else {**scene.plain, **each} for each in table["scenes"]]
    return scene, table, whole


def heights(scene: Any, run: Any) -> np.ndarray:
    return decoded(scene, run["bodies"][1]["position"])[:, 1]


def test_the_page_has_the_motion_of_each_run() -> None:
    text, told = page_of_sweep(swept())
    scene, table, runs = described(text)
    assert told == "" and table["runs"] == [0, 1, 2, 3, 4, 5]
    assert [each is None for each in runs] == [True, False] * 3
    for g, run in zip((-1, -2, -3), runs[1::2], strict=True):
        time = decoded(scene, run["times"])
        assert time == pytest.approx(np.linspace(0, 1, 21), abs=1e-6)
        assert heights(scene, run) == pytest.approx(5 + g * time**2 / 2, abs=2e-3)
        (column,) = (each for each in run["channels"]["list"] if each["name"] == "REQUEST/1.F2")
        assert decoded(scene, column["values"]) == pytest.approx(5 + g * time**2 / 2, abs=2e-3)


def test_the_page_tells_numbers_measures_and_how_runs_ended() -> None:
    sweep = swept()
    _, table, _ = described(page_of_sweep(sweep)[0])
    assert [each["name"] for each in table["numbers"]] == [G, MASS]
    assert [each["unit"] for each in table["numbers"]] == ["m/s^2", "kg"]
    assert [each["values"] for each in table["numbers"]] == sweep.values.T.tolist()
    assert table["failed"] == [True, False] * 3
    assert table["outcomes"][:2] == ["INVALID", "DONE"]
    assert "has a negative mass" in table["messages"][0]
    (lowest,) = table["measures"]
    assert (lowest["name"], lowest["unit"]) == (LOWEST, "m")
    assert lowest["values"][0] is None and lowest["values"][1] == sweep.measures[1, 0]


def test_runs_are_computed_again_as_they_were_run(path: Path) -> None:
    """With the flags of the sweep, its command file and numbers that were set."""
    path.with_suffix(".acf").write_text("fall.adm\n\nSIMULATE/DYNAMIC, END=0.5, STEPS=10\nSTOP\n")
    words = ["sweep", "fall.adm", f"{G}=-1,-2", "--measure", LOWEST, "--set", "QG[1]=7"]
    words = [*words[:-1], "POINT_MASS/2.QG[1]=7", "--steps", "5", "-o", "runs.nc", "--quiet"]
    assert main(words) == 0
    path.unlink()
    assert main(["view", "runs.nc", "--no-open"]) == 0
    scene, _, runs = described(Path("runs.html").read_text(encoding="utf-8"))
    time = decoded(scene, runs[1]["times"])
    assert time == pytest.approx(np.linspace(0, 0.5, 6), abs=1e-6)
    assert heights(scene, runs[1]) == pytest.approx(7 - time**2, abs=2e-3)
    assert scene.plain["deck"] == "fall.adm"


def test_runs_that_are_others_when_computed_again_are_told(path: Path) -> None:
    sweep = swept(path)
    sweep.measures[3, 0] += 1e-3
    sweep.outcomes[5] = "NEWTON_FAILED"
    text, told = page_of_sweep(sweep)
    assert "2 runs (3, 5) have other measures" in told
    assert told in scene_of(text).plain["notes"]
    with pytest.warns(DeckWarning, match="2 runs"):
        sweep.view("a.html")


def test_chosen_runs_and_channels_alone_are_in_the_page(path: Path) -> None:
    swept(path, path="runs.nc")
    words = ["view", "runs.nc", "--runs", "1:6:2", "--channels", "REQUEST/*", "-o", "a.html"]
    assert main(words) == 4  # the sweep has runs that failed
    _, table, runs = described(Path("a.html").read_text(encoding="utf-8"))
    assert table["runs"] == [1, 3, 5]
    names = [each["name"] for each in runs[0]["channels"]["list"]]
    assert "REQUEST/1.F2" in names and all(name.startswith("REQUEST/1.") for name in names)


def test_runs_that_are_ahead_are_not_in_the_page() -> None:
    sweep = swept()
    sweep.outcomes[1] = sweep.outcomes[2] = ""
    _, table, runs = described(page_of_sweep(sweep)[0])
    assert table["runs"] == [0, 3, 4, 5] and len(runs) == 4


def test_an_interruption_ends_all_runs(monkeypatch: pytest.MonkeyPatch) -> None:
    sweep, carried = swept(), list[Any]()

    def interrupted(*given: Any, **options: Any) -> al.Results:
        carried.append(given)
        return replace(al.simulate(DECK), outcome=al.Outcome.INTERRUPTED)

    monkeypatch.setattr(motions, "simulate", interrupted)
    with pytest.raises(KeyboardInterrupt):
        page_of_sweep(sweep)
    assert len(carried) == 1


def test_many_runs_have_fewer_frames_and_channels(monkeypatch: pytest.MonkeyPatch) -> None:
    time = np.linspace(0, 1, 5001)
    assert len(decimation.frames(time, 100)) == 900
    assert len(decimation.frames(time, 100, 200)) == decimation.RUNS_BUDGET // (200 * 100)
    assert len(decimation.frames(time, 100, 10**6)) == decimation.FEWEST
    monkeypatch.setattr(motions, "RUNS_CHANNEL_BUDGET", 2000)
    _, _, runs = described(page_of_sweep(swept(), numbers=[1, 3])[0])
    assert [each["name"] for each in runs[0]["channels"]["list"]] == ["POINT_MASS/2.y"]


def test_what_is_equal_in_all_runs_is_kept_once() -> None:
    one = len(page_of_sweep(swept(varied={G: [-1, -2]}))[0])
    many = len(page_of_sweep(swept(varied={G: np.linspace(-1, -9, 42)}))[0])
    assert (many - one) / 40 < 1500


@pytest.mark.parametrize(
    ("text", "runs"),
    [("3", [3]), ("0,5,7", [0, 5, 7]), (":3", [0, 1, 2]), ("7:", [7, 8]), ("0:9:4", [0, 4, 8])],
)
def test_runs_are_named_one_by_one_or_from_to(text: str, runs: list[int]) -> None:
    assert numbers_of_runs(text, 9) == runs


def test_python_names_runs_by_numbers_or_as_the_command_does(path: Path) -> None:
    sweep = swept(path)
    for runs in ([1, 3], "1:4:2", (1, 3)):
        written = sweep.view("a.html", runs=runs)
        assert described(written.read_text(encoding="utf-8"))[1]["runs"] == [1, 3]
    with pytest.raises(UsageError, match="belong to a sweep"):
        al.view(DECK, "b.html", runs=[1])
    with pytest.raises(UsageError, match="is shown by a page"):
        sweep.view("a.glb")


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (["runs.nc", "--runs", "x"], "--runs x: it is not like 0,5,7"),
        (["runs.nc", "--runs", "0:6:0"], "--runs 0:6:0: it is not like"),
        (["runs.nc", "--runs", "6"], "there is no run 6: they are 0 to 5"),
        (["runs.nc", "--runs", "3:3"], "none of these runs has been carried out"),
        (["runs.nc", "--runs", "0,2,4"], "none of the runs has a motion"),
        (["runs.nc", "--channels", "PART/9.x"], "no result is called 'PART/9.x'"),
        (["runs.nc", "--end", "3"], "its runs are carried out as they were"),
        (["runs.nc", "--against", "runs.nc"], "its runs are carried out as they were"),
        (["runs.nc", "--glb"], "a sweep is shown by a page"),
        (["runs.nc", "--deck", "other.adm"], "is not the deck of these runs"),
        (["old.nc"], "the sweep does not carry its deck"),
        (["fall.adm", "--runs", "0"], "belong to the file of a sweep"),
    ],
)
def test_mistakes_are_told_in_a_sentence(
    path: Path, capsys: pytest.CaptureFixture, words: list[str], told: str
) -> None:
    sweep = swept(path, path="runs.nc")
    Path("other.adm").write_text(DECK.replace("MASS=2, CM", "MASS=3, CM"))
    sweep.meta = {name: text for name, text in sweep.meta.items() if name != "source"}
    sweep.save("old.nc")
    assert main(["view", *words, "--no-open"]) == 2
    said = capsys.readouterr().err.splitlines()
    assert told in said[-1] and not list(path.parent.glob("*.html"))


def test_a_page_that_would_be_too_large_says_what_to_choose(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    sweep = swept()
    monkeypatch.setattr(motions, "RUNS_BUDGET", 2 * 3 * decimation.FEWEST)
    with pytest.raises(UsageError, match=r"3 coordinates .* choose 2 at most, as runs= 0:6:3"):
        page_of_sweep(sweep)
    monkeypatch.setattr(motions, "RUNS_CHANNEL_BUDGET", 6 * decimation.FEWEST)
    with pytest.raises(UsageError, match="channels of 1 runs are too many .* choose 6 channels"):
        page_of_sweep(sweep, numbers=[1], channels=["*"])
    monkeypatch.setattr(motions, "MOST", 3)
    with pytest.raises(UsageError, match=r"6 runs are too many .* as runs= 0:6:2"):
        page_of_sweep(sweep)


def test_runs_that_ended_early_are_shown_as_far_as_they_go() -> None:
    """The force 1/(c - t) has no value at t = c, which is inside of the run for c = 0.5 alone."""
    force = (
        "VARIABLE/c, FUNCTION=0.5\nSFORCE/1, TRANSLATIONAL, I=2, J=1, FUNCTION=1/(VARVAL(c)-TIME)"
    )
    sweep = swept(DECK.replace("SIMULATE", f"{force}\nSIMULATE"), varied={"c": [0.5, 5]})
    scene, table, (early, whole) = described(page_of_sweep(sweep)[0])
    assert table["failed"] == [True, False]
    assert 0.2 < decoded(scene, early["times"])[-1] <= 0.5
    assert decoded(scene, whole["times"])[-1] == 1


def test_a_sweep_of_python_with_commands_that_have_no_text_has_no_page() -> None:
    deck = al.read(DECK)
    commands = list(al.read_commands("x.adm\n\nSIMULATE/DYNAMIC, END=0.2, STEPS=2\n", deck))
    sweep = swept(deck, commands=commands, varied={G: [-1]})
    with pytest.raises(UsageError, match="does not carry its deck"):
        page_of_sweep(sweep)


def test_routines_of_the_user_are_bound_again(path: Path, capsys: pytest.CaptureFixture) -> None:
    """Numbers are kept in the file; functions are not, which would have a module loaded."""
    calls = "VARIABLE/1, FUNCTION=USER(3)\nSFORCE/1, TRANSLATIONAL, I=2, J=1, FUNCTION=VARVAL(1)\n"
    path.write_text(DECK.replace("SIMULATE", f"{calls}SIMULATE"))
    Path("pulling.py").write_text("def pull(parameters, time):\n    return parameters[0] * time\n")
    words = ["sweep", "fall.adm", f"{MASS}=1,2", "--measure", LOWEST, "--quiet", "-o"]
    assert main([*words, "numbers.nc", "--user", "VARIABLE/1=3"]) == 0
    assert main(["view", "numbers.nc", "--no-open"]) == 0
    assert main([*words, "functions.nc", "--user", "VARSUB=pulling:pull"]) == 0
    assert main(["view", "functions.nc", "--no-open"]) == 3
    assert "the routine VARSUB is no part of the deck" in capsys.readouterr().err
    assert main(["view", "functions.nc", "--no-open", "--user", "VARSUB=pulling:pull"]) == 0
    assert "other measures" not in capsys.readouterr().err
    assert main(["view", "functions.nc", "--no-open", "--user", "VARSUB=9"]) == 0
    assert "2 runs (0, 1) have other measures" in capsys.readouterr().err


HOSTILE = "</script><script>alert(1)</script><!-- <b>$&{{bundle}}"


def test_hostile_names_and_messages_are_text(path: Path) -> None:
    deck = DECK.replace("a mass that falls", HOSTILE)
    sweep = swept(deck)
    sweep.messages[0] = HOSTILE
    text, _ = page_of_sweep(sweep)
    assert text.count("</script>") == 4 and "<!--" not in text
    assert described(text)[1]["messages"][0] == HOSTILE
