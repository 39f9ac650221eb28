"""A deck that others wrote, run as it comes: assembled, set free, at rest, linearised."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from adamslite import Outcome
from adamslite.scene import load_scene, run_scene

FOLDER = Path(__file__).parents[1] / "decks" / "fast"
USER = ("VARSUB=0", "SENSUB=0", *(f"VARIABLE/{n}0000=4.53786E-02" for n in (1, 2, 3)))


@pytest.mark.slow
def test_the_frequencies_of_a_wind_turbine() -> None:
    """The first seven of 337, to the digits that ADAMS printed."""
    scene = load_scene(FOLDER / "Test14_ADAMS.adm", FOLDER / "Test14_ADAMS_LIN.acf", USER)
    results = run_scene(scene, {})
    assert results.outcome is Outcome.DONE
    assert "equilibrium" not in results.meta  # it is stable
    model = results.linearizations[-1].model
    expected = np.loadtxt(FOLDER / "frequencies.csv", delimiter=",", skiprows=2)[:, 1]
    swinging = model.frequencies[model.eigenvalues.imag > 0.0]
    assert swinging[:7] == pytest.approx(expected, rel=1e-5)
    assert model.undamped.size == 337
