"""Scenes that no other program was given: contacts, belts, nets, chains of bodies.

Reference decks are solved by whole commands, the first with the engine in the cache and the second
with everything; structures in a process that has run something small, so that imports and the
compilation of methods are left out.
"""

from __future__ import annotations

import json
import tempfile
from collections.abc import Iterator
from pathlib import Path
from statistics import median

from benchmarks.figures import Figure
from benchmarks.startup import DECKS, SHORT, command
from benchmarks.structures import SIZES, structure

#: Reference decks, and what a second run should stay below [s].
WHOLE = {
    "paper-sforce/paper-sforce": 0.25,
    "contact/bouncing-ball/bouncing-ball": None,
    "contact/incline/incline": None,
    "cables/belt-drive/sliding": 1.5,
    "cables/chain-drive/coarse": 1.0,
}
#: One of the names of each method that is compiled by itself.
METHODS = ("GSTIFF", "HHT", "RADAU", "ABAM", "VERLET")
ENGINE_BOUND = 3.0
#: HHT, fifty steps: prints CPU of set-up and solution [s] and the peak of memory [MB].
INSIDE = """
import json, sys, time
from benchmarks.memory import peak
from adamslite import assemble, compile_model, read, simulate
simulate(read(sys.argv[2]), end=1e-3, steps=1, integrator="HHT")
before = time.process_time()
model = compile_model(assemble(read(sys.argv[1])))
setup = time.process_time() - before
results = simulate(model, end=0.1, steps=50, integrator="HHT", error=1e-4)
setup += results.summary["setup_cpu_s"]
print(json.dumps([setup, results.summary["solve_cpu_s"], peak()]))
"""


def scenes(repeats: int) -> list[Figure]:
    """Everything of this module."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        return [*cold_start(folder), *whole_scenes(folder, repeats)]


def cold_start(folder: Path) -> Iterator[Figure]:
    """What each method takes when it is compiled first; kernels are in the cache."""
    out = ["-o", str(folder / "out.csv"), "--quiet"]
    for method in METHODS:
        words = ["-m", "adamslite", "solve", str(SHORT), *out, "--integrator", method]
        cache = folder / f"cold-{method}"
        command(words, cache)
        for code in cache.glob("*.o"):
            if not code.name.startswith("k"):
                code.unlink()
        cold, warm = command(words, cache)[0], command(words, cache)[0]
        yield Figure("engine, first compilation", method, cold - warm, "s", ENGINE_BOUND)


def whole_scenes(folder: Path, repeats: int) -> Iterator[Figure]:
    """Reference decks as whole commands, and structures."""
    for name, bound in WHOLE.items():
        deck = (DECKS / name).with_suffix(".adm")
        commands = [str(each) for each in [deck.with_suffix(".acf")] if each.exists()]
        out = ["-o", str(folder / "out.csv"), "--quiet"]
        words = ["-m", "adamslite", "solve", str(deck), *commands, *out]
        yield Figure("reference decks, first solve", name, command(words, folder / "cache")[0], "s")
        again = median(command(words, folder / "cache")[0] for _ in range(repeats))
        yield Figure("reference decks, second solve", name, again, "s", bound)
    for kind, sizes in SIZES.items():
        for size in sizes:
            path = folder / "structure.adm"
            path.write_text(structure(kind, size))
            words = ["-c", INSIDE, str(path), str(SHORT)]
            found = [json.loads(command(words, folder / "cache")[1]) for _ in range(2)][-1]
            for what, unit, value in zip(
                ("set-up", "solution", "memory"), ("s", "s", "MB"), found, strict=True
            ):
                yield Figure(f"{kind}, HHT, 0.1 s", f"{size}: {what}", value, unit)
