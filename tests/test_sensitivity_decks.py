"""Derivatives of whole mechanisms against closed forms and other integrators' differences."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import mpmath as mp
import numpy as np
import pytest
from scenes import BALL_ON_A_FLOOR, GRAVITY, INERTIA, LENGTH, MASS, PENDULUM, PERIOD, RATE
from scipy.integrate import solve_ivp

import adamslite as al
from adamslite.sensitivity import study, taped

DECKS = Path(__file__).parents[1] / "decks"


def error(found: np.ndarray, expected: np.ndarray) -> float:
    """The largest gap against the largest value."""
    return float(np.abs(found - expected).max() / np.abs(expected).max())


def growing(t: float, m0: mp.mpf, k: mp.mpf, mu: mp.mpf, x0: mp.mpf) -> mp.mpf:
    """(m x')' + k x = 0, m = m0 + mu t, from rest: Bessel functions of order zero."""
    start, z = (2 * mp.sqrt(m0 * k * (1 + mu * s / m0)) / mu for s in (0, mp.mpf(t)))
    wronskian = mp.besselj(0, start) * mp.bessely(1, start) - mp.besselj(1, start) * mp.bessely(
        0, start
    )
    waves = mp.bessely(1, start) * mp.besselj(0, z) - mp.besselj(1, start) * mp.bessely(0, z)
    return x0 / wronskian * waves


def slopes_of(function: Callable[..., mp.mpf], times: np.ndarray, values: list, at: int) -> Any:
    """The derivative by one of the values, at every time."""
    given = [mp.mpf(str(value)) for value in values]

    def moved(t: float, value: mp.mpf) -> mp.mpf:
        return function(t, *given[:at], value, *given[at + 1 :])

    return np.array([float(mp.diff(lambda v, t=t: moved(t, v), given[at])) for t in times])


@pytest.mark.parametrize("method", ["GSTIFF", "RADAU"])
def test_a_growing_mass_on_a_spring(method):
    """Forces hang on accelerations; the rate of growth is the number in 10*TIME."""
    numbers = {
        "PART/2.MASS": 10.0, "SPRINGDAMPER/1.K": 4000.0, "VARIABLE/Dm.FUNCTION": 10.0,
        "PART/2.QG[0]": 0.01,
    }  # fmt: skip
    deck = DECKS / "growing-mass-spring" / "growing-mass-spring.adm"
    found = al.sensitivities(
        deck, numbers, ["PART/2.x"], end=1.0, steps=5, error=1e-12, integrator=method
    )
    for k, name in enumerate(numbers):
        expected = slopes_of(growing, found.time, [*numbers.values()], k)
        assert error(found.curve("PART/2.x", name), expected) <= 1e-6, name


@pytest.mark.parametrize("method", ["GSTIFF", "RADAU"])
def test_the_period_of_a_pendulum_by_its_length(method):
    """At the end of the period T(L) the speed is zero: d(wz)/dL = -wz' dT/dL.

    The length is in two numbers, the place of the body and of its pin.
    """
    by = ["PART/2.QG[0]", "MARKER/3.QP[0]"]
    found = al.sensitivities(
        PENDULUM, by, ["PART/2.wz@end"], end=PERIOD, steps=20, error=1e-11, integrator=method
    )
    at_end, marker = (found["PART/2.wz@end", name] for name in by)
    slope = MASS * GRAVITY * (INERTIA - MASS * LENGTH**2) / (MASS * LENGTH**2 + INERTIA) ** 2
    expected = -RATE * (PERIOD / 2) * slope / RATE
    assert at_end - marker == pytest.approx(expected, rel=1e-6)


FOUR_BAR = """a four-bar linkage of revolutes in space, three redundant rows
PART/1, GROUND
MARKER/1, PART=1
MARKER/2, PART=1, QP=0.4,0,0
PART/2, MASS=1, CM=22, IP=1E-4,8E-4,8E-4, REULER=90D,0,0
MARKER/20, PART=2
MARKER/21, PART=2, QP=0.1,0,0
MARKER/22, PART=2, QP=0.05,0,0
PART/3, MASS=2, CM=32, IP=1E-4,0.02,0.02, QG=0,0.1,0, REULER=32.3D,0,0
MARKER/30, PART=3
MARKER/31, PART=3, QP=0.35,0,0
MARKER/32, PART=3, QP=0.175,0,0
PART/4, MASS=1.5, CM=42, IP=1E-4,0.01,0.01, QG=0.4,0,0, REULER=109.9D,0,0
MARKER/40, PART=4
MARKER/41, PART=4, QP=0.3,0,0
MARKER/42, PART=4, QP=0.15,0,0
JOINT/1, REVOLUTE, I=20, J=1
JOINT/2, REVOLUTE, I=30, J=21
JOINT/3, REVOLUTE, I=31, J=41
JOINT/4, REVOLUTE, I=40, J=2
MOTION/1, JOINT=1, FUNCTION=PI/2+2*TIME
VARIABLE/rocker, FUNCTION=AZ(40,2)
END
"""


def rocker(t: float, a: mp.mpf, b: mp.mpf, c: mp.mpf, d: mp.mpf, w: mp.mpf) -> mp.mpf:
    """Angle of the rocker of a driven four-bar: crank a, coupler b, rocker c, ground d."""
    x, y = a * mp.cos(mp.pi / 2 + w * t) - d, a * mp.sin(mp.pi / 2 + w * t)
    gap = mp.sqrt(x**2 + y**2)
    return mp.atan2(y, x) - mp.acos((c**2 + gap**2 - b**2) / (2 * c * gap))


@pytest.mark.filterwarnings("ignore::adamslite.DeckWarning")
def test_a_driven_four_bar_with_redundant_rows():
    names = ["MARKER/21.QP[0]", "MARKER/31.QP[0]", "MARKER/41.QP[0]", "MARKER/2.QP[0]",
             "MOTION/1.FUNCTION[1]"]  # fmt: skip
    lengths = [0.1, 0.35, 0.3, 0.4, 2.0]
    found = al.sensitivities(FOUR_BAR, names, ["VARIABLE/rocker"], end=1.0, steps=10, error=1e-8)
    for k, name in enumerate(names):
        expected = slopes_of(rocker, found.time, lengths, k)
        assert error(found.curve("VARIABLE/rocker", name), expected) <= 1e-6, name


DOUBLE_PENDULUM = """two boxes on revolutes with a damper in the first, let go level
PART/1, GROUND
MARKER/1, PART=1
ACCGRAV/JGRAV=-9.81
PART/2, MASS=13.86, CM=20, IP=0.01,0.293,0.293
MARKER/2, PART=2
MARKER/20, PART=2, QP=0.25,0,0
MARKER/21, PART=2, QP=0.5,0,0
PART/3, MASS=13.86, CM=30, IP=0.01,0.293,0.293, QG=0.5,0,0
MARKER/3, PART=3
MARKER/30, PART=3, QP=0.25,0,0
JOINT/1, REVOLUTE, I=2, J=1
JOINT/2, REVOLUTE, I=3, J=21
SFORCE/1, ROTATION, I=2, J=1, FUNCTION=-0.1*WZ(2,1,1)
VARIABLE/first, FUNCTION=AZ(2,1)
VARIABLE/second, FUNCTION=AZ(3,1)
END
"""


def double_pendulum(
    t: np.ndarray, m1: complex, m2: complex, damping: complex, g: complex, length: complex
) -> np.ndarray:
    """Angles (2, nt) of both boxes, 0.25 to their middles; pins of the first ``length`` apart."""
    half, inertia = 0.25, 0.293

    def rates(_: float, y: np.ndarray) -> np.ndarray:
        a, b, u, v = y
        c = m2 * length * half * np.cos(a - b)
        s = m2 * length * half * np.sin(a - b)
        matrix = np.array([[inertia + m1 * half**2 + m2 * length**2, c],
                           [c, inertia + m2 * half**2]])  # fmt: skip
        force = np.array([
            -s * v**2 - (m1 * half + m2 * length) * g * np.cos(a) - damping * u,
            s * u**2 - m2 * half * g * np.cos(b),
        ])  # fmt: skip
        return np.array([u, v, *np.linalg.solve(matrix, force)])

    start = np.zeros(4, dtype=complex)
    made = solve_ivp(rates, (0, t[-1]), start, "DOP853", t, rtol=1e-12, atol=1e-13)
    return made.y[:2]


@pytest.mark.parametrize("method", ["GSTIFF", "RADAU"])
def test_the_double_pendulum_whose_sensitivities_fail_elsewhere(method):
    """That of the Modelica library; another integrator in complex numbers gives derivatives."""
    numbers = {
        "PART/2.MASS": 13.86, "PART/3.MASS": 13.86, "SFORCE/1.FUNCTION": 0.1,
        "ACCGRAV.JGRAV": 9.81, "MARKER/21.QP[0]": 0.5,
    }  # fmt: skip
    signs = {"ACCGRAV.JGRAV": -1.0, "SFORCE/1.FUNCTION": 1.0}
    of = ["VARIABLE/first", "VARIABLE/second"]
    run = {"end": 1.5, "steps": 30, "integrator": method}
    found = al.sensitivities(DOUBLE_PENDULUM, numbers, of, error=1e-11, **run)
    for name, value in numbers.items():
        given = {**numbers, name: value + 1e-20j}
        expected = double_pendulum(found.time, *given.values()).imag / 1e-20
        expected *= signs.get(name, 1.0)
        for channel, slopes in zip(of, expected, strict=True):
            assert error(found.curve(channel, name), slopes) <= 1e-6, (channel, name)


FALL = """a mass falls from a height of 1 onto a constant push below 0
PART/1, GROUND
MARKER/1, PART=1
ACCGRAV/JGRAV=-9.81
POINT_MASS/2, MASS=2, CM=2, QG=0,1,0
MARKER/2, POINT_MASS=2
VFORCE/1, I=2, JFLOAT=3, RM=1, FX=IF(TIME-0.313: 0, 2, 2)\\FY=IF(DY(2,1): 50, 0, 0)\\FZ=0
MARKER/3, PART=1, FLOATING
END
"""


def fallen(t: np.ndarray, h: complex, g: complex, f: complex, m: complex) -> np.ndarray:
    """y(t) until it leaves the push; ``t`` behind the crossing."""
    first = np.sqrt(2 * h / g)
    s, speed = t - first, -g * first
    return speed * s + 0.5 * (f / m - g) * s**2


@pytest.mark.parametrize("method", ["GSTIFF", "RADAU"])
def test_forces_that_set_in_where_the_motion_takes_them(method):
    """The crossing hangs on the numbers, and accelerations jump there: velocities take it."""
    numbers = {"POINT_MASS/2.QG[1]": 1.0, "ACCGRAV.JGRAV": 9.81, "VFORCE/1.FY[0]": 50.0,
               "POINT_MASS/2.MASS": 2.0}  # fmt: skip
    run = {"end": 0.7, "steps": 35, "error": 1e-10, "integrator": method}
    found = al.sensitivities(FALL, [*numbers, "VFORCE/1.FX[0]"], ["POINT_MASS/2.?"], **run)
    later = found.time > 0.48
    for name, value in numbers.items():
        given = {**numbers, name: value + 1e-30j}
        expected = fallen(found.time[later], *given.values()).imag / 1e-30
        expected *= -1.0 if name == "ACCGRAV.JGRAV" else 1.0
        assert error(found.curve("POINT_MASS/2.y", name)[later], expected) <= 1e-6, name
    # x = (t - t0)^2/2 behind the time t0 in the text
    slopes = -np.maximum(found.time - 0.313, 0.0)
    assert error(found.curve("POINT_MASS/2.x", "VFORCE/1.FX[0]"), slopes) <= 1e-6


@pytest.mark.filterwarnings("ignore::adamslite.DeckWarning")
@pytest.mark.parametrize(
    ("name", "by", "run"),
    [
        ("pendulum-gcon", "ACCGRAV.JGRAV", {"end": 1.0, "steps": 40}),
        ("bricard", "MARKER/40.QP[1]", {"end": 0.5, "steps": 25}),
        ("four-bar", "JOINT/1.IC[1]", {"end": 0.5, "steps": 50}),
        ("spring-pendulum", "POINT_MASS/2.QG[2]", {"end": 2.0, "steps": 40}),
        ("heavy-top", "PART/2.IP[2]", {"end": 0.2, "steps": 10}),
    ],
)
def test_matrices_that_are_kept_cost_no_digits(name, by, run, monkeypatch):
    """Derivatives by matrices of earlier steps differ from those by matrices of all steps by less
    than either is off by; far fewer matrices are made.
    """
    made = []
    followed = taped.followed

    def watched(*given):
        made.append(followed(*given))
        return made[-1]

    monkeypatch.setattr(study, "followed", watched)
    deck = al.read(DECKS / name / f"{name}.adm")
    kept = al.sensitivities(deck, [by], ["*.?"], error=1e-8, integrator="GSTIFF", **run)
    monkeypatch.setattr(taped, "EXACT", True)
    exact = al.sensitivities(deck, [by], ["*.?"], error=1e-8, integrator="GSTIFF", **run)
    size = np.abs(exact.curves).max()
    assert np.abs(kept.curves - exact.curves).max() <= exact.errors[0] * size
    assert made[0].matrices <= 0.5 * made[1].matrices


@pytest.mark.filterwarnings("ignore::adamslite.DeckWarning")
@pytest.mark.parametrize("tolerance", [1e-5, 1e-8])
@pytest.mark.parametrize(
    ("name", "by", "run"),
    [
        ("four-bar", "JOINT/1.IC[1]", {"end": 0.5, "steps": 50}),
        ("slider-crank", "MARKER/21.QP[0]", {"end": 0.05, "steps": 25}),
        ("heavy-top", "PART/2.IP[2]", {"end": 0.2, "steps": 10}),
        ("car-axis", "POINT_MASS/3.QG[1]", {"end": 0.5, "steps": 25}),
    ],
)
def test_stages_leave_a_share_of_error(name, by, run, tolerance, monkeypatch):
    """Systems of stages solved as far as ERROR asks for, against round-off: multipliers of velocity
    rows move velocities alone, and grow from step to step where only places are looked at.
    """
    deck, method = al.read(DECKS / name / f"{name}.adm"), {"integrator": "RADAU"}
    near = al.sensitivities(deck, [by], ["*.?"], error=tolerance, **method, **run)
    monkeypatch.setattr(taped, "EXACT", True)
    exact = al.sensitivities(deck, [by], ["*.?"], error=tolerance, **method, **run)
    assert error(near.curves, exact.curves) <= 3.0 * tolerance


def test_a_bounce_against_differences():
    """Height, mass, stiffness, damping and the place of the floor, behind two bounces."""
    names = ["POINT_MASS/2.QG[1]", "POINT_MASS/2.MASS", *(f"VFORCE/1.FY[{k}]" for k in (0, 1, 3))]
    run, deck = {"end": 1.5, "steps": 3}, al.read(BALL_ON_A_FLOOR)
    found = al.sensitivities(deck, names, ["POINT_MASS/2.y@end"], error=1e-12, **run)
    for name, value in zip(found.by, found.at, strict=True):
        h = 1e-4 * value
        ends = {
            k: al.simulate(
                deck.with_values({name: value + k * h}), error=1e-13, integrator="RKF45", **run
            )["POINT_MASS/2.y"][-1]
            for k in (-2, -1, 1, 2)
        }
        slope = (8 * (ends[1] - ends[-1]) - (ends[2] - ends[-2])) / (12 * h)
        assert found["POINT_MASS/2.y@end", name] == pytest.approx(slope, rel=1e-5), name


def test_zeros_and_places_of_mass_centres_have_derivatives():
    """What is zero is left out of equations until a number asks for it: a damper of C = 0 takes
    c/(2 m) of the amplitude.
    """
    deck = """a mass on a spring with a damper that does nothing
PART/1, GROUND
MARKER/1, PART=1
POINT_MASS/2, MASS=2, CM=2, QG=2,0,0
MARKER/2, POINT_MASS=2
SPRINGDAMPER/1, TRANSLATIONAL, I=2, J=1, K=8, C=0, LENGTH=1
END
"""
    found = al.sensitivities(
        deck, ["SPRINGDAMPER/1.C"], ["POINT_MASS/2.x"], end=np.pi, steps=16, error=1e-10
    )
    t = found.time
    expected = -(t * np.cos(2 * t) - np.sin(2 * t) / 2) / 4
    gap = np.abs(found.curve("POINT_MASS/2.x", "SPRINGDAMPER/1.C") - expected).max()
    assert gap <= 1e-6


def test_a_number_that_drives_a_plane_motion_out_of_its_plane():
    """A rod on a ball joint swings in the plane; its speed across, which is zero, turns it out."""
    deck = al.read(
        PENDULUM.replace("JOINT/1, REVOLUTE", "JOINT/1, SPHERICAL").replace("CM=2", "CM=2, VZ=0")
    )
    run = {"end": 1.0, "steps": 4}
    found = al.sensitivities(deck, ["PART/2.VZ"], ["PART/2.*"], error=1e-9, **run)
    ends = [
        al.simulate(deck.with_values({"PART/2.VZ": v}), error=1e-12, integrator="RKF45", **run)
        for v in (1e-5, -1e-5)
    ]
    slopes = (ends[0]["PART/2.z"] - ends[1]["PART/2.z"]) / 2e-5
    assert np.abs(slopes).max() > 0.1
    assert error(found.curve("PART/2.z", "PART/2.VZ"), slopes) <= 1e-6
    assert np.abs(found.curve("PART/2.x", "PART/2.VZ")).max() <= 1e-9


@pytest.mark.parametrize("method", ["GSTIFF", "RADAU"])
def test_a_heavy_top_against_differences(method):
    """Turns in space: inertia about the axis of a top that spins fast."""
    deck, run = al.read(DECKS / "heavy-top" / "heavy-top.adm"), {"end": 0.2, "steps": 4}
    name = "PART/2.IP[2]"
    value = next(each.value for each in al.names(deck) if each.name == name)
    found = al.sensitivities(deck, [name], ["PART/2.*"], error=1e-9, integrator=method, **run)
    h = 1e-4 * value
    ends = [
        al.simulate(deck.with_values({name: v}), error=1e-13, integrator="RKF45", **run)
        for v in (value + h, value - h)
    ]
    for channel in ("PART/2.x", "PART/2.vz", "PART/2.wx", "PART/2.wz"):
        slopes = (ends[0][channel] - ends[1][channel]) / (2 * h)
        assert error(found.curve(channel, name), slopes) <= 1e-5, channel
