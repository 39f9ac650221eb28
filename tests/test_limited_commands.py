"""Limits of CPU, steps and memory in commands that are more than one run."""

from __future__ import annotations

import importlib
import re
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from fit_scenes import SWINGS, K, X, table

import adamslite as al
from adamslite import Outcome, machine
from adamslite.cli.main import main
from adamslite.errors import NoRoom, OutOfMemory, RunFailed
from adamslite.fitting import curves
from adamslite.native import worker
from adamslite.sensitivity import adjoint, study

#: As the command line and Python name them.
STEPS, CPU = r"as --max-steps allows|as max_steps= allows", r"--cpu-limit allows|cpu_limit= allows"
TIMES = np.linspace(0.0, 2.0, 41)


def measured() -> Path:
    """The swing of a mass on a spring of K=260, which is 200 in the deck."""
    run = al.simulate(al.with_values(al.read(SWINGS), {K: 260.0}), steps=40)
    return table(TIMES, x=run[X])


def test_a_fit_that_runs_out_of_steps_has_its_best_numbers(tmp_path, monkeypatch, capsys) -> None:
    """More steps lead nearer, and a limit that is not reached changes nothing."""
    monkeypatch.chdir(tmp_path)
    Path("swings.adm").write_text(SWINGS)
    whole = al.fit(SWINGS, measured(), [K])
    assert whole[K] == pytest.approx(260.0, rel=1e-4) and not whole.stopped
    off = []
    for most in (2_000, 6_000, 10**9):
        found = al.fit(SWINGS, measured(), [K], max_steps=most)
        off.append(abs(found[K] - 260.0))
        assert bool(found.stopped) == found.limited == (most < 10**9)
        assert not found.stopped or (
            re.search(STEPS, found.stopped) and np.isnan(found.errors).all()
        )
        assert found.results.summary["outcome"] == "DONE"
    assert found[K] == whole[K] and off[0] > 1.0 > off[1] >= off[2]
    words = ["fit", "swings.adm", str(measured()), "--by", K, "--max-steps", "6000", "--quiet"]
    assert main(words) == 4
    told = "".join(capsys.readouterr())
    assert re.search(STEPS, told) and "not worked out" in told
    assert al.read("swings.fitted.adm").values is not None


def test_an_interrupted_fit_has_its_best_numbers(monkeypatch) -> None:
    from adamslite.fitting.curves import Runs

    usual, calls = Runs.results, []

    def results(self, values, **options):
        calls.append(values)
        if len(calls) > 12:
            monkeypatch.undo()
            raise KeyboardInterrupt
        return usual(self, values, **options)

    monkeypatch.setattr(Runs, "results", results)
    found = al.fit(SWINGS, measured(), [K])
    assert found.stopped == Outcome.INTERRUPTED.sentence and found.limited
    reached = {each[0] for each in calls}
    assert found[K] == min(reached, key=lambda each: abs(each - 260.0)) != calls[0][0]


def test_a_fit_whose_first_run_is_too_much_says_so() -> None:
    with pytest.raises(RunFailed, match=STEPS):
        al.fit(SWINGS, measured(), [K], max_steps=5)


def spent(monkeypatch: pytest.MonkeyPatch, module, before: int) -> None:
    """Let the CPU be spent after so many calls of what works derivatives out."""
    name = "followed" if module is study else "interruptible"
    usual, calls = getattr(module, name), []

    def limited(*words, **options):
        calls.append(words)
        if len(calls) > before:
            raise worker.Overspent
        return usual(*words, **options)

    monkeypatch.setattr(module, name, limited)


def test_derivatives_that_are_worked_out_are_kept(monkeypatch, tmp_path, capsys) -> None:
    """Here two numbers of three, one at a time."""
    by = ["SPRINGDAMPER/1.K", "SPRINGDAMPER/1.C", "SPRINGDAMPER/1.LENGTH"]
    of, run = ["POINT_MASS/2.x@end"], {"end": 0.5, "steps": 5}
    whole = al.sensitivities(SWINGS, by, of, **run)
    monkeypatch.setattr(study, "LIMITED", 1)
    spent(monkeypatch, study, 2)
    found = al.sensitivities(SWINGS, by, of, **run, cpu_limit=1e6)
    assert re.search(CPU, found.stopped) and not whole.stopped
    np.testing.assert_allclose(found.gradient[0, :2], whole.gradient[0, :2], rtol=1e-9)
    assert np.isnan(found.gradient[0, 2]) and np.isnan(found.curves[2]).all()
    assert (found.values == whole.values).all()
    (tmp_path / "swings.adm").write_text(SWINGS)
    words = ["sens", str(tmp_path / "swings.adm"), "--of", *of, "--by", *by, "--cpu-limit", "1e6"]
    assert main([*words, "--end", "0.5", "--steps", "5"]) == 4
    out, told = capsys.readouterr()
    assert "nan" in out and re.search(CPU, told)


def test_measures_whose_gradient_is_found_are_kept(monkeypatch) -> None:
    of, run = ["POINT_MASS/2.x@end", "max POINT_MASS/2.x"], {"end": 0.5, "steps": 5}
    whole = al.gradient(SWINGS, of, [K], **run)
    spent(monkeypatch, adjoint, 1)
    found = al.gradient(SWINGS, of, [K], **run, cpu_limit=1e6)
    assert re.search(CPU, found.stopped) and (found.values == whole.values).all()
    assert found.gradient[0, 0] == whole.gradient[0, 0] and np.isnan(found.gradient[1, 0])


@pytest.mark.parametrize("work", [al.sensitivities, al.gradient])
def test_derivatives_need_a_run_that_reaches_its_end(work) -> None:
    words = {"by": [K], "of": ["POINT_MASS/2.x@end"], "max_steps": 5}
    with pytest.raises(RunFailed, match=STEPS):
        work(SWINGS, **words)


@pytest.mark.parametrize(
    ("flag", "said"), [("--cpu-limit=1e-4", CPU), ("--max-steps=3", STEPS)], ids=["cpu", "steps"]
)
@pytest.mark.parametrize("command", ["linear", "sens"])
def test_a_command_that_reaches_a_limit_ends_by_name(
    tmp_path: Path, capsys, command: str, flag: str, said: str
) -> None:
    deck = tmp_path / "swings.adm"
    deck.write_text(SWINGS)
    more = ["--of", "POINT_MASS/2.x@end", "--by", K] if command == "sens" else ["--time", "1"]
    assert main([command, str(deck), flag, *more]) == 4
    assert re.search(said, capsys.readouterr().err)


def test_modes_that_take_too_long_are_not_found(monkeypatch) -> None:
    def late(call, stop=None, over=None):
        raise worker.Overspent

    monkeypatch.setattr("adamslite.analyses.session.session.interruptible", late)
    with pytest.raises(RunFailed, match=CPU):
        al.linearize(SWINGS, cpu_limit=1e6)


def test_a_reference_whose_run_reaches_a_limit_is_not_met(capsys) -> None:
    deck = Path(__file__).parents[1] / "decks/hanging-mass"
    assert main(["verify", str(deck), "--max-steps", "10"]) == 1
    assert "STEP_LIMIT" in capsys.readouterr().out


@pytest.mark.parametrize("fault", [NoRoom("too little"), OutOfMemory("too little")])
def test_a_fit_without_memory_for_a_run_has_its_best_numbers(monkeypatch, fault) -> None:
    """Those after it would have none either: it is a limit, and no place where runs fail."""
    usual, runs = curves.simulate, []

    def short(*words, **options):
        runs.append(words)
        if len(runs) > 8:
            raise fault
        return usual(*words, **options)

    monkeypatch.setattr(curves, "simulate", short)
    found = al.fit(SWINGS, measured(), [K])
    assert found.limited and found.stopped == "too little" and len(runs) == 9


def test_references_without_memory_for_their_run_are_not_met(monkeypatch, capsys) -> None:
    """Each has its line, and the others are tried."""
    decks = [str(Path(__file__).parents[1] / "decks" / name) for name in ("atwood", "cam")]

    def short(*_, **__):
        raise OutOfMemory("too little")

    monkeypatch.setattr("adamslite.verification.verification.run_scene", short)
    assert main(["verify", *decks, "--jobs", "1"]) == 1
    lines = capsys.readouterr().out.splitlines()
    assert lines[-1].startswith("0 of ") and len(lines) > 2
    assert all(line.startswith("FAIL") and "too little" in line for line in lines[:-1])


def test_linear_algebra_needs_its_memory(monkeypatch) -> None:
    """Its library ends the process, or waits for ever, where it gets none."""
    monkeypatch.delitem(sys.modules, machine.ALGEBRA, raising=False)
    used = machine.used_memory()
    with machine.memory_limited(used + machine.OF_ALGEBRA // 2), pytest.raises(MemoryError):
        importlib.import_module(machine.ALGEBRA)


class TestASweep:
    """Each process of a worker has the limit for itself, while its runs last."""

    @pytest.fixture
    def deck(self, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> str:
        monkeypatch.chdir(tmp_path)
        Path("swings.adm").write_text(SWINGS)
        return "swings.adm"

    @pytest.mark.skipif(sys.platform != "linux", reason="no other system keeps a limit")
    @pytest.mark.parametrize(
        "steps",
        [
            pytest.param(300_000, id="fails"),
            pytest.param(3_000_000, id="is refused", marks=pytest.mark.slow),
        ],
    )
    def test_runs_that_find_no_memory_are_carried_out_again(self, deck: str, steps: int) -> None:
        """Rows of 1e5 numbers and more: an allocation fails, or the estimate says so before."""
        words = ["sweep", deck, "POINT_MASS/2.MASS=1,1.5,2", "--measure", "max POINT_MASS/2.x"]
        words += ["--end", "0.2", "--steps", str(steps), "-o", "x.nc", "--quiet", "--workers", "2"]
        first = adamslite(*words, "--memory-limit", "150MB")
        assert first.returncode == 4, first.stderr
        assert first.stderr.count("MEMORY_LIMIT") == 3 and "memory" in first.stderr
        there = al.load_sweep("x.nc")
        assert (
            there.outcomes == ["MEMORY_LIMIT"] * 3 and np.isnan(there["max POINT_MASS/2.x"]).all()
        )
        again = adamslite(*words, "--memory-limit", "4GB")
        assert again.returncode == 0, again.stderr
        assert al.load_sweep("x.nc").outcomes == ["DONE"] * 3

    def test_the_limit_changes_nothing_that_fits(self, deck: str) -> None:
        words = ({"POINT_MASS/2.MASS": [1.0, 2.0]}, "grid", 0, ["max POINT_MASS/2.x"])
        whole = al.sweep(deck, *words, workers=1, path="whole.nc")
        limited = al.sweep(deck, *words, workers=1, path="limited.nc", memory_limit="8GB")
        assert limited.outcomes == ["DONE"] * 2 and limited.key == whole.key
        assert Path("whole.nc").read_bytes() == Path("limited.nc").read_bytes()

    @pytest.mark.parametrize(
        ("flags", "said"),
        [
            (["--memory-limit", "2GB", "--threads"], "threads have one together"),
            (["--memory-limit", "2GB", "--scheduler", "tcp://nowhere:1"], "have their own"),
            (["--memory-limit", "much"], "it must be a size"),
            pytest.param(
                ["--memory-limit", "1MB"], "before the run the process takes",
                marks=pytest.mark.skipif(sys.platform != "linux", reason="it is not asked"),
            ),
        ],
    )  # fmt: skip
    def test_a_limit_that_no_run_could_keep_is_refused(
        self, deck: str, flags: list[str], said: str, capsys
    ) -> None:
        words = ["sweep", deck, "POINT_MASS/2.MASS=1,2", "--measure", "max POINT_MASS/2.x"]
        assert main([*words, "-o", "x.nc", *flags]) == 2
        assert said in capsys.readouterr().err and not Path("x.nc").exists()


def adamslite(*words: str) -> subprocess.CompletedProcess[str]:
    """A command in a process of its own, which takes no more than it needs."""
    return subprocess.run(
        [sys.executable, "-m", "adamslite", *words], capture_output=True, text=True, timeout=120
    )


@pytest.mark.slow
@pytest.mark.skipif(sys.platform != "linux", reason="no other system keeps a limit")
@pytest.mark.parametrize("command", ["linear", "sens", "fit", "verify"])
def test_whatever_memory_there_is_a_command_ends_by_name(
    tmp_path, monkeypatch, command: str
) -> None:
    """From a limit that is too small for the program itself to one that is enough."""
    monkeypatch.chdir(tmp_path)
    Path("swings.adm").write_text(SWINGS)
    shutil.copytree(Path(__file__).parents[1] / "decks/hanging-mass", "hanging-mass")
    words = {
        "linear": ["swings.adm"], "verify": ["hanging-mass"],
        "sens": ["swings.adm", "--of", "POINT_MASS/2.x@end", "--by", K],
        "fit": ["swings.adm", str(measured()), "--by", K],
    }  # fmt: skip
    codes = []
    for size in (60, 90, 100, 120, 140, 170, 200, 250, 1000):
        done = subprocess.run(
            [sys.executable, "-m", "adamslite", command, *words[command],
             "--memory-limit", f"{size}MB"],
            capture_output=True, text=True, timeout=60,
        )  # fmt: skip
        ends = (0, 1) if command == "verify" else (0, 2, 4)
        assert done.returncode in ends, (size, done.stderr)
        assert done.returncode == 0 or "--memory-limit" in done.stdout + done.stderr
        codes.append(done.returncode)
    assert codes[-1] == 0 and codes[0] != 0
