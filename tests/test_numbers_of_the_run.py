"""HSIZE, ORDER, NJAC and NRHS in a REQUEST: numbers of the integrator at the output times."""

from __future__ import annotations

import numpy as np
import pytest

from adamslite.analyses.simulation import simulate
from adamslite.model.model import assemble
from adamslite.reading.read import read

SPRING = """a mass of 1 on a spring of 100
PART/1, GROUND
MARKER/1, PART=1
PART/2, MASS=1, CM=2, IP=1,1,1, QG=1,0,0
MARKER/2, PART=2
JOINT/1, TRANSLATIONAL, I=3, J=4
MARKER/3, PART=2, REULER=90D,90D,0
MARKER/4, PART=1, REULER=90D,90D,0
SFORCE/1, TRANSLATIONAL, ACTIONONLY, I=3, J=4, FUNCTION=-100*DX(2,1)
REQUEST/1, F2=HSIZE()\\F3=ORDER()\\F4=NJAC()\\F6=NRHS()\\F7=2*HSIZE()+DX(2,1)
"""
ORDERS = {"GSTIFF": range(1, 7), "RADAU": (5,), "HHT": (2,), "RKF45": range(5, 9)}


@pytest.mark.parametrize("method", ORDERS)
def test_numbers_of_the_integrator(method: str) -> None:
    """A loose ERROR lets the steps grow to HMAX, on which the output times lie."""
    found = simulate(
        assemble(read(SPRING)), end=1.0, steps=10, integrator=method, error=1.0, hmax=1e-3
    )
    size, order, jacobians, residuals = (found[f"REQUEST/1.F{n}"] for n in (2, 3, 4, 6))
    assert size.max() <= 1e-3 * (1 + 1e-12)
    assert 0.5 / found.summary["steps"] < size[5:-1].min() < 2.0 / found.summary["steps"]
    assert found["REQUEST/1.F7"] == pytest.approx(2 * size + found["PART/2.x"], abs=1e-15)
    assert set(order[1:]) <= set(ORDERS[method])
    assert (np.diff(jacobians) >= 0).all() and (np.diff(residuals) >= 0).all()
    assert jacobians[-1] <= found.summary["jacobians"]
    assert residuals[-1] > 1000
