"""Contacts and stops that a run never reaches are named after it, with how near it came."""

from __future__ import annotations

import re

import numpy as np
import pytest
from tiers import every

import adamslite

HEAD = """A ball between a floor, another ball and stops
UNITS/FORCE=NEWTON, MASS=KILOGRAM, LENGTH={unit}, TIME=SECOND
ACCGRAV/JGRAV={g!r}
PART/1, GROUND
MARKER/1, PART=1
MARKER/2, PART=1, QP=0,{floor!r},0, REULER=0,-90D,0
MARKER/4, PART=1, QP={other!r},0,0
PART/2, MASS=1, CM=3, IP=1,1,1, VX={vx!r}, VY={vy!r}
MARKER/3, PART=2
GRAPHICS/1, ELLIPSOID, CM=3, XSCALE={d!r}, YSCALE={d!r}, ZSCALE={d!r}
GRAPHICS/2, PLANE, RM=2, XMIN=-1, XMAX=1, YMIN=-1, YMAX=1
GRAPHICS/3, ELLIPSOID, CM=4, XSCALE={d!r}, YSCALE={d!r}, ZSCALE={d!r}
"""
LAW = "IMPACT, STIFFNESS={k!r}, EXPONENT=1.5, DAMPING=0, DMAX={d!r}\n"
FLOOR, BALL = "CONTACT/1, IGEOM=1, JGEOM=2, ", "CONTACT/2, IGEOM=1, JGEOM=3, "
STOP = (
    "SFORCE/1, ACTIONONLY, I=3, J=1\n"
    ", FUNCTION=BISTOP(DX(3,1),VX(3,1),-{far!r},{far!r},{k!r},1,0,{d!r})\n"
)
RUN = "SIMULATE/DYNAMIC, END={end!r}, STEPS={steps}\nEND\n"
UNITS = {"METER": 1.0, "MILLIMETER": 1e3}


WHOLE = FLOOR + LAW + BALL + LAW + STOP + RUN


def text(body: str = WHOLE, unit: str = "METER", **given: float) -> str:
    L = UNITS[unit]
    lengths = {"g": -9.81, "floor": -0.5, "other": 2.0, "vx": 1.0, "vy": 2.0, "d": 0.1, "far": 0.8}
    values = {name: given.get(name, value) * L for name, value in lengths.items()}
    values |= {"k": 1e4 / L**1.5, "end": given.get("end", 0.3), "steps": given.get("steps", 3)}
    return (HEAD + body).format(unit=unit, **values)


def missed(deck: str, **options: object) -> dict[str, float]:
    """What was not reached, and the distances that are reported."""
    results = adamslite.simulate(adamslite.read(deck), **options)
    found = re.findall(r"(\w+/\w+) by (\S+?)[,;]", results.meta.get("not reached", ""))
    return {label: float(value) for label, value in found}


@pytest.mark.parametrize("unit", UNITS)
@pytest.mark.parametrize("method", ["GSTIFF", "HHT", "RADAU", "RKF45", "ABAM", "NEWMARK"])
def test_distances_are_those_of_the_motion(unit: str, method: str) -> None:
    """For 0.3 s, x = t, y = 2 t - g t^2/2, radii 0.05: the floor at -0.5 is nearest at the start,
    by 0.45; the other ball at 2 and the stop at 0.8 at the end.
    """
    L, (x, y) = UNITS[unit], (0.3, 0.6 - 9.81 * 0.045)
    found = missed(text(unit=unit), integrator=method)
    assert found == {
        "CONTACT/1": pytest.approx(0.45 * L, rel=5e-3),
        "CONTACT/2": pytest.approx((np.hypot(2 - x, y) - 0.1) * L, rel=5e-3),
        "SFORCE/1": pytest.approx(0.5 * L, rel=5e-3),
    }


@pytest.mark.parametrize("unit", UNITS)
@pytest.mark.parametrize("values", [{}, {"vx": -0.3, "vy": 0.5, "floor": -0.9, "far": 0.4}])
def test_a_run_without_what_is_missed_is_the_same(unit: str, values: dict[str, float]) -> None:
    whole = text(unit=unit, **values)
    assert set(missed(whole)) == {"CONTACT/1", "CONTACT/2", "SFORCE/1"}
    one, other = (
        adamslite.simulate(adamslite.read(deck), error=1e-10)
        for deck in (whole, text(RUN, unit=unit, **values))
    )
    for axis in "xy":
        np.testing.assert_allclose(
            one[f"PART/2.{axis}"], other[f"PART/2.{axis}"], rtol=0, atol=1e-9 * UNITS[unit]
        )


@pytest.mark.parametrize("seed", every(4, range(24)))
@pytest.mark.parametrize("method", ["GSTIFF", "RADAU", "RKF45"])
def test_nothing_that_touches_is_called_missed(seed: int, method: str) -> None:
    """Random throws without friction: by the parabola each either passes at a distance or sinks
    in, also where it does so between outputs alone.
    """
    rng = np.random.default_rng(seed)
    vx, vy, floor = rng.uniform(0.5, 3), rng.uniform(-1, 3), -rng.uniform(0.1, 0.6)
    end, far = rng.uniform(0.1, 0.8), rng.uniform(0.1, 1.5)
    low = vy * end - 9.81 * end**2 / 2
    misses_floor = min(0.0, low) - 0.05 > floor
    found = missed(
        text(FLOOR + LAW + STOP + RUN, vx=vx, vy=vy, floor=floor, far=far, end=end, steps=1),
        integrator=method,
        error=1e-6,
    )
    assert ("CONTACT/1" in found) == misses_floor
    assert ("SFORCE/1" in found) == (vx * end < far)


@pytest.mark.parametrize("method", ["GSTIFF", "RADAU", "RKF45"])
def test_a_touch_too_weak_to_end_a_step_is_one(method: str) -> None:
    """At the top of the throw, 0.2039 high, a stop at 0.2035 is touched for 0.018 s."""
    stop = (
        "SFORCE/1, ACTIONONLY, I=3, J=1\n, FUNCTION=IMPACT({h}-DY(3,1),-VY(3,1),0,1E-12,1,0,0.1)\n"
    )
    for height, found in ((0.2035, {}), (0.2043, {"SFORCE/1": pytest.approx(4.3e-4, rel=0.1)})):
        deck = text(stop.format(h=height) + RUN, steps=1)
        assert missed(deck, integrator=method, error=1e-6) == found


def test_what_an_earlier_run_touched_was_reached() -> None:
    """The stop at 0.2 throws the ball back in the first SIMULATE; it ends on the other side."""
    run = "SIMULATE/DYNAMIC, END=0.3, STEPS=3\n"
    deck = text(STOP + run + RUN, far=0.2, end=0.35)
    assert missed(deck) == {}


def test_where_nothing_is_left_to_move_nothing_is_claimed() -> None:
    """A driven slider in front of a stop: its force is all that is asked for."""
    deck = text(
        "MARKER/5, PART=1, REULER=90D,90D,0\nMARKER/6, PART=2, REULER=90D,90D,0\n"
        "JOINT/1, TRANSLATIONAL, I=6, J=5\nMOTION/1, JOINT=1, TRANSLATION, FUNCTION=0.1*TIME\n"
        + STOP + "SIMULATE/KINEMATIC, END=0.3, STEPS=3\nEND\n", vy=0.0, vx=0.1,
    )  # fmt: skip
    assert missed(deck) == {}
