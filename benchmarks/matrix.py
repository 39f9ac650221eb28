"""Every hard case with every integrator: inside the band, rejected, or outside of it.

    python -m benchmarks.matrix                            every case, some minutes
    python -m benchmarks.matrix --case pulse --only HHT    parts of it; the other cells stay

A case is a deck with a reference and a band (decks/README.md).  ERROR limits what one step adds,
not what a run adds up to, and how that grows is a property of the scene and the order of the
method.  So each integrator starts at the ERROR of the deck and gets a tenth of it, and a tenth of
that, until the run is inside of the band; the page shows the ERROR that it took.  CONSTANT_BDF has
no error test; it starts at a twentieth of the output step and gets a quarter of it.
"""

from __future__ import annotations

import argparse
import sys
import time
from collections.abc import Iterator, Sequence
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

import adamslite
from adamslite.analyses.setup.output_times import output_times
from adamslite.errors import UsageError
from adamslite.results.outcomes import Outcome
from adamslite.results.results import Results
from adamslite.scene import load_scene
from adamslite.verification.reference_file import Reference, read_reference
from adamslite.verification.variants import Variant, patient
from benchmarks import report
from benchmarks.hard_cases import (
    CONSTANT,
    PASSED,
    REPORTED,
    SILENT,
    SLOW,
    STOPPED,
    Cell,
    columns,
    read,
    write,
)
from benchmarks.torture import CASES, Case

#: CPU [s] that an integrator may use for a case, and the least ERROR asked for.
SECONDS, LEAST = 20.0, 1e-12
#: From one rung to the next: ERROR, and the step of CONSTANT_BDF.
TIGHTER, SHORTER = 0.1, 0.25


def share_of(reference: Reference, results: Results) -> float:
    """Part of the band that a run used; above 1 is outside."""
    worst = reference.judge(results).worst
    share = worst.severity if worst else 0.0
    if reference.stop:
        at, slack = reference.stop
        share = max(share, abs(float(results.summary["t_end"]) - at) / slack)
    return share


class Scene:
    """A case ready to run."""

    def __init__(self, case: Case) -> None:
        self.case = case
        self.reference = read_reference(case.told.reference)
        scene = load_scene(case.told.deck)
        self.kernels = adamslite.compile_model(adamslite.assemble(scene.deck))
        self.run = partial(adamslite.simulate, self.kernels, commands=scene.commands)
        stated = [s for s in (*scene.deck.of("INTEGRATOR"), *scene.commands)
                  if s.keyword == "INTEGRATOR" and s.error]  # fmt: skip
        own = stated[-1].error if stated else 1e-3
        self.error = self.reference.options.get("error", own)

    def ladder(self, variant: Variant) -> Iterator[tuple[str, dict[str, Any]]]:
        """Settings from that of the deck on, each in words and as options."""
        options = {**self.reference.options, **variant.options}
        if variant.integrator == CONSTANT:
            step = self.output_step / 20.0
            while True:
                yield f"h={step:.2g}", {**options, "hmax": step}
                step *= SHORTER
        error = self.error
        while error >= LEAST * 0.999:
            yield f"{error:.0e}", {**options, "error": error}
            error *= TIGHTER

    @property
    def output_step(self) -> float:
        """Longest time between two records [time]."""
        options, times = self.reference.options, self.reference.table.time
        if "end" in options:
            return options["end"] / options["steps"]
        runs = [s for s in (*self.kernels.model.deck.of("SIMULATE"), *self.run.keywords["commands"])
                if s.keyword == "SIMULATE" and s.kind in ("DYNAMICS", "TRANSIENT")]  # fmt: skip
        if runs:
            times = output_times(runs[-1], 0.0)
        return float(np.diff(times).max())


def attempt(scene: Scene, variant: Variant, seconds: float) -> Cell:
    """Climb until a run is inside of the band, stops by itself, or the time is up."""
    best, first, left = Cell(scene.case.name, variant.label, SILENT), None, seconds
    for setting, options in scene.ladder(variant):
        try:
            results = patient(scene.run, left)(**options)
        except UsageError as rejection:
            return replace(best, verdict=STOPPED, outcome="UsageError", report=str(rejection))
        left -= results.summary["solve_cpu_s"]
        share, verdict = judged(scene.reference, results)
        first = share if first is None else first
        if share < best.share:
            report = results.meta.get("accuracy", "")
            best = replace(
                best, setting=setting, share=share, steps=results.summary["steps"],
                cpu=results.summary["solve_cpu_s"], report=report,
            )  # fmt: skip
        best = replace(best, verdict=verdict, first=first, outcome=results.outcome.name)
        if verdict != SILENT or left <= 0.0:
            break
    if best.verdict == SILENT and (best.report or left <= 0.0):
        return replace(best, verdict=REPORTED if best.report else SLOW)
    return best


def judged(reference: Reference, results: Results) -> tuple[float, str]:
    """The share of the band that a run used, and the verdict on it alone."""
    if results.outcome is Outcome.INTERRUPTED:
        return np.inf, SLOW
    if results.outcome is not reference.outcome:
        return np.inf, STOPPED if results.outcome is not Outcome.DONE else SILENT
    share = share_of(reference, results)
    return share, PASSED if share <= 1.0 else SILENT


def measure(cases: Sequence[Case], tried: Sequence[Variant], folder: Path, seconds: float) -> None:
    """Fill the cells of some cases and integrators, case by case."""
    for case in cases:
        began = time.monotonic()
        scene = Scene(case)
        new = [attempt(scene, variant, seconds) for variant in tried]
        done = {(cell.case, cell.integrator) for cell in new}
        write([*(c for c in read(folder) if (c.case, c.integrator) not in done), *new], folder)
        silent = ", ".join(cell.integrator for cell in new if cell.verdict == SILENT)
        took = time.monotonic() - began
        print(f"{case.name}: {took:.0f} s{'; silent: ' + silent if silent else ''}", flush=True)


def main() -> int:
    """Measure what the command line requests."""
    parser = argparse.ArgumentParser(
        prog="python -m benchmarks.matrix", description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )  # fmt: skip
    parser.add_argument(
        "--case", nargs="+", default=[""], metavar="PART", help="cases with this in their name"
    )
    parser.add_argument(
        "--only", nargs="+", default=[""], metavar="PART",
        help="integrators with this in their name",
    )  # fmt: skip
    parser.add_argument(
        "--seconds", type=float, default=SECONDS, help=f"CPU of a cell ({SECONDS:g})"
    )
    parser.add_argument(
        "--out", type=Path, default=report.FOLDER,
        help="folder of the table; the page is written unless it is another one",
    )  # fmt: skip
    args = parser.parse_args()
    args.out.mkdir(parents=True, exist_ok=True)
    cases = [case for case in CASES if any(part in case.name for part in args.case)]
    tried = [variant for variant in columns() if any(p in variant.label for p in args.only)]
    measure(cases, tried, args.out, args.seconds)
    if args.out == report.FOLDER:
        report.write(report.FOLDER, report.PAGE, [".svg"], few=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
