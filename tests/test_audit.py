"""The balance of energy that a run keeps of itself, and the faults that it must see."""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from scenes import GROUND, PENDULUM, SPRING, chain, options, run

from adamslite.cli.main import main
from adamslite.equations.system import System
from adamslite.results.results import Results

METHODS = ("GSTIFF", "GSTIFF I3", "HHT", "RADAU", "RKF45")
WINDOW = (
    GROUND
    + """POINT_MASS/2, MASS={mass}, CM=2, QG={at},0,0, VX={speed}
MARKER/2, POINT_MASS=2
VFORCE/1, I=2, J_PART=1, FX=IF(ABS(DX(2)-5)-.01:{force},0,0)
END
"""
)
SMOOTH = WINDOW.replace(
    "IF(ABS(DX(2)-5)-.01:{force},0,0)",
    "{force}*(STEP(DX(2),4.99,0,4.995,1)-STEP(DX(2),5.005,0,5.01,1))",
)
CHATTER = (
    GROUND
    + """POINT_MASS/2, MASS={mass}, CM=2, VX={speed}
MARKER/2, POINT_MASS=2
VFORCE/1, I=2, J_PART=1, FX=BISTOP(DX(2),VX(2),-1,1,1E8,1.1,0,1E-3)
GCON/1, FUNCTION=DY(2)
END
"""
)
TUMBLING = (
    GROUND
    + """PART/2, MASS=1, CM=2, IP=0.1,0.1,0.1, WX={x}, WY={y}
MARKER/2, PART=2
BUSHING/1, I=2, J=1, K=1E4,1E4,1E4, C={damping},0,0, KT={stiffness}
END
"""
)
#: A part and a point mass on a damped spring between them, in free flight.
FLIGHT = (
    GROUND
    + """PART/2, MASS=1, CM=2, IP=.1,.2,.3, QG=1,0,0, WX=3, VY=1
MARKER/2, PART=2
MARKER/4, PART=2, QP=.1,.2,0
POINT_MASS/3, MASS=2, CM=3, QG=2,.5,0
MARKER/3, POINT_MASS=3
SFORCE/1, TRANSLATIONAL, I=3, J=4, FUNCTION=-100*(DM(3,4)-.5)-VR(3,4)
END
"""
)
DRIVEN = PENDULUM.replace("END", "MOTION/1, JOINT=1, ROTATION, {law}\nEND")
RUBBING = PENDULUM.replace(
    "END",
    "FRICTION/1, JOINT=1, PIN_RADIUS=.05, MU_STATIC=.4, MU_DYNAMIC=.3, "
    "STICTION_TRANSITION_VELOCITY=.01\nEND",
)
SWINGING = PENDULUM.replace(
    "JOINT/1, REVOLUTE, I=3, J=1", "GCON/1, FUNCTION=DM(2,1)-1-.2*SIN(3*TIME)"
)


def audited(deck: str, end: float, steps: int, method: str, error: float = 1e-6) -> Results:
    """A run with its balance."""
    return run(deck, end, steps, audit=True, **options(method, error))


@pytest.fixture
def blind(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """Integrators that look for no change of an expression within their steps."""
    tables = System._tables

    def without_watch(system: System) -> None:
        tables(system)
        system.sizes.watched = system.sizes.zones = 0

    monkeypatch.setattr(System, "_tables", without_watch)
    yield


# ---- the faults put back -------------------------------------------------------------------------


@pytest.mark.parametrize("case", [(1, 10, 0, -1000), (4, -20, 10, 3000)])
@pytest.mark.parametrize("method", METHODS)
def test_a_force_that_every_step_passed_over_is_missing_in_the_balance(method, case, blind):
    """A window of 2 cm on a way of 100 m: its work is 0.02 force, and no step saw it."""
    mass, speed, at, force = case
    deck = WINDOW.format(mass=mass, speed=speed, at=at, force=force)
    results = audited(deck, 10.0, 10, method)
    assert results["POINT_MASS/2.vx"][-1] == pytest.approx(speed)
    (found,) = results.balances
    assert not found.closes
    assert found.gap == pytest.approx(0.02 * abs(force), rel=1e-3)
    assert "passed over a force" in results.meta["energy"]


@pytest.mark.parametrize("case", [(1, 33.3), (2, 20)])
def test_chatter_between_stops_that_gains_energy_is_told(case, blind):
    """Elastic stops at +-1: the speed is that of the start, and I3, which does not test velocities
    beside a constraint, makes more or less of it.
    """
    mass, speed = case
    results = audited(CHATTER.format(mass=mass, speed=speed), 10.0, 100, "GSTIFF I3")
    (found,) = results.balances
    inside = np.abs(results["POINT_MASS/2.x"]) < 1.0
    energy = 0.5 * mass * results["POINT_MASS/2.vx"][inside] ** 2
    assert np.ptp(energy) > 0.05 * energy[0]
    assert not found.closes


@pytest.mark.parametrize("turn", [(30, 1, 100, 0), (20, -2, 50, 3)])
@pytest.mark.parametrize("method", METHODS)
def test_a_tumbling_bushing_creates_energy(method, turn):
    """Past 90 degrees about x of J its torques have no potential."""
    x, y, stiffness, damping = turn
    three = ",".join(3 * [str(stiffness)])
    deck = TUMBLING.format(x=x, y=y, stiffness=three, damping=damping)
    (found,) = audited(deck, 3.0, 30, method, 1e-5).balances
    assert found.created > 0.05 * found.energy
    assert "small angles" in str(found)


@pytest.mark.parametrize("method", METHODS)
def test_a_smooth_window_that_every_step_passed_over_is_missing_too(method, blind):
    """Two STEPs of 5 mm, 15 mm wide in the mean."""
    deck = SMOOTH.format(mass=1, speed=10, at=0, force=-1000)
    (found,) = audited(deck, 10.0, 10, method).balances
    assert found.gap == pytest.approx(15.0, rel=1e-3) and not found.closes


# ---- what closes ---------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("method", "error"),
    [("GSTIFF", 1e-6), ("RADAU", 1e-6), ("RKF45", 1e-6), ("HHT", 1e-4), ("VERLET", 1e-4)],
)
@pytest.mark.parametrize("deck", (SPRING, chain(3)), ids=("spring", "chain"))
def test_the_balance_of_masses_on_springs_closes(deck, method, error):
    (found,) = audited(deck, 3.0, 30, method, error).balances
    assert found.closes and found.missed == 0
    assert found.gap < 1e3 * error * found.energy


@pytest.mark.parametrize(
    "deck",
    [
        PENDULUM, RUBBING, SWINGING, DRIVEN.format(law="FUNCTION=SIN(2*TIME)"),
        DRIVEN.format(law="VELOCITY, FUNCTION=2*COS(2*TIME)"),
        DRIVEN.format(law="ACCELERATION, FUNCTION=-4*SIN(2*TIME)"),
    ],
    ids=["pendulum", "friction", "gcon", "displacement", "velocity", "acceleration"],
)  # fmt: skip
@pytest.mark.parametrize("method", ("GSTIFF", "RADAU", "RKF45"))
def test_the_balance_counts_work_of_motions_and_friction(deck, method):
    (found,) = audited(deck, 3.0, 30, method).balances
    assert found.closes and found.missed == 0
    assert found.gap < 1e-4 * found.energy


def test_the_gap_is_what_a_run_has_lost():
    """m x'' = -k (x - 1): all of the energy 4 (x - 1)^2 + v^2 = 4 (per unit mass 2)."""
    results = audited(SPRING, 30.0, 300, "GSTIFF", 1e-4)
    x, v = results["POINT_MASS/2.x"][-1], results["POINT_MASS/2.vx"][-1]
    lost = 4.0 - (4.0 * (x - 1.0) ** 2 + v**2)
    assert results.balances[0].gap == pytest.approx(lost, rel=0.05)


@pytest.mark.parametrize("method", ("GSTIFF", "HHT", "RADAU", "RKF45"))
def test_momenta_are_kept_where_nothing_external_acts(method):
    (found,) = audited(FLIGHT, 3.0, 30, method).balances
    assert found.closes
    (linear, _), (angular, explained) = found.momenta
    assert linear < 1e-12 and angular <= explained
    assert "momenta are kept" in str(found)


def test_momenta_are_not_told_where_something_external_acts():
    for deck in (SPRING, PENDULUM, FLIGHT.replace("END", "ACCGRAV/JGRAV=-9.81\nEND")):
        assert audited(deck, 1.0, 10, "GSTIFF").balances[0].momenta == ()


@pytest.mark.parametrize("deck", (SPRING, RUBBING), ids=("spring", "friction"))
@pytest.mark.parametrize("method", METHODS)
def test_an_audit_changes_no_number(deck, method):
    plain = run(deck, 2.0, 20, **options(method, 1e-5))
    results = audited(deck, 2.0, 20, method, 1e-5)
    assert np.array_equal(plain.values, results.values)
    assert plain.balances == () and "energy" not in plain.meta


@pytest.mark.parametrize("flags", (["--quiet"], ["--summary", "json"], []))
def test_the_command_tells_what_is_wrong_even_when_it_is_quiet(
    flags, tmp_path, monkeypatch, capsys
):
    monkeypatch.chdir(tmp_path)
    Path("a.adm").write_text(TUMBLING.format(x=30, y=1, stiffness="100,100,100", damping=0))
    assert main(["solve", "a.adm", "--end", "3", "--steps", "30", "--audit", *flags]) == 0
    told = capsys.readouterr()
    assert "WARNING: BUSHING" in told.err
    if "json" in flags:
        assert json.loads(told.out)["energy_gap"] > 0.0
