"""A run that was killed goes on from its last state, to the same bytes."""

from __future__ import annotations

from pathlib import Path

import pytest
from unfinished_runs import killed, solved
from unfinished_scenes import CASES, prepared

QUICK = (
    "GSTIFF SI2", "HHT", "contacts by RADAU", "RKF45", "VERLET", "two analyses",
    "one equilibrium after the other",
)  # fmt: skip


@pytest.mark.parametrize("case", QUICK)
def test_a_run_that_is_killed_goes_on_to_the_same_bytes(tmp_path: Path, case: str) -> None:
    words, deck = CASES[case][1:], prepared(tmp_path, case)
    whole = solved(deck, *words)
    found, hits = killed(deck, 1, 2, *words)
    assert hits and found == whole


@pytest.mark.slow
@pytest.mark.parametrize("case", CASES)
def test_runs_killed_at_many_instants_go_on_to_the_same_bytes(tmp_path: Path, case: str) -> None:
    words, deck = CASES[case][1:], prepared(tmp_path, case)
    whole, hits = solved(deck, *words), 0
    for seed in range(3):
        found, more = killed(deck, seed, 4, *words)
        assert found == whole
        hits += more
    assert hits
