"""Kinematic analyses: angles over many turns, whatever the output steps."""

from __future__ import annotations

import numpy as np
import pytest
from scenes import GROUND

import adamslite as al


def turned(way: str, steps: int, end: float = 10.0) -> al.Results:
    """AZ of a part on a pin that is turned by a function of TIME."""
    deck = (
        GROUND + "PART/2, MASS=1, CM=2, IP=1,1,1\nMARKER/2, PART=2\n"
        "JOINT/1, REVOLUTE, I=2, J=1\n"
        f"MOTION/1, JOINT=1, ROTATION, FUNCTION={way}\nREQUEST/1, F2=AZ(2,1)\n"
        f"SIMULATE/KINEMATICS, END={end}, STEPS={steps}\nEND\n"
    )
    found = al.simulate(al.read(deck))
    assert found.outcome is al.Outcome.DONE and len(found.time) == steps + 1
    return found


@pytest.mark.parametrize("steps", [1, 5, 50])
@pytest.mark.parametrize("rate", [2.0, -3.1, 9.0])
def test_turns_between_outputs_are_counted(rate: float, steps: int) -> None:
    """Ten seconds at 9 rad/s are 14 turns: all of them, in one output step as well."""
    found = turned(f"{rate}*TIME", steps)
    np.testing.assert_allclose(found["REQUEST/1.F2"], rate * found.time, atol=1e-9)


@pytest.mark.parametrize("steps", [2, 7])
@pytest.mark.parametrize("rate", [0.8, -2.5])
def test_turns_of_a_part_that_starts_at_rest_are_counted(rate: float, steps: int) -> None:
    found = turned(f"0.5*{rate}*TIME**2", steps)
    np.testing.assert_allclose(found["REQUEST/1.F2"], 0.5 * rate * found.time**2, atol=1e-9)


@pytest.mark.parametrize("kind", ["KINEMATICS", "TRANSIENT", "DYNAMICS"])
@pytest.mark.parametrize("level", ["VELOCITY", "ACCELERATION"])
def test_a_motion_that_gives_rates_is_integrated(kind: str, level: str) -> None:
    """w = sin 3 t, hence an angle of (1 - cos 3 t)/3; w' = 3 cos 3 t gives the same."""
    rate = "SIN(3*TIME)" if level == "VELOCITY" else "3*COS(3*TIME)"
    deck = (
        GROUND + "PART/2, MASS=1, CM=2, IP=1,1,1\nMARKER/2, PART=2\n"
        f"JOINT/1, REVOLUTE, I=2, J=1\nMOTION/1, JOINT=1, ROTATION, {level}, FUNCTION={rate}\n"
        "DIFF/1, IC=2, FUNCTION=-DIF(1)*WZ(2)\nREQUEST/1, F2=AZ(2,1)\n"
        f"INTEGRATOR/ERROR=1E-7\nSIMULATE/{kind}, END=2, STEPS=4\nEND\n"
    )
    found = al.simulate(al.read(deck))
    angle = (1 - np.cos(3 * found.time)) / 3
    np.testing.assert_allclose(found["REQUEST/1.F2"], angle, rtol=0, atol=1e-5)
    np.testing.assert_allclose(found["DIFF/1"], 2 * np.exp(-angle), rtol=0, atol=1e-5)
