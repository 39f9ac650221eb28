"""Counts of runs against those kept in counts.csv: a gate for speed that reads no clock.

    python -m benchmarks.counts            # compare; exit code 1 where something differs
    python -m benchmarks.counts --renew    # write what is so now

Each scene is run by one method, compiled for x86-64-v2 whatever the processor.  ``entries``
(numbers in the factor of a Newton matrix) and ``instructions`` (of the kernels, or of a method, as
they are given to LLVM) are the same everywhere.  Counts of a run follow its rounding, which the
functions of the C library and numpy's sums may alter from one processor to another: ``band`` is how
far they may be off, twice the share of the count (of the steps, where they are more) by which they
differ between the levels of x86-64 that the processor which renewed them has.  Where that is zero,
rounding has no say, and they must be equal.
"""

from __future__ import annotations

import argparse
import csv
import json
import os
import subprocess
import sys
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Any

from benchmarks.mechanisms import text as scene_text
from benchmarks.scenes import CHAINS, SCALING, chain
from benchmarks.structures import NET, REVOLUTES, structure

ROOT = Path(__file__).parent.parent
KEPT = Path(__file__).parent / "counts.csv"
LEVEL, MORE_LEVELS = "x86-64-v2", ("x86-64-v3", "x86-64-v4")
#: What rounding may alter, and what it may not.
RUN = ("steps", "rejected", "newton", "factorizations", "restarts")
FIXED = ("entries", "instructions")
Counts = dict[str, int]

METHODS = ("GSTIFF", "HHT", "RADAU", "ABAM")
#: A scene of the benchmarks with its size, or a reference deck; the methods; and ERROR.
SCENES: tuple[tuple[str, int, tuple[str, ...], float], ...] = (
    ("S1", 10, (*METHODS, "VERLET"), 1e-5),
    ("S1", 50, (*METHODS, "VERLET"), 1e-5),
    ("S2", 100, (*METHODS, "VERLET"), 1e-5),
    ("S3", 1, METHODS, 1e-6),
    ("S5", 10, METHODS, 1e-5),
    (NET, 10, ("GSTIFF", "HHT"), 1e-5),
    (NET, 30, ("HHT",), 1e-4),
    (REVOLUTES, 10, ("GSTIFF", "RADAU"), 1e-4),
    (REVOLUTES, 50, ("HHT",), 1e-3),
    ("decks/paper-sforce/paper-sforce", 0, ("",), 0.0),
    ("decks/contact/bouncing-ball/bouncing-ball", 0, ("",), 0.0),
    ("decks/contact/incline/incline", 0, ("",), 0.0),
    ("decks/cables/belt-drive/sliding", 0, ("",), 0.0),
    ("decks/cables/chain-drive/coarse", 0, ("",), 0.0),
    ("decks/friction-stiction/friction-stiction", 0, ("",), 0.0),
)


def name_of(scene: str, size: int, method: str) -> str:
    """How a row is called."""
    return " ".join(filter(None, (scene.removeprefix("decks/"), str(size or ""), method)))


def counted() -> Iterator[tuple[str, Counts]]:
    """Run everything in this process, for the processor that ``ADAMSLITE_CPU`` names."""
    for scene, size, methods, error in SCENES:
        kernels, commands, end = prepared(scene, size)
        static = {"entries": factor_entries(kernels), "instructions": instructions(kernels)}
        for method in methods:
            yield (
                name_of(scene, size, method),
                {**run(kernels, commands, end, method, error), **static},
            )
    yield from engines()


def prepared(scene: str, size: int) -> tuple[Any, str | None, float | None]:
    """The kernels of a scene, the path of its command file, and the end of its run."""
    from adamslite import assemble, compile_model, read

    if scene.startswith("decks/"):
        path = (ROOT / scene).with_suffix(".adm")
        commands = path.with_suffix(".acf")
        return (
            compile_model(assemble(read(path))), str(commands) if commands.exists() else None, None
        )  # fmt: skip
    if scene in (NET, REVOLUTES):
        return compile_model(assemble(read(structure(scene, size)))), None, 0.1
    end = chain(scene, size).end if scene in (*CHAINS, *SCALING) else 2.0
    return compile_model(assemble(read(scene_text(scene, size)))), None, end


def run(kernels: Any, commands: str | None, end: float | None, method: str, error: float) -> Counts:
    """The counts of one run; a deck of its own keeps its method and its commands."""
    from adamslite import simulate

    flags: dict[str, Any] = {"integrator": method, "error": error} if method else {}
    if end is not None:
        flags.update(end=end, steps=10)
    results = (
        simulate(kernels, commands=commands, **flags) if commands else simulate(kernels, **flags)
    )
    return {key: int(results.summary[key]) for key in RUN}


def factor_entries(kernels: Any) -> int:
    """Numbers in the factor of the Newton matrix of a stabilised formulation."""
    from adamslite.equations.system import System

    return System(kernels, stabilised=True).elimination.LV.size - 1


def instructions(kernels: Any) -> int:
    """Of all kernels of a scene."""
    from adamslite.kernels.compile import writer_of

    return sum(
        lines_of(writer_of(kernels, group).kernels(group.name)[0]) for group in kernels.groups
    )


def engines() -> Iterator[tuple[str, Counts]]:
    """Instructions of the shared part of the engine and of each method."""
    from adamslite.equations.engine import OPERATIONS, engine_parts
    from adamslite.language.method import declared

    for entry in (OPERATIONS, *sorted({method.entry for method in declared()})):
        written = sum(map(lines_of, engine_parts(entry)))
        yield f"engine {entry.rpartition('.')[2]}", {"instructions": written}


def lines_of(text: str) -> int:
    """Instructions in LLVM assembly: each takes a line that is indented."""
    return sum(line.startswith("  ") for line in text.splitlines())


# ---- what is kept -------------------------------------------------------------------------------


def measured(level: str) -> dict[str, Counts]:
    """The counts for a level of x86-64, from a process of its own; nothing without that level."""
    environment = {**os.environ, "ADAMSLITE_CPU": level}
    done = subprocess.run(
        [sys.executable, "-m", "benchmarks.counts", "--print"],
        capture_output=True, text=True, env=environment, cwd=ROOT,
    )  # fmt: skip
    if done.returncode and level != LEVEL:
        return {}
    if done.returncode:
        sys.exit(done.stderr)
    return json.loads(done.stdout)


def band(found: Counts, others: Iterable[Counts]) -> float:
    """Twice the largest share by which counts of a run differ from those of other processors."""
    shares = (
        abs(found[key] - other[key]) / scale(found, key)
        for other in others
        for key in RUN
        if key in found
    )
    return 2.0 * max(shares, default=0.0)


def scale(counts: Counts, key: str) -> int:
    """What the band of a count is a share of: the count, or the steps where they are more."""
    return max(1, counts[key], counts["steps"])


def renew() -> None:
    """Write the counts of now, with the bands that follow from the levels of this processor."""
    found = measured(LEVEL)
    others = [counts for level in MORE_LEVELS if (counts := measured(level))]
    with KEPT.open("w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["scene", *RUN, "band", *FIXED])
        for name, counts in found.items():
            share = band(counts, (other[name] for other in others))
            run, fixed = ([counts.get(key, "") for key in keys] for keys in (RUN, FIXED))
            writer.writerow([name, *run, f"{share:.3g}", *fixed])
    print(f"{KEPT.name}: {len(found)} rows; bands from {1 + len(others)} levels of x86-64")


def kept() -> Iterator[tuple[str, Counts, float]]:
    """The rows of the file: scene, counts, band."""
    with KEPT.open(newline="") as file:
        for row in csv.DictReader(file):
            counts = {key: int(row[key]) for key in (*RUN, *FIXED) if row[key]}
            yield row["scene"], counts, float(row["band"])


def differences(rows: Iterable[tuple[str, Counts, float]], found: dict[str, Counts]) -> list[str]:
    """A sentence for each count that is not what was kept."""
    told, left = [], dict(found)
    for name, counts, share in rows:
        now = left.pop(name, None)
        if now is None:
            told.append(f"{name}: is kept, but no longer counted")
            continue
        for key, value in counts.items():
            most = share * scale(counts, key) if key in RUN else 0.0
            if abs(now[key] - value) > most:
                change = f"{100.0 * (now[key] - value) / max(1, value):+.1f} %"
                allowed = f", {most:.0f} allowed" if most else ""
                told.append(f"{name}: {key} {value} -> {now[key]} ({change}{allowed})")
    return told + [f"{name}: is counted, but not kept" for name in left]


def compare() -> int:
    """Print what has changed; the exit code."""
    rows = list(kept())
    told = differences(rows, measured(LEVEL))
    for sentence in told:
        print(sentence)
    if told:
        print(
            f"{len(told)} counts differ from benchmarks/{KEPT.name}. If that is meant, give the "
            "reason in docs/decisions and renew them: python -m benchmarks.counts --renew"
        )
        return 1
    print(f"counts of {len(rows)} scenes and methods are those of benchmarks/{KEPT.name}")
    return 0


def main() -> int:
    """Compare, renew, or print the counts of this process."""
    parser = argparse.ArgumentParser(
        prog="python -m benchmarks.counts", description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )  # fmt: skip
    parser.add_argument("--renew", action="store_true", help="write counts.csv again")
    parser.add_argument("--print", action="store_true", help=argparse.SUPPRESS)
    arguments = parser.parse_args()
    if arguments.print:
        print(json.dumps(dict(counted())))
        return 0
    if arguments.renew:
        renew()
        return 0
    return compare()


if __name__ == "__main__":
    sys.exit(main())
