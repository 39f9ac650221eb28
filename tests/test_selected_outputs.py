"""`solve --outputs` and `simulate(outputs=...)`: only the columns that are named."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import adamslite
from adamslite.cli.main import main
from adamslite.errors import UsageError
from adamslite.results.results import Results

DECK = """\
two masses and a request
PART/1, GROUND
MARKER/1, PART=1
PART/2, MASS=1, CM=2, IP=1,1,1, VX=1
MARKER/2, PART=2
POINT_MASS/20, MASS=1, CM=20
MARKER/20, POINT_MASS=20
VARIABLE/Load, FUNCTION=TIME
REQUEST/1, DISPLACEMENT, I=2
SIMULATE/DYNAMIC, END=1, STEPS=2
END
"""
SELECTED = {
    "PART/2.x": ["PART/2.x"],
    "part/2.v?": ["PART/2.vx", "PART/2.vy", "PART/2.vz"],
    "variable/load": ["VARIABLE/Load"],
    "*.x": ["PART/2.x", "POINT_MASS/20.x"],
    "REQUEST/1": [f"REQUEST/1.F{n}" for n in range(1, 9)],
    "POINT_MASS/*.y": ["POINT_MASS/20.y"],
}


@pytest.fixture(scope="module")
def deck():
    return adamslite.read(DECK)


@pytest.mark.parametrize("pattern", SELECTED)
def test_a_pattern_selects_columns(deck, pattern: str) -> None:
    whole, some = adamslite.simulate(deck), adamslite.simulate(deck, outputs=[pattern])
    assert list(some.names) == SELECTED[pattern]
    assert all(np.array_equal(some[name], whole[name]) for name in some)
    assert some.source == whole.source


def test_several_patterns_keep_the_order_of_the_columns(deck) -> None:
    some = adamslite.simulate(deck, outputs=["VARIABLE/*", "PART/2.y", "*2.y"])
    assert some.names == ("PART/2.y", "VARIABLE/Load")


def test_one_pattern_may_be_a_text(deck) -> None:
    assert adamslite.simulate(deck, outputs="PART/2.y").names == ("PART/2.y",)


def test_a_confirmed_run_is_limited_too(deck) -> None:
    some = adamslite.simulate(deck, outputs=["PART/2.vx"], confirm=True)
    assert some.names == ("PART/2.vx",) and some.confirmation and some.confirmation.confirmed


@pytest.mark.parametrize(
    ("pattern", "hint"),
    [
        ("PART/2.xx", "did you mean PART/2.x or "),
        ("PRAT/2", r"did you mean PART/2\.\*"),
        ("?", "there are PART/2.x"),
        ("PART/3.*", "no result is called 'PART/3"),
    ],
)
def test_a_pattern_that_means_nothing_stops_before_the_run(deck, pattern: str, hint: str) -> None:
    with pytest.raises(UsageError, match=hint):
        adamslite.simulate(deck, outputs=["PART/2.x", pattern])


def test_the_command_line_writes_the_selected_columns(tmp_path: Path, capsys, monkeypatch) -> None:
    monkeypatch.chdir(tmp_path)
    Path("a.adm").write_text(DECK)
    assert main(["solve", "a.adm", "--quiet", "--outputs", "REQUEST/*", "PART/2.x"]) == 0
    assert Results.load("a.csv").names == ("PART/2.x", *SELECTED["REQUEST/1"])
    assert main(["solve", "a.adm", "--outputs", "REQEST/*", "-o", "b.csv"]) == 2
    assert "did you mean REQUEST/1.*" in capsys.readouterr().err
    assert not Path("b.csv").exists()
