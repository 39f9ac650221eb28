"""What processes keep for each other: runs side by side, and a folder that goes away."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from falling_mass import falling_mass
from replacing import replaced

import adamslite
from adamslite.results.results import Results


@pytest.fixture
def deck(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A deck of its own in the current folder."""
    monkeypatch.chdir(tmp_path)
    return falling_mass()


@pytest.mark.slow
def test_a_folder_that_goes_away_or_takes_nothing(deck: Path, tmp_path: Path) -> None:
    """A run in a folder for the cache that is removed, or read-only, is a run all the same."""
    folder = tmp_path / "kept"
    env = {**os.environ, "ADAMSLITE_CACHE": str(folder)}
    env["PYTHONPATH"] = str(Path(adamslite.__file__).parents[1])
    words = [sys.executable, "-m", "adamslite", "solve", "fall.adm", "-o", "out.csv"]
    found = []
    for state in ("new", "kept", "removed", "read-only"):
        if state == "removed":
            shutil.rmtree(folder)
        if state == "read-only":
            folder.chmod(0o500)
        run = subprocess.run(words, env=env, capture_output=True, text=True)
        assert run.returncode == 0, run.stderr
        found.append(Path("out.csv").read_bytes())
    folder.chmod(0o700)
    assert len({*found}) == 1


@pytest.mark.slow
def test_processes_at_once_agree(deck: Path, tmp_path: Path) -> None:
    """Six runs of a deck that nothing is kept of, two of them of other numbers."""
    shutil.copy(deck, "heavy.adm")
    replaced(Path("heavy.adm"), "-10.0", "-30.0")
    env = {**os.environ, "PYTHONPATH": str(Path(adamslite.__file__).parents[1])}
    words = [sys.executable, "-m", "adamslite", "solve"]
    runs = [
        subprocess.Popen([*words, f"{name}.adm", "-o", f"{k}.csv", "--quiet"], env=env)
        for k, name in enumerate(["fall", "heavy", "fall", "fall", "heavy", "fall"])
    ]
    assert [run.wait() for run in runs] == [0] * 6
    ends = [Results.load(f"{k}.csv")["POINT_MASS/2.y"][-1] for k in range(6)]
    assert np.allclose(ends, [-10.0, -30.0, -10.0, -10.0, -30.0, -10.0])
