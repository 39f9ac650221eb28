"""Sweeps that are carried out again, and numbers that are given twice."""

from __future__ import annotations

from pathlib import Path

import pytest
from test_sweeps import DECK, LOWEST, NAME

import adamslite as al
from adamslite.cli.main import main


@pytest.fixture
def path(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "fall.adm").write_text(DECK)
    return tmp_path / "fall.adm"


def test_a_run_that_the_program_failed_at_is_tried_again(path: Path, monkeypatch) -> None:
    usual = al.analyses.simulation.simulate

    def failing(deck, **options):
        if deck.values[NAME] == -2:
            raise RuntimeError("no room")
        return usual(deck, **options)

    wanted, kept = ("fall.adm", {NAME: [-1.0, -2.0]}), {"measures": [LOWEST], "workers": 1}
    with monkeypatch.context() as patch:
        patch.setattr("adamslite.sweeps.job.simulate", failing)
        first = al.sweep(*wanted, **kept, path="fall.nc")
    assert first.outcomes == ["DONE", "FAULT"]
    assert al.sweep(*wanted, **kept, path="fall.nc").outcomes == ["DONE", "DONE"]


def test_a_number_that_varies_has_no_other_value(path: Path, capsys) -> None:
    words = ["sweep", "fall.adm", f"{NAME}=-1,-2", "--measure", LOWEST, "--workers", "1"]
    assert main([*words, "--set", f"{NAME.lower()}=-3"]) == 2
    assert (
        f"{NAME} is varied, and has one value by --set {NAME.lower()}=-3" in capsys.readouterr().err
    )
    assert not Path("fall.sweep.nc").exists()
    assert main([*words, "--quiet", "--set", "POINT_MASS/2.MASS=3"]) == 0
