"""A drill string in a curved hole: a deck that others wrote, with a library of routines."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import adamslite as al
from adamslite.elements.bases.spline_curve import through
from adamslite.elements.matrix import Matrix

DECK = Path(__file__).parents[1] / "decks" / "adamspy" / "drill_string.adm"
ROUTINES = ("BitForces", "StringForces", "HoleCurveSub", "gse_deriv")


def test_its_routines_are_all_that_it_lacks() -> None:
    with pytest.raises(al.DeckError) as fault:
        al.read(DECK)
    missing = [each.message.split()[2] for each in fault.value.errors]
    assert missing == [f"adrill_solver::{name}" for name in ROUTINES]
    assert [len(each.places) for each in fault.value.errors] == [1, 43, 1, 1]


@pytest.mark.slow
def test_it_moves_with_constants_for_its_forces() -> None:
    """The hole is a spline through MATRIX/9000, which lists its points; 90 PTCVs stay on it."""
    bound = {"BitForces": 0.0, "StringForces": 0.0, "GSE/990": 0.0}
    line = {"HoleCurveSub": (0.0, 0.0, 0.0, 0.0, 0.0, 1500.0)}
    points = np.array(al.read(DECK, user=bound | line).get(Matrix, 9000).table)
    hole = through(points, False)

    def curve(given: tuple[float, ...], alpha: float) -> list[float]:
        return hole.at(np.array([alpha]))[0].tolist()

    deck = al.read(DECK, user=bound | {"HoleCurveSub": curve})
    results = al.simulate(deck, end=0.01, steps=2, integrator="RADAU", error=1e-3)
    assert results.outcome is al.Outcome.DONE
    assert results.summary["max_violation"] < 1e-6
