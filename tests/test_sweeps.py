"""Sweeps: ranges and samples, runs by workers, the file of all runs, going on with it.

The deck falls freely from rest: after T seconds y is y0 - g T^2/2, whatever the mass.
"""

from __future__ import annotations

import os
from pathlib import Path
from time import sleep as wait
from typing import Any

import numpy as np
import pytest

import adamslite as al
from adamslite.cli.main import main
from adamslite.errors import FormatError, UsageError
from adamslite.results.channels import of_argument
from adamslite.sweeps.measures import Measure, parsed
from adamslite.sweeps.ranges import ranges_of, sampled
from adamslite.sweeps.workers import carried_out

DECK = """a mass that falls
UNITS/SYSTEM=MKS
ACCGRAV/JGRAV=-10
PART/1, GROUND
POINT_MASS/2, MASS=2, CM=2, QG=0,5,0
MARKER/2, POINT_MASS=2
VARIABLE/k, FUNCTION=3
REQUEST/1, F2=VARVAL(k)*TIME
SIMULATE/DYNAMIC, END=1, STEPS=10
END
"""
NAME = "ACCGRAV.JGRAV"
LOWEST = "min POINT_MASS/2.y"


@pytest.fixture
def path(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "fall.adm").write_text(DECK)
    return tmp_path / "fall.adm"


def values(*texts: str, sample: str = "grid", seed: int = 0) -> np.ndarray:
    return sampled(ranges_of(texts), sample, seed)


# ---- ranges and samples ----------------------------------------------------------------------


def test_a_range_has_both_ends_and_a_grid_all_combinations() -> None:
    assert values("a=80:120:5")[:, 0].tolist() == [80, 90, 100, 110, 120]
    assert values("a=1:2:2", "b=3, -4,5e-1").tolist() == [
        [1, 3], [1, -4], [1, 0.5], [2, 3], [2, -4], [2, 0.5],
    ]  # fmt: skip
    assert values("a=5").tolist() == [[5]]
    assert values("a=2:1:3")[:, 0].tolist() == [2, 1.5, 1]


@pytest.mark.parametrize("sample", ["sobol:64", "lhs:64"])
def test_samples_fill_a_range_evenly_and_again_with_the_same_seed(sample: str) -> None:
    found = values("a=10:20", "b=1,2,4,8", sample=sample, seed=3)
    assert found.shape == (64, 2)
    assert [*np.histogram(found[:, 0], 8, (10, 20))[0]] == [8] * 8
    assert np.unique(found[:, 1], return_counts=True)[1].tolist() == [16] * 4
    assert (values("a=10:20", "b=1,2,4,8", sample=sample, seed=3) == found).all()
    assert (values("a=10:20", "b=1,2,4,8", sample=sample, seed=4) != found).any()


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("a", "write NAME=VALUES"),
        ("=3", "write NAME=VALUES"),
        ("a=", "a=: it has no values"),
        ("a=1,two", "a: 'two' is no number"),
        ("a=1,,2", "a: '' is no number"),
        ("a=1,inf", "a: 'inf' is no finite number"),
        ("a=nan:1:3", "a: 'nan' is no finite number"),
        ("a=1:1:3", "the range is empty"),
        ("a=1:2:1", "2 to 1000000"),
        ("a=1:2:0.5", "2 to 1000000"),
        ("a=1:2:1000001", "2 to 1000000"),
        ("a=1:2:3:4", "FROM:TO:COUNT"),
        ("a=1:2", "a grid needs how many values, as 1:2:5"),
        ("a=1:2:1000000 b=1:2:1000000", "sobol:N draws some"),
    ],
)
def test_what_is_no_range_is_told_in_a_sentence(text: str, told: str) -> None:
    with pytest.raises(UsageError, match=told):
        values(*text.split())


@pytest.mark.parametrize(
    ("sample", "told"),
    [
        ("sobl:8", "did you mean sobol"),
        ("grid:3", "grid, sobol:N, lhs:N or saltelli:N"),
        ("lhs", "say how many runs, as lhs:256"),
        ("lhs:-1", "say how many"),
        ("sobol:100", "sobol:64 or sobol:128"),
    ],
)
def test_what_is_no_sample_is_told_in_a_sentence(sample: str, told: str) -> None:
    with pytest.raises(UsageError, match=told):
        values("a=1:2", sample=sample)


# ---- measures --------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("kind", "expected"),
    [
        ("max", 4), ("min", -6), ("absmax", 6), ("range", 10), ("first", 0), ("final", 2),
        ("maxtime", 1), ("mintime", 3), ("mean", (2 - 2 - 2) / 4),
        ("rms", ((8 + (16 + 36) / 2 * 2 + (36 + 4) / 2) / 4) ** 0.5),
    ],
)  # fmt: skip
def test_measures_of_a_history(kind: str, expected: float) -> None:
    """Times 0, 1, 3, 4 and values 0, 4, -6, 2; means are integrals by trapezoids over time."""
    time, history = np.array([0.0, 1, 3, 4]), np.array([0.0, 4, -6, 2])
    assert Measure(kind, "x").of(time, history) == pytest.approx(expected, rel=1e-15)
    assert np.isnan(Measure(kind, "x").of(time[:0], history[:0]))


@pytest.mark.parametrize("kind", ["max", "min", "mean", "maxtime", "mintime", "rms"])
def test_a_measure_of_what_is_no_number_is_none(kind: str) -> None:
    assert np.isnan(Measure(kind, "x").of(np.arange(3.0), np.array([1, np.nan, 2])))


@pytest.mark.parametrize("text", ["max", "maxx REQUEST/1.F2", "REQUEST/1.F2"])
def test_what_is_no_measure_is_told(text: str) -> None:
    with pytest.raises(UsageError, match="a measure is a word and a column"):
        parsed([text])


# ---- runs ------------------------------------------------------------------------------------


def test_runs_are_those_of_the_deck_with_other_numbers() -> None:
    """To the last bit; y falls to 5 - g/2."""
    found = al.sweep(
        DECK, {NAME: [-1, -2], "k": "3:4:2"}, measures=[LOWEST, "final REQUEST/1.*"],
        outputs="POINT_MASS/2.y",
    )  # fmt: skip
    assert found[NAME].tolist() == [-1, -1, -2, -2]
    assert found["VARIABLE/k.FUNCTION"].tolist() == [3, 4, 3, 4]
    assert found[LOWEST] == pytest.approx([4.5, 4.5, 4, 4], abs=1e-3)
    assert found["final REQUEST/1.F2"] == pytest.approx([3, 4, 3, 4], abs=1e-12)
    assert found.outcomes == ["DONE"] * 4
    assert found["time"] == pytest.approx(np.linspace(0, 1, 11))
    for k in range(4):
        alone = al.simulate(DECK.replace("-10", str(found[NAME][k])))
        assert (found["POINT_MASS/2.y"][k] == alone["POINT_MASS/2.y"]).all()
        assert found["steps"][k] == alone.summary["steps"]


def test_numbers_have_the_units_of_the_deck() -> None:
    symbols = {"force": "N", "length": "mm", "time": "s", "mass": "t"}
    for dimension, unit in (
        ("force time/length", "N s/mm"), ("torque/angle", "N mm/rad"), ("mass length^2", "t mm^2"),
        ("length/time^2", "mm/s^2"), ("angle", "rad"), ("1", ""), ("the user's", ""),
        ("force, torque", ""), ("length/time", "mm/s"),
    ):  # fmt: skip
        assert of_argument(dimension, symbols) == unit
        assert of_argument(dimension, {}) == ("rad" if dimension == "angle" else "")
    found = al.sweep(DECK, {NAME: [-1], "POINT_MASS/2.MASS": [1]}, measures=[LOWEST])
    assert found.units[NAME] == "m/s^2" and found.units["POINT_MASS/2.MASS"] == "kg"


@pytest.mark.parametrize("by", ["processes", "threads"])
def test_workers_find_the_same(by: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("adamslite.sweeps.workers.LOT", 1e-3)  # workers, and small lots
    monkeypatch.setattr("adamslite.sweeps.workers.SHORT", 0.0)
    varied = f"{NAME}=-1:-20:60"
    one = al.sweep(DECK, varied, measures=[LOWEST], outputs="POINT_MASS/2.y", workers=1)
    two = al.sweep(DECK, varied, measures=[LOWEST], outputs="POINT_MASS/2.y", workers=2, by=by)
    assert two.outcomes == ["DONE"] * 60
    for name in (NAME, LOWEST, "steps", "POINT_MASS/2.y"):
        assert (one[name] == two[name]).all()


def ends_at_once(numbers: list[int]) -> Any:
    os._exit(9)


def test_a_worker_that_dies_is_told_and_what_is_done_is_kept(path, monkeypatch, capsys) -> None:
    monkeypatch.setattr("adamslite.sweeps.workers.LOT", 1e-3)
    monkeypatch.setattr("adamslite.sweeps.workers.SHORT", 0.0)
    words = ["sweep", str(path), f"{NAME}=-1:-9:90", "--measure", LOWEST, "-o", "x.nc"]
    with monkeypatch.context() as patch:
        patch.setattr("adamslite.sweeps.workers._lot", ends_at_once)
        assert main([*words, "--workers", "2"]) == 4
    assert "has ended by itself" in capsys.readouterr().err
    assert 1 <= len(al.load_sweep("x.nc").ahead) < 90
    assert main([*words, "--workers", "1", "--quiet"]) == 0
    assert al.load_sweep("x.nc").outcomes == ["DONE"] * 90


def test_a_run_that_makes_no_model_fails_by_name_and_the_others_go_on(path, capsys) -> None:
    varied = ["POINT_MASS/2.MASS=1,-2,3"]
    assert main(["sweep", str(path), *varied, "--measure", LOWEST, "-o", "x.nc"]) == 4
    told = capsys.readouterr().err
    assert "3 of 3 runs, 2 DONE, 1 INVALID" in told
    assert "run 1 (POINT_MASS/2.MASS=-2): INVALID: POINT_MASS/2 has a negative mass" in told
    found = al.load_sweep("x.nc")
    assert found.failed == [1]
    assert np.isnan(found[LOWEST]).tolist() == [False, True, False]


def test_a_run_that_ends_before_its_first_output_is_kept_and_the_others_go_on() -> None:
    """A body with hinges 1 apart fits points of ground that are 1 apart, and none that are 5."""
    deck = """a body between two hinges
UNITS/SYSTEM=MKS
PART/1, GROUND
MARKER/1, PART=1
MARKER/2, PART=1, QP=1,0,0
PART/2, MASS=1, CM=5, IP=1,1,1
MARKER/3, PART=2
MARKER/4, PART=2, QP=1,0,0
MARKER/5, PART=2
JOINT/1, SPHERICAL, I=3, J=1
JOINT/2, SPHERICAL, I=4, J=2
SIMULATE/DYNAMIC, END=0.1, STEPS=2
END
"""
    found = al.sweep(
        deck, {"MARKER/2.QP[0]": [1, 5, 1]}, measures=["max PART/2.x"], outputs="PART/2.x"
    )
    assert found.failed == [1] and found.outcomes[1] not in ("DONE", "FAULT")
    assert found.messages[1]
    assert np.isnan(found["max PART/2.x"]).tolist() == [False, True, False]
    assert found.samples.tolist() == [3, 0, 3]


def test_a_sweep_without_an_output_time_is_kept(path, capsys) -> None:
    """All runs end before they begin, and a file has no dimension without entries."""
    words = ["POINT_MASS/2.MASS=0,-1", "--outputs", "POINT_MASS/2.x", "--workers", "1", "--threads"]
    assert main(["sweep", str(path), *words, "-o", "x.nc"]) == 4
    found = al.load_sweep("x.nc")
    assert found.outcomes == ["INVALID", "INVALID"] and found.samples.tolist() == [0, 0]
    assert found.history(0).shape == (2, 0)
    assert main(["plot", "x.nc"]) == 2
    assert "no run has a history" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("varied", "told"),
    [
        ("SIMULATE.STEPS=10.5,20", "STEPS takes a whole number"),
        ("SIMULATE.END=-1,1", "SIMULATE ends at -1, but the time is 0 already"),
        ("POINT_MASS/2.MASS=0,1", "POINT_MASS/2 has no mass"),
    ],
)
def test_values_out_of_range_fail_by_themselves(varied: str, told: str) -> None:
    found = al.sweep(DECK, [varied], measures=[LOWEST], workers=1)
    assert found.outcomes == ["INVALID", "DONE"]
    assert told in found.messages[0]


@pytest.mark.parametrize(
    ("words", "told"),
    [
        ([f"{NAME}=1"], "nothing of the runs would be kept"),
        (["POINT_MASS/2.MAS=1", "--measure", LOWEST], "there is no number POINT_MASS/2.MAS"),
        (["k=1", "VARIABLE/k=2", "--measure", LOWEST], "VARIABLE/k.FUNCTION is varied twice"),
        ([f"{NAME}=1", "--measure", "max PART/9.x"], "no result is called 'PART/9.x'"),
        (["UNITS.SYSTEM=MKS,CGS", "--measure", LOWEST], "'MKS' is no number, and a sweep varies"),
        (["POINT_MASS/3.MASS=1", "--measure", LOWEST], "did you mean POINT_MASS/2.MASS"),
        ([f"{NAME}=1", "--measure", LOWEST, "--integrator", "NONE"], "--integrator NONE: there"),
        ([f"{NAME}=1", "--measure", LOWEST, "-o", "x.csv"], "the file of a sweep ends in .nc"),
        ([f"{NAME}=1", "--measure", LOWEST, "-o", "there.nc"], "there.nc holds no sweep"),
        ([f"{NAME}=1", "--measure", LOWEST, "-o", "result.nc"], "result.nc holds no sweep"),
    ],
)
def test_what_cannot_be_swept_is_told_in_a_sentence(path, capsys, words, told) -> None:
    Path("there.nc").write_text("notes")
    if "result.nc" in words:
        al.simulate(DECK).save("result.nc")
    assert main(["sweep", str(path), *words]) == 2
    said = capsys.readouterr().err
    assert told in said and len(said.splitlines()) == 1
    assert Path("there.nc").read_text() == "notes"


# ---- the file, and going on ------------------------------------------------------------------


def test_what_is_written_is_read_again(path) -> None:
    varied = {NAME: "-3:-1:3", "SIMULATE.END": [1, 2]}
    made = al.sweep(path, varied, measures=["max POINT_MASS/2.*"], outputs="REQUEST/1", path="x.nc")
    back = al.load_sweep("x.nc")
    assert (back.names, back.measured, back.channels) == (made.names, made.measured, made.channels)
    assert (back.meta, back.outcomes) == (made.meta, made.outcomes)
    assert made.units.items() <= back.units.items()
    for one, two in ((back.values, made.values), (back.measures, made.measures)):
        assert np.array_equal(one, two)
    assert not made.has_common_time
    for at, (time, histories) in made.histories.items():
        assert np.array_equal(back.histories[at][0], time)
        assert np.array_equal(back.histories[at][1], histories)
    with pytest.raises(FormatError, match="a sweep of runs"):
        al.Results.load("x.nc")


def test_xarray_opens_it(path) -> None:
    xarray = pytest.importorskip("xarray")
    al.sweep(path, f"{NAME}=-3:-1:3", measures=[LOWEST], outputs="POINT_MASS/2.y", path="x.nc")
    with xarray.open_dataset("x.nc", engine="scipy") as found:
        assert found["POINT_MASS_2_y"].dims == ("run", "time")
        assert found["min_POINT_MASS_2_y"].values == pytest.approx([3.5, 4, 4.5], abs=1e-3)
        assert [str(each) for each in found["outcome"].values] == ["DONE"] * 3
        assert found["ACCGRAV_JGRAV"].attrs["name"] == NAME


def interrupted_after(runs: int) -> Any:
    def carried(*given: Any) -> Any:
        for n, lot in enumerate(carried_out(*given)):
            if n == runs:
                raise KeyboardInterrupt
            yield lot

    return carried


def test_an_interrupted_sweep_goes_on_where_it_stopped(path, monkeypatch, capsys) -> None:
    command = ["sweep", str(path), f"{NAME}=-1:-9:9", "--measure", LOWEST, "--outputs",
               "POINT_MASS/2.y", "--workers", "1", "-o", "x.nc"]  # fmt: skip
    with monkeypatch.context() as patch:
        patch.setattr("adamslite.sweeps.sweep.carried_out", interrupted_after(4))
        assert main(command) == 4
    assert "the same command goes on" in capsys.readouterr().err
    assert al.load_sweep("x.nc").ahead == [4, 5, 6, 7, 8]
    carried: list[int] = []

    def noted(job: Any, numbers: list[int], *rest: Any) -> Any:
        carried.extend(numbers)
        return carried_out(job, numbers, *rest)

    with monkeypatch.context() as patch:
        patch.setattr("adamslite.sweeps.sweep.carried_out", noted)
        assert main(command) == 0
    assert carried == [4, 5, 6, 7, 8]
    whole = al.sweep(path, f"{NAME}=-1:-9:9", measures=[LOWEST], outputs="POINT_MASS/2.y")
    back = al.load_sweep("x.nc")
    assert np.array_equal(back["POINT_MASS/2.y"], whole["POINT_MASS/2.y"])
    assert np.array_equal(back[LOWEST], whole[LOWEST])
    before = Path("x.nc").read_bytes()
    assert main(command) == 0 and Path("x.nc").read_bytes() == before


@pytest.mark.parametrize("change", ["deck", "values", "measure", "flag"])
def test_another_sweep_is_not_written_over(path, capsys, change: str) -> None:
    given = {"values": f"{NAME}=-1:-2:2", "measure": LOWEST, "flag": "20"}
    command = "sweep {path} {values} --measure|{measure}|--steps {flag} -o x.nc --quiet"

    def words() -> list[str]:
        text = command.format(path=path, **given)
        start, measure, rest = text.split("|")
        return [*start.split(), measure, *rest.split()]

    assert main(words()) == 0
    before = Path("x.nc").read_bytes()
    if change == "deck":
        path.write_text(DECK.replace("QG=0,5", "QG=0,6"))
    else:
        other = {"values": f"{NAME}=-1:-3:2", "measure": "max POINT_MASS/2.y", "flag": "30"}
        given[change] = other[change]
    assert main(words()) == 2
    assert "holds another sweep" in capsys.readouterr().err
    assert Path("x.nc").read_bytes() == before


@pytest.mark.filterwarnings("ignore::adamslite.errors.DeckWarning")
def test_threads_take_turns_in_a_routine_of_the_user(monkeypatch: pytest.MonkeyPatch) -> None:
    """It has one room for what it is given."""
    monkeypatch.setattr("adamslite.sweeps.workers.LOT", 1e-3)
    monkeypatch.setattr("adamslite.sweeps.workers.SHORT", 0.0)

    @al.reads("DY(2, 1)")
    def height(parameters: Any, time: float, y: float) -> float:
        wait(1e-6)  # another thread goes on
        return y

    deck = DECK.replace("FUNCTION=3\n", "FUNCTION=USER(3)\n").replace(
        "MARKER/2", "MARKER/1, PART=1\nMARKER/2"
    )
    one, four = (
        al.sweep(
            deck, f"{NAME}=-1:-9:12", measures=["max REQUEST/1.F2", "final REQUEST/1.F2"],
            user={"VARIABLE/k": height}, workers=workers, by="threads",
        )
        for workers in (1, 4)
    )  # fmt: skip
    assert four.outcomes == ["DONE"] * 12
    assert np.array_equal(four.measures, one.measures)
    assert four["final REQUEST/1.F2"] == pytest.approx(5 + four[NAME] / 2, abs=1e-3)
