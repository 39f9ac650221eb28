"""Tables of docs/background/cable_scenes.py, on a folder of its own and a run not solved."""

import importlib.util
from collections.abc import Mapping
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest
from fakes import fall

from adamslite.resources import find
from adamslite.results.results import Results

SCRIPT = Path(__file__).parent.parent / "docs" / "background" / "cable_scenes.py"
PAGE = """\
# Cables
<!-- acceptance -->
| | quantity | deck | expected | measured | allowed |
|---|---|---|---|---|---|
| F2 | speed | fall | 2 | 2.5 | 0.1 |
<!-- end -->
between
<!-- scenes -->
| scene | form | bodies | integrator | steps | CPU [s] | worst error / allowed |
|---|---|---|---|---|---|---|
| drum | sections | 40 | HHT | 90 | 1.00 | 0.5 |
| fall | ale | 40 | HHT | 90 | 1.00 | 0.5 |
<!-- end -->
below
"""
DECK = """\
Free fall
PART/1, GROUND
PART/2, MASS=3
POINT_MASS/3, MASS=1
MARKER/1, PART=1
"""
REFERENCE = """\
# tolerance: abs 0.02
# measure: last PART/2.vx = 1.01 tol abs 0.1
time,PART/2.x
0,0
0.5,0.125
1,0.51
"""


@pytest.fixture
def script(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> ModuleType:
    """The program, with the folder cables/fall, a page and a run of x = t^2/2 in its place."""
    spec = importlib.util.spec_from_file_location("scene_tables", SCRIPT)
    program = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(program)
    folder = tmp_path / "cables" / "fall"
    folder.mkdir(parents=True)
    (folder / "fall.adm").write_text(DECK)
    (folder / "reference.csv").write_text(REFERENCE)
    (tmp_path / "cables.md").write_text(PAGE)

    def run(deck: Path, options: Mapping[str, Any]) -> Results:
        return fall(meta={"integrator": "GSTIFF"})

    monkeypatch.setattr(program, "DECKS", tmp_path)
    monkeypatch.setattr(program, "PAGE", tmp_path / "cables.md")
    monkeypatch.setattr(program, "solve_quietly", run)
    acceptance = (
        ("F1", "place", "cables/fall", "", "PART/2.x", 0),
        ("F2", "speed", "cables/fall", "fa", "last", 0),
        ("F3", "another deck's", "cables/fall", "rise", "last", 0),
        ("F4", "another folder's", "cables/rise", "", "last", 0),
    )
    monkeypatch.setattr(program, "ACCEPTANCE", acceptance)
    return program


def test_a_folder_gives_rows_of_both_tables(script: ModuleType, tmp_path: Path) -> None:
    """Two bodies, 10 steps, 0.2 s of CPU; x is 0.01 of 0.02 off at the end, v 0.01 of 0.1."""
    scenes, accepted = script.measure(tmp_path / "cables" / "fall")
    assert scenes == ["| fall | sections | 2 | GSTIFF | 10 | 0.20 | 0.5 |\n"]
    assert accepted == [
        "| F1 | place | fall | closed form | 0.01 off at t = 1 | 0.02 |\n",
        "| F2 | speed | fall | 1.01 | 1 | 0.1 |\n",
    ]


def test_measured_rows_replace_those_of_the_page(script: ModuleType, tmp_path: Path) -> None:
    """In order of their names; rows of other folders and the text around the tables stay."""
    script.main(["cables/fall"])
    old = "| F2 | speed | fall | 2 | 2.5 | 0.1 |\n"
    new = (
        "| F1 | place | fall | closed form | 0.01 off at t = 1 | 0.02 |\n"
        "| F2 | speed | fall | 1.01 | 1 | 0.1 |\n"
    )
    expected = PAGE.replace(old, new).replace(
        "| fall | ale | 40 | HHT | 90 | 1.00 | 0.5 |",
        "| fall | sections | 2 | GSTIFF | 10 | 0.20 | 0.5 |",
    )
    assert (tmp_path / "cables.md").read_text() == expected


@pytest.mark.parametrize(
    ("deck", "form"),
    [
        ("payout-level/ale", "ale"),
        ("payout-level/paper", "paper"),
        ("drag-line/dig-paper", "paper"),
        ("crane/no-sway", "rigid rope"),
        ("kink-anchored/anchored", "sections"),
    ],
)
def test_the_form_of_a_deck_is_told_from_its_words(
    script: ModuleType, deck: str, form: str
) -> None:
    text = (find("decks") / "cables" / f"{deck}.adm").read_text(encoding="utf-8")
    assert script.form(text) == form
