"""Switches that lead back from both sides: the motion would slide along the change."""

from __future__ import annotations

import pytest
from scenes import GROUND, options, run

from adamslite.results.outcomes import Outcome

FORMULAS = ("GSTIFF", "GSTIFF I3", "HHT", "NEWMARK", "RADAU", "RKF45", "ABAM")
DECK = """POINT_MASS/2, MASS=1, CM=2, VX=1.1
MARKER/2, POINT_MASS=2
VFORCE/1, I=2, J_PART=1, FX={force}
END
"""


@pytest.mark.numerical
@pytest.mark.parametrize("error", [1e-3, 1e-6, 1e-9])
@pytest.mark.parametrize("formula", FORMULAS)
@pytest.mark.parametrize(
    "force",
    ["IF(VX(2)-1.7: 3, 3, -2)", "IF(VX(2)-1.7: 3, -2, -2)", "IF(VX(2)-1.7: 3, 1, -2)",
     "IF(DX(2)-0.61: 1, 1, IF(VX(2)-1.7: 3, 3, -2))", "-MAX(3*SIGN(1,VX(2)-1.7), -2)",
     "MIN(3, MAX(-2, IF(VX(2)-1.7: 9, 0, -9)))"],
)  # fmt: skip
def test_every_switch_that_leads_back_from_both_sides_ends_as_chattering(formula, error, force):
    """Below 1.7 m/s the mass is pushed forwards, above backwards, whatever the switch is made of:
    IF has two relations that change together, and MAX one that follows another.
    """
    last = run(GROUND + DECK.format(force=force), 2.0, 10, **options(formula, error))
    assert last.outcome is Outcome.CHATTERING
