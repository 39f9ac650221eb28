"""Demands on the decks of decks/torture that no column of a result says."""

from __future__ import annotations

import pytest

from adamslite.outcomes import Outcome
from adamslite.places import find
from adamslite.results import Results
from adamslite.runs import load_scene, run_scene


def solved(deck: str, **options: object) -> Results:
    """Results of a deck below decks/."""
    results = run_scene(load_scene(find("decks") / deck), options)
    assert results.outcome is Outcome.DONE, results.message
    return results


@pytest.mark.parametrize("error", (1e-4, 1e-6, 1e-8))
def test_the_step_does_not_follow_a_node_without_mass(error: float) -> None:
    """A microgram on springs, 67000 times as fast as the motion: at most ten times the steps."""
    light, without = (
        solved(f"torture/massless-node/{deck}.adm", error=error).summary["steps"]
        for deck in ("massless-node", "one-spring")
    )
    assert light < 10 * without


@pytest.mark.parametrize(
    ("deck", "redundant"), [("four-bar/four-bar.adm", 3), ("bricard/bricard.adm", 1)]
)
def test_redundant_rows_are_counted_and_named(deck: str, redundant: int) -> None:
    """One degree of freedom is left, and each row that was left out has a name."""
    results = solved(deck, end=0.01, steps=1)
    assert results.summary["dof"] == 1
    named = results.meta["redundant"].partition(": ")[2].split("; ")
    assert len(named) == redundant
    assert all(name.startswith("JOINT/") for name in named)
