"""Progress: what is shown of a run, where, and what keeps its steps short."""

from __future__ import annotations

import re
import sys
from types import SimpleNamespace
from typing import Any

import pytest

import adamslite as al
from adamslite.cli.main import main
from adamslite.errors import UsageError
from adamslite.progress import (
    AnalysisProgress,
    Progress,
    RunState,
    SentenceProgress,
    TalkingProgress,
    progress_of,
)
from adamslite.progress.meter import Meter

MASS = """A mass in a field of force
UNITS/SYSTEM=MKS
PART/1, GROUND
MARKER/1, PART=1
POINT_MASS/2, MASS=1, CM=2, QG=1,0,0
MARKER/2, POINT_MASS=2
"""


class Clock:
    """A clock that is set by hand [s]."""

    def __init__(self) -> None:
        self.now = 100.0

    def __call__(self) -> float:
        return self.now


class Stream:
    """What is written, to a terminal or to a file."""

    def __init__(self, terminal: bool) -> None:
        self.terminal, self.text = terminal, ""

    def isatty(self) -> bool:
        return self.terminal

    def write(self, text: str) -> None:
        self.text += text

    def flush(self) -> None:
        pass


def state(time: float, steps: int = 0, step: float = 0.01, **more: Any) -> RunState:
    facts = {"time": time, "end": 2.0, "step": step, "order": 3, "steps": steps, "longest": 0.1}
    return RunState(**{**facts, **more})


@pytest.fixture
def plain(monkeypatch: pytest.MonkeyPatch) -> None:
    """A terminal without rich."""
    monkeypatch.setattr("adamslite.progress.terminal._has_rich", lambda: False)
    monkeypatch.setenv("COLUMNS", "200")


def test_speed_and_time_left_are_those_of_the_last_seconds() -> None:
    """1000 steps and 0.1 s of motion in each second; later half as fast."""
    clock = Clock()
    meter = Meter(clock)
    meter.look(state(0.0))
    for second in range(1, 6):
        clock.now += 1.0
        look = meter.look(state(0.1 * second, 1000 * second))
    assert (look.speed, look.left) == (pytest.approx(1000.0), pytest.approx(15.0))
    assert look.text == " 25 %  t = 0.5 of 2  h = 1.0e-02  order 3  1 000 steps/s  0:15 left"
    for second in range(1, 11):
        clock.now += 1.0
        look = meter.look(state(0.5 + 0.05 * second, 5000 + 500 * second))
    assert (look.speed, look.left) == (pytest.approx(500.0), pytest.approx(20.0))


@pytest.mark.parametrize(
    ("left", "shown"),
    [
        (7.4, "0:07 left"),
        (754.0, "12:34 left"),
        (11_100.0, "3 h 05 min left"),
        (4e5, "4 days left"),
    ],
)
def test_time_left_is_shown_in_units_to_read(left: float, shown: str) -> None:
    """One second for a share of 1 / (left + 1) of the motion."""
    clock = Clock()
    meter = Meter(clock)
    meter.look(state(0.0))
    clock.now += 1.0
    assert meter.look(state(2.0 / (left + 1.0), 10)).text.endswith(shown)


def test_short_steps_are_explained_once_they_last() -> None:
    """Steps of 0.01 that become 1e-5; the reason is asked for after a second of them."""
    clock, asked = Clock(), []

    def limit() -> str:
        asked.append(clock.now)
        return "the error of PART/2"

    meter = Meter(clock)
    for k in range(100):
        meter.look(state(0.01 * k, k, limit=limit))
        clock.now += 0.1
    assert not asked
    texts = []
    for k in range(15):
        texts.append(meter.look(state(1.0 + 1e-5 * k, 100 + k, 1e-5, limit=limit)).text)
        clock.now += 0.1
    assert "short steps" not in texts[8]
    assert texts[-1].endswith("short steps: the error of PART/2")
    assert meter.look(state(1.1, 120, 0.01, limit=limit)).limit == ""


def test_steps_that_were_always_short_are_explained() -> None:
    """Already at the first look: a hundred thousand steps for each that HMAX allows."""
    clock = Clock()
    meter = Meter(clock)
    limits = []
    for k in range(15):
        limits.append(meter.look(state(1e-3 * k, 1000 * k, 5e-7, limit=lambda: "events")).limit)
        clock.now += 0.1
    assert limits[:9] == [""] * 9 and limits[-3:] == ["events"] * 3


def test_a_second_analysis_begins_anew() -> None:
    clock = Clock()
    meter = Meter(clock)
    for k in range(20):
        meter.look(state(0.1 * k, 100 * k))
        clock.now += 1.0
    look = meter.look(state(2.0, 0, start=2.0, end=4.0))
    assert (look.state.share, look.speed, look.left) == (0.0, 0.0, None)


def test_a_terminal_line_is_drawn_over(plain: None) -> None:
    clock, stream = Clock(), Stream(True)
    progress = TalkingProgress(stream, clock)
    progress.watch(state(0.5, 50))
    clock.now += 0.05
    progress.watch(state(0.51, 51))  # too soon to be drawn
    progress.say("compiling once")
    progress.close()
    line = " 25 %  t = 0.5 of 2  h = 1.0e-02  order 3"
    assert stream.text == f"\r{line}\r{' ' * len(line)}\rcompiling once\n"


def test_a_line_is_no_wider_than_the_terminal(plain: None, monkeypatch: Any) -> None:
    monkeypatch.setenv("COLUMNS", "20")
    stream = Stream(True)
    TalkingProgress(stream, Clock()).watch(state(0.5, 50))
    assert stream.text == "\r 25 %  t = 0.5 of 2"


def test_a_file_gets_a_line_for_each_tenth_of_a_long_run() -> None:
    """100 s for 2 s of motion: tenths from the first after 5 s on, nothing in between."""
    clock, stream = Clock(), Stream(False)
    progress = TalkingProgress(stream, clock)
    for k in range(1001):
        progress.watch(state(0.002 * k, k))
        clock.now += 0.1
    progress.close()
    lines = stream.text.splitlines()
    tenths = [line for line in lines if line.split(" %")[0] in {f"{n}" for n in range(10, 101, 10)}]
    assert len(tenths) == 10
    assert len(lines) <= 16
    assert "\r" not in stream.text and "\x1b" not in stream.text
    assert lines[-1].startswith("100 %  t = 2 of 2  h = 1.0e-02  order 3  10 steps/s")


def test_a_file_gets_no_line_of_a_short_run() -> None:
    clock, stream = Clock(), Stream(False)
    progress = TalkingProgress(stream, clock)
    for k in range(101):
        progress.watch(state(0.02 * k, k))
        clock.now += 0.04
    assert stream.text == ""


def test_a_file_hears_of_a_run_that_hardly_advances() -> None:
    """An hour at 3 per cent: a line whenever the time has doubled, ten or so."""
    clock, stream = Clock(), Stream(False)
    progress = TalkingProgress(stream, clock)
    for k in range(36_000):
        progress.watch(state(0.06 + 1e-9 * k, 100 + k, 1e-9, limit=lambda: "the error of PART/2"))
        clock.now += 0.1
    lines = stream.text.splitlines()
    assert 5 <= len(lines) <= 12
    assert all(line.startswith("3 %") and "the error of PART/2" in line for line in lines)


def test_several_processes_report_sentences_only(capsys: Any) -> None:
    """`verify` solves decks side by side."""
    progress = SentenceProgress()
    progress.watch(state(0.5, 50))
    progress.say("compiling once")
    assert capsys.readouterr().err == "compiling once\n"


def test_rich_draws_a_bar(monkeypatch: Any) -> None:
    monkeypatch.setenv("COLUMNS", "120")
    monkeypatch.setenv("TERM", "xterm")
    monkeypatch.delenv("NO_COLOR", raising=False)
    for colours in (True, False):
        if not colours:
            monkeypatch.setenv("NO_COLOR", "1")
        clock, stream = Clock(), Stream(True)
        progress = TalkingProgress(stream, clock)
        progress.watch(state(0.5, 50))
        progress.close()
        assert "t = 0.5 of 2" in stream.text and "━" in stream.text
        assert bool(re.search(r"\x1b\[(3|9)\d", stream.text)) is colours


def test_quiet_and_scripts_show_nothing(tmp_path: Any, capfd: Any) -> None:
    deck = tmp_path / "mass.adm"
    deck.write_text(MASS + "SIMULATE/DYNAMIC, END=1, STEPS=2\nEND\n")
    assert main(["solve", str(deck), "-o", str(tmp_path / "out.csv"), "--quiet"]) == 0
    al.simulate(deck)
    assert capfd.readouterr() == ("", "")


def test_python_chooses() -> None:
    own = Progress()
    assert type(progress_of(None)) is type(progress_of(False)) is Progress
    assert type(progress_of(True)) is TalkingProgress
    assert progress_of(own) is own
    with pytest.raises(UsageError, match="progress='yes': it is True, False or a function"):
        progress_of("yes")  # type: ignore[arg-type]
    told: list[tuple[float, float]] = []
    progress_of(lambda time, end: told.append((time, end))).watch(state(0.5))
    assert told == [(0.5, 2.0)]


class Shell(SimpleNamespace):
    """The shell of a notebook, as IPython has it."""


@pytest.fixture
def shown(monkeypatch: Any) -> list[str]:
    """In a notebook: the texts that its display gets."""
    ipython = pytest.importorskip("IPython")
    display = pytest.importorskip("IPython.display")
    texts: list[str] = []

    def show(content: dict[str, str], **options: Any) -> Any:
        texts.append(content["text/plain"])
        return SimpleNamespace(update=show)

    monkeypatch.setattr(ipython, "get_ipython", lambda: Shell(kernel=object()))
    monkeypatch.setattr(display, "display", show)
    return texts


def test_a_notebook_shows_progress_by_itself(shown: list[str]) -> None:
    from adamslite.progress.notebook import NotebookProgress

    assert type(progress_of(None)) is type(progress_of(True)) is NotebookProgress
    assert type(progress_of(False)) is Progress
    clock = Clock()
    progress = NotebookProgress(clock)
    progress.watch(state(0.1, 10))  # too soon: a short run shows nothing
    assert shown == []
    clock.now += 1.0
    progress.watch(state(0.5, 50))
    progress.close()
    assert shown == [
        " 25 %  t = 0.5 of 2  h = 1.0e-02  order 3  40 steps/s  0:04 left",
        "",
    ]


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


def test_the_display_is_not_imported_before_it_is_needed() -> None:
    """Neither rich nor the machinery of notebooks."""
    from subprocess import run

    program = (
        "import sys, adamslite.cli.main, adamslite.progress\n"
        "print([m for m in ('rich', 'IPython', 'shutil', 'adamslite.progress.bar',"
        " 'adamslite.progress.notebook') if m in sys.modules])"
    )
    found = run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    assert found.stdout.strip() == "[]"
