"""A guard of time that touches zero without a slope is followed through its round-off."""

from __future__ import annotations

import numpy as np
import pytest
from pytest import approx
from scenes import done, options
from test_clock import pushed

import adamslite as al
from adamslite.results.outcomes import Outcome


def step5(x: np.ndarray, low: float, high: float) -> np.ndarray:
    """STEP5(x, low, 0, high, 1)."""
    d = np.clip((x - low) / (high - low), 0.0, 1.0)
    return d**3 * (10.0 - 15.0 * d + 6.0 * d * d)


def twice(times: np.ndarray) -> np.ndarray:
    """A STEP5 of a STEP5, whose D reaches 1 with a rate and a second rate of zero."""
    return step5(step5(times, 0.2, 1.2), 0.0, 1.0)


NESTED = {
    "twice": ("STEP5(STEP5(TIME,0.2,0,1.2,1),0,0,1,1)", twice),
    "three times": (
        "STEP5(STEP5(STEP5(TIME,0.2,0,1.2,1),0,0,1,1),0,0,1,1)",
        lambda t: step5(twice(t), 0.0, 1.0),
    ),
    "within a millisecond": (
        "STEP5(STEP5(TIME,0,0,1E-3,1),0,0,1,1)",
        lambda t: step5(step5(t, 0.0, 1e-3), 0.0, 1.0),
    ),
    "shifted": (
        "STEP5(STEP5(TIME,0,0,1,0.3)+0.7,0.7,0,1,1)",
        lambda t: step5(step5(t, 0.0, 1.0), 0.0, 1.0),
    ),
    "to and fro": (
        "STEP5(STEP5(TIME,0,0,1,1)+STEP5(TIME,1,0,2,-1),0,0,1,1)",
        lambda t: step5(step5(t, 0.0, 1.0) - step5(t, 1.0, 2.0), 0.0, 1.0),
    ),
}


@pytest.mark.parametrize("name", NESTED)
@pytest.mark.parametrize("formula", ["GSTIFF", "HHT", "RADAU", "RKF45"])
def test_a_step_of_a_step_is_two_steps(name: str, formula: str):
    """Near its end the inner one is 1 - 10 d^3, round-off of 1 for 1e-5 of its length: 65 000
    changes of a branch, 3 million steps.  The force gives 1 kg its impulse.
    """
    text, law = NESTED[name]
    at = np.linspace(0.0, 2.0, 400_001)
    results = done(pushed(text), 2.0, 20, **options(formula, 1e-6))
    impulse = float(((law(at)[1:] + law(at)[:-1]) / 2).sum() * (at[1] - at[0]))
    assert results["POINT_MASS/2.vx"][-1] == approx(impulse, abs=2e-4)
    assert results.summary["steps"] < 2500


PLATEAUS = {
    "IF(STEP5(TIME,0.5,-1,0.7,0)-STEP5(TIME,1.1,0,1.3,1): 0, 1, 0)": 0.4,
    "IF(MAX(0,0.5-TIME)**3+MAX(0,TIME-0.9)**3: 0, 1, 0)": 0.4,
    "IF((TIME-0.5)**3*(0.8-TIME)**3: 0, 0, 1)": 0.3,
    "IF(-(TIME-0.7)**4: 0, 0, 1)": 0.0,
}


@pytest.mark.parametrize("law", PLATEAUS)
def test_a_guard_that_becomes_zero_without_a_slope_still_decides(law: str):
    """IF jumps where it is zero, or where it passes zero as a cube does."""
    results = done(pushed(law), 2.0, 20, **options("RADAU", 1e-6))
    assert results["POINT_MASS/2.vx"][-1] == approx(PLATEAUS[law], abs=1e-4)


@pytest.mark.parametrize("formula", ["GSTIFF", "RADAU", "RKF45"])
def test_a_step_of_a_step_goes_on_in_a_run_that_begins_near_its_end(formula: str):
    """From 1.1 s on the outer D - 1 is -0.01 at most, and its round-off still that of 1."""
    runs = "SIMULATE/DYNAMIC, END=1.1, STEPS=2\nSIMULATE/DYNAMIC, END=1.4, STEPS=2\nEND\n"
    deck = al.read(pushed(NESTED["twice"][0]).replace("END\n", runs))
    results = al.simulate(deck, **options(formula, 1e-9))
    assert results.outcome is Outcome.DONE and results.summary["steps"] < 2000
    at = np.linspace(0.0, 1.4, 400_001)
    impulse = float(((twice(at)[1:] + twice(at)[:-1]) / 2).sum() * (at[1] - at[0]))
    assert results["POINT_MASS/2.vx"][-1] == approx(impulse, abs=1e-6)


@pytest.mark.parametrize("formula", ["GSTIFF", "RADAU", "ABAM"])
def test_a_wave_of_a_short_step_is_followed_in_the_step_alone(formula: str):
    """HAVSIN in 0.1 ms of 1 s took 31 800 steps, as if its cosine went on."""
    stiff = "-(1409*DX(2)+79*VX(2))*{}(TIME,0.429,1,0.4291,0)+75.4"
    runs = [
        done(pushed(stiff.format(name)), 1.0, 10, **options(formula, 1e-6))
        for name in ("STEP5", "HAVSIN")
    ]
    one, other = (each["POINT_MASS/2.vx"][-1] for each in runs)
    assert other == approx(one, abs=1e-5)  # both rise as fast on either side of their middle
    assert runs[1].summary["steps"] < 2 * runs[0].summary["steps"]


def test_a_condition_of_time_in_a_constraint_is_no_part_of_it():
    """Its bounds, which are none of a number, ended the program: exit code 70."""
    constraint = "GCON/9, FUNCTION=IF(TIME-0.5: DY(2), DY(2), 2*DY(2))\nEND\n"
    deck = al.read(pushed("1").replace("END\n", constraint))
    results = al.simulate(deck, end=1.0, steps=4, **options("GSTIFF", 1e-6))
    assert results.outcome is Outcome.DONE
