"""The package finds its grammar and decks wherever it is, and its stages are functions."""

import runpy
import shutil
from pathlib import Path

import pytest

import adamslite
from adamslite import resources

VERBS = ("read", "check", "assemble", "compile_model", "simulate", "compare")


@pytest.mark.parametrize("name", ["grammar", "decks"])
def test_in_a_checkout_the_folders_stand_next_to_the_package(name: str) -> None:
    assert resources.find(name).is_dir()


@pytest.mark.parametrize("home", ["adamslite/grammar", "grammar"])
def test_inside_the_package_first_then_next_to_it(tmp_path: Path, home: str) -> None:
    package = tmp_path / "adamslite"
    package.mkdir()
    shutil.copy(resources.__file__, package)
    for place in {home, "grammar"}:
        (tmp_path / place).mkdir()
    find = runpy.run_path(str(package / "resources.py"))["find"]
    assert find("grammar") == tmp_path / home


@pytest.mark.parametrize("verb", VERBS)
def test_every_stage_is_a_function_of_the_package(verb: str) -> None:
    assert callable(getattr(adamslite, verb))


def test_an_unknown_name_is_no_attribute() -> None:
    assert not hasattr(adamslite, "sovle")
    assert set(VERBS) < set(dir(adamslite))
