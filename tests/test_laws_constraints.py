"""Laws every constraint obeys: independent rows, an exact Newton matrix, balanced reactions."""

from __future__ import annotations

import pytest
from constraint_decks import DECKS, deck
from newton_matrix import matrix_error, rank_at_random_posture
from tiers import slow

from adamslite.language.statement import STATEMENTS

# Six motions are six expressions of thousands of nodes.
NAMES = [slow(name) if name == "MOTION DISPLACEMENT" else name for name in DECKS]


def test_every_constraint_has_a_deck() -> None:
    constraints = {k for k, cls in STATEMENTS.items() if hasattr(cls, "constraints")}
    assert constraints == {name.split()[0] for name in DECKS}


@pytest.mark.parametrize("name", NAMES)
def test_rows_are_independent(name: str) -> None:
    rows = DECKS[name][0]
    assert rank_at_random_posture(deck(name)) == (rows, rows)


@pytest.mark.parametrize("stabilised", [True, False], ids=["SI2", "I3"])
@pytest.mark.parametrize("name", NAMES)
def test_the_newton_matrix_agrees_with_differences(name: str, stabilised: bool) -> None:
    assert matrix_error(deck(name), stabilised) < 1e-6
