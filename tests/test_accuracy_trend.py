"""ERROR is worth its digits: the error of known motions falls with it."""

from __future__ import annotations

from fnmatch import fnmatch

import numpy as np
import pytest

from adamslite.resources import find
from adamslite.results.outcomes import Outcome
from adamslite.scene import load_scene, run_scene
from adamslite.verification.reference_file import read_reference

# Deck, reference and the columns that are looked at: a pendulum on a rod (A01), seven bodies in a
# plane with tiny masses, a slider-crank at 150 rad/s.
CASES = {
    "A01": ("pendulum-gcon/pendulum-gcon.adm", "pendulum-gcon/reference.csv", "POINT_MASS/2.[xy]"),
    "andrews": ("andrews/andrews.adm", "andrews/reference.csv", "VARIABLE/*"),
    "slider-crank": (
        "slider-crank/slider-crank.adm",
        "slider-crank/slider-crank.reference.csv",
        "VARIABLE/crank",
    ),
}
# GSTIFF on index 3 tests positions only and NEWMARK is of first order: neither promises this.
METHODS = ("GSTIFF", "HHT", "RADAU")
# An error that is nothing but round-off, or outputs so dense that they bound the step, cannot fall.
NEGLIGIBLE = 1e-9


def error(case: str, method: str, tolerance: float) -> float:
    """Largest difference from the reference over all of its times."""
    deck, file, pattern = CASES[case]
    exact = read_reference(find("decks") / file).table
    results = run_scene(
        load_scene(find("decks") / deck), {"integrator": method, "error": tolerance}
    )
    assert results.outcome is Outcome.DONE, results.message
    rows = np.searchsorted(results.time, exact.time - 1e-9)
    names = [name for name in exact.names if fnmatch(name, pattern)]
    return max(float(np.abs(results[name][rows] - exact[name]).max()) for name in names)


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("case", CASES)
def test_the_error_falls_with_the_tolerance(case: str, method: str) -> None:
    """By ten from ERROR 1e-4 to 1e-6, by five more from there to 1e-8."""
    coarse, middle, fine = (error(case, method, tolerance) for tolerance in (1e-4, 1e-6, 1e-8))
    assert coarse > 10 * middle
    assert middle > 5 * fine or fine < NEGLIGIBLE


@pytest.mark.parametrize("case", CASES)
def test_the_explicit_integrator_is_better_than_it_is_asked_for(case: str) -> None:
    """Order 8 with steps no longer than the output step: beyond 1e-7 at every ERROR."""
    assert max(error(case, "RKF45", tolerance) for tolerance in (1e-4, 1e-6)) < 1e-7
