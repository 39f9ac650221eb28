"""What ends before anything moves: settings, states that do not exist, analyses that cannot be."""

from __future__ import annotations

import re

import pytest
from outcome_scenes import FALLING, ended_early, reason
from scenes import GROUND, PENDULUM

import adamslite as al
from adamslite import Outcome
from adamslite.errors import UsageError


@pytest.mark.parametrize(
    ("options", "told"),
    [({"error": 1e-300}, "ERROR too"), ({"hmax": 1e-300}, "HMAX is too short a step")],
)
def test_settings_out_of_all_proportion_are_told(options, told):
    """No expression is to blame for an ERROR of 1e-300, nor accuracy for an HMAX of 1e-300."""
    assert told in reason(ended_early(FALLING + "END\n", **options))


@pytest.mark.parametrize(
    ("function", "told"),
    [("VARVAL(6)+1", "every value of it would do, or none"), ("VARVAL(6)**2+1", "open by 1")],
)
def test_a_variable_that_has_no_solution_is_named(function, told):
    results = ended_early(FALLING + f"VARIABLE/6, FUNCTION={function}\nEND\n")
    assert results.outcome is Outcome.UNDETERMINED
    assert reason(results).startswith("VARIABLE/6 (<text>:8:1): at t = 0, ")
    assert reason(results).endswith(f"{told}.")


def test_an_expression_without_a_value_at_the_start():
    results = ended_early(FALLING + "VFORCE/7, I=2, J_PART=1, FX=1/TIME\nEND\n")
    assert (
        reason(results)
        == "VFORCE/7 (<text>:8:1): at t = 0, 1/TIME has no finite value at TIME = 0."
    )


def test_accelerations_that_nothing_determines():
    """A part without inertia, free to turn."""
    results = ended_early(GROUND + "PART/2, MASS=1, CM=2, IP=0,0,0\nMARKER/2, PART=2\nEND\n")
    assert results.outcome is Outcome.UNDETERMINED
    told = r"PART/2 \(<text>:4:1\), rotation about [xyz]: at t = 0, it is free\."
    assert re.fullmatch(told, reason(results))


def test_a_joint_that_cannot_close():
    """Two points of one part, a metre apart, held at one point of the ground."""
    second = "JOINT/2, SPHERICAL, I=2, J=1\nEND"
    results = ended_early(PENDULUM.replace("END", second))
    assert results.outcome is Outcome.INITIAL_CONDITIONS_FAILED
    told = (
        r"JOINT/[12] \(<text>:[89]:1\), [xyz] of I - J, stays open by 0\.5\d* at position level, "
        r"against JOINT/[12] \(<text>:[89]:1\)\."
    )
    assert re.fullmatch(told, reason(results))


def test_a_kinematic_analysis_with_freedom():
    results = ended_early(
        PENDULUM.replace("END", "SIMULATE/KINEMATICS, END=1, STEPS=2\nEND"), None, None
    )
    assert results.outcome is Outcome.NOT_KINEMATIC
    assert reason(results) == "At t = 0, the model has one degree of freedom."


def test_no_equilibrium_names_the_balance_that_fails():
    """Nothing holds 10 kg against gravity: 98.1 N along y."""
    results = ended_early(FALLING + "SIMULATE/STATICS\nEND\n", None, None)
    assert results.outcome is Outcome.NO_EQUILIBRIUM
    expected = "POINT_MASS/2 (<text>:5:1), forces along y: at t = 0, out of balance by 98.1."
    assert reason(results) == expected


def test_without_an_end_nothing_runs():
    with pytest.raises(UsageError, match="There is no end time"):
        al.simulate(al.read(FALLING + "END\n"))


@pytest.mark.parametrize("method", ["GSTIFF", "ABAM", "HHT"])
def test_equations_without_finite_derivatives_are_told(method):
    """The constraint depends on the time by a slope that it has not: the matrix has no number."""
    results = ended_early(
        GROUND + "PART/2, MASS=1, CM=2, IP=1,2,3, QG=1,0,0\nMARKER/2, PART=2\n"
        "GCON/1, FUNCTION=DM(2,1)-STEP(0.5,2,1E-3,VX(2,1),TIME)\nEND\n",
        integrator=method,
    )
    assert not results.success and reason(results)
