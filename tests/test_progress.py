"""Progress: what is shown of a run, and where."""

from __future__ import annotations

import re
import sys
from types import SimpleNamespace
from typing import Any

import pytest
from progress_scenes import Clock, Stream, state
from unfinished_scenes import cranked, lowered

from adamslite import simulate
from adamslite.errors import UsageError
from adamslite.progress import Progress, SentenceProgress, TalkingProgress, progress_of
from adamslite.progress.meter import Meter


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


@pytest.mark.parametrize("text", [lowered(10), cranked(60, 10)], ids=["equilibria", "postures"])
def test_output_times_that_are_solved_in_turn_are_shown(
    text: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """All but the last, which the end of the run reports."""
    monkeypatch.setattr("adamslite.progress.analysis.INTERVAL", 0.0)
    told: list[tuple[float, float]] = []
    times = simulate(text, progress=lambda time, end: told.append((time, end))).time
    assert {(time, 60.0) for time in times[times > 1.0][:-1]} <= set(told)


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
