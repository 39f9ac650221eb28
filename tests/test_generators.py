"""Decks and references in the tree are what their generators write."""

import runpy
import shutil
import sys
from collections.abc import Callable
from pathlib import Path

import cranes
import draglines
import generate
import numpy as np
import pytest
import ropeways
import strings
from tiers import every, slow
from written import assert_same_reference, assert_same_text

from adamslite.resources import find

#: Folders of decks/cables that take seconds to write: what is integrated, and its columns.
SLOW = {
    "cable-car": [(ropeways, "coasting", 3), (strings, "hauled", 2)],
    "crane": [(cranes, "straight", 4)],
    "drag-line": [(draglines, "motion", 5)],
}
#: Other folders of decks, whose generators take less than a third of a second.
QUICK = (
    "arrays",
    "beam-cantilever",
    "beam-string",
    "cam",
    "nforce",
    "bushing",
    "chrono",
    "user-routine",
    "conical-pendulum",
    "contact/bouncing-ball",
    "contact/top",
    "delayed-brake",
    "gforce-pair",
    "growing-mass-dalembert",
    "growing-mass-printed",
    "growing-mass-singular",
    "hanging-mass",
    "paper-sforce",
    "pendulum-gcon",
    "pendulum-revolute",
    "pid-winch",
    "replay",
    "splines",
    "transfer-functions",
    "view-crank",
)
CHEAP = [
    slow(case) if case == "arrestment" else case for case in sorted(set(generate.CASES) - set(SLOW))
]
SHEAVES = runpy.run_path(str(find("decks") / "cables" / "sheaves" / "make_reference.py"))["CASES"]
WATER = runpy.run_path(str(find("decks") / "cables" / "water" / "make_reference.py"))["CASES"]
WINCHES = runpy.run_path(str(find("decks") / "cables" / "winches" / "make_reference.py"))["CASES"]
HOISTS = runpy.run_path(str(find("decks") / "cables" / "hoists" / "make_reference.py"))["CASES"]
DESCRIBE = runpy.run_path(str(find("decks") / "cables" / "described" / "describe.py"))


@pytest.mark.parametrize("case", CHEAP)
def test_a_folder_of_cables_is_what_its_generator_writes(case: str) -> None:
    folder = find("decks") / "cables" / case
    for name, deck, reference in generate.CASES[case]():
        assert_same_text(deck, (folder / f"{name}.adm").read_text(encoding="utf-8"))
        kept = (folder / f"{name}.reference.csv").read_text(encoding="utf-8")
        assert_same_reference(reference, kept)


def resting(columns: int) -> Callable[..., np.ndarray]:
    """In the place of an integration, whose last argument are the times."""
    return lambda *given: np.zeros((columns, len(given[-1])))


@pytest.mark.parametrize("case", SLOW)
def test_the_decks_of_a_folder_are_what_its_generator_writes(
    case: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Without their references, which take seconds."""
    for module, integrated, columns in SLOW[case]:
        monkeypatch.setattr(module, integrated, resting(columns))
    for name, deck, _ in generate.CASES[case]():
        kept = (find("decks") / "cables" / case / f"{name}.adm").read_text(encoding="utf-8")
        assert_same_text(deck, kept)


@pytest.mark.parametrize(
    "case",
    every(
        3,
        [
            *("drum", "belt", "slip", "crane", "arrestment", "deck-sheaves", "deck-kink"),
            *("ring", "folded", "mount"),
        ],
    ),
)
def test_a_reference_of_a_described_scene_is_what_its_generator_writes(case: str) -> None:
    folder = find("decks") / "cables" / "described"
    kept = (folder / f"{case}.reference.csv").read_text(encoding="utf-8")
    assert_same_reference(DESCRIBE[case.replace("-", "_")](), kept)


@pytest.mark.parametrize("case", SHEAVES)
def test_a_reference_of_sheaves_is_what_its_generator_writes(case: str) -> None:
    kept = find("decks") / "cables" / "sheaves" / f"{case}.reference.csv"
    assert_same_reference(SHEAVES[case](), kept.read_text(encoding="utf-8"))


@pytest.mark.parametrize("case", WATER)
def test_a_reference_of_cables_in_water_is_what_its_generator_writes(case: str) -> None:
    kept = find("decks") / "cables" / "water" / f"{case}.reference.csv"
    assert_same_reference(WATER[case](), kept.read_text(encoding="utf-8"))


@pytest.mark.parametrize("case", ["block-lifts", "block-sinks", "landing", "reeved"])
def test_a_reference_of_winches_is_what_its_generator_writes(case: str) -> None:
    kept = find("decks") / "cables" / "winches" / f"{case}.reference.csv"
    assert_same_reference(WINCHES[case](), kept.read_text(encoding="utf-8"))


@pytest.mark.parametrize("case", ["equaliser", "beam-on-beam", "late-soft"])
def test_a_reference_of_hoists_is_what_its_generator_writes(case: str) -> None:
    kept = find("decks") / "cables" / "hoists" / f"{case}.reference.csv"
    assert_same_reference(HOISTS[case](), kept.read_text(encoding="utf-8"))


@pytest.mark.parametrize("case", every(3, QUICK))
def test_a_reference_of_a_deck_is_what_its_generator_writes(
    case: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """In a copy of its folder: a generator writes beside itself."""
    kept, copy = find("decks") / case, tmp_path / case
    shutil.copytree(kept, copy)
    shutil.copy(find("decks") / "minimal.py", tmp_path)
    for reference in copy.rglob("*.csv"):
        reference.unlink()
    monkeypatch.setattr(sys, "path", [str(copy), *sys.path])
    runpy.run_path(str(copy / "make_reference.py"), run_name="__main__")
    for reference in kept.rglob("*.csv"):
        written = (copy / reference.relative_to(kept)).read_text(encoding="utf-8")
        assert_same_reference(written, reference.read_text(encoding="utf-8"))
