"""Analyses that follow each other at one time: each has rows of its own in every format."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import adamslite
from adamslite.cli.main import main
from adamslite.outputs.csv import read
from adamslite.results.formats import formats
from adamslite.results.outcomes import Outcome
from adamslite.results.results import Results

# At rest y = -(1 + M g/K).
HUNG = """A mass on a spring
UNITS/SYSTEM=MKS
ACCGRAV/JGRAV=-10
PART/1, GROUND
MARKER/1, PART=1
POINT_MASS/2, MASS=1, CM=2, QG=0,-1,0
MARKER/2, POINT_MASS=2
SPRINGDAMPER/1, TRANSLATIONAL, I=2, J=1, K=100, C=5, LENGTH=1
REQUEST/1, F2=DY(2,1)\\F3=FY(2,1)
INTEGRATOR/GSTIFF, ERROR=1E-9
OUTPUT/REQSAVE
RESULTS/XRF
END
"""
THREE = "SIM/STATIC\nPOINT_MASS/2, MASS=2\nSIM/STATIC\nSPRINGDAMPER/1, K=400\nSIM/STATIC\n"
HEIGHTS = [-1.1, -1.2, -1.05]


def hung(commands: str, folder: Path) -> Results:
    (folder / "hung.adm").write_text(HUNG)
    (folder / "hung.acf").write_text(f"{commands}STOP\n")
    return adamslite.simulate(folder / "hung.adm")


@pytest.mark.numerical
def test_three_equilibria_are_three_rows_of_every_format(tmp_path: Path) -> None:
    results = hung(THREE, tmp_path)
    assert results.meta["analyses"] == "STATICS row 1; STATICS row 2; STATICS row 3"
    for suffix, each in formats().items():
        if each.read is None:
            continue
        path = tmp_path / f"x{suffix}"
        results.save(path)
        found = Results.load(path)
        np.testing.assert_allclose(found["REQUEST/1.F2"], HEIGHTS, rtol=1e-5)
        np.testing.assert_array_equal(found.time, [0.0, 0.0, 0.0])
        assert main(["diff", str(path), str(tmp_path / f"x{suffix}")]) == 0


def test_every_file_of_the_command_line_has_the_rows(tmp_path: Path) -> None:
    hung(THREE, tmp_path)
    path = tmp_path / "x.csv"
    words = ["--page", str(tmp_path / "x.html"), "--quiet"]
    assert main(["solve", str(tmp_path / "hung.adm"), "-o", str(path), *words]) == 0
    for file in ("x.csv", "x.req", "x.res"):
        found = Results.load(tmp_path / file)["REQUEST/1.F2"]
        np.testing.assert_allclose(found, HEIGHTS, rtol=1e-5)
    assert read(path).meta["analyses"].count("STATICS") == 3


def test_equilibria_at_one_time_are_plotted_over_their_rows(tmp_path: Path) -> None:
    figure = hung(THREE, tmp_path).plot("REQUEST/1.F2")
    (axis,) = figure.axes
    np.testing.assert_array_equal(axis.lines[0].get_xdata(), [1.0, 2.0, 3.0])
    assert axis.get_xlabel() == "row"


def test_motion_begins_with_the_row_of_its_equilibrium(tmp_path: Path) -> None:
    results = hung("SIM/STATIC\nSIM/DYN, END=1, STEPS=4\n", tmp_path)
    np.testing.assert_array_equal(results.time, np.linspace(0.0, 1.0, 5))
    assert "analyses" not in results.meta


def test_an_equilibrium_stays_where_the_model_changes_before_it_moves(tmp_path: Path) -> None:
    """Cut off, the mass falls; before, the spring carried 10 N."""
    cut = "SIM/STATIC\nDEACTIVATE/SPRINGDAMPER, ID=1\nSIM/DYN, END=1, STEPS=1\n"
    results = hung(f"{cut}SIM/DYN, END=2, STEPS=1\n", tmp_path)
    np.testing.assert_array_equal(results.time, [0.0, 0.0, 1.0, 2.0])
    np.testing.assert_allclose(results["REQUEST/1.F3"], [10.0, 0.0, 0.0, 0.0], rtol=1e-12)
    np.testing.assert_allclose(results["REQUEST/1.F2"], [-1.1, -1.1, -6.1, -21.1], rtol=1e-6)
    rows = "STATICS row 1; DYNAMICS row 2 to 3; DYNAMICS row 3 to 4"
    assert results.meta["analyses"] == rows


def test_a_run_whose_start_does_not_close_has_no_rows() -> None:
    open_ = HUNG.replace("REQUEST", "GCON/1, FUNCTION=1\nREQUEST")
    results = adamslite.simulate(open_, end=1.0, strict=None)
    assert results.outcome is Outcome.INITIAL_CONDITIONS_FAILED and results.count == 0


@pytest.mark.numerical
@pytest.mark.parametrize("seed", range(6))
def test_random_sequences_keep_every_equilibrium(seed: int, tmp_path: Path) -> None:
    random, lines, expected = np.random.default_rng(seed), [], []
    mass, stiffness = 1.0, 100.0
    for _ in range(8):
        if random.random() < 0.6:
            mass = float(random.integers(1, 9))
            lines.append(f"POINT_MASS/2, MASS={mass}")
        if random.random() < 0.4:
            stiffness = float(random.integers(50, 500))
            lines.append(f"SPRINGDAMPER/1, K={stiffness}")
        lines.append("SIM/STATIC")
        expected.append(-(1.0 + 10.0 * mass / stiffness))
    results = hung("\n".join([*lines, ""]), tmp_path)
    np.testing.assert_allclose(results["REQUEST/1.F2"], expected, rtol=1e-6)
