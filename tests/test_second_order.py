"""LINEAR/MKB: mass, damping, stiffness and inputs of small motions, as a file."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

from adamslite.cli.main import main

# Two masses in a row along x between walls: springs 30 (wall), 20 (between), dampers 1 and 0.5.
ROW = """two masses on springs
PART/1, GROUND
MARKER/1, PART=1, REULER=90D,90D,0
PART/2, MASS=2, CM=2, IP=1,1,1, QG=1,0,0
MARKER/2, PART=2, REULER=90D,90D,0
PART/3, MASS=5, CM=3, IP=1,1,1, QG=2,0,0
MARKER/3, PART=3, REULER=90D,90D,0
JOINT/1, TRANSLATIONAL, I=2, J=1
JOINT/2, TRANSLATIONAL, I=3, J=1
SPRINGDAMPER/1, TRANSLATIONAL, I=2, J=1, K=30, C=1, LENGTH=1
SPRINGDAMPER/2, TRANSLATIONAL, I=3, J=2, K=20, C=0.5, LENGTH=1
VARIABLE/1, FUNCTION=0
SFORCE/1, TRANSLATIONAL, ACTIONONLY, I=3, J=1, FUNCTION=VARVAL(1)
PINPUT/1, VARIABLES=1
{more}SIMULATE/STATICS
END
"""


@pytest.fixture
def written(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    """What LINEAR/MKB writes of the deck; None where the run fails."""
    monkeypatch.chdir(tmp_path)

    def run(more: str = "") -> dict | None:
        Path("row.adm").write_text(ROW.format(more=more))
        Path("row.acf").write_text("SIMULATE/STATICS\nLINEAR/MKB, FILE=out.json, PINPUT=1\n")
        code = main(["solve", "row.adm", "row.acf"])
        assert (code == 0) == Path("out.json").exists()
        return json.loads(Path("out.json").read_text()) if code == 0 else None

    return run


def test_matrices_of_two_masses(written) -> None:
    """In the coordinates x of the parts: M = diag(2, 5), K and B of the chain, F = (0, 1)."""
    found = written()
    rows = [found["coordinates"].index(f"PART/{n}.x") for n in (2, 3)]
    inverse = np.linalg.inv(np.array(found["basis"])[rows])
    turned = {word: inverse.T @ np.array(found[word]) @ inverse
              for word in ("mass", "damping", "stiffness")}  # fmt: skip
    assert turned["mass"] == pytest.approx(np.diag([2.0, 5.0]), abs=1e-9)
    assert turned["stiffness"] == pytest.approx(np.array([[50, -20], [-20, 20.0]]), abs=1e-7)
    assert turned["damping"] == pytest.approx(np.array([[1.5, -0.5], [-0.5, 0.5]]), abs=1e-9)
    assert inverse.T @ found["input_matrix"] == pytest.approx(np.array([[0.0], [1.0]]), abs=1e-9)
    assert found["inputs"] == ["VARIABLE/1"]


def test_states_that_are_no_motions_are_reported(written, capsys) -> None:
    assert written("DIFF/1, IC=1, FUNCTION=-DIF(1)\n") is None
    assert "LINEAR/MKB cannot write" in capsys.readouterr().err
