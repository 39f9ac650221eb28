"""Runs that end early, and what their messages say."""

from __future__ import annotations

from scenes import GROUND, run

import adamslite as al
from adamslite import Outcome

FALLING = (
    GROUND
    + "ACCGRAV/JGRAV=-9.81\nPOINT_MASS/2, MASS=10, CM=2\nMARKER/2, POINT_MASS=2\n"
    + "VARIABLE/5, FUNCTION=10*TIME\n"
)
PRINTED = (
    "VFORCE/7, I=2, J_PART=1, FX=VARVAL(5)*ACCX(2)+10*VX(2)\\"
    "FY=VARVAL(5)*(ACCY(2)-JGRAV)+10*VY(2)\\FZ=VARVAL(5)*ACCZ(2)+10*VZ(2)\n"
)
WHEN = r"at t = [\d.e-]+, in step \d+ of size [\d.e-]+"


def ended_early(
    deck: str, end: float | None = 1.0, steps: int | None = 10, **options
) -> al.Results:
    """A run that ends early: its message ends with the sentence of the outcome."""
    results = run(deck, end, steps, **options)
    assert results.outcome is not Outcome.DONE
    assert results.message.endswith(f". {results.outcome.sentence}")
    return results


def reason(results: al.Results) -> str:
    """The message without the sentence of the outcome."""
    return results.message.removesuffix(f" {results.outcome.sentence}")


def with_integrator(deck: str, arguments: str) -> str:
    return deck.replace("END\n", f"INTEGRATOR/{arguments}\nEND\n")
