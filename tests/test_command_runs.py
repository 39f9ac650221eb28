"""Command files that are carried out: what commands between analyses do to a run."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import adamslite
from adamslite.cli.main import main
from adamslite.errors import UsageError
from adamslite.outputs.saved_files import SavedFiles
from adamslite.reading.read import read, read_commands
from adamslite.resources import find
from adamslite.results.results import Results

FALL = """a mass that falls with 9.81 m/s2 from rest
UNITS/SYSTEM=MKS
ACCGRAV/JGRAV=-9.81
PART/1, GROUND
MARKER/1, PART=1
POINT_MASS/2, MASS=2, CM=2
MARKER/2, POINT_MASS=2
REQUEST/1, F2=DY(2)
"""
PENDULUM = """a pendulum of length 1 that starts level
UNITS/SYSTEM=MKS
ACCGRAV/JGRAV=-9.81
PART/1, GROUND
MARKER/1, PART=1
PART/2, MASS=2, CM=2, IP=0.1,0.2,0.3, QG=1,0,0
MARKER/2, PART=2
MARKER/3, PART=2, QP=-1,0,0
JOINT/1, REVOLUTE, I=3, J=1
"""


def run(deck: str, commands: str, **options: Any) -> Results:
    scene = read(deck)
    return adamslite.simulate(scene, commands=read_commands(commands + "\n", scene), **options)


def test_a_column_that_a_command_brings_holds_no_number_before() -> None:
    """y = -4.905 t^2 is F2 at first, F3 later; neither stands for the other."""
    results = run(
        FALL,
        "SIM/DYN, END=1, STEPS=2\nREQUEST/1, DISPLACEMENT, I=2\nSIM/DYN, END=2, STEPS=2",
        error=1e-9,
    )
    fallen = -4.905 * results.time**2
    assert results.time == pytest.approx([0, 0.5, 1, 1.5, 2])
    assert results["REQUEST/1.F3"][3:] == pytest.approx(fallen[3:])
    assert np.isnan(results["REQUEST/1.F3"][:3]).all()
    assert results["REQUEST/1.F2"][:3] == pytest.approx(fallen[:3], abs=1e-9)
    assert results["REQUEST/1.F2"][3:] == pytest.approx([0, 0], abs=1e-9)  # the x of DISPLACEMENT
    assert results["POINT_MASS/2.y"] == pytest.approx(fallen, abs=1e-7)
    assert "REQUEST/1.F3 at t = 0" in results.meta["no number"]


@pytest.mark.parametrize("system", ["MKS", "CGS", "IPS", "FPS"])
def test_units_as_a_command_change_the_factor_of_forces(system: str) -> None:
    """From t = 1 on a force of 2 units acts on 2 units of mass: y'' = UCF - 9.81."""
    factor = {"MKS": 1.0, "CGS": 1.0, "IPS": 386.0886, "FPS": 32.17405}[system]
    force = "VFORCE/1, I=2, J_PART=1, FX=0\\FY=STEP(TIME,1,0,1.000001,2)\\FZ=0\n"
    results = run(
        FALL + force, f"SIM/DYN, END=1, STEPS=1\nUNITS/SYSTEM={system}\nSIM/DYN, END=2, STEPS=1",
        error=1e-9,
    )  # fmt: skip
    assert results["POINT_MASS/2.vy"][-1] == pytest.approx(factor - 2 * 9.81, rel=1e-5)


@pytest.mark.parametrize("pattern", ["T", "F", "T:F:F", "F:T"])
def test_a_matrix_that_is_not_renewed_leads_to_the_same_equilibrium(pattern: str) -> None:
    """The pendulum hangs, held by a spring of 3 N m / rad: 19.62 sin a = 3 (90 deg - a)."""
    spring = "SPRINGDAMPER/1, ROTATIONAL, I=3, J=1, KT=3\n"
    results = run(PENDULUM + spring, f"EQUILIBRIUM/PATTERN={pattern}\nSIM/STATICS")
    usual = run(PENDULUM + spring, "SIM/STATICS")
    angle = np.arctan2(results["PART/2.x"][0], -results["PART/2.y"][0])
    assert 19.62 * np.sin(angle) == pytest.approx(3 * (np.pi / 2 - angle), abs=1e-3)
    fewer = results.summary["factorizations"] < results.summary["newton"]
    assert fewer == (pattern != "T")
    assert usual.summary["factorizations"] >= usual.summary["newton"]


# ---- SAVE and RELOAD --------------------------------------------------------------------------

#: A double pendulum with a motor that gets faster, a state, a friction and a counted angle.
DRIVEN = (
    PENDULUM
    + """MARKER/4, PART=2, QP=1,0,0
PART/5, MASS=1, CM=5, IP=0.1,0.1,0.1, QG=2,-1,0
MARKER/5, PART=5
MARKER/6, PART=5, QP=0,1,0
JOINT/2, REVOLUTE, I=6, J=4
DIFF/1, IC=1, FUNCTION=WZ(6,4)-DIF(1)
SFORCE/1, ROTATIONAL, I=6, J=4, FUNCTION=3*DIF(1)-0.1*AZ(6,4)
VARIABLE/1, FUNCTION=2*AZ(3,1)+DIF(1)
REQUEST/1, F1=VARVAL(1)\\F2=AZ(6,4)
"""
)
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
FIRST, SECOND = "SIM/DYN, END=0.5, STEPS=5", "SIM/DYN, END=1, STEPS=5"


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


# ---- INFO -------------------------------------------------------------------------------------


def test_info_prints_values_of_the_present_state() -> None:
    """A mass of 2 that has fallen for 1 s, and the force of its weight on a spring of 2 N/m."""
    spring = "SPRINGDAMPER/1, TRANSLATIONAL, I=2, J=4, K=2, LENGTH=1\nMARKER/4, PART=1, QP=1,0,0\n"
    results = run(
        FALL,
        "INFO/DISP, I=2\nSIM/DYN, END=1, STEPS=1\nINFO/DISPLACEMENT, I=1, J=2\nINFO/VEL, I=2\n"
        "INFO/ACC, I=2, RM=1\nSIM/DYN, END=2, STEPS=1",
        error=1e-10,
    )  # fmt: skip
    first, second, third, fourth = results.meta["info"].split("; ")
    assert first == "t = 0: DISPLACEMENT I=2: DM 0, DX 0, DY 0, DZ 0, PSI 0, THETA 0, PHI 0"
    assert second.startswith("t = 1: DISPLACEMENT I=1, J=2: DM 4.905") and "DY 4.905" in second
    assert "VX 0, VY -9.81" in third and "ACCX 0, ACCY -9.81" in fourth
    assert results["POINT_MASS/2.y"] == pytest.approx([0, -4.905, -19.62], abs=1e-7)
    held = run(FALL + spring, "SIM/INIT\nINFO/FORCE, I=2, J=4\nINFO/FORCE, I=4, J=2, RM=2")
    assert "FX 0, FY 0" in held.meta["info"]  # as long as it is at the start
    pulled = run(
        FALL.replace("CM=2\n", "CM=2, QG=-1,0,0\n") + spring, "SIM/INIT\nINFO/FORCE, I=2, J=4"
    )
    assert "FM 2, FX 2, FY 0" in pulled.meta["info"]


def test_info_leaves_the_run_as_it_is() -> None:
    plain, asked = (run(DRIVEN, f"{FIRST}\n{words}{SECOND}") for words in ("", "INFO/VEL, I=5\n"))
    assert np.array_equal(plain.values, asked.values)
    assert "t = 0.5: VELOCITY I=5: VM" in asked.meta["info"]


# ---- LINEAR -----------------------------------------------------------------------------------

#: Two equal masses between walls, three equal springs: 1 and sqrt(3) times sqrt(k/m) = 2 rad/s.
CHAIN = """two masses on three springs of 4 N/m
UNITS/SYSTEM=MKS
PART/1, GROUND
MARKER/1, PART=1
MARKER/4, PART=1, QP=3,0,0
POINT_MASS/2, MASS=1, CM=2, QG=1,0,0
MARKER/2, POINT_MASS=2
POINT_MASS/3, MASS=1, CM=3, QG=2,0,0
MARKER/3, POINT_MASS=3
JPRIM/1, INLINE, I=2, J=5
JPRIM/2, INLINE, I=3, J=5
MARKER/5, PART=1, REULER=90D,90D,0
SPRINGDAMPER/1, TRANSLATIONAL, I=2, J=1, K=4, LENGTH=1
SPRINGDAMPER/2, TRANSLATIONAL, I=3, J=2, K=4, LENGTH=1
SPRINGDAMPER/3, TRANSLATIONAL, I=4, J=3, K=4, LENGTH=1
VFORCE/1, I=2, J_PART=1, FX=VARVAL(1)\\FY=0\\FZ=0
VARIABLE/1, FUNCTION=0
VARIABLE/2, FUNCTION=DX(3)
PINPUT/1, VARIABLES=1
POUTPUT/1, VARIABLES=2
"""


@pytest.fixture
def chain(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Callable[[str], int]:
    """Solve the chain with these commands in a folder of its own."""
    monkeypatch.chdir(tmp_path)
    Path("o.adm").write_text(CHAIN)

    def solve(commands: str) -> int:
        Path("o.acf").write_text(f"SIM/STATICS\n{commands}\n")
        return main(["solve", "o.adm"])

    return solve


def shapes(name: str) -> dict[tuple[int, str], tuple[float, float]]:
    """Magnitude and phase of each mode and coordinate of a file of mode shapes."""
    rows = [line.split(",") for line in Path(name).read_text().splitlines()[1:]]
    return {(int(row[0]), row[2]): (float(row[3]), float(row[4])) for row in rows}


def test_coords_writes_mode_shapes(chain: Callable[[str], int]) -> None:
    """Both masses go the same way at 2 rad/s, against each other at sqrt(12) rad/s."""
    assert chain("LINEAR/EIGENSOL, COORDS=1,25\nLINEAR/EIGENSOL, COORDS=2") == 0
    assert sorted(each.name for each in Path().iterdir()) == [
        "o.2.modes.csv", "o.2.shapes.csv", "o.acf", "o.adm", "o.csv", "o.modes.csv", "o.shapes.csv",
    ]  # fmt: skip
    found = shapes("o.shapes.csv")
    assert {mode for mode, _ in found} == {1, 2}
    assert found[1, "POINT_MASS/2.x"] == pytest.approx((1, 0), abs=1e-9)
    assert found[1, "POINT_MASS/3.x"] == pytest.approx((1, 0), abs=1e-9)
    size, phase = found[2, "POINT_MASS/3.x"]
    assert (size, abs(phase)) == pytest.approx((1, 180)) and found[2, "POINT_MASS/2.x"] == (1, 0)
    assert found[1, "POINT_MASS/2.y"][0] < 1e-9
    assert {mode for mode, _ in shapes("o.2.shapes.csv")} == {2}


def test_shapes_of_equal_frequencies_are_different_ones(chain: Callable[[str], int]) -> None:
    Path("o.adm").write_text(CHAIN.replace("SPRINGDAMPER/2", "! "))
    assert chain("LINEAR/EIGENSOL, COORDS=1,2") == 0
    found = shapes("o.shapes.csv")
    table = np.array([[found[m, f"POINT_MASS/{b}.x"][0] for b in (2, 3)] for m in (1, 2)])
    assert abs(np.linalg.det(table)) == pytest.approx(1, abs=1e-9)


def test_matlab_tables(chain: Callable[[str], int]) -> None:
    """Four files of plain numbers; C (s I - A)^-1 B + D is the response of mass 2 to a force."""
    assert chain("LINEAR/STATEMAT, FILE=plant, FORMAT=MATLAB, PINPUT=1, POUTPUT=1") == 0
    a, b, c, d = (np.loadtxt(f"plant{letter}", ndmin=2) for letter in "abcd")
    s = 0.7j
    response = c @ np.linalg.solve(s * np.eye(len(a)) - a, b) + d
    stiffness = np.array([[8 + s**2, -4], [-4, 8 + s**2]])
    assert response[0, 0] == pytest.approx(np.linalg.solve(stiffness, [1, 0])[1], rel=1e-9)


@pytest.mark.parametrize(
    ("ports", "letters"), [("", "a"), (", PINPUT=1", "ab"), (", POUTPUT=1", "ac")]
)
def test_tables_that_are_empty_are_not_written(
    chain: Callable[[str], int], ports: str, letters: str
) -> None:
    assert chain(f"LINEAR/STATEMAT, FORMAT=MATLAB{ports}") == 0
    assert {each.name for each in Path().glob("*states*")} == {f"o.states.{k}" for k in letters}


def test_a_table_takes_no_other_file(chain: Callable[[str], int]) -> None:
    plain = "LINEAR/STATEMAT, FILE=pa"
    assert chain(f"LINEAR/STATEMAT, FILE=p, FORMAT=MATLAB\n{plain}") == 3
    assert chain("LINEAR/STATEMAT, FILE=o.c, FORMAT=MATLAB") == 0


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


# ---- flags beside commands --------------------------------------------------------------------


def test_a_flag_for_the_end_leaves_commands_in_their_order() -> None:
    """What follows the last SIMULATE sees its end: y = -4.905 t^2 at t = 2."""
    after = "INFO/DISP, I=2\nLINEAR/EIGENSOL"
    results = run(FALL, f"SIM/DYN, END=1, STEPS=4\n{after}\nSTOP", end=2.0, steps=2, error=1e-9)
    assert results.time == pytest.approx([0, 1, 2])
    assert results.linearizations[0].time == 2.0
    assert "t = 2: DISPLACEMENT I=2: DM 19.62" in results.meta["info"]
    fewer = run(FALL, f"SIM/DYN, END=1, STEPS=4\n{after}", steps=1, error=1e-9)
    assert fewer.time == pytest.approx([0, 1]) and fewer.linearizations[0].time == 1.0


def test_a_flag_for_the_end_replaces_no_equilibrium() -> None:
    """The spring of 100 N/m holds 2 kg 0.1962 m lower; from there nothing moves."""
    spring = (
        "SPRINGDAMPER/1, TRANSLATIONAL, I=2, J=3, K=100, LENGTH=1\nMARKER/3, PART=1, QP=0,1,0\n"
    )
    results = run(FALL + spring, "SIM/STATICS", end=2.0, steps=2)
    assert results.time == pytest.approx([0, 1, 2])
    assert results["POINT_MASS/2.y"] == pytest.approx([-0.1962] * 3, abs=1e-6)


def test_kenergy_writes_shares_of_bodies(chain: Callable[[str], int]) -> None:
    """Masses of 1 and 3 on three springs: shares m phi^2 of the modes of (K - w^2 M) phi = 0."""
    Path("o.adm").write_text(CHAIN.replace("POINT_MASS/3, MASS=1", "POINT_MASS/3, MASS=3"))
    assert chain("LINEAR/EIGENSOL, KENERGY=1,2") == 0
    rows = [line.split(",") for line in Path("o.kinetic.csv").read_text().splitlines()[1:]]
    found = np.array([float(row[3]) for row in rows]).reshape(2, 2)
    mass = np.array([1.0, 3.0])
    squares, modes = np.linalg.eig(np.array([[8.0, -4.0], [-4.0, 8.0]]) / mass[:, None])
    shares = (mass[:, None] * modes**2)[:, np.argsort(squares)]
    assert found == pytest.approx((shares / shares.sum(axis=0)).T, abs=1e-9)
    assert [row[2] for row in rows] == ["POINT_MASS/2", "POINT_MASS/3"] * 2


@pytest.mark.parametrize("turned", [("IP=5,6,3", ""), ("IP=5,3,6", ", REULER=0,90D,0")])
def test_kinetic_energy_of_turning_parts(
    chain: Callable[[str], int], turned: tuple[str, str]
) -> None:
    """Flywheels of 3 and 1 kg m2 about z on torsion springs of 2 N m, ground - first - second.

    (K - w^2 I) phi = 0 with K = [[4, -2], [-2, 2]]; also where y of the mass centre is along z.
    """
    tensor, axes = turned
    Path("o.adm").write_text(
        "flywheels\nPART/1, GROUND\nMARKER/1, PART=1\n"
        f"PART/2, MASS=1, CM=2, {tensor}\nMARKER/2, PART=2{axes}\nMARKER/4, PART=2\n"
        "PART/3, MASS=1, CM=3, IP=5,5,1\nMARKER/3, PART=3\n"
        "JOINT/1, REVOLUTE, I=4, J=1\nJOINT/2, REVOLUTE, I=3, J=1\n"
        "SPRINGDAMPER/1, ROTATIONAL, I=4, J=1, KT=2\nSPRINGDAMPER/2, ROTATIONAL, I=3, J=4, KT=2\n"
    )
    assert chain("LINEAR/EIGENSOL, KENERGY=1,2") == 0
    rows = [line.split(",") for line in Path("o.kinetic.csv").read_text().splitlines()[1:]]
    found = np.array([float(row[3]) for row in rows]).reshape(2, 2)
    inertia = np.array([3.0, 1.0])
    squares, modes = np.linalg.eig(np.array([[4.0, -2.0], [-2.0, 2.0]]) / inertia[:, None])
    shares = (inertia[:, None] * modes**2)[:, np.argsort(squares)]
    assert found == pytest.approx((shares / shares.sum(axis=0)).T, abs=1e-9)


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
