"""Progress of runs: what they report, and what keeps their steps short."""

from __future__ import annotations

import re
from typing import Any

import pytest
from progress_scenes import Clock, Stream

import adamslite as al
from adamslite.cli.main import main
from adamslite.progress import AnalysisProgress, Progress, RunState, TalkingProgress

MASS = """A mass in a field of force
UNITS/SYSTEM=MKS
PART/1, GROUND
MARKER/1, PART=1
POINT_MASS/2, MASS=1, CM=2, QG=1,0,0
MARKER/2, POINT_MASS=2
"""


def test_quiet_and_scripts_show_nothing(tmp_path: Any, capfd: Any) -> None:
    deck = tmp_path / "mass.adm"
    deck.write_text(MASS + "SIMULATE/DYNAMIC, END=1, STEPS=2\nEND\n")
    assert main(["solve", str(deck), "-o", str(tmp_path / "out.csv"), "--quiet"]) == 0
    al.simulate(deck)
    assert capfd.readouterr() == ("", "")


class Watcher(Progress):
    """Keeps states, with the limits of steps; ends the run after some of them."""

    def __init__(self, most: int) -> None:
        self.most, self.seen, self.limits = most, [], []

    def watch(self, state: RunState) -> None:
        self.seen.append(state)
        self.limits.append(state.limit())
        if len(self.seen) >= self.most and state.steps > self.seen[0].steps:
            raise KeyboardInterrupt


def watched(text: str, most: int = 3, **options: Any) -> Watcher:
    """Looks at a run of 1e6 s, which would take far longer than any test."""
    watcher = Watcher(most)
    results = al.simulate(text + "END\n", end=1e6, steps=10, progress=watcher, **options)
    assert results.outcome is al.Outcome.INTERRUPTED
    return watcher


def test_a_run_reports_time_step_order_and_steps() -> None:
    """A mass on a spring of 1 Hz; steps are far below HMAX, time and steps increase."""
    spring = MASS + "SPRINGDAMPER/1, TRANSLATIONAL, I=2, J=1, K=39.5, LENGTH=1.5\n"
    seen = watched(spring, error=1e-8).seen
    assert all(each.end == 1e6 and each.start == 0.0 for each in seen)
    assert all(0.0 < each.step < 1.0 and 1 <= each.order <= 5 for each in seen)
    assert seen[0].time < seen[-1].time and seen[0].steps < seen[-1].steps


@pytest.mark.slow
def test_an_analysis_of_many_runs_is_reported_as_one() -> None:
    """s' = -s(t - 0.01): a run for each two delays, each of which is over long before a look."""
    decay = "DIFF/1, IC=1, FUNCTION=-DELAY(DIF(1),0.01,1)\n"
    seen = watched(MASS + decay).seen
    assert all((each.start, each.end) == (0.0, 1e6) for each in seen)
    assert [each.time for each in seen] == sorted(each.time for each in seen)
    assert [each.steps for each in seen] == sorted(each.steps for each in seen)
    assert seen[-1].steps > 100


def test_an_interrupt_between_runs_ends_the_analysis() -> None:
    """It may come when a run of DELAY is just over."""

    class Impatient(Progress):
        looks = 0

        def watch(self, state: RunState) -> None:
            self.looks += 1
            raise KeyboardInterrupt

    decay = "DIFF/1, IC=1, FUNCTION=-DELAY(DIF(1),0.01,1)\n"
    impatient = Impatient()
    results = al.simulate(MASS + decay + "END\n", end=1e6, steps=10, progress=impatient)
    assert results.outcome is al.Outcome.INTERRUPTED
    assert impatient.looks == 1


def test_looks_at_short_runs_are_not_too_many() -> None:
    """A run each 10 ms for a second: about ten looks, none at the end."""
    clock, watcher = Clock(), Watcher(10**6)
    whole = AnalysisProgress(watcher, 0.0, 1.0, lambda: 7, clock)
    for k in range(1, 101):
        clock.now += 0.01
        whole.watch(RunState(time=0.01 * k, start=0.01 * (k - 1), end=0.01 * k, steps=3))
    assert 9 <= len(watcher.seen) <= 11
    assert all((each.start, each.end, each.steps) == (0.0, 1.0, 10) for each in watcher.seen)
    assert watcher.seen[0].time >= 0.085 and watcher.seen[-1].time < 1.0


def test_the_statement_with_the_largest_error_is_named() -> None:
    """PART/4 vibrates at 1000 Hz, POINT_MASS/2 does not move: the error is that of PART/4."""
    stiff = (
        "PART/4, MASS=1, CM=4, IP=1,1,1, VX=1\nMARKER/4, PART=4\n"
        "VFORCE/1, I=4, J_PART=1, FX=-4E7*DX(4)\\FY=0\\FZ=0\n"
    )
    limits = watched(MASS + stiff).limits
    assert limits[-1].startswith("the error of PART/4 (<text>:7:1), ")


def test_events_are_named_with_their_statement() -> None:
    """10 kN that turn over wherever the mass passes x = 1, 1 m from its start: every 28 ms."""
    force = "VFORCE/7, I=2, J_PART=1, FX=IF(DX(2)-1: 1E4, 0, -1E4)\\FY=0\\FZ=0\n"
    away = MASS.replace("QG=1,0,0", "QG=2,0,0")
    limits = watched(away + force, hmax=2e-3, error=1e-7).limits
    assert limits[-1] == "events of VFORCE/7 (<text>:7:1)"


@pytest.mark.slow
def test_a_run_prints_lines_to_a_file() -> None:
    """On a clock that adds a second at each look, until a line shows the speed."""
    clock, stream = Clock(), Stream(False)

    def ticking() -> float:
        clock.now += 1.0
        return clock.now

    class Limited(TalkingProgress):
        def watch(self, state: RunState) -> None:
            super().watch(state)
            if "steps/s" in stream.text:
                raise KeyboardInterrupt

    spring = MASS + "SPRINGDAMPER/1, TRANSLATIONAL, I=2, J=1, K=39.5, LENGTH=1.5\nEND\n"
    al.simulate(spring, end=1e6, steps=10, error=1e-8, progress=Limited(stream, ticking))
    last = stream.text.splitlines()[-1]
    assert re.fullmatch(
        r"\d+ %  t = \S+ of 1e\+06  h = \S+  order \d  [\d ]+ steps/s  .* left.*", last
    )
