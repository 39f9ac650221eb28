"""INCANG along whole motions: an angle between two lines in a plane, and in space."""

from __future__ import annotations

import numpy as np
import pytest
from scenes import done

TURNTABLE = """A line that turns about the axis of a pin, and one that stands still
UNITS/SYSTEM=MKS
PART/1, GROUND
MARKER/1, PART=1, QP={origin}, REULER={axes}
MARKER/4, PART=1, QP={fixed}
PART/2, MASS=2, CM=2, QG={origin}, REULER={axes}, IP=0.1,0.1,0.2
MARKER/2, PART=2
MARKER/3, PART=2, QP={tip}
JOINT/1, REVOLUTE, I=2, J=1
{drive}
REQUEST/1, F1=INCANG(3,1,4)\\F2=INCANG(4,2,3)
END
"""
EXACT = {"integrator": "RADAU", "error": 1e-9}
ORIGIN, ANGLES = (0.3, -0.2, 0.5), (0.4, 1.1, -0.7)


def rotation(psi: float, theta: float, phi: float) -> np.ndarray:
    """Body-fixed 3-1-3."""

    def about(axis: int, q: float) -> np.ndarray:
        c, s = np.cos(q), np.sin(q)
        a, b = (axis + 1) % 3, (axis + 2) % 3
        r = np.eye(3)
        r[a, a], r[a, b], r[b, a], r[b, b] = c, -s, s, c
        return r

    return about(2, psi) @ about(0, theta) @ about(2, phi)


def deck(drive: str, fixed: tuple[float, ...], tip: tuple[float, ...] = (2, 0, 0)) -> str:
    """The lines, given along the axes of the pin."""
    place = np.array(ORIGIN) + rotation(*ANGLES) @ fixed

    def listed(values: object) -> str:
        return ", ".join(repr(float(v)) for v in np.array(values))

    return TURNTABLE.format(
        origin=listed(ORIGIN),
        axes=listed(ANGLES),
        fixed=listed(place),
        tip=listed(tip),
        drive=drive,
    )


@pytest.mark.parametrize("start", [0.4, 2.9])
@pytest.mark.parametrize("rate", [2.0, -3.1])
@pytest.mark.parametrize("formula", ["GSTIFF", "RADAU"])
def test_it_goes_on_past_a_half_turn(formula: str, rate: float, start: float) -> None:
    """Lines in one plane: start + rate t where the line turns away from the other, two turns long,
    and start - rate t where it turns towards it, through 0.
    """
    drive = f"MOTION/1, JOINT=1, FUNCTION={rate}*TIME"
    fixed = (np.cos(start), -np.sin(start), 0.0)
    results = done(deck(drive, fixed), 4.0, 100, integrator=formula, error=1e-9)
    assert results["REQUEST/1.F1"] == pytest.approx(start + rate * results.time, abs=1e-9)
    assert results["REQUEST/1.F2"] == pytest.approx(start + rate * results.time, abs=1e-9)


@pytest.mark.parametrize("start", [0.0, np.pi])
def test_lines_that_start_along_each_other(start: float) -> None:
    """The first value that is not 0 counts as positive; opposite lines come nearer, either way."""
    fixed = (3 * np.cos(start), 0.0, 0.0)
    for rate in (2.0, -2.0):
        results = done(deck(f"MOTION/1, JOINT=1, FUNCTION={rate}*TIME", fixed), 4.0, 100, **EXACT)
        expected = 2.0 * results.time if start == 0.0 else np.pi - 2.0 * results.time
        assert results["REQUEST/1.F1"] == pytest.approx(expected, abs=1e-7)


def test_lines_in_space_come_back() -> None:
    """A line on a cone passes the other one by: the plain angle, from arccos, for three turns."""
    results = done(
        deck("MOTION/1, JOINT=1, FUNCTION=5*TIME", (1, 0, 0), (1, 0, 0.4)), 4.0, 200, **EXACT
    )
    turned = np.cos(5 * results.time) / np.hypot(1, 0.4)
    assert results["REQUEST/1.F1"] == pytest.approx(np.arccos(turned), abs=1e-9)


@pytest.mark.parametrize("formula", ["GSTIFF", "HHT", "RADAU", "ABAM"])
def test_a_spring_of_the_included_angle(formula: str) -> None:
    """J a'' = -k (a - 3.6) about the pin, wound through the half turn: a = 3.6 - 2.4 cos(w t)."""
    torque = "VTORQUE/1, I=2, J_PART=1, RM=1, TZ=-0.2*6.25*(INCANG(3,1,4)-3.6)"
    fixed = (np.cos(1.2), -np.sin(1.2), 0.0)
    options = {"integrator": formula, "error": 1e-8}
    results = done(deck(torque, fixed), 2.0, 40, **options)
    expected = 3.6 - 2.4 * np.cos(2.5 * results.time)
    assert results["REQUEST/1.F1"] == pytest.approx(expected, abs=2e-5)
