"""What is looked for in expressions of TIME before a run keeps within its CPU."""

from __future__ import annotations

from typing import Any

import pytest
from scenes import GROUND

import adamslite as al
from adamslite import Outcome
from adamslite.analyses.clock import step_limits, stops
from adamslite.analyses.setup.run_options import Budget

DECK = GROUND + (
    "POINT_MASS/2, MASS=1, CM=2, QG=1,0,0\nMARKER/2, POINT_MASS=2\n"
    "VFORCE/1, I=2, J_PART=1, FX={0}\\ FY={1}\\ FZ={2}\nEND\n"
)
CURVES = "SIN(31*TIME)", "SIN(33*TIME**2)", "COS(35*TIME)*TIME"
GUARDS = tuple(f"IF({curve}: 1, 0, -1)" for curve in CURVES)


@pytest.mark.parametrize(
    ("module", "name", "forces"),
    [(step_limits, "time_scales", CURVES), (stops, "around_changes", GUARDS)],
)
def test_each_expression_is_a_place_to_end(
    module: Any, name: str, forces: tuple[str, ...], monkeypatch: pytest.MonkeyPatch
) -> None:
    """A hundred of them took 8 s of CPU with a limit of 1 s."""
    usual, looked_at = getattr(module, name), []

    def noted(program: Any, *asked: Any) -> Any:
        looked_at.append(program)
        return usual(program, *asked)

    monkeypatch.setattr(module, name, noted)
    deck = al.read(DECK.format(*forces))
    assert al.simulate(deck, end=1.0, steps=1, integrator="GSTIFF").outcome is Outcome.DONE
    assert len(set(looked_at)) > 2
    looked_at.clear()
    spent = property(lambda budget: bool(looked_at))
    monkeypatch.setattr(Budget, "out_of_time", spent)
    results = al.simulate(deck, end=2.0, steps=1, integrator="GSTIFF", cpu_limit=100.0)
    assert results.outcome is Outcome.CPU_LIMIT
    assert len(looked_at) == 1
