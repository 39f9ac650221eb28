"""How large the loads of a deck are, which says whether a spring is too stiff for them."""

from __future__ import annotations

import pytest

from adamslite import read
from adamslite.assembly.load_scale import load_scale
from adamslite.assembly.scope import Posture
from adamslite.model.model import Model

#: A mass, pushed by the square of time; the push is that of a VARIABLE which two others take.
DECK = """\
a push that grows
PART/1, GROUND
MARKER/1, PART=1
POINT_MASS/2, MASS=1, CM=2
MARKER/2, POINT_MASS=2
VARIABLE/1, FUNCTION=TIME**2
VARIABLE/2, FUNCTION=VARVAL(1)+VARVAL(1)
SFORCE/1, TRANSLATION, I=2, J=1, ACTIONONLY, FUNCTION=0.5*VARVAL(2)
END
"""


@pytest.mark.parametrize("until", [3.0, 30.0])
def test_a_push_by_a_variable_is_as_large_as_it_becomes(until: float) -> None:
    """At the latest of some times, which comes near to the end."""
    model = Model(read(DECK))
    found = load_scale(model, Posture.start(model), 1.0, until, ())
    assert found == pytest.approx(until**2, rel=0.1)
