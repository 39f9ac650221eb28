"""What a user waits for and what it takes: whole commands in fresh processes, memory, set-up.

``ADAMSLITE_CACHE`` names the folder in which adamslite keeps what it compiled; here a temporary
one, so that "the very first" is that, and the user's own cache is left alone.
"""

from __future__ import annotations

import json
import os
import resource
import subprocess
import sys
import tempfile
from collections.abc import Callable
from pathlib import Path
from statistics import median

from benchmarks.decks import chain_deck, deck
from benchmarks.figures import Figure
from benchmarks.scenes import cable

DECKS = Path(__file__).parent.parent / "decks"
PAPER = DECKS / "cable-level3-n10" / "cable-level3-n10.adm"
SHORT = DECKS / "swinging-cable-n10" / "swinging-cable-n10.adm"

# Prints CPU of the set-up, and the peak of memory [MB] above that of the bare import and above that
# after something small has run, which goes first so that set-up includes no import.
INSIDE = """
import json, sys, time
from benchmarks.memory import forget_peak, peak
from adamslite import assemble, compile_model, read, simulate
bare = peak()
simulate(read(sys.argv[2]), end=1e-3, steps=1)
forget_peak()
small, before = peak(), time.process_time()
model = compile_model(assemble(read(sys.argv[1])))
setup = time.process_time() - before
results = simulate(model, end=0.01, steps=10, integrator=sys.argv[3], error=1e-4)
setup += results.summary["setup_cpu_s"]
print(json.dumps([setup, peak() - bare, peak() - small]))
"""


def command(arguments: list[str], cache: Path) -> tuple[float, str]:
    """Run Python with arguments; return CPU [s] and what it printed."""
    root = str(Path(__file__).parent.parent)
    path = os.pathsep.join(filter(None, (root, os.environ.get("PYTHONPATH"))))
    environment = {**os.environ, "ADAMSLITE_CACHE": str(cache), "PYTHONPATH": path}
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run(
        [sys.executable, *arguments], env=environment, capture_output=True, text=True, check=True
    )
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    cpu = after.ru_utime - before.ru_utime + after.ru_stime - before.ru_stime
    return cpu, done.stdout


def new_shape(folder: Path) -> Path:
    """A deck whose force law no other deck has."""
    text = chain_deck(cable("S1", 10)).replace("-2*VR(", "-2*TANH(TIME+DM(1,2)**3)*VR(")
    path = folder / "new-shape.adm"
    path.write_text(text)
    return path


def startup(repeats: int) -> list[Figure]:
    """Everything a user waits for, in an order that fills the cache as a user does."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        return [*_commands(folder, repeats), *_large(folder, repeats)]


def _commands(folder: Path, repeats: int) -> list[Figure]:
    ours, out = ["-m", "adamslite"], ["-o", str(folder / "out.csv"), "--quiet"]
    solve, new = [*ours, "solve", str(PAPER), *out], [*ours, "solve", str(new_shape(folder)), *out]

    def cpu(arguments: list[str]) -> Callable[[], float]:
        return lambda: command(arguments, folder / "cache")[0]

    tried = (
        ("--help", 0.15, cpu([*ours, "--help"]), repeats),
        ("check a 50-line deck", 0.4, cpu([*ours, "check", str(SHORT)]), repeats),
        ("the very first solve, a paper's deck", 20.0, cpu(solve), 1),
        ("the same again", 1.0, cpu(solve), repeats),
        ("first solve of a deck with a new force law", 3.0, cpu(new), 1),
    )
    return [
        Figure("whole commands, CPU", what, median(run() for _ in range(times)), "s", bound)
        for what, bound, run, times in tried
    ]


def _large(folder: Path, repeats: int) -> list[Figure]:
    """Set-up and memory of a deck with 1000 masses, in processes that have run something small."""
    large, group = folder / "large.adm", "1000 masses, second run of the deck"
    large.write_text(deck("S1", 1000))
    found = []
    for integrator in ("GSTIFF", "ABAM"):
        words = ["-c", INSIDE, str(large), str(SHORT), integrator]
        told = [json.loads(command(words, folder / "cache")[1]) for _ in range(repeats + 1)]
        setup, bare, small = (median(column) for column in zip(*told[1:], strict=True))
        found += [
            Figure(group, f"set-up, {integrator}", setup, "s", 0.5),
            Figure(group, f"memory above the bare import, {integrator}", bare, "MB", 60.0),
            Figure(group, f"memory above a deck of ten masses, {integrator}", small, "MB"),
        ]
    return found
