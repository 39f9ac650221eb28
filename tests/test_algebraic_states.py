"""DIFFs whose equation has no rate of their own."""

from __future__ import annotations

import numpy as np
import pytest
from scenes import GROUND

import adamslite as al
from adamslite.reading.read import read_commands

RATE_OF = """
POINT_MASS/2, MASS=1, CM=2
MARKER/2, POINT_MASS=2
DIFF/1, IMPLICIT, IC={start}, FUNCTION={function}
VFORCE/1, I=2, J_PART=1, FX=DIF1(1)
END
"""


@pytest.mark.parametrize("integrator", ("GSTIFF", "HHT", "RADAU", "RKF45"))
@pytest.mark.parametrize("function", ("SIN(3*TIME)-DIF(1)", "2*DIF(1)-2*SIN(3*TIME)"))
def test_a_diff_without_its_rate_differentiates(integrator: str, function: str) -> None:
    """y = sin 3t whatever IC is; a force of its rate on 1 kg gives v = sin 3t."""
    text = GROUND + RATE_OF.format(start=7, function=function)
    found = al.simulate(al.read(text), end=1.0, steps=5, integrator=integrator, error=1e-8)
    expected = np.sin(3 * found.time)
    assert found["DIFF/1"] == pytest.approx(expected, abs=1e-5)
    assert found["POINT_MASS/2.vx"] == pytest.approx(expected, abs=1e-5)


def test_such_a_diff_starts_where_a_curved_equation_holds() -> None:
    """y^3 = 8 + x, x = 0 at the start: y = 2 from the guess 1."""
    text = GROUND + RATE_OF.format(start=1, function="DIF(1)**3-8-DX(2)")
    found = al.simulate(al.read(text), end=0.1, steps=1, error=1e-8)
    assert found["DIFF/1"][0] == pytest.approx(2.0, abs=1e-12)
    assert found["DIFF/1"] ** 3 == pytest.approx(8 + found["POINT_MASS/2.x"], abs=1e-6)


def test_statics_solve_such_a_diff_too() -> None:
    text = GROUND + RATE_OF.format(start=1, function="DIF(1)**3-8-DX(2)").replace(
        "END", "SFORCE/2, I=2, J=1, ACTIONONLY, FUNCTION=-100*DZ(2)\nEND"
    ).replace("FX=DIF1(1)", "FX=54-2*DX(2)\\FY=-DY(2)")
    deck = al.read(text)
    found = al.simulate(deck, commands=read_commands("SIMULATE/STATICS\n", deck))
    assert found["DIFF/1"] == pytest.approx(np.cbrt(35.0), abs=1e-6)
