"""MATRIX: the same elements row by row, column by column, one by one and from a file."""

from __future__ import annotations

from pathlib import Path

import pytest
from decklets import last

import adamslite as al
from adamslite.reading.read import read_commands

ROWS = [(1.0, 2.0, 3.0), (0.0, 0.0, 4.5)]


@pytest.mark.parametrize(
    "written",
    [
        "FULL=RORDER, ROWS=2, COLUMNS=3, VALUES=1,2,3,0,0,4.5",
        "FULL=CORDER, ROWS=2, COLUMNS=3, VALUES=1,0,2,0,3,4.5",
        "SPARSE, ROWS=2, COLUMNS=3, VALUES=1,1,1, 1,3,3, 2,3,4.5, 1,2,2",
    ],
)
def test_elements_are_given_in_any_order(written: str) -> None:
    matrix = last(f"MATRIX/1, {written}")
    assert matrix.table == ROWS and matrix.complete


@pytest.mark.parametrize("names", ["", "a, b, c\n", "# numbers of a test\n"])
def test_elements_come_from_a_file(tmp_path: Path, names: str) -> None:
    (tmp_path / "numbers.csv").write_text(f"{names}1,2,3\n0,0,4.5\n")
    (tmp_path / "other.csv").write_text("7\n8\n9\n")
    path = tmp_path / "deck.adm"
    path.write_text("title\nPART/1, GROUND\nMATRIX/1, FILE=numbers.csv\nEND\n")
    deck = al.read(path)
    assert deck.find("MATRIX", 1).table == ROWS
    (change,) = read_commands("MATRIX/1, FILE=other.csv\n", deck)
    assert deck.redefined(change).find("MATRIX", 1).table == [(7.0,), (8.0,), (9.0,)]
    (change,) = read_commands("MATRIX/1, ROWS=1, COLUMNS=2, VALUES=5,6\n", deck)
    assert deck.redefined(change).find("MATRIX", 1).table == [(5.0, 6.0)]
