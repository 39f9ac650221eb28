"""The history of the BDF behind an event: of order 2 or 3, from derivatives of the motion."""

from __future__ import annotations

import numpy as np
import pytest
from pytest import approx
from scenes import GROUND, done, options

MASS = GROUND + "POINT_MASS/2, MASS=1, CM=2, QG={x},0,0, VX={v}\nMARKER/2, POINT_MASS=2\n"
FORMULAS = ("GSTIFF", "GSTIFF I3")


@pytest.mark.parametrize("formula", FORMULAS)
def test_a_force_that_jumps_with_time(formula):
    """x'' = 6 t, from t = 1 on -6 t: x(2) = 1 + 6 - (8 - 1); a start of order 1 took 29 steps."""
    force = "VFORCE/1, I=2, J_PART=1, FX=6*TIME*IF(TIME-1:1,-1,-1)\nEND\n"
    deck = MASS.format(x=0, v=0) + force
    run, before = (done(deck, end, 1, **options(formula, 1e-6)) for end in (2.0, 1.0))
    assert run["POINT_MASS/2.x"][-1] == approx(0.0, abs=2e-5)
    assert run.summary["restarts"] == 1
    assert run.summary["steps"] - before.summary["steps"] <= 26


@pytest.mark.parametrize("formula", FORMULAS)
@pytest.mark.parametrize(
    ("error", "steps", "off"), [(1e-4, 23, 8e-3), (1e-6, 43, 3e-4), (1e-8, 82, 6e-6)]
)
def test_few_steps_are_lost_where_a_slope_changes(formula, error, steps, off):
    """x'' = -x for x > 0, -4 x for x < 0: twenty corners.  Starts of order 1 took 27, 46 and 86
    steps from corner to corner.
    """
    force = "VFORCE/1, I=2, J_PART=1, FX=-DX(2)+3*MAX(0,-DX(2))\nEND\n"
    period = 1.5 * np.pi
    run = done(MASS.format(x=0, v=1) + force, 10 * period, 40, **options(formula, error))
    t = run.time % period
    exact = np.where(t < np.pi, np.sin(t), -np.sin(2 * (t - np.pi)) / 2)
    assert run["POINT_MASS/2.x"] == approx(exact, abs=off)
    assert run.summary["restarts"] == 20
    assert run.summary["steps"] / 20 <= steps


@pytest.mark.parametrize(
    ("error", "steps", "off"),
    [
        (1e-3, 5950, 5.26e-3),
        (3e-4, 6885, 4.98e-3),
        (1e-4, 8435, 1.44e-3),
        (1e-5, 11020, 3.09e-4),
        (1e-6, 14390, 6.50e-5),
        (1e-7, 19420, 1.08e-5),
    ],
)
def test_fewer_steps_behind_corners_are_as_accurate(error, steps, off):
    """x'' = -x for x > 0, -(1 + c) x for x < 0, ten periods, sixteen c from 0.4 to 250: the steps
    of all, and the geometric mean of their root mean square errors, with starts of order 1.
    """
    taken, errors = 0, []
    for c in np.geomspace(0.4, 250, 16):
        force = f"VFORCE/1, I=2, J_PART=1, FX=-DX(2)+{c}*MAX(0,-DX(2))\nEND\n"
        omega = np.sqrt(1 + c)
        period = np.pi * (1 + 1 / omega)
        run = done(MASS.format(x=0, v=1) + force, 10 * period, 40, **options("GSTIFF", error))
        t = run.time % period
        exact = np.where(t < np.pi, np.sin(t), -np.sin(omega * (t - np.pi)) / omega)
        errors.append(np.sqrt(np.mean((run["POINT_MASS/2.x"] - exact) ** 2)))
        taken += run.summary["steps"]
    assert taken <= 0.95 * steps
    assert np.exp(np.mean(np.log(errors))) <= 1.05 * off
