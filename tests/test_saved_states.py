"""SAVE and RELOAD: runs that go on from a state that was kept."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from command_decks import DRIVEN, FALL, FIRST, SECOND, run

from adamslite.cli.main import main
from adamslite.errors import UsageError
from adamslite.outputs.saved_files import SavedFiles
from adamslite.resources import find
from adamslite.results.results import Results

FREE = """two masses and the springs between them
UNITS/SYSTEM=MKS
PART/1, GROUND
MARKER/1, PART=1
POINT_MASS/2, MASS=1, CM=2, QG=1,0,0, VY=1
MARKER/2, POINT_MASS=2
POINT_MASS/3, MASS=1, CM=3, QG=2,0,0
MARKER/3, POINT_MASS=3
SPRINGDAMPER/1, TRANSLATIONAL, I=2, J=1, K=100, C=1, LENGTH=1
SPRINGDAMPER/2, TRANSLATIONAL, I=3, J=2, K=100, C=1, LENGTH=1
"""
METHODS = ["GSTIFF", "GSTIFF I3", "RADAU", "HHT", "NEWMARK", "ABAM", "RKF45", "VERLET", "AUTO"]


def with_method(method: str) -> tuple[str, dict[str, Any]]:
    name, _, form = method.partition(" ")
    options = {"integrator": name, "error": 1e-5} | ({"formulation": form} if form else {})
    return FREE if name == "VERLET" else DRIVEN, options


def last_half(results: Results) -> np.ndarray:
    """The last six rows: from t = 0.5 to t = 1."""
    assert results.time[-5:] == pytest.approx([0.6, 0.7, 0.8, 0.9, 1.0])
    return results.values[-5:]


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("kept", ["STATES, BUFFER=a", "SYSTEM, FILE=a"])
def test_a_run_goes_on_from_a_state_as_if_nothing_had_come_between(method: str, kept: str) -> None:
    deck, options = with_method(method)
    plain = run(deck, f"{FIRST}\n{SECOND}", **options)
    between = "SIM/DYN, END=0.8, STEPS=3"
    again = run(deck, f"{FIRST}\nSAVE/{kept}\n{between}\nRELOAD/{kept}\n{SECOND}", **options)
    assert again.time[6:9] == pytest.approx([0.6, 0.7, 0.8])
    assert again.time[9] == 0.5
    assert np.array_equal(last_half(again), last_half(plain))


@pytest.mark.parametrize("method", METHODS)
def test_a_later_run_goes_on_from_a_file(method: str, tmp_path: Path) -> None:
    deck, options = with_method(method)
    first = run(deck, f"{FIRST}\nSAVE/FILE=a", files=SavedFiles(tmp_path), **options)
    assert (tmp_path / "a").is_file() and len(list(tmp_path.iterdir())) == 1
    second = run(deck, f"RELOAD/FILE=a\n{SECOND}", files=SavedFiles(tmp_path), **options)
    plain = run(deck, f"{FIRST}\n{SECOND}", **options)
    assert np.array_equal(first.values, plain.values[:6])
    assert second.time == pytest.approx([0.5, 0.6, 0.7, 0.8, 0.9, 1.0])
    assert np.array_equal(second.values[1:], plain.values[6:])


CHANGES = (
    "DEACTIVATE/SFORCE, ID=1\nPART/5, MASS=3, IP=1,1,1\nVARIABLE/1, FUNCTION=7*AZ(3,1) &\n"
    ", IC=2\nACCGRAV/JGRAV=-1\nINTEGRATOR/HHT, ERROR=1E-4\nEQUILIBRIUM/PATTERN=T:F, ALIMIT=5D"
)


def test_a_system_brings_back_what_commands_have_changed(tmp_path: Path) -> None:
    """Also settings, with those of statics, in the same run and in another one."""
    plain = run(DRIVEN, f"{CHANGES}\n{FIRST}\n{SECOND}")
    undone = "ACTIVATE/SFORCE, ID=1\nPART/5, MASS=1\nACCGRAV/JGRAV=-9.81\nINTEGRATOR/GSTIFF"
    files = SavedFiles(tmp_path)
    saved = f"{CHANGES}\n{FIRST}\nSAVE/SYSTEM, FILE=b.json, TITLE=with changes\n{undone}"
    same = run(
        DRIVEN, f"{saved}\nSIM/DYN, END=0.7, STEPS=2\nRELOAD/FILE=b.json\n{SECOND}", files=files
    )
    assert np.array_equal(last_half(same), last_half(plain))
    other = run(DRIVEN, f"{undone}\nRELOAD/FILE=b.json\n{SECOND}", files=SavedFiles(tmp_path))
    assert last_half(other) == pytest.approx(last_half(plain), rel=1e-12, abs=1e-12)


def test_states_are_put_into_the_model_as_it_is_now() -> None:
    """A mass falls for 1 s; from there again, but without gravity: it keeps 9.81 m/s."""
    results = run(
        FALL,
        "SIM/DYN, END=1, STEPS=1\nSAVE/STATES, BUFFER=a\nSIM/DYN, END=2, STEPS=1\n"
        "ACCGRAV/JGRAV=0\nRELOAD/STATES, BUFFER=a\nSIM/DYN, END=2, STEPS=1",
        error=1e-9,
    )  # fmt: skip
    assert results.time == pytest.approx([0, 1, 2, 1, 2])
    assert results["POINT_MASS/2.y"] == pytest.approx(
        [0, -4.905, -19.62, -4.905, -4.905 - 9.81], abs=1e-7
    )


@pytest.mark.parametrize(
    ("text", "deck", "why"),
    [
        ("", FALL, "not a file of SAVE"),
        ("{}", FALL, "not a file of SAVE"),
        ("[1, 2]", FALL, "not a file of SAVE"),
        ('"', FALL, "not a file of SAVE"),
        (None, FALL.replace(" MASS=2", " MASS=3"), "belongs to another deck"),
    ],
)
def test_another_file_is_rejected(text: str | None, deck: str, why: str, tmp_path: Path) -> None:
    run(FALL, "SIM/DYN, END=1, STEPS=1\nSAVE/FILE=a", files=SavedFiles(tmp_path))
    if text is not None:
        (tmp_path / "a").write_text(text)
    with pytest.raises(UsageError, match=why):
        run(deck, "RELOAD/FILE=a\nSIM/DYN, END=2, STEPS=1", files=SavedFiles(tmp_path))


def test_a_missing_file_is_told(tmp_path: Path) -> None:
    with pytest.raises(UsageError, match="there is no file a"):
        run(FALL, "RELOAD/FILE=a\nSIM/DYN, END=2, STEPS=1", files=SavedFiles(tmp_path))


def test_repeated_runs_of_a_confirmation_write_no_file(tmp_path: Path) -> None:
    files = SavedFiles(tmp_path)
    run(FALL, "SIM/DYN, END=1, STEPS=1\nSAVE/FILE=a", files=files, error=1e-3)
    before = (tmp_path / "a").read_text()
    run(FALL, "SIM/DYN, END=1, STEPS=1\nSAVE/FILE=a", files=files, error=1e-3, confirm=True)
    assert (tmp_path / "a").read_text() == before


def test_files_of_save_on_the_command_line(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("fall.adm").write_text(FALL)
    Path("one.acf").write_text("SIM/DYN, END=1, STEPS=1\nSAVE/FILE=half\n")
    Path("two.acf").write_text("RELOAD/FILE=half\nSIM/DYN, END=2, STEPS=1\n")
    Path("three.acf").write_text("RELOAD/FILE=half\nSIM/DYN, END=2, STEPS=1\nSAVE/FILE=half\n")
    Path("four.acf").write_text("SIM/DYN, END=2, STEPS=1\nSAVE/FILE=fall.adm\n")
    solve, out = ["solve", "fall.adm"], ["-o", "r.csv", "--error", "1e-9"]
    assert main([*solve, "two.acf", *out]) == 2
    assert "two.acf:1:8: there is no file half" in capsys.readouterr().err
    assert main([*solve, "one.acf", *out]) == 0 and Path("half").is_file()
    assert main([*solve, "two.acf", *out]) == 0
    assert Results.load("r.csv")["POINT_MASS/2.y"] == pytest.approx([-4.905, -19.62], abs=1e-7)
    assert main([*solve, "three.acf", *out]) == 3
    assert main([*solve, "four.acf", *out]) == 3
    assert capsys.readouterr().err.count("is read by this run") == 2


@pytest.mark.parametrize(
    "deck",
    [
        "slider-crank/driven.adm",
        "friction-stiction/friction-stiction.adm",
        "arrays/arrays.adm",
    ],
)
def test_decks_go_on_from_states_to_the_same_bits(deck: str, tmp_path: Path) -> None:
    """Motions of time in a plane, creep, states: the first hundredth of a second."""
    text = (find("decks") / deck).read_text()
    first, between, second = (f"SIM/DYN, END={t}, STEPS=2" for t in (0.005, 0.0075, 0.01))
    plain = run(text, f"{first}\n{second}")
    kept = "SAVE/STATES, BUFFER=a\nSAVE/SYSTEM, FILE=a"
    files = SavedFiles(tmp_path)
    states = run(
        text, f"{first}\n{kept}\n{between}\nRELOAD/STATES, BUFFER=a\n{second}", files=files
    )
    other = run(text, f"RELOAD/SYSTEM, FILE=a\n{second}", files=SavedFiles(tmp_path))
    assert np.array_equal(states.values[-2:], plain.values[-2:])
    assert np.array_equal(other.values[-2:], plain.values[-2:])


def test_a_sensor_that_has_acted_since_acts_again(tmp_path: Path) -> None:
    """SENVAL is 2 t of the time at which the sensor passes t = 0.5, and 0 before; also when that
    has happened before RELOAD already.
    """
    deck = FALL + (
        "SENSOR/1, FUNCTION=TIME\\, VALUE=0.5, GE, ERROR=1E-9, EVALUATE=2*TIME\n"
        "REQUEST/2, F2=SENVAL(1)\n"
    )
    for kept, change in (
        ("STATES, BUFFER=a", ""),
        ("STATES, BUFFER=a", "REQUEST/1, F2=DX(2)\n"),
        ("SYSTEM, FILE=a", ""),
    ):
        results = run(
            deck,
            f"SIM/DYN, END=0.25, STEPS=1\nSAVE/{kept}\nSIM/DYN, END=1, STEPS=3\n{change}"
            f"RELOAD/{kept}\nSIM/DYN, END=1, STEPS=3",
            files=SavedFiles(tmp_path),
        )
        back = np.flatnonzero(np.diff(results.time) < 0)[0] + 1
        value = results["REQUEST/2.F2"]
        assert results.time[back] == 0.25 and value[back] == 0.0
        assert value[back - 1] == pytest.approx(1.0, abs=1e-6) == value[-1]
