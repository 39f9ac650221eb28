"""Command files that are carried out: what commands between analyses do to a run."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import adamslite
from adamslite.reading.read import read, read_commands
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
