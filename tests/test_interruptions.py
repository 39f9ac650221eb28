"""Signals that end a command: whenever they arrive, in a sentence."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

AT_SIGNALS = """
import os, signal, sys
signal.signal(signal.{name}, signal.{before})
import adamslite.__main__ as command
if {when!r} == "import":
    os.kill(os.getpid(), signal.{name})
from adamslite.cli import main as cli
def run():
    if {when!r} == "command":
        os.kill(os.getpid(), signal.{name})
        print("goes on", flush=True)
    if {when!r} == "module":
        try:
            import interrupting
        except BaseException as fault:
            print(type(fault), flush=True)
        import time
        time.sleep(60)
    if {when!r} == "finaliser":
        class Left:
            def __del__(self):
                os.kill(os.getpid(), signal.{name})
                sum(range(10))
        Left()
        import time
        time.sleep(60)
    return 0
cli.main = run
code = command.main()
if {when!r} == "end":
    os.kill(os.getpid(), signal.{name})
sys.exit(code)
"""
INTERRUPTED = (4, "", "adamslite: interrupted\n")
#: A module of C that is being imported takes an exception for another fault.
INTERRUPTING = """
import os, signal
try:
    os.kill(os.getpid(), signal.{name})
    sum(range(10))
except KeyboardInterrupt:
    raise ImportError
"""


@pytest.mark.skipif(sys.platform == "win32", reason="it has no such signals")
@pytest.mark.parametrize("name", ["SIGINT", "SIGTERM", "SIGHUP"])
@pytest.mark.parametrize(
    ("when", "ending"),
    [
        ("import", INTERRUPTED),
        ("command", INTERRUPTED),
        ("module", INTERRUPTED),
        ("finaliser", INTERRUPTED),
        ("end", (0, "", "")),
    ],
)
def test_a_signal_ends_a_command_in_a_sentence(tmp_path: Path, name, when, ending) -> None:
    """Whenever it arrives: also where nothing can be raised, and when all is over."""
    before = "default_int_handler" if name == "SIGINT" else "SIG_DFL"
    (tmp_path / "interrupting.py").write_text(INTERRUPTING.format(name=name))
    program = AT_SIGNALS.format(name=name, before=before, when=when)
    run = subprocess.run(
        [sys.executable, "-c", program], capture_output=True, text=True, timeout=50,
        env={**os.environ, "PYTHONPATH": os.pathsep.join([str(tmp_path), *sys.path])},
    )  # fmt: skip
    assert (run.returncode, run.stdout, run.stderr) == ending


@pytest.mark.parametrize("known", ["cause", "context"])
def test_an_interruption_that_comes_as_another_fault_is_one(
    known: str, monkeypatch: pytest.MonkeyPatch, capsys
) -> None:
    """Where it meets a class that is being made, or a module, they may report a fault of theirs."""
    from adamslite.cli import main as cli
    from adamslite.cli.commands import cache

    def run(_: object) -> int:
        try:
            raise KeyboardInterrupt
        except KeyboardInterrupt as fault:
            raise RuntimeError("Error calling __set_name__") from (
                fault if known == "cause" else None
            )

    monkeypatch.setattr(cache, "run", run)
    assert cli.main(["cache"]) == 4
    assert capsys.readouterr().err == "adamslite: interrupted\n"


LOADED_BY_HALF = """
import atexit, os, sys
import adamslite.__main__ as command
from adamslite.cli import main as cli
atexit.register(print, "taken away", flush=True)
class Library:
    def __del__(self, write=os.write):
        write(1, b"taken down")
sys.modules["library"] = Library()
def run(*_):
    raise KeyboardInterrupt
cli._with_commands = run
sys.exit(command.main())
"""


def test_what_was_being_loaded_is_not_taken_down() -> None:
    """Libraries whose loading was interrupted crash then; temporary folders go all the same."""
    run = subprocess.run([sys.executable, "-c", LOADED_BY_HALF], capture_output=True, text=True)
    assert (run.returncode, run.stdout, run.stderr) == (4, "taken away\n", INTERRUPTED[2])


IN_TEXT = """
import os, signal, sys, time
import adamslite.__main__ as command
from adamslite.cli import main as cli
SIGNAL = "import os, signal; os.kill(os.getpid(), signal.{name}); sum(range(10))"
def run():
    exec(SIGNAL)
    time.sleep(60)
cli.main = run
sys.exit(command.main())
"""


@pytest.mark.skipif(sys.platform == "win32", reason="it has no such signals")
@pytest.mark.parametrize("name", ["SIGINT", "SIGTERM", "SIGHUP"])
def test_a_signal_while_a_text_is_carried_out(tmp_path: Path, name) -> None:
    """Classes are made from such texts; Python ends by SIGINT at last where one was interrupted,
    unless the command leaves before.
    """
    (tmp_path / "command.py").write_text(IN_TEXT.format(name=name))
    run = subprocess.run(
        [sys.executable, "-m", "command"], capture_output=True, text=True, timeout=50,
        env={**os.environ, "PYTHONPATH": os.pathsep.join([str(tmp_path), *sys.path])},
    )  # fmt: skip
    assert (run.returncode, run.stdout, run.stderr) == INTERRUPTED


@pytest.mark.skipif(sys.platform == "win32", reason="it has no such signals")
@pytest.mark.parametrize("name", ["SIGINT", "SIGTERM", "SIGHUP"])
def test_a_signal_that_who_starts_a_command_ignores_stays_ignored(name) -> None:
    program = AT_SIGNALS.format(name=name, before="SIG_IGN", when="command")
    run = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True)
    assert (run.returncode, run.stdout, run.stderr) == (0, "goes on\n", "")


def test_an_interruption_at_the_end_of_a_run_is_not_lost(monkeypatch) -> None:
    """Native code has come to its end when the exception is raised: what follows it must not go on.

    A run that is not over soon is in a thread; who waits for that is interrupted last.
    """
    from scenes import SPRING

    import adamslite as al
    from adamslite.analyses.dynamics import dynamic
    from adamslite.native.worker import Worker

    monkeypatch.setattr(dynamic, "UNWATCHED", 1.0)
    usual, waits = Worker.wait, []

    def wait(self, timeout: float) -> None:
        while self.works:
            usual(self, 1.0)
        waits.append(timeout)
        raise KeyboardInterrupt

    deck = al.read(SPRING)
    al.simulate(deck, end=1.0, steps=5)  # nothing is compiled below
    monkeypatch.setattr(Worker, "wait", wait)
    results = al.simulate(deck, end=1.0, steps=5)
    assert waits and results.outcome is al.Outcome.INTERRUPTED and len(results.time) == 6
