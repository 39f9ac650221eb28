"""Files of LINEAR: mode shapes, kinetic energy, state matrices."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from adamslite.cli.main import main

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
