"""Random cases of every kind end with a word of the program: see tests/fuzz."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from fuzz import guarded
from fuzz.calls import Broken
from fuzz.cases import KEPT, Case, keep, kept
from fuzz.guarded import BROKEN, FAULTS, LARGE, SIGNAL, SLOW, TRACEBACK, Child, verdicts
from fuzz.kinds import KINDS, Kind
from fuzz.minimise import minimised

COMMAND = Path(__file__).parent / "fuzz"
#: Kinds of cases that compile what they run.
RUNS = ("solve", "any", "words")
CASES = sorted(each.name for each in KEPT.iterdir())


@pytest.mark.parametrize("kind", [each for each in KINDS if each != "grammar"])
def test_a_case_is_always_the_same(kind: str) -> None:
    make = KINDS[kind].make
    assert make(1, 7) == make(1, 7) != make(1, 8)
    assert make(2, 7) != make(1, 7)


@pytest.mark.slow
def test_a_deck_of_the_grammar_is_always_the_same() -> None:
    make = KINDS["grammar"].make
    assert make(1, 7) == make(1, 7) != make(1, 8)


@pytest.mark.parametrize("name", [each for each in CASES if kept(KEPT / each)[0] not in RUNS])
def test_a_case_that_was_found_stays_mended(
    name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    kind, case = kept(KEPT / name)
    assert KINDS[kind].meet(case, tmp_path)


@pytest.mark.slow
def test_all_cases_that_were_found_stay_within_their_limits() -> None:
    """The command that meets them again names each of them with the word for its end."""
    done = subprocess.run(
        [sys.executable, COMMAND, "--again", KEPT], capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stdout + done.stderr
    assert [line.partition(":")[0] for line in done.stdout.splitlines()] == CASES


@pytest.mark.slow
@pytest.mark.parametrize("kind", KINDS)
def test_no_case_of_the_sample_is_a_fault(kind: str) -> None:
    """Cases with fixed seeds, so many as take about a minute of CPU in all kinds together."""
    done = subprocess.run(
        [sys.executable, COMMAND, "--kind", kind], capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stdout + done.stderr
    last = done.stdout.splitlines()[-1]
    assert last.startswith(f"{kind}: {KINDS[kind].sample} cases (")
    assert last.endswith(", ".join(f"0 {each}" for each in FAULTS))


# ---- the guard -----------------------------------------------------------------------------------


def deed(case: Case, folder: Path) -> str:
    """What the only file says: every way in which a case can be a fault, and one in which not."""
    word = case.files["a"].decode()
    if word == "raise":
        raise ValueError("of the program")
    if word == "break":
        raise Broken("KeyError: 'x'")
    if word == "die":
        os.kill(os.getpid(), signal.SIGSEGV)
    if word == "leave":
        os._exit(3)
    if word == "spin":
        start = time.process_time()
        while time.process_time() < start + 2.6:
            pass
    if word == "hoard":
        return f"{len(b'x' * 400_000_000)} bytes"
    return "done"


WORDS = ("fine", "raise", "break", "die", "leave", "spin", "hoard", "fine")
ENDS = ["done", TRACEBACK, BROKEN, SIGNAL, SIGNAL, SLOW, LARGE, "done"]


@pytest.fixture
def deeds(monkeypatch: pytest.MonkeyPatch) -> str:
    """A kind whose cases do that, with limits that a test can afford."""

    def make(seed: int, number: int) -> Case:
        return Case({"a": WORDS[number].encode()})

    monkeypatch.setitem(KINDS, "deeds", Kind("deeds", make, deed, len(WORDS)))
    monkeypatch.setattr(guarded, "ALLOWED_CPU", 2.0)
    guarded.forget_peak()  # a child begins with what this process has now, less libraries
    monkeypatch.setattr(guarded, "ALLOWED_MEMORY", guarded.peak() + 50.0)
    return "deeds"


@pytest.mark.parametrize("jobs", [1, 3])
def test_each_way_to_end_is_told_from_the_others(deeds: str, jobs: int) -> None:
    """Whoever dies takes no other case along."""
    found = dict(verdicts(deeds, 1, range(len(WORDS)), jobs))
    assert [found[number].word for number in range(len(WORDS))] == ENDS
    assert "ValueError: of the program" in found[1].what and "test_fuzz.py" in found[1].what
    assert found[2].what == "KeyError: 'x'"
    assert found[3].what == "SIGSEGV" and found[4].what == "exit code 3"


def test_a_case_without_an_end_is_ended(deeds: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """By the kernel where it computes, by the parent where it waits."""
    endless = Kind("endless", KINDS[deeds].make, lambda case, folder: str(max(iter(int, 1))), 1)
    monkeypatch.setitem(KINDS, "endless", endless)
    monkeypatch.setattr(guarded, "MOST_CPU", 0)
    with Child("endless") as child:
        verdict = child.verdict(Case({"a": b""}))
    assert verdict.word == SLOW and "of CPU" in verdict.what
    waiting = Kind("waiting", KINDS[deeds].make, lambda case, folder: str(signal.pause()), 1)
    monkeypatch.setitem(KINDS, "waiting", waiting)
    monkeypatch.setattr(guarded, "SILENCE", 0.5)
    with Child("waiting") as child:
        verdict = child.verdict(Case({"a": b""}))
    assert verdict.word == SLOW and "no answer" in verdict.what


def test_what_is_not_needed_for_a_fault_is_left_out() -> None:
    """Two lines far from each other, and of each only a part."""
    lines = [b"line %d\n" % k for k in range(100)]
    case = Case({"a": b"".join([*lines, b"one x\n", *lines, b"two y\n", *lines]), "b": b"other"})

    def fails(each: Case) -> bool:
        return b"x" in each.files["a"] and b"y" in each.files["a"].partition(b"x")[2]

    assert minimised(case, fails).files == {"a": b"xy", "b": b""}


def test_a_kept_case_is_read_again(tmp_path: Path) -> None:
    case = Case({"a.csv": b"\0\xff", "b.csv": b""}, ("a.csv", 'quoted "word"', "\n"))
    keep(case, "csv", tmp_path / "kept", "a signal: SIGSEGV")
    assert kept(tmp_path / "kept") == ("csv", case)
