"""Through postures in which constraints lose rank: a row of four parallelograms that flattens at
every half turn.
"""

from __future__ import annotations

import numpy as np
import pytest

import adamslite
from adamslite.outcomes import Outcome
from benchmarks import decks
from benchmarks.reference import four_bar


@pytest.fixture(scope="module")
def kernels():
    return adamslite.compile_model(adamslite.assemble(adamslite.read(decks.deck("S4", 4))))


@pytest.mark.parametrize(
    ("error", "allowed"), [(1e-4, 2.0), (1e-6, 0.08), (2e-7, 0.02), (2e-8, 0.004)]
)
def test_ninety_seven_flattened_postures(kernels, error: float, allowed: float) -> None:
    """The angle after ten seconds against a tight reference; an error of 1e-8 in a speed of 30
    grows to some 1e-3 rad on the way.
    """
    results = adamslite.simulate(kernels, end=10.0, steps=10, error=error, hmax=1.0)
    assert results.outcome is Outcome.DONE, results.message
    turned = four_bar(4)[0] - np.pi / 2  # counted from the vertical
    assert results["REQUEST/1.F2"][-1] == pytest.approx(turned, abs=allowed)


@pytest.mark.parametrize("error", [1e-3, 1e-5, 1e-7])
def test_hht_passes_them_too(kernels, error: float) -> None:
    results = adamslite.simulate(
        kernels, end=10.0, steps=10, error=error, hmax=1.0, integrator="HHT"
    )
    assert results.outcome is Outcome.DONE, results.message
