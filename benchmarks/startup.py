"""How long a user waits: whole commands in fresh processes, with a cache of our own.

``ADAMSLITE_CACHE`` names the folder in which adamslite keeps what it compiled; here a temporary
one, so that "the very first" is that, and the user's own cache is left alone.
"""

from __future__ import annotations

import csv
import os
import resource
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from statistics import median

from benchmarks.decks import chain_deck, deck
from benchmarks.scenes import cable

DECKS = Path(__file__).parent.parent / "decks"
PAPER = DECKS / "cable-level3-n10" / "cable-level3-n10.adm"
SHORT = DECKS / "swinging-cable-n10" / "swinging-cable-n10.adm"

PREPARE = """
import sys
from adamslite import assemble, compile_model, read
compile_model(assemble(read(sys.argv[1])))
"""


@dataclass(frozen=True)
class Figure:
    """One line: CPU and wall [s], and what they should stay below."""

    what: str
    bound: float
    cpu: float
    wall: float
    ok: bool


def command(arguments: list[str], cache: Path) -> tuple[float, float, bool]:
    """Run Python with arguments; return CPU [s], wall [s] and whether it succeeded."""
    environment = {**os.environ, "ADAMSLITE_CACHE": str(cache)}
    before, start = resource.getrusage(resource.RUSAGE_CHILDREN), time.perf_counter()
    done = subprocess.run([sys.executable, *arguments], env=environment, capture_output=True)
    after, end = resource.getrusage(resource.RUSAGE_CHILDREN), time.perf_counter()
    cpu = after.ru_utime - before.ru_utime + after.ru_stime - before.ru_stime
    return cpu, end - start, done.returncode == 0


def figure(what: str, bound: float, run: Callable[[], tuple[float, float, bool]], repeats: int):
    """Run some times and take the medians."""
    runs = [run() for _ in range(repeats)]
    cpu, wall = median(r[0] for r in runs), median(r[1] for r in runs)
    return Figure(what, bound, cpu, wall, all(r[2] for r in runs))


def new_shape(folder: Path) -> Path:
    """A deck whose force law no other deck has."""
    text = chain_deck(cable("S1", 10)).replace("-2*VR(", "-2*TANH(TIME+DM(1,2)**3)*VR(")
    path = folder / "new-shape.adm"
    path.write_text(text)
    return path


def figures(folder: Path, repeats: int) -> list[Figure]:
    """Everything a user waits for, in an order that fills the cache as a user does."""
    cache, ours = folder / "cache", ["-m", "adamslite"]
    large = folder / "large.adm"
    large.write_text(deck("S1", 1000))
    solve = [*ours, "solve", str(PAPER), "-o", str(folder / "out.csv"), "--quiet"]
    new = [*ours, "solve", str(new_shape(folder)), "-o", str(folder / "out.csv"), "--quiet"]
    prepare = ["-c", PREPARE, str(large)]

    def run(arguments: list[str]) -> Callable[[], tuple[float, float, bool]]:
        return lambda: command(arguments, cache)

    return [
        figure("--help", 0.15, run([*ours, "--help"]), repeats),
        figure("check a 50-line deck", 0.4, run([*ours, "check", str(SHORT)]), repeats),
        figure("the very first solve, paper deck", 20.0, run(solve), 1),
        figure("solve of the paper deck, second run", 1.0, run(solve), repeats),
        figure("first solve of a new deck", 3.0, run(new), 1),
        figure("1000-mass deck, read to compiled, first run", 2.5, run(prepare), 1),
        figure("1000-mass deck, second run", 1.0, run(prepare), repeats),
    ]


def startup(repeats: int, path: Path) -> str:
    """Measure, write a CSV, and return the table."""
    with tempfile.TemporaryDirectory() as folder:
        found = figures(Path(folder), repeats)
    with path.open("w", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(("what", "bound_s", "cpu_s", "wall_s", "ok"))
        writer.writerows((f.what, f.bound, f.cpu, f.wall, f.ok) for f in found)
    lines = ["Start-up [s]", "", "| what | CPU | wall | bound |", "|---|---|---|---|"]
    for f in found:
        failed = "" if f.ok else " (failed)"
        lines.append(f"| {f.what}{failed} | {f.cpu:.2f} | {f.wall:.2f} | {f.bound:g} |")
    return "\n".join(lines) + "\n"
