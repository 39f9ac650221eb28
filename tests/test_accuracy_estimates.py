"""What a run is estimated to be off by, beside what it is off by: motions with a truth."""

from __future__ import annotations

import math
import re

import numpy as np
import pytest
from scenes import GROUND, done
from scipy.spatial.transform import Rotation

import adamslite as al

HEAD = GROUND + "UNITS/SYSTEM=MKS\n"


def estimate(results: al.Results, name: str) -> float:
    """The estimated error of a channel; zero where nothing is said of it."""
    note = results.meta.get("accuracy", "")
    found = re.search(rf"(\S+)( rad)? in {name}( [xyz])? \(", note)
    return float(found[1]) if found else 0.0


def is_judged(results: al.Results, name: str, off: float, size: float) -> None:
    """What is off by 1 % or more is told within a factor of 3, what is off by 1e-4 is not."""
    told = estimate(results, name)
    assert told or off < 0.01 * size
    assert not told or off > 1e-4 * size
    if told and off < 0.3 * size:
        assert off / 3 < told < 3 * off


@pytest.mark.numerical
@pytest.mark.parametrize("error", [1e-3, 1e-4, 1e-6])
@pytest.mark.parametrize("method", ["GSTIFF", "RADAU", "HHT", "ABAM"])
def test_a_twist_of_turning_shafts_is_judged_by_itself(method: str, error: float) -> None:
    """Two shafts turn by 100 rad, 0.03 rad apart: I s" = -K s - C s' - 50 - 5 sin 300 t.

    On z = (s, s') a linear system: particular solutions, and two exponential functions.
    """
    deck = HEAD + (
        "PART/2, MASS=1, CM=2, IP=1,1,.02\nMARKER/2, PART=2\nMARKER/10, PART=1\n"
        "JOINT/1, REVOLUTE, I=2, J=10\nMOTION/1, JOINT=1, FUNCTION=100*TIME\n"
        "PART/3, MASS=1, CM=3, IP=1,1,.05, WZ=100\nMARKER/3, PART=3\nMARKER/11, PART=1\n"
        "JOINT/2, REVOLUTE, I=3, J=11\n"
        "SPRINGDAMPER/1, ROTATIONAL, I=3, J=2, KT=5000, CT=.2\n"
        "SFORCE/1, ROTATIONAL, ACTIONONLY, I=3, J=11, FUNCTION=-50-5*SIN(300*TIME)\n"
        "REQUEST/1, F2=AZ(3,2)\nEND\n"
    )
    results = done(deck, 1.0, 200, integrator=method, error=error)
    inertia, damping, stiffness, w, t = 0.05, 0.2, 5000.0, 300.0, results.time
    driven = -5.0 / (stiffness - inertia * w * w + 1j * damping * w)
    rate = np.roots([inertia, damping, stiffness])
    held = -50.0 / stiffness
    start = np.array([-held - driven.imag, -w * driven.real])
    free = np.linalg.solve(np.array([[1, 1], rate]), start)
    twist = held + (driven * np.exp(1j * w * t)).imag + (np.exp(np.outer(t, rate)) @ free).real
    off = np.abs(results["REQUEST/1.F2"] - twist).max()
    is_judged(results, "SPRINGDAMPER/1", off, np.ptp(twist))


@pytest.mark.numerical
@pytest.mark.parametrize("error", [1e-3, 1e-4, 1e-6])
@pytest.mark.parametrize("method", ["GSTIFF", "RADAU", "HHT", "ABAM"])
def test_an_orbit_is_judged_by_its_phase(method: str, error: float) -> None:
    """Five turns of an orbit of eccentricity 0.9: Kepler's equation."""
    deck = HEAD + (
        "POINT_MASS/2, MASS=1, CM=2, QG=.1,0,0, VY=4.358898943540674\nMARKER/2, POINT_MASS=2\n"
        "SFORCE/1, TRANSLATIONAL, I=2, J=1, FUNCTION=-1/DM(2,1)**2\nEND\n"
    )
    results = done(deck, 31.4, 314, integrator=method, error=error)
    anomaly = results.time.copy()
    for _ in range(200):
        anomaly -= (anomaly - 0.9 * np.sin(anomaly) - results.time) / (1.05 - 0.9 * np.cos(anomaly))
    x, y = np.cos(anomaly) - 0.9, math.sqrt(1 - 0.81) * np.sin(anomaly)
    off = np.hypot(results["POINT_MASS/2.x"] - x, results["POINT_MASS/2.y"] - y).max()
    is_judged(results, "POINT_MASS/2", off, 2.0)


@pytest.mark.numerical
@pytest.mark.parametrize("steps", [5, 40, 2000])
@pytest.mark.parametrize("error", [1e-3, 1e-6])
@pytest.mark.parametrize("method", ["GSTIFF", "RADAU", "HHT", "ABAM"])
def test_a_small_vibration_on_a_long_way_is_told(method: str, error: float, steps: int) -> None:
    """1 mm between two masses that go a kilometre: s = 1e-3 cos(w t)."""
    deck = HEAD + (
        "POINT_MASS/2, MASS=1000, CM=2, VX=50\nMARKER/2, POINT_MASS=2\n"
        "POINT_MASS/3, MASS=1, CM=3, QG=1.001,0,0, VX=50\nMARKER/3, POINT_MASS=3\n"
        "SPRINGDAMPER/1, TRANSLATIONAL, I=3, J=2, K=400, LENGTH=1\nEND\n"
    )
    results = done(deck, 20.0, steps, integrator=method, error=error)
    apart = results["POINT_MASS/3.x"] - results["POINT_MASS/2.x"] - 1.0
    off = np.abs(apart - 1e-3 * np.cos(math.sqrt(400 * 1.001) * results.time)).max()
    assert off < 2e-5 or estimate(results, "SPRINGDAMPER/1") > 1e-6
    assert off > 2e-7 or "accuracy" not in results.meta


@pytest.mark.numerical
@pytest.mark.parametrize("error", [1e-3, 1e-4, 1e-6])
@pytest.mark.parametrize("method", ["GSTIFF", "RADAU", "HHT", "ABAM"])
@pytest.mark.parametrize("law", ["bell", "slow"])
def test_the_speed_behind_a_bump_is_judged(law: str, method: str, error: float) -> None:
    """A mass passes a force that is narrow against its travel: v^2 = v0^2 - 2/m of its integral."""
    mass, v0, force, x0, w = 0.63, 125.0, 21300.0, 58.0, 0.031
    s = f"((DX(2,1)-{x0})/{w})**2"
    text = {"bell": f"EXP(-{s})", "slow": f"1/(1+{s})"}[law]
    work = force * w * {"bell": math.sqrt(math.pi), "slow": math.pi - 2 * w / x0}[law]
    deck = HEAD + (
        f"POINT_MASS/2, MASS={mass}, CM=2, VX={v0}\nMARKER/2, POINT_MASS=2\n"
        f"VFORCE/1, I=2, J_PART=1, FX=-{force}*{text}\nREQUEST/1, F2=VX(2,1)\nEND\n"
    )
    results = done(deck, 1.0, 20, integrator=method, error=error)
    lost = v0 - math.sqrt(v0 * v0 - 2 * work / mass)
    off = abs(results["REQUEST/1.F2"][-1] - v0 + lost)
    told = estimate(results, "REQUEST/1.F2")
    assert told or off < 0.01 * lost
    assert not told or off > 1e-4 * lost
    assert off < 1e-3 * lost or error > 1e-6 or law == "slow"


@pytest.mark.numerical
@pytest.mark.parametrize("steps", [3, 60])
@pytest.mark.parametrize("error", [1e-3, 1e-6])
@pytest.mark.parametrize("method", ["GSTIFF", "RADAU", "HHT", "ABAM", "NEWMARK"])
def test_a_sensor_near_a_peak_is_judged_by_its_time(method: str, error: float, steps: int) -> None:
    """A mass on a spring, x = cos(w t), is stopped at x = -0.97, before the second output or
    after some; places are right to a hundredth of what the time is.
    """
    w = 15.57
    deck = HEAD + (
        "POINT_MASS/2, MASS=1, CM=2, QG=1,0,0\nMARKER/2, POINT_MASS=2\n"
        f"VFORCE/1, I=2, J_PART=1, FX=-{w * w}*DX(2)\n"
        "SENSOR/1, FUNCTION=DX(2)\\, VALUE=-.97, ERROR=1e-6, LE, HALT\nEND\n"
    )
    results = al.simulate(al.read(deck), end=1.2, steps=steps, integrator=method, error=error)
    due = math.acos(-0.97) / w
    off = abs(float(results.time[-1]) - due)
    told = estimate(results, "the time of its end")
    assert told or off < 0.01 * due
    assert not told or off > 1e-4 * due


@pytest.mark.numerical
@pytest.mark.parametrize("error", [1e-3, 1e-6])
@pytest.mark.parametrize("method", ["GSTIFF", "RADAU", "HHT", "ABAM"])
def test_a_cardan_shaft_at_the_origin_is_right(method: str, error: float) -> None:
    """tan(driven) = tan(driving)/cos 30 deg; nothing to warn about."""
    deck = HEAD + (
        "PART/2, MASS=1, CM=20, IP=.01,.01,.01, WZ=10\nMARKER/20, PART=2\n"
        "PART/3, MASS=1, CM=30, REULER=0,30D,0, IP=.02,.02,.03, WZ=8.660254037844387\n"
        "MARKER/30, PART=3\nMARKER/31, PART=1, REULER=0,30D,0\n"
        "MARKER/22, PART=2, REULER=0,90D,0\nMARKER/32, PART=3, ZP=1,0,0, XP=0,0,1\n"
        "JOINT/1, REVOLUTE, I=20, J=1\nJOINT/2, REVOLUTE, I=30, J=31\n"
        "JOINT/3, UNIVERSAL, I=22, J=32\nMOTION/1, JOINT=1, ROTATION, FUNCTION=10*TIME\n"
        "REQUEST/1, F2=AZ(30,31)\nEND\n"
    )
    results = done(deck, 1.0, 200, integrator=method, error=error)
    turn = np.arctan2(np.sin(10 * results.time) / math.cos(math.pi / 6), np.cos(10 * results.time))
    off = results["REQUEST/1.F2"] - turn
    assert np.abs(off - 2 * np.pi * np.round(off / (2 * np.pi))).max() < 1e-4
    assert "accuracy" not in results.meta


@pytest.mark.numerical
@pytest.mark.parametrize("error", [1e-3, 1e-4, 1e-6])
@pytest.mark.parametrize("method", ["GSTIFF", "RADAU", "HHT", "ABAM"])
def test_a_chain_of_pendulums_is_not_determined_for_long(method: str, error: float) -> None:
    """Two bars that tumble for 15 s: the note says how far runs of different methods agree.  RADAU
    at 1e-6 has a coarser second run, which is lost at 9 s: 5.5 % was said of all of it.
    """
    deck = HEAD + (
        "ACCGRAV/JGRAV=-9.81\nPART/2, MASS=1, CM=21, IP=.1,.1,.1\nMARKER/2, PART=2\n"
        "MARKER/21, PART=2, QP=.5,0,0\nMARKER/22, PART=2, QP=1,0,0\n"
        "PART/3, MASS=1, CM=31, IP=.1,.1,.1, QG=1,0,0\nMARKER/3, PART=3\n"
        "MARKER/31, PART=3, QP=.5,0,0\nMARKER/10, PART=1\n"
        "JOINT/1, REVOLUTE, I=2, J=10\nJOINT/2, REVOLUTE, I=3, J=22\nEND\n"
    )
    best = done(deck, 15.0, 150, integrator="ABAM", error=1e-11)
    results = done(deck, 15.0, 150, integrator=method, error=error)
    off = np.abs(results["PART/3.x"] - best["PART/3.x"])
    note = results.meta.get("accuracy", "")
    assert "estimated global error" in note
    assert off.max() > 0.02
    assert "not determined" in note or off.max() < 0.9
    if "not determined" in note:
        since = float(note.split("from t = ")[1].split()[0])
        assert off[results.time < since - 0.5].max() < 0.5 and since > 4.0


@pytest.mark.numerical
@pytest.mark.parametrize("error", [1e-3, 1e-4, 1e-5, 1e-6])
@pytest.mark.parametrize("method", ["GSTIFF", "RADAU", "HHT", "ABAM"])
def test_a_window_is_told_though_two_runs_err_alike(method: str, error: float) -> None:
    """A force over 0.2 mm gives its work: GSTIFF is 7.3e-3 m/s off at 1e-4, 7.2e-3 at 1e-6."""
    rises, falls = (7.715768, 7.715800273999), (7.7159480172, 7.71600824896)
    deck = HEAD + (
        "POINT_MASS/2, MASS=0.4474, CM=2, VX=13.04\nMARKER/2, POINT_MASS=2\n"
        f"VFORCE/1, I=2, J_PART=1, FX=44764.5*(STEP5(DX(2),{rises[0]},0,{rises[1]},1)"
        f"-STEP5(DX(2),{falls[0]},0,{falls[1]},1))\nREQUEST/1, F2=DX(2)\\F3=VX(2)\nEND\n"
    )
    results = done(deck, 1.0, 20, integrator=method, error=error)
    work = 44764.5 * (sum(falls) - sum(rises)) / 2
    speed = math.sqrt(13.04**2 + 2 * work / 0.4474)
    off = abs(results["REQUEST/1.F3"][-1] - speed)
    limit = 1e-3 if error < 1e-3 else 1e-2
    assert estimate(results, "REQUEST/1.F3") or off < limit * (speed - 13.04)


TWO = ("GSTIFF", 1e-3), ("RADAU", 1e-9)


def test_a_slide_on_a_long_arm_is_not_doubted_across() -> None:
    """In mm the rail keeps y of the slider only to errors of turns, 1e-3 rad, times 200 mm."""
    deck = (
        "a slide\nUNITS/FORCE=NEWTON, MASS=KILOGRAM, LENGTH=MILLIMETER, TIME=SECOND\n"
        "ACCGRAV/JGRAV=-9806.65\nPART/1, GROUND\nMARKER/1, PART=1\n"
        "PART/2, MASS=3, CM=20, IP=2E4,2E4,3E4\nMARKER/20, PART=2\n"
        "JOINT/1, REVOLUTE, I=20, J=1\nMARKER/22, PART=2, REULER=90D,90D,0\n"
        "PART/3, MASS=0.5, CM=30, QG=200,0,0, IP=100,100,100\n"
        "MARKER/30, PART=3, REULER=90D,90D,0\nJOINT/2, TRANSLATIONAL, I=30, J=22\n"
        "SFORCE/1, TRANSLATIONAL, I=30, J=20, FUNCTION=-2*(DM(30,20)-200)-0.01*VR(30,20)\n"
        "SFORCE/2, ROTATION, I=20, J=1, ACTIONONLY, FUNCTION=2500*STEP(TIME,0,0,0.5,1)\nEND\n"
    )
    found, tight = (done(deck, 1.0, 50, integrator=m, error=e) for m, e in TWO)
    for name, most in (("PART/3.x", 428.7), ("PART/3.y", 430.4)):
        assert 1e-6 < np.abs(found[name] - tight[name]).max() / most < 2e-3
    assert "accuracy" not in found.meta


def turned(*angles: tuple[float, float, float]) -> str:
    """REULER of turns one after the other [degrees]."""
    whole = Rotation.identity()
    for each in angles:
        whole = whole * Rotation.from_euler("ZXZ", each, degrees=True)
    return ",".join(f"{x:.17g}D" for x in whole.as_euler("ZXZ", degrees=True))


@pytest.mark.parametrize("method", ["GSTIFF", "RADAU", "HHT"])
def test_an_angle_at_half_a_turn_is_no_error(method: str) -> None:
    """A body that turns about x of an oblique frame: there PSI of MARKER/2 is pi, by round-off on
    both sides, and y and z of its angular velocity are round-off."""
    frame, along = (20, 50, 30), (90, 90, 0)
    deck = GROUND + (
        f"MARKER/10, PART=1, REULER={turned(frame)}\n"
        "PART/2, MASS=1, CM=5, IP=1,2,3, QG=0.1,0.3,-0.4\nMARKER/5, PART=2\n"
        f"MARKER/2, PART=2, REULER={turned(frame, (180, 30, 0))}\n"
        f"MARKER/4, PART=2, QP=-0.1,-0.3,0.4, REULER={turned(frame, along)}\n"
        f"MARKER/3, PART=1, REULER={turned(frame, along)}\nJOINT/1, REVOLUTE, I=4, J=3\n"
        "ACCGRAV/KGRAV=-9.81\nREQUEST/1, DISPLACEMENT, I=2, J=10\n"
        "REQUEST/2, VELOCITY, I=2, J=10, RM=10\nEND\n"
    )
    results = done(deck, 4.0, 100, integrator=method, error=1e-8)
    psi = results["REQUEST/1.F6"]
    assert np.abs(np.abs(psi) - np.pi).max() < 1e-6 and np.ptp(results["REQUEST/2.F6"]) > 1.0
    note = results.meta.get("accuracy", "")
    assert "1.F6" not in note and "REQUEST/2" not in note and "not determined" not in note
