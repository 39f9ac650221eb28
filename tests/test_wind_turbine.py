"""Decks of wind turbines that others wrote, run as they come."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from adamslite import DeckError, Outcome
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


@pytest.mark.slow
def test_a_turbine_with_a_locked_teeter_turns_for_20_seconds() -> None:
    """Its teeter damper is IF(ABS(AZ): 0, 0, -40*WZ), while a MOTION keeps AZ at zero."""
    user = ("VARSUB=0", "SFOSUB=0", "GFOSUB=0", "SENSUB=0")
    results = run_scene(load_scene(FOLDER / "Test01_ADAMS.adm", user=user), {})
    assert results.outcome is Outcome.DONE
    assert results.time[-1] == 20.0


def test_a_turbine_names_the_routines_it_lacks() -> None:
    with pytest.raises(DeckError) as fault:
        load_scene(FOLDER / "Test01_ADAMS.adm")
    words = [each.message.split()[2] for each in fault.value.errors]
    assert words == ["VARSUB", "SFOSUB", "GFOSUB", "SENSUB"]
    assert [len(each.places) for each in fault.value.errors] == [5, 1, 20, 1]
