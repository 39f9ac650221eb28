"""Sweeps whose first process is killed: its workers, and its file."""

from __future__ import annotations

import sys
from pathlib import Path
from subprocess import PIPE, Popen

import numpy as np
import pytest
from test_sweeps import DECK
from writing_commands import environment

import adamslite as al


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """With the deck of a mass that falls."""
    (tmp_path / "fall.adm").write_text(DECK)
    return tmp_path


KILLED = """import os
import time
import adamslite
from adamslite.sweeps import workers

def stuck(numbers):
    os.write(1, b"begun\\n")  # a line is whole, whoever writes beside it
    time.sleep(200)

if __name__ == "__main__":
    workers.LOT = workers.SHORT = 1e-9
    workers._lot = stuck
    varied, kept = "ACCGRAV.JGRAV=-1:-9:90", ["min POINT_MASS/2.y"]
    adamslite.sweep("fall.adm", varied, measures=kept, workers=3)
"""


def test_workers_end_when_the_first_process_is_killed(folder: Path) -> None:
    """Its output has no writer left only when all of them have gone."""
    (folder / "killed.py").write_text(KILLED)
    command = [sys.executable, "killed.py"]
    first = Popen(command, cwd=folder, env=environment(), stdout=PIPE, text=True)
    assert first.stdout is not None
    assert [first.stdout.readline() for _ in range(3)] == ["begun\n"] * 3
    first.kill()
    assert set(first.communicate(timeout=90)[0].split()) <= {"begun"}


SAVED = """import os
import signal
import adamslite
from adamslite.sweeps import sweep as sweeps

class Writing(sweeps._Writing):
    def now_and_then(self):
        self.write()
        if len(self._made) - len(self._made.ahead) == 30:
            os.kill(os.getpid(), signal.SIGKILL)

if __name__ == "__main__":
    sweeps._Writing = Writing
    adamslite.sweep("fall.adm", "ACCGRAV.JGRAV=-1:-9:90", measures=["min POINT_MASS/2.y"],
                    workers=1, path="x.nc")
"""


@pytest.mark.skipif(sys.platform == "win32", reason="signals of POSIX")
def test_what_was_in_the_file_of_a_killed_sweep_is_not_run_again(folder: Path) -> None:
    (folder / "saved.py").write_text(SAVED)
    first = Popen([sys.executable, "saved.py"], cwd=folder, env=environment())
    assert first.wait(120) == -9
    assert [each.name for each in folder.glob("*.part")] == []
    assert al.load_sweep(folder / "x.nc").ahead == [*range(30, 90)]
    words = {"measures": ["min POINT_MASS/2.y"], "workers": 1}
    whole = al.sweep(folder / "fall.adm", "ACCGRAV.JGRAV=-1:-9:90", **words)
    again = al.sweep(folder / "fall.adm", "ACCGRAV.JGRAV=-1:-9:90", path=folder / "x.nc", **words)
    assert again.outcomes == ["DONE"] * 90
    assert np.array_equal(again["min POINT_MASS/2.y"], whole["min POINT_MASS/2.y"])
