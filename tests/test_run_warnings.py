"""Runs of Python that do not reach their end: a warning, or an exception with the results."""

from __future__ import annotations

import pickle
import warnings

import pytest

import adamslite as al
from adamslite.results.outcomes import Outcome

FALL = """A mass that falls
UNITS/SYSTEM=MKS
ACCGRAV/JGRAV=-9.81
PART/1, GROUND
MARKER/1, PART=1
POINT_MASS/2, MASS=2, CM=2
MARKER/2, POINT_MASS=2
VARIABLE/1, FUNCTION=SQRT(1+DY(2,1))
REQUEST/1, F2=VARVAL(1)
SFORCE/1, TRANSLATION, ACTIONONLY, I=2, J=1, FUNCTION=VARVAL(1)
SIMULATE/DYNAMIC, END=2, STEPS=20
END
"""
HALTED = FALL.replace("SIMULATE", "SENSOR/1, FUNCTION=DY(2,1)\\, VALUE=-0.5, LE, HALT\nSIMULATE")


def test_a_run_that_stops_early_warns() -> None:
    with pytest.warns(al.RunWarning, match="^NOT_FINITE: ") as said:
        results = al.simulate(FALL)
    assert not results.success and len(said) == 1
    assert str(said[0].message).endswith(results.message) and results.message
    assert said[0].filename == __file__


def test_the_part_of_an_expression_without_a_value_is_named_with_its_values() -> None:
    results = al.simulate(FALL, strict=None)
    assert "SFORCE/1" in results.message
    assert "SQRT(1 + DY(2, 1, 0)) has no finite value at 1 + DY(2, 1, 0) = -" in results.message


def test_strict_raises_with_the_results() -> None:
    with pytest.raises(al.RunFailed, match="NOT_FINITE") as caught:
        al.simulate(FALL, strict=True)
    results = caught.value.results
    assert results.outcome is Outcome.NOT_FINITE and results.time[-1] < 1.0
    assert pickle.loads(pickle.dumps(caught.value)).results.count == results.count


def test_warnings_as_errors_stop_the_program() -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        with pytest.raises(al.RunWarning):
            al.simulate(FALL)


@pytest.mark.parametrize("strict", [False, True, None])
def test_an_end_that_the_deck_requests_is_a_success(strict: bool | None) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        results = al.simulate(HALTED, strict=strict)
    assert results.success and results.outcome is Outcome.HALTED and not results.message


def test_studies_do_not_warn_of_their_runs() -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error", al.RunWarning)
        runs = al.sweep(FALL, {"POINT_MASS/2.MASS": [1.0, 2.0]}, measures=["max POINT_MASS/2.y"])
    assert len(runs) == 2
