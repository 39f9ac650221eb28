"""Mechanisms with closed forms: what the joints do, not how they are written."""

from __future__ import annotations

import numpy as np
import pytest

import adamslite
from adamslite.results.results import Results

START = """mechanism
UNITS/SYSTEM=MKS
PART/1, GROUND
MARKER/1, PART=1
MARKER/2, PART=1, REULER=0,30D,0
PART/2, MASS=1, CM=20, IP=1,1,1
MARKER/20, PART=2
PART/3, MASS=2, CM=30, IP=1,2,3
MARKER/30, PART=3
INTEGRATOR/ERROR=1e-8
"""


def run(text: str, end: float = 1.0) -> Results:
    """Results of the start with more statements."""
    deck = adamslite.read(f"{START}{text}\nEND\n")
    results = adamslite.simulate(deck, end=end, steps=20)
    assert results.outcome.name == "DONE", results.message
    return results


def shafts(kind: str, first: str, second: str) -> tuple[np.ndarray, np.ndarray]:
    """Turn of the driving shaft and speed ratio of shafts at 30 degrees."""
    results = run(
        f"""PART/4, MASS=1, CM=40, IP=1,1,1, REULER=0,30D,0
MARKER/40, PART=4
MARKER/41, PART=4, {second}
MARKER/21, PART=2, {first}
JOINT/1, REVOLUTE, I=20, J=1
JOINT/2, CYLINDRICAL, I=40, J=2
JOINT/3, {kind}, I=21, J=41
JOINT/4, FIXED, I=30, J=1
MOTION/1, JOINT=1, FUNCTION=2*TIME
REQUEST/1, F1=WZ(20,1,1)\\F2=WZ(40,2,2)\\F3=AZ(20,1)""",
        end=4.0,
    )
    ratio = results["REQUEST/1.F2"] / results["REQUEST/1.F1"]
    return results["REQUEST/1.F3"], ratio


@pytest.mark.parametrize(
    ("kind", "first", "second", "phase"),
    [
        ("HOOKE", "REULER=0,0,0", "REULER=0,0,0", np.pi / 2),
        ("UNIVERSAL", "REULER=0,90D,0", "REULER=90D,90D,0", 0.0),
    ],
)
def test_a_cross_joint_has_the_speed_ratio_of_hooke(
    kind: str, first: str, second: str, phase: float
) -> None:
    turn, ratio = shafts(kind, first, second)
    b = np.radians(30.0)
    hooke = np.cos(b) / (1.0 - np.sin(b) ** 2 * np.cos(turn + phase) ** 2)
    assert np.abs(ratio - hooke).max() < 1e-7


@pytest.mark.parametrize("second", ["REULER=0,0,0", "REULER=0,180D,0"])
def test_a_constant_velocity_joint_keeps_the_speed(second: str) -> None:
    _, ratio = shafts("CONVEL", "REULER=0,0,0", second)
    assert np.abs(ratio - 1.0).max() < 1e-7


def test_a_screw_travels_its_pitch_in_a_turn_to_the_right() -> None:
    results = run(
        """JOINT/1, CYLINDRICAL, I=20, J=1
JOINT/2, SCREW, I=20, J=1, PITCH=0.5
JOINT/3, FIXED, I=30, J=1
MOTION/1, JOINT=1, ROTATION, FUNCTION=10*PI*TIME
REQUEST/1, F1=DZ(20,1,1)"""
    )
    assert results["REQUEST/1.F1"] == pytest.approx(2.5 * results.time, abs=1e-6)


def test_a_pinion_drives_its_rack_over_many_turns() -> None:
    results = run(
        """MARKER/3, PART=1, QP=0,-0.1,0.7, REULER=90D,90D,0
MARKER/31, PART=3, REULER=90D,90D,0, QP=0.3,-0.1,0
JOINT/1, REVOLUTE, I=20, J=1
JOINT/2, TRANSLATIONAL, I=31, J=3
JOINT/3, RACKPIN, I=20, J=31, PD=0.2
MOTION/1, JOINT=1, FUNCTION=20*TIME
REQUEST/1, F1=DZ(31,3,3)"""
    )
    moved = results["REQUEST/1.F1"] - results["REQUEST/1.F1"][0]
    assert moved == pytest.approx(0.1 * 20 * results.time, abs=1e-6)


def test_a_coupler_divides_the_turns() -> None:
    results = run(
        """MARKER/3, PART=1, QP=1,0,0
JOINT/1, REVOLUTE, I=20, J=1
JOINT/2, TRANSLATIONAL, I=30, J=1
COUPLER/1, JOINTS=1,2, SCALES=-4, TYPE=R:T
MOTION/1, JOINT=1, FUNCTION=12*TIME
SFORCE/1, TRANSLATIONAL, ACTIONONLY, I=30, J=1, FUNCTION=7
REQUEST/1, F1=DZ(30,1,1)\\F2=MOTION(1,0,8,0)"""
    )
    assert results["REQUEST/1.F1"] == pytest.approx(3.0 * results.time, abs=1e-6)
    assert results["REQUEST/1.F2"] == pytest.approx(-7.0 / 4.0, abs=1e-6)


def test_gears_turn_against_each_other_as_their_radii() -> None:
    results = run(
        """MARKER/3, PART=1, QP=3,0,0
MARKER/4, PART=1, QP=1,0,0, REULER=0,-90D,0
MARKER/31, PART=3, REULER=20D,0,0
JOINT/1, REVOLUTE, I=20, J=1
JOINT/2, REVOLUTE, I=31, J=3
GEAR/1, JOINTS=1,2, CV=4
MOTION/1, JOINT=1, FUNCTION=12*TIME
REQUEST/1, F1=AZ(31,3)"""
    )
    turned = results["REQUEST/1.F1"] - results["REQUEST/1.F1"][0]
    assert turned == pytest.approx(-6.0 * results.time, abs=1e-6)


UNITS = "FORCE=NEWTON, MASS=KILOGRAM, LENGTH={}, TIME=SECOND"


@pytest.mark.parametrize(("length", "ucf"), [("METER", 1.0), ("MILLIMETER", 1e3)])
@pytest.mark.parametrize("place", ["0.3,0,0", "0.1,-0.2,0.2"])
def test_moments_of_inertia_may_be_about_any_marker(place: str, length: str, ucf: float) -> None:
    """J = J_IM - m (d^2 1 - d d^T) about the mass centre; alpha = UCF J^-1 T from rest."""
    torque = np.array([3.0, -2.0, 4.0]) / ucf
    deck = START.replace("SYSTEM=MKS", UNITS.format(length)) + (
        "PART/4, MASS=2, CM=40, IM=41, IP=1,1.2,1.4,0.1,0.05,-0.1\nMARKER/40, PART=4\n"
        f"MARKER/41, PART=4, QP={place}\n"
        "VTORQUE/1, I=40, J_PART=1, TX={}\\TY={}\\TZ={}\nEND\n".format(*torque)
    )
    results = adamslite.simulate(adamslite.read(deck), end=0.01, steps=1)
    d = np.array([float(x) for x in place.split(",")])
    given = np.array([[1, -0.1, -0.05], [-0.1, 1.2, 0.1], [-0.05, 0.1, 1.4]])
    inertia = given - 2 * (d @ d * np.eye(3) - np.outer(d, d))
    found = [results[f"PART/4.{name}"][0] for name in ("alx", "aly", "alz")]
    assert found == pytest.approx(ucf * np.linalg.solve(inertia, torque), rel=1e-9)


def test_rates_and_angles_of_a_part_are_those_of_its_cm_marker() -> None:
    """psi adds up about z; WX and WZ are about x and z of the marker."""
    results = run(
        """PART/4, MASS=2, CM=40, IP=1,2,3, REULER=20D,0,0, WX=0.3, WZ=-0.2
MARKER/40, PART=4, QP=1,0,0, REULER=40D,30D,15D""",
        end=0.01,
    )
    angles = [results[f"PART/4.{n}"][0] for n in ("psi", "theta", "phi")]
    assert angles == pytest.approx(np.radians([60, 30, 15]), abs=1e-12)
    psi, theta, phi = angles
    level, up = np.array([np.cos(psi), np.sin(psi), 0]), np.array([-np.sin(psi), np.cos(psi), 0])
    z = np.array([0, 0, np.cos(theta)]) - np.sin(theta) * up
    x = np.cos(phi) * level + np.sin(phi) * np.cross(z, level)
    rates = [results[f"PART/4.{n}"][0] for n in ("wx", "wy", "wz")]
    assert rates == pytest.approx(0.3 * x - 0.2 * z, abs=1e-12)


@pytest.mark.parametrize(("place", "sense"), [(0.1, 1), (-0.1, -1)])
def test_a_gear_may_drive_a_rack(place: float, sense: int) -> None:
    """A turn by w about z moves what lies at (x, 0) along y by w x."""
    results = run(
        f"""MARKER/3, PART=1, QP=0.5,0,0, REULER=180D,90D,0
MARKER/31, PART=3, QP=0.5,0.3,0, REULER=180D,90D,0
MARKER/4, PART=1, QP={place},0,0, REULER=180D,90D,0
JOINT/1, REVOLUTE, I=20, J=1
JOINT/2, TRANSLATIONAL, I=31, J=3
GEAR/1, JOINTS=1,2, CV=4
MOTION/1, JOINT=1, FUNCTION=20*TIME
REQUEST/1, F1=DY(31,3)"""
    )
    moved = results["REQUEST/1.F1"] - results["REQUEST/1.F1"][0]
    assert moved == pytest.approx(sense * 0.1 * 20 * results.time, abs=1e-6)


def test_a_coupler_counts_from_where_it_is_drawn() -> None:
    """A slider drawn at 0.7 that goes three quarters of the way of one drawn at -0.2."""
    results = run(
        """MARKER/21, PART=2, QP=0,0,-0.2
MARKER/31, PART=3, QP=0,0,0.7
JOINT/1, TRANSLATIONAL, I=21, J=1
JOINT/2, TRANSLATIONAL, I=31, J=1
COUPLER/1, JOINTS=1,2, SCALES=3,-4
MOTION/1, JOINT=1, FUNCTION=TIME-0.2
REQUEST/1, F1=DZ(21,1)\\F2=DZ(31,1)"""
    )
    assert results["REQUEST/1.F1"] == pytest.approx(results.time - 0.2, abs=1e-6)
    assert results["REQUEST/1.F2"] == pytest.approx(0.75 * results.time + 0.7, abs=1e-6)


@pytest.mark.parametrize(
    ("how", "distance"),
    [
        ("FUNCTION=TIME**2", lambda t: t**2),
        ("VELOCITY, FUNCTION=2*TIME", lambda t: t**2),
        ("ACCELERATION, ICVEL=3, FUNCTION=6*TIME", lambda t: 3 * t + t**3),
    ],
)
def test_a_motion_follows_displacement_velocity_or_acceleration(how: str, distance) -> None:
    results = run(
        f"""JOINT/1, TRANSLATIONAL, I=20, J=1
JOINT/2, FIXED, I=30, J=1
MOTION/1, JOINT=1, {how}
REQUEST/1, F1=DZ(20,1)\\F2=ACCZ(20)\\F3=MOTION(1,0,4,0)"""
    )
    assert results["REQUEST/1.F1"] == pytest.approx(distance(results.time), abs=1e-5)
    assert results["REQUEST/1.F3"] == pytest.approx(results["REQUEST/1.F2"], abs=1e-5)


def test_reactions_balance_at_both_ends_and_in_other_axes() -> None:
    results = run(
        """ACCGRAV/KGRAV=-10
MARKER/21, PART=2, QP=-1,0,0, REULER=0,90D,0
MARKER/3, PART=1, QP=-1,0,0, REULER=0,90D,0
JOINT/1, FIXED, I=21, J=3
JOINT/2, FIXED, I=1, J=30
REQUEST/1, F1=FZ(21)\\F2=TY(21,3)\\F3=TY(3,21)\\F4=FY(21,3,3)\\F5=JOINT(2,1,4,0)\\
, F6=FM(3)\\F7=TM(21,3)\\F8=FZ(1)
REQUEST/2, FORCE, I=21, J=3"""
    )
    last = {n: results[f"REQUEST/1.F{n}"][-1] for n in range(1, 9)}
    expected = {1: 10.0, 2: -10.0, 3: 10.0, 4: 10.0, 5: 20.0, 6: 10.0, 7: 10.0, 8: -20.0}
    assert last == pytest.approx(expected, abs=1e-8)
    assert results["REQUEST/2.F4"][-1] == pytest.approx(10.0, abs=1e-8)
    assert results["JOINT/2.fz"][-1] == pytest.approx(-20.0, abs=1e-8)


def test_a_point_mass_slides_like_a_part_that_is_kept_from_turning() -> None:
    line = "MARKER/3, PART=1, REULER=0,60D,0\nACCGRAV/KGRAV=-10\n"
    native = run(
        line
        + """POINT_MASS/4, MASS=1, CM=40
MARKER/40, POINT_MASS=4
JPRIM/1, INLINE, I=40, J=3
REQUEST/1, F1=DZ(40)\\F2=JPRIM(1,0,1,0)"""
    )
    workaround = run(
        line
        + """JPRIM/1, INLINE, I=20, J=3
JPRIM/2, ORIENTATION, I=20, J=1
REQUEST/1, F1=DZ(20)\\F2=JPRIM(1,0,1,0)"""
    )
    fall = -0.5 * 10.0 * np.cos(np.radians(60.0)) ** 2 * native.time**2
    assert native["REQUEST/1.F1"] == pytest.approx(fall, abs=1e-6)
    for n in ("F1", "F2"):
        assert native[f"REQUEST/1.{n}"] == pytest.approx(workaround[f"REQUEST/1.{n}"], abs=1e-9)


def test_a_bead_runs_round_a_closed_hoop() -> None:
    angle = np.linspace(0.0, 2 * np.pi, 33)
    points = np.column_stack([np.cos(angle), np.sin(angle), 0 * angle])
    points[-1] = points[0]
    results = run(
        f"""MATRIX/1, ROWS=33, COLUMNS=3, VALUES={",".join(f"{v:.12f}" for v in points.ravel())}
CURVE/1, CLOSED, MATRIX=1, CURVE_POINTS
POINT_MASS/4, MASS=2, CM=40, QG=1,0,0, VY=3
MARKER/40, POINT_MASS=4
PTCV/1, I=40, CURVE=1, RM=1
REQUEST/1, F1=DM(40)\\F2=VM(40)\\F3=PTCV(1,0,1,0)\\F4=PTCV(1,1,1,0)""",
        end=5.0,
    )
    assert results["REQUEST/1.F1"] == pytest.approx(1.0, abs=1e-5)
    assert results["REQUEST/1.F2"] == pytest.approx(3.0, abs=1e-5)
    assert results["REQUEST/1.F3"] == pytest.approx(2 * 3.0**2, rel=1e-2)
    assert results["REQUEST/1.F4"] == pytest.approx(results["REQUEST/1.F3"], abs=1e-9)


def test_a_bead_starts_where_it_is_drawn_on_a_curve_that_lies_askew() -> None:
    """At speed 3 along the straight y = -1, z = 2 of a marker that is turned and moved."""
    results = run(
        """MARKER/3, PART=1, QP=1,2,3, REULER=90D,90D,0
MATRIX/1, ROWS=5, COLUMNS=3, VALUES=0,-1,2, 1,-1,2, 2,-1,2, 3,-1,2, 4,-1,2
CURVE/1, OPEN, MATRIX=1, CURVE_POINTS
POINT_MASS/4, MASS=2, CM=40, QG=3,2.5,2, VY=3
MARKER/40, POINT_MASS=4
PTCV/1, I=40, CURVE=1, RM=3
REQUEST/1, F1=DX(40,1)\\F2=DY(40,1)\\F3=DZ(40,1)"""
    )
    x, y, z = (results[f"REQUEST/1.F{n}"] for n in (1, 2, 3))
    assert x == pytest.approx(3.0, abs=1e-6) and z == pytest.approx(2.0, abs=1e-6)
    assert y == pytest.approx(2.5 + 3 * results.time, abs=1e-6)


def test_joints_tell_what_they_ask_for_at_the_start() -> None:
    deck = adamslite.read(
        START + "JOINT/1, CYLINDRICAL, I=20, J=1, ICTRAN=2, ICROT=90D,3\n"
        "JOINT/2, REVOLUTE, I=30, J=1, IC=1,2\nMOTION/1, JOINT=1, ROTATION, VELOCITY, ICDISP=4,"
        " FUNCTION=1\nEND\n"
    )
    first, second = deck.of("JOINT")
    assert first.initial() == [
        ("ictran", "TRANSLATION", 2.0, None),
        ("icrot", "ROTATION", pytest.approx(np.pi / 2), 3),
    ]
    assert second.initial() == [("ic", "ROTATION", 1.0, 2.0)]
    assert deck.of("MOTION")[0].initial() == [("icdisp", "ROTATION", 4.0, None)]
