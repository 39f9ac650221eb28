"""SPLINE with FILE: tables beside the deck, and the replay of a recorded run."""

from __future__ import annotations

from pathlib import Path

import pytest
from scenes import GROUND

import adamslite as al
from adamslite.language.diagnostics import DeckError

PENDULUM = (
    GROUND
    + """ACCGRAV/JGRAV=-9.81
PART/2, MASS=3, CM=2, IP=2,2,2
MARKER/2, PART=2, QP=0,-0.4,0
MARKER/3, PART=2
JOINT/1, REVOLUTE, I=3, J=1
VARIABLE/angle, FUNCTION=AZ(3,1)
"""
)
TABLE = "# a table\ntime, left, right wheel\n0,1,10\n1,2,20\n2,4,40\n3,8,80\n"


OUTSIDE = "it is not in the folder of the deck or below, nor in one that adamslite.allow_path opens"


def spline(folder: Path, arguments: str, table: str = TABLE, name: str = "road.csv") -> object:
    """SPLINE/1 with these arguments, in a deck beside a table."""
    (folder / name).parent.mkdir(exist_ok=True)
    (folder / name).write_text(table, encoding="utf-8")
    deck = folder / "deck.adm"
    deck.write_text(f"title\nPART/1, GROUND\nSPLINE/1, {arguments}\nEND\n", encoding="utf-8")
    return al.read(deck).find("SPLINE", 1).points(folder)


def reason(folder: Path, arguments: str, table: str = TABLE) -> str:
    """Why the file cannot be used."""
    with pytest.raises(DeckError) as caught:
        spline(folder, arguments, table)
    (diagnostic,) = caught.value.diagnostics
    assert (diagnostic.code, diagnostic.span.line) == ("data-file", 3)
    return diagnostic.message.partition(": ")[2]


@pytest.mark.parametrize(
    "channel",
    ["BLOCK=right wheel", 'BLOCK="Right Wheel"', "CHANNEL=2"],
    ids=["name", "case", "number"],
)
def test_a_channel_is_taken_by_name_or_number(tmp_path: Path, channel: str) -> None:
    x, (y,), _ = spline(tmp_path, f"FILE=road.csv, {channel}")
    assert (x, y) == ((0.0, 1.0, 2.0, 3.0), (10.0, 20.0, 40.0, 80.0))


def test_the_only_channel_needs_no_name_and_names_no_row(tmp_path: Path) -> None:
    table = "0,5\r\n1,6\r\n\r\n2,7\r\n3,8\r\n"
    assert spline(tmp_path, "FILE=data/road.csv", table, "data/road.csv").curves == ((5, 6, 7, 8),)


def test_a_changed_file_is_read_again(tmp_path: Path) -> None:
    for last in (8, 9.5):
        points = spline(tmp_path, "FILE=road.csv, BLOCK=left", TABLE.replace(",8,", f",{last},"))
        assert points.curves[0][-1] == last


@pytest.mark.parametrize(
    ("arguments", "expected"),
    [
        ("FILE=rail.csv", "there is no such file"),
        ("FILE=../road.csv", OUTSIDE),
        ("FILE=/etc/road.csv", OUTSIDE),
        ("FILE=deck.adm", "only tables .csv can be read"),
        ("FILE=road.csv", "name one of its columns by BLOCK or CHANNEL: left, right wheel"),
        ("FILE=road.csv, CHANNEL=3", "it has no channel 3, but 1 to 2"),
        ("FILE=road.csv, BLOCK=lft", "it has no column lft; its columns are left, right wheel"),
    ],
)
def test_a_file_that_gives_no_points(tmp_path: Path, arguments: str, expected: str) -> None:
    assert reason(tmp_path, arguments) == expected


@pytest.mark.parametrize(
    ("table", "expected"),
    [
        ("", "it is empty"),
        ('"' + "x" * 200_000 + "\n", "it cannot be read: field larger than field limit (131072)"),
        ("x,y\n", "it has 0 rows, and 4 are needed"),
        ("0,1\n1,2\n2,3\n", "it has 3 rows, and 4 are needed"),
        ("0,1\n1,2\n2,3,4\n3,4\n", "line 3 has 3 columns, those before it 2"),
        ("0,1\n1,2\n\n2,high\n3,4\n", "line 4: 'high' is not a number"),
        ("0,1\n1,nan\n2,3\n3,4\n", "a value is not a number"),
    ],
)
def test_a_table_that_gives_no_points(tmp_path: Path, table: str, expected: str) -> None:
    assert reason(tmp_path, "FILE=road.csv", table) == expected


def test_times_must_increase(tmp_path: Path) -> None:
    with pytest.raises(
        DeckError, match="the first column of SPLINE/1 must increase: 1 is followed"
    ):
        spline(tmp_path, "FILE=road.csv", "0,1\n1,2\n1,3\n2,4\n")


def test_a_link_does_not_lead_out_of_the_folder(tmp_path: Path) -> None:
    inner = tmp_path / "decks"
    inner.mkdir()
    (tmp_path / "secret.csv").write_text(TABLE, encoding="utf-8")
    (inner / "link.csv").symlink_to(tmp_path / "secret.csv")
    found = reason(inner, "FILE=link.csv, CHANNEL=1")
    assert found == OUTSIDE


def test_a_recorded_run_is_replayed(tmp_path: Path) -> None:
    """The torque of a MOTION, recorded 200 times in 2 s, moves the pendulum alike.

    A cubic spline follows the torque to some 1e-6 of 20 N m, the start from rest included.
    """
    motion = "MOTION/1, JOINT=1, ROTATION, FUNCTION=0.8*SIN(2*TIME)**3\n"
    torque = "SFORCE/1, ROTATIONAL, I=3, J=1, FUNCTION=CUBSPL(TIME,0,1)\n"
    file = "SPLINE/1, FILE=recorded.csv, BLOCK=MOTION/1.tz\n"
    recorded = al.simulate(al.read(PENDULUM + motion + "END\n"), end=2.0, steps=200, error=1e-8)
    recorded.save(tmp_path / "recorded.csv")
    (tmp_path / "replay.adm").write_text(PENDULUM + file + torque + "END\n", encoding="utf-8")
    replayed = al.simulate(al.read(tmp_path / "replay.adm"), end=2.0, steps=200, error=1e-8)
    assert replayed["VARIABLE/angle"] == pytest.approx(recorded["VARIABLE/angle"], abs=1e-6)


@pytest.mark.parametrize(
    ("more", "expected"), [("", 8.0), (", LINEAR_EXTRAPOLATE", 8.0 + 16.0)], ids=["usual", "linear"]
)
def test_beyond_a_file_its_last_value_holds(tmp_path: Path, more: str, expected: float) -> None:
    """y = 4 x - 4 at the end: straight lines of INTERP are 4 per unit there."""
    (tmp_path / "road.csv").write_text(TABLE, encoding="utf-8")
    text = f"{PENDULUM}SPLINE/1, FILE=road.csv, CHANNEL=1{more}\n"
    text += "VARIABLE/1, FUNCTION=INTERP(TIME+3,1,1)\nEND\n"
    (tmp_path / "deck.adm").write_text(text, encoding="utf-8")
    results = al.simulate(al.read(tmp_path / "deck.adm"), end=4.0, steps=1)
    assert results["VARIABLE/1"][-1] == pytest.approx(expected)
