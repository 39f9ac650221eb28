"""Any change of a deck gives a diagnostic or a run, never a traceback: see mutations.py."""

from __future__ import annotations

from pathlib import Path

import pytest
from mutations import mutant, outcome

FAST, SLOW = 100, 500


def test_mutants_are_always_the_same() -> None:
    assert mutant(7) == mutant(7) != mutant(8)


@pytest.mark.slow
def test_mutants_are_read_and_checked(tmp_path: Path) -> None:
    found = {outcome(number, tmp_path) for number in range(FAST)}
    assert found == {"errors", "checked"}


@pytest.mark.slow
def test_many_mutants_are_read_and_checked(tmp_path: Path) -> None:
    assert {outcome(number, tmp_path) for number in range(FAST, SLOW)} == {"errors", "checked"}
