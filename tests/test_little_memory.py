"""Memory that runs out while code is compiled: a sentence, exit code 4, nothing left behind.

LLVM ends its process by ``abort`` there, and no exception of Python can leave its frames.
"""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest
from falling_mass import FALL
from writing_commands import adamslite, contents, environment

from adamslite.cli.commands.codes import STOPPED_EARLY
from adamslite.native import fatal

LINUX = pytest.mark.skipif(sys.platform != "linux", reason="limits and figures of Linux")
UNIX = pytest.mark.skipif(os.name != "posix", reason="signals of POSIX")


def test_the_exit_code_is_that_of_the_command_line() -> None:
    assert fatal.STOPPED_EARLY == STOPPED_EARLY


ABORTS = """\
import ctypes, sys
from adamslite import notation
from adamslite.caching.alone import alone
from adamslite.native.fatal import explained
notation.use(sys.argv[1])
with alone("k" + 32 * "0" + ".o"), explained():
    ctypes.CDLL(None).abort()
"""


@UNIX
@pytest.mark.parametrize(
    ("whose", "code"), [("command line", STOPPED_EARLY), ("Python", -signal.SIGABRT)]
)
def test_an_abort_of_the_compiler_is_explained(whose: str, code: int, cache: Path) -> None:
    """A command has an exit code; a program of the user's own ends as it would."""
    done = subprocess.run(
        [sys.executable, "-c", ABORTS, whose], env=environment(), capture_output=True
    )
    assert (done.returncode, done.stderr) == (code, fatal.SENTENCE)
    assert os.listdir(cache) == []


@UNIX
def test_the_handler_of_a_program_is_put_back() -> None:
    """Compiling takes the signal and gives it back, however many compile at once."""
    program = (
        "import ctypes, signal, sys\n"
        "from adamslite.native.fatal import explained\n"
        "signal.signal(signal.SIGABRT, lambda *_: sys.exit(7))\n"
        "with explained():\n"
        "    with explained():\n"
        "        pass\n"
        "signal.raise_signal(signal.SIGABRT)\n"
    )
    done = subprocess.run([sys.executable, "-c", program], env=environment(), capture_output=True)
    assert (done.returncode, done.stderr) == (7, b"")


#: What compiles gets so much more memory than the process has [MB], from its n-th time.
SHORT = """\
import resource
from adamslite.native import compiler
emitted, times = compiler._emitted, []
def short(text, *rest):
    times.append(1)
    if len(times) == {turn}:
        with open("/proc/self/statm") as file:
            pages = int(file.read().split()[0])
        most = pages * resource.getpagesize() + {more} * 1000000
        resource.setrlimit(resource.RLIMIT_AS, (most, resource.RLIM_INFINITY))
    return emitted(text, *rest)
compiler._emitted = short
"""


@LINUX
@pytest.mark.slow
@pytest.mark.parametrize("turn", (1, 2))
@pytest.mark.parametrize("more", (0, 1, 3, 10))
def test_memory_that_ends_while_code_is_compiled(
    turn: int, more: int, cache: Path, tmp_path: Path
) -> None:
    """Libraries cannot be loaded, LLVM finds no memory, or Python or the system finds none."""
    (tmp_path / "fall.adm").write_text(FALL.format(now=more))
    (tmp_path / "fall.csv").write_text("# adamslite, old\n")
    before = contents(tmp_path)
    done = adamslite(tmp_path, ["solve", "fall.adm", "--quiet"], SHORT.format(turn=turn, more=more))
    said = done.stderr
    assert done.returncode == STOPPED_EARLY, said
    last = said.splitlines()[-1]
    assert last.startswith("adamslite: ") and ("memory" in last or "LLVM cannot be loaded" in last)
    assert "Traceback" not in said
    left = contents(tmp_path)
    assert left["fall.csv"] == before["fall.csv"]
    assert not [name for name in left if name.endswith((".lock", ".part"))]
