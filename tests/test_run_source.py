"""Results know the texts that they came from, from which deck and commands are read again."""

from __future__ import annotations

import pickle
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import adamslite
from adamslite.reading.read import read_commands
from adamslite.results.results import Results
from adamslite.scene import load_scene, run_scene

DECK = """\
a free fall
PART/1, GROUND
MARKER/1, PART=1
POINT_MASS/2, MASS=1, CM=2, QG=1,0,0
MARKER/2, POINT_MASS=2
ACCGRAV/KGRAV=-9.81
VARIABLE/1, FUNCTION=USER(1)
SPLINE/1, FILE=road.csv
REQUEST/1, F2=AKISPL(TIME,0,1)
END
"""
COMMANDS = "fall.adm\n\nSIMULATE/DYNAMIC, END=1, STEPS=2\nSTOP\n"
TABLE = "x,y\n0,0\n1,1\n2,4\n3,9\n4,16\n"


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    (tmp_path / "fall.adm").write_text(DECK)
    (tmp_path / "fall.acf").write_text(COMMANDS)
    (tmp_path / "road.csv").write_text(TABLE)
    return tmp_path


def solved(folder: Path) -> Results:
    return run_scene(load_scene(folder / "fall.adm", user=["VARIABLE/1=7"]), {})


def test_a_run_of_files_keeps_their_texts(folder: Path) -> None:
    source = solved(folder).source
    assert source is not None
    assert (source.deck, source.name, source.stem) == (DECK, "fall.adm", "fall")
    assert (source.commands, source.commands_name) == (COMMANDS, "fall.acf")
    assert (source.user, source.folder) == (("VARIABLE/1=7",), str(folder))


def test_the_deck_is_read_again_from_the_results(folder: Path) -> None:
    """With the numbers for its routines, the table beside it, and its commands."""
    results = pickle.loads(pickle.dumps(solved(folder)))
    deck, commands = results.source.read()
    again = adamslite.simulate(deck, commands=commands)
    assert again.names == results.names
    assert np.array_equal(again.values, results.values)
    assert again.source == results.source


def test_a_deck_that_was_given_as_text_has_no_name() -> None:
    deck = adamslite.read("a title\nPART/1, GROUND\nSIMULATE/DYNAMIC, END=1, STEPS=2\nEND\n")
    source = adamslite.simulate(deck).source
    assert source is not None
    assert (source.name, source.stem, source.folder) == ("<text>", "results", "")
    assert (source.commands, source.commands_name, source.user) == ("", "", ())
    read, commands = source.read()
    assert (read.title, tuple(commands)) == ("a title", ())


@pytest.mark.parametrize("suffix", [".nc", ".mat", ".parquet", ".res"])
def test_a_file_is_solved_again_where_nothing_else_is(folder: Path, suffix: str) -> None:
    """The table of the deck is in the file, too."""
    results = solved(folder)
    results.save(folder / f"a{suffix}")
    for name in ("fall.adm", "fall.acf", "road.csv"):
        (folder / name).unlink()
    found = Results.load(folder / f"a{suffix}")
    assert found.source is not None and found.source.folder == ""
    deck, commands = found.source.read()
    again = adamslite.simulate(deck, commands=commands)
    assert np.array_equal(again.values, results.values)
    found.save(folder / f"b{suffix}")
    assert Results.load(folder / f"b{suffix}").source.read()[0].of("SPLINE")


def test_a_file_names_no_file_elsewhere_and_no_function(folder: Path) -> None:
    """What others have sent neither writes beside its folder nor loads a module."""
    results = solved(folder)
    elsewhere = folder / "elsewhere.csv"
    evil = replace(
        results.source, user=("VARIABLE/1=os:getcwd",), folder="", made=None,
        tables=(("../../elsewhere.csv", "x"), (str(elsewhere), "x"), ("road.csv", TABLE)),
    )  # fmt: skip
    replace(results, source=evil).save(folder / "a.nc")
    found = Results.load(folder / "a.nc").source
    assert found is not None and found.user == ()
    with pytest.raises(adamslite.DeckError, match="missing-routine"):
        found.read()
    assert not elsewhere.exists()


def test_commands_of_a_text_are_kept(folder: Path) -> None:
    deck = adamslite.read(folder / "fall.adm", {"VARIABLE/1": 7.0})
    commands = read_commands("SIMULATE/DYNAMIC, END=1, STEPS=2\n", deck)
    source = adamslite.simulate(deck, commands=commands).source
    assert source is not None
    assert source.commands == "SIMULATE/DYNAMIC, END=1, STEPS=2\n"
    assert len(source.read()[1]) == 1
