"""Dynamic analyses of models without freedoms: their MOTIONs determine every posture."""

from __future__ import annotations

from math import acos, atan2, cos, pi, sin, sqrt

import numpy as np
import pytest

import adamslite
from adamslite.results.outcomes import Outcome
from adamslite.results.results import Results

pytestmark = pytest.mark.filterwarnings("ignore:.*corner")  # what is tested
METHODS = ("GSTIFF", "RADAU", "HHT", "ABAM", "AUTO")
HEAD = """A mechanism without freedoms
UNITS/SYSTEM=MKS
PART/1, GROUND
MARKER/1, PART=1
"""


class Input:
    """A random angle of time: a polygon of 3 to 6 corners, or a smooth one; its expression."""

    def __init__(self, random: np.random.Generator, piecewise: bool) -> None:
        self.piecewise, self.kind = piecewise, "DYNAMIC" if piecewise else "KINEMATICS"
        if piecewise:
            count = int(random.integers(3, 7))
            self.t = np.concatenate([[0.0], np.sort(random.uniform(0.05, 0.95, count)), [1.0]])
            self.y = np.concatenate([[0.0], random.uniform(-7.0, 7.0, count + 1)])
            text = f"{self.y[-1]:.17g}"
            for k in reversed(range(len(self.t) - 1)):
                slope = (self.y[k + 1] - self.y[k]) / (self.t[k + 1] - self.t[k])
                line = f"{self.y[k]:.17g}+({slope:.17g})*(TIME-{self.t[k]:.17g})"
                text = f"IF(TIME-{self.t[k + 1]:.17g}:{line},{self.y[k + 1]:.17g},{text})"
            self.text = text
        else:
            self.a, self.w, self.c = random.uniform([0.0, 1.0, -20.0], [3.0, 15.0, 20.0])
            self.text = f"{self.a}*SIN({self.w}*TIME)+({self.c})*TIME**2"

    def __call__(self, t: np.ndarray) -> np.ndarray:
        if self.piecewise:
            return np.interp(t, self.t, self.y)
        return self.a * np.sin(self.w * t) + self.c * t**2


def solved(deck: str, method: str, steps: int, kind: str = "DYNAMIC") -> Results:
    run = f"SIMULATE/{kind}, END=1, STEPS={steps}\nEND\n"
    return adamslite.simulate(f"{deck}INTEGRATOR/{method}\n{run}")


def crank_rocker(
    random: np.random.Generator, drive: Input, redundant: bool
) -> tuple[str, tuple[float, ...]]:
    """Four bars of Grashof's kind, in one of their two assemblies: d (ground), a, b, c.

    ``redundant``: all joints are REVOLUTE, in a plane that is tilted.
    """
    while True:
        a, d, b, c = np.append(0.2, random.uniform(0.5, 1.2, 3))
        if a + max(b, c, d) < 0.93 * (b + c + d - max(b, c, d)) and abs(b - c) < d - 1.25 * a:
            break
    side = float(random.choice([-1.0, 1.0]))
    bx, by, phi = four_bar(a, b, c, d, side, 0.0)
    beta = atan2(by, bx - a)
    p, t = random.uniform(0.2, 1.2, 2) if redundant else (0.0, 0.0)

    def at(x: float) -> str:
        """A point of the ground line."""
        return f"QG={x * cos(p)},{x * sin(p)},0"

    ball, tube = ("REVOLUTE", "REVOLUTE") if redundant else ("SPHERICAL", "CYLINDRICAL")
    deck = f"""A crank and a rocker
UNITS/SYSTEM=MKS
PART/1, GROUND
MARKER/1, PART=1, REULER={p},{t},0
MARKER/10, PART=1, {at(d).replace("QG", "QP")}, REULER={p},{t},0
PART/2, QG=0,0,0, REULER={p},{t},0, MASS=1, CM=20, IP=.1,.1,.1
MARKER/20, PART=2, QP={a / 2},0,0
MARKER/21, PART=2
MARKER/22, PART=2, QP={a},0,0
PART/3, {at(a)}, REULER={p},{t},{beta}, MASS=1, CM=30, IP=.1,.1,.1
MARKER/30, PART=3, QP={b / 2},0,0
MARKER/31, PART=3
MARKER/32, PART=3, QP={b},0,0
PART/4, {at(d)}, REULER={p},{t},{phi}, MASS=1, CM=40, IP=.1,.1,.1
MARKER/40, PART=4, QP={c / 2},0,0
MARKER/41, PART=4
MARKER/42, PART=4, QP={c},0,0
JOINT/1, REVOLUTE, I=21, J=1
JOINT/2, {ball}, I=31, J=22
JOINT/3, {tube}, I=32, J=42
JOINT/4, REVOLUTE, I=41, J=10
MOTION/1, JOINT=1, ROTATION, FUNCTION={drive.text}
REQUEST/1, F2=DX(42,1,1)\\F3=DY(42,1,1)\\F4=AZ(21,1)
REQUEST/2, F2=MOTION(1,0,8,1)
"""
    return deck, (a, b, c, d, side)


def four_bar(
    a: float, b: float, c: float, d: float, side: float, angle: float
) -> tuple[float, float, float]:
    """Joint of coupler and rocker, and the angle of the rocker, in closed form."""
    px, py = a * cos(angle), a * sin(angle)
    r = sqrt((px - d) ** 2 + py**2)
    phi = atan2(py, px - d) + side * acos((c * c + r * r - b * b) / (2 * c * r))
    return d + c * cos(phi), c * sin(phi), phi


@pytest.mark.numerical
@pytest.mark.parametrize("seed", range(12))
def test_four_bars_follow_their_crank(seed: int) -> None:
    random = np.random.default_rng(1200 + seed)
    drive = Input(random, piecewise=seed % 3 > 0)
    deck, bars = crank_rocker(random, drive, seed % 2 == 1)
    found = solved(deck, METHODS[seed % 5], int(random.integers(3, 60)), drive.kind)
    assert found.outcome is Outcome.DONE
    points = np.array([four_bar(*bars, angle)[:2] for angle in drive(found.time)])
    np.testing.assert_allclose(found["REQUEST/1.F2"], points[:, 0], atol=1e-9)
    np.testing.assert_allclose(found["REQUEST/1.F3"], points[:, 1], atol=1e-9)
    np.testing.assert_allclose(found["REQUEST/1.F4"], drive(found.time), atol=1e-9)
    assert ("speed jumps" in found.meta) == drive.piecewise


@pytest.mark.numerical
@pytest.mark.parametrize("seed", range(12))
def test_slider_cranks_follow_their_crank(seed: int) -> None:
    """x = r cos f + sqrt(l^2 - r^2 sin^2 f)."""
    random = np.random.default_rng(4200 + seed)
    drive = Input(random, piecewise=seed % 2 > 0)
    r, rod = random.uniform(0.1, 0.4), random.uniform(0.5, 1.0)
    deck = f"""{HEAD}MARKER/10, PART=1, REULER=90D,90D,0
PART/2, QG=0,0,0, MASS=1, CM=20, IP=.1,.1,.1
MARKER/20, PART=2
MARKER/21, PART=2, QP={r},0,0
PART/3, QG={r},0,0, MASS=1, CM=30, IP=.1,.1,.1
MARKER/30, PART=3
MARKER/31, PART=3, QP={rod},0,0
PART/4, QG={r + rod},0,0, MASS=1, CM=40, IP=.1,.1,.1
MARKER/40, PART=4
MARKER/41, PART=4, REULER=90D,90D,0
JOINT/1, REVOLUTE, I=20, J=1
JOINT/2, SPHERICAL, I=30, J=21
JOINT/3, CYLINDRICAL, I=31, J=40
JOINT/4, TRANSLATIONAL, I=41, J=10
MOTION/1, JOINT=1, ROTATION, FUNCTION={drive.text}
REQUEST/1, F2=DX(40,1)\\F3=VX(40,1)
"""
    found = solved(deck, METHODS[seed % 5], int(random.integers(2, 80)), drive.kind)
    assert found.outcome is Outcome.DONE
    angle = drive(found.time)
    exact = r * np.cos(angle) + np.sqrt(rod**2 - (r * np.sin(angle)) ** 2)
    np.testing.assert_allclose(found["REQUEST/1.F2"], exact, atol=1e-9)


@pytest.mark.numerical
@pytest.mark.parametrize("seed", range(12))
def test_cardan_shafts_follow_their_input(seed: int) -> None:
    """tan of the driven angle = tan(input)/cos(bend), through all turns."""
    random = np.random.default_rng(7200 + seed)
    drive = Input(random, piecewise=seed % 2 > 0)
    bend = random.uniform(0.1, 1.1)
    deck = f"""{HEAD}PART/2, MASS=1, CM=20, IP=.01,.01,.01
MARKER/20, PART=2
PART/3, MASS=1, CM=30, REULER=0,{bend},0, IP=.02,.02,.03
MARKER/30, PART=3
MARKER/31, PART=1, REULER=0,{bend},0
MARKER/22, PART=2, REULER=0,90D,0
MARKER/32, PART=3, ZP=1,0,0, XP=0,0,1
JOINT/1, REVOLUTE, I=20, J=1
JOINT/2, REVOLUTE, I=30, J=31
JOINT/3, UNIVERSAL, I=22, J=32
MOTION/1, JOINT=1, ROTATION, FUNCTION={drive.text}
REQUEST/1, F3=AZ(20,1)\\F4=AZ(30,31)
"""
    found = solved(deck, METHODS[seed % 5], int(random.integers(2, 80)), drive.kind)
    assert found.outcome is Outcome.DONE
    angle = drive(found.time)
    turns = np.round(angle / pi)
    exact = turns * pi + np.arctan(np.tan(angle - turns * pi) / cos(bend))
    np.testing.assert_allclose(found["REQUEST/1.F4"], exact, atol=1e-8)
    np.testing.assert_allclose(found["REQUEST/1.F3"], angle, atol=1e-9)


TURNTABLE = f"""{HEAD}PART/2, MASS=2, CM=20, IP=.1,.2,.3
MARKER/20, PART=2
JOINT/1, REVOLUTE, I=20, J=1
MOTION/1, JOINT=1, ROTATION, FUNCTION=%s
REQUEST/1, F2=AZ(20,1)\\F3=MOTION(1,0,8,0)
"""


@pytest.mark.parametrize("method", METHODS)
def test_a_speed_that_jumps_is_reported_once(method: str) -> None:
    found = solved(TURNTABLE % "MAX(0,TIME-0.3)-2*MAX(0,TIME-0.7)", method, 50)
    t = found.time
    exact = np.maximum(0, t - 0.3) - 2 * np.maximum(0, t - 0.7)
    np.testing.assert_allclose(found["REQUEST/1.F2"], exact, atol=1e-12)
    assert found.meta["speed jumps"].startswith("MOTION/1 at t = 0.3, 0.7: speeds")
    assert "no degree of freedom" in found.meta["kinematic"]


@pytest.mark.parametrize("method", METHODS)
def test_a_displacement_that_jumps_ends_the_run(method: str) -> None:
    found = solved(TURNTABLE % "IF(TIME-0.5:0.1*TIME,1,1)", method, 10)
    assert found.outcome is Outcome.BROKEN_MOTION
    assert "at t = 0.5, the displacement jumps" in found.message
    assert found.time[-1] == pytest.approx(0.4)


def test_torques_are_those_of_inverse_dynamics() -> None:
    found = solved(TURNTABLE % "SIN(3*TIME)", "GSTIFF", 20, "KINEMATICS")
    torque = -0.3 * 9 * np.sin(3 * found.time)
    np.testing.assert_allclose(found["REQUEST/1.F3"], torque, atol=1e-9)


def test_smooth_motions_are_integrated_as_they_were() -> None:
    found = solved(TURNTABLE % "SIN(3*TIME)", "GSTIFF", 20)
    assert found.success and "kinematic" not in found.meta and found.summary["newton"] > 20


@pytest.mark.parametrize(
    "more",
    ["DIFF/1, IC=1, FUNCTION=-DIF(1)", "SENSOR/1, FUNCTION=AZ(20,1)\\, VALUE=0.5, GE, HALT"],
)
def test_what_has_a_past_is_integrated(more: str) -> None:
    deck = TURNTABLE % "MAX(0,TIME-0.3)"
    assert "kinematic" not in solved(f"{deck}{more}\n", "GSTIFF", 10).meta
