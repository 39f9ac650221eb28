"""CONSTANT_BDF: fixed steps, fixed order, and what stops it; SI1 and HASTIFF."""

from __future__ import annotations

import numpy as np
import pytest
from decklets import told
from scenes import GROUND, PENDULUM, done, run

import adamslite as al

SPRING = (
    GROUND
    + "POINT_MASS/2, MASS=1, CM=2, QG=2,0,0\nMARKER/2, POINT_MASS=2\n"
    + "SFORCE/1, TRANSLATIONAL, I=2, J=1, FUNCTION=-(DM(2,1)-1)\n"
)
# Ten doublings, each after as many equal steps as the formula looks back.
START_UP = 60


@pytest.mark.parametrize("order", (1, 2, 3, 4))
def test_it_has_the_order_kmax_whatever_error_says(order):
    """x'' = -(x - 1) to t = 2: half the step, 2^order less error; ERROR is for the corrector.

    Beyond order 4 the start, made at order 3, is what counts.
    """
    errors = []
    for count in (100, 200):
        deck = (
            SPRING + f"INTEGRATOR/CONSTANT_BDF, KMAX={order}, HINIT={2 / count}, ERROR=1E-9\nEND\n"
        )
        results = done(deck, 2.0, 4)
        assert count < results.summary["steps"] < count + START_UP
        assert results.summary["rejected"] == 0
        errors.append(np.abs(results["POINT_MASS/2.x"] - 1 - np.cos(results.time)).max())
    assert errors[0] / errors[1] == pytest.approx(2.0**order, rel=0.15)


@pytest.mark.parametrize(
    ("settings", "steps"),
    [("HINIT=0.001, HMAX=0.1", 1000), ("HMAX=0.002", 500), ("KMAX=4", 200)],
    ids=["HINIT", "HMAX", "a 20th of the output step"],
)
def test_what_the_step_is(settings, steps):
    """One second in ten output steps."""
    results = done(SPRING + f"INTEGRATOR/CONSTANT_BDF, {settings}\nEND\n", 1.0, 10)
    assert steps < results.summary["steps"] < steps + START_UP


def test_what_the_corrector_cannot_do_ends_the_run_by_name():
    """y' = 10 y^2 from 1 reaches infinity at 0.1: before that, implicit steps have no solution."""
    deck = GROUND + "DIFF/1, IC=1, FUNCTION=10*DIF(1)**2\nINTEGRATOR/CONSTANT_BDF\nEND\n"
    results = run(deck, 0.4, 40)
    assert results.outcome is al.Outcome.NEWTON_FAILED
    assert results.summary["t_end"] == pytest.approx(0.1, abs=0.01)
    assert "DIFF/1" in results.message


def test_si1_is_solved_as_si2_and_says_so():
    """The same numbers, and a warning at the word."""
    one, two = (
        done(PENDULUM.replace("END", f"INTEGRATOR/GSTIFF, {form}\nEND"), 1.0).values
        for form in ("SI1", "SI2")
    )
    np.testing.assert_array_equal(one, two)
    warning = told(PENDULUM.replace("END", "INTEGRATOR/GSTIFF, SI1\nEND"))[0]
    assert (warning.code, warning.severity) == ("solved-as", "warning")
    assert warning.source_line[warning.span.column - 1 :] == "SI1"


def test_hastiff_runs_as_what_adams_has_instead():
    """The same numbers as those of GSTIFF, SI2, and a warning."""
    one, two = (
        done(PENDULUM.replace("END", f"INTEGRATOR/{form}\nEND"), 1.0).values
        for form in ("HASTIFF", "GSTIFF, SI2")
    )
    np.testing.assert_array_equal(one, two)
    (warning, *_) = told(PENDULUM.replace("END", "INTEGRATOR/HASTIFF\nEND"))
    assert warning.message == "ADAMS has discontinued HASTIFF; GSTIFF, SI2 runs in its place"
