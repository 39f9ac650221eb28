"""Runs that have reached a limit, and go on with a larger one to the bytes of a run without.

They have so many outputs that blocks are full, with which states are written, before the limit,
however fast the machine is.
"""

from __future__ import annotations

import subprocess
from pathlib import Path

import pytest
from unfinished_runs import command, solved
from unfinished_scenes import chain, cranked, lowered, pendulum, written

#: The flag that ends a run, that with which it goes on, and what is said.
LIMITS = {
    "steps": (
        ("--max-steps", "4000"),
        ("--max-steps", "900000"),
        "--resume x.csv.part --max-steps N",
    ),
    "few steps": (("--max-steps", "300"), ("--max-steps", "900000"), "--max-steps N"),
    "CPU": (("--cpu-limit", "0.3"), ("--cpu-limit", "600"), "for as much CPU once more"),
    "CPU once more": (("--cpu-limit", "0.5"), (), "or give another --cpu-limit"),
}


def run(folder: Path, *words: str) -> tuple[int, str]:
    done = subprocess.run(command(*words), capture_output=True, text=True, cwd=folder)
    return done.returncode, done.stderr


def ends(folder: Path, code: int, error: str) -> bytes:
    """The results of runs until one ends for good."""
    for _ in range(60):
        if code == 0:
            return (folder / "x.csv").read_bytes()
        assert code == 4, error
        code, error = run(folder, "--resume", "x.csv.part")
    raise AssertionError(error)


#: The limit, the deck and its flags, by what runs.
LIMITED = {
    "RKF45": ("steps", pendulum(1200, 8000), "--integrator", "RKF45", "--error", "1e-7"),
    "postures": ("few steps", cranked(30, 900)),
    "VERLET": ("steps", chain(20, 400), "--integrator", "VERLET", "--error", "1e-4"),
    "GSTIFF": ("CPU", pendulum(1200, 8000), "--integrator", "GSTIFF", "--error", "1e-7"),
    "equilibria": ("CPU", lowered(40000)),
    "RADAU": ("CPU once more", pendulum(1200, 8000), "--integrator", "RADAU", "--error", "1e-7"),
}
QUICK = ("RKF45", "postures")


@pytest.mark.parametrize(
    "case",
    [each if each in QUICK else pytest.param(each, marks=pytest.mark.slow) for each in LIMITED],
)
def test_a_run_at_its_limit_goes_on(tmp_path: Path, case: str) -> None:
    limit, text, *flags = LIMITED[case]
    few, more, said = LIMITS[limit]
    deck = written(tmp_path, text)
    code, error = run(tmp_path, deck.name, "-o", "x.csv", *flags, *few)
    assert code == 4 and said in error, error
    table = (tmp_path / "x.csv").read_text()
    assert "# outcome: STEP_LIMIT" in table or "# outcome: CPU_LIMIT" in table
    code, error = run(tmp_path, "--resume", "x.csv.part", *more)
    found = ends(tmp_path, code, error)
    assert found == solved(deck, *flags) and not (tmp_path / "x.csv.part").exists()


def test_a_limit_that_is_not_larger_ends_it_again(tmp_path: Path) -> None:
    deck = written(tmp_path, pendulum(400, 8000))
    flags = ("--integrator", "RKF45", "--error", "1e-7", "--max-steps", "2000")
    first = run(tmp_path, deck.name, "-o", "x.csv", *flags)
    table = (tmp_path / "x.csv").read_bytes()
    assert run(tmp_path, "--resume", "x.csv.part") == first
    assert (tmp_path / "x.csv").read_bytes() == table and (tmp_path / "x.csv.part").exists()


#: A mass on a spring, which gets 1e11 times as stiff after a while.
STIFFENS = """\
a spring that stiffens
PART/1, GROUND
MARKER/1, PART=1
POINT_MASS/2, MASS=1, QG=1,0,0, CM=2
MARKER/2, POINT_MASS=2
VFORCE/1, I=2, JFLOAT=3, RM=1, FX=-1E6*DX(2)*IF(TIME-400: 1, 1, 1E11), FY=0, FZ=0
MARKER/3, PART=1, FLOATING
SIMULATE/DYNAMIC, END=800, STEPS=40000
END
"""


@pytest.mark.slow
def test_a_run_that_creeps_goes_on_for_so_many_steps(tmp_path: Path) -> None:
    deck = written(tmp_path, STIFFENS)
    flags = ("--integrator", "RKF45")
    code, error = run(tmp_path, deck.name, "-o", "x.csv", *flags)
    table = (tmp_path / "x.csv").read_text()
    assert code == 4 and "# outcome: CREEPING" in table, error
    assert "--max-steps N` goes on with it up to so many steps, however short" in error
    taken = int(error.partition("in step ")[2].split()[0])
    more = ("--max-steps", str(taken + 5000))
    code, error = run(tmp_path, "--resume", "x.csv.part", *more)
    found = (tmp_path / "x.csv").read_bytes()
    assert code == 4 and b"# outcome: STEP_LIMIT" in found, error
    assert run(tmp_path, deck.name, "-o", "whole.csv", *flags, *more)[0] == 4
    assert found == (tmp_path / "whole.csv").read_bytes()
