"""Command files that are carried out: what commands between analyses do to a run."""

from __future__ import annotations

import numpy as np
import pytest
from command_decks import DRIVEN, FALL, FIRST, PENDULUM, SECOND, run


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
