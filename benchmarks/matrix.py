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
import csv
import sys
import time
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import asdict, dataclass, fields, replace
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

import adamslite
from adamslite.analyses.output_times import output_times
from adamslite.errors import UsageError
from adamslite.language.method import AUTO
from adamslite.outputs.whole_files import whole_file
from adamslite.results.outcomes import Outcome
from adamslite.results.results import Results
from adamslite.scene import load_scene
from adamslite.verification.reference_file import Reference, read_reference
from adamslite.verification.work_precision import Variant, patient, variants
from benchmarks.tables import table
from benchmarks.torture import CASES, Case

NAME = "matrix.csv"
#: CPU [s] that an integrator may use for a case, and the least ERROR asked for.
SECONDS, LEAST = 20.0, 1e-12
#: The method of fixed steps.
CONSTANT = "CONSTANT_BDF"
#: From one rung to the next: ERROR, and the step of CONSTANT_BDF.
TIGHTER, SHORTER = 0.1, 0.25

#: Inside the band; rejected or ended early; too slow; outside, and the summary reports it; outside,
#: and nothing reports it.
PASSED, STOPPED, SLOW = "passed", "stopped", "slow"
REPORTED, SILENT = "reported", "silent"
WORDS = {
    PASSED: "ended inside the band", STOPPED: "were rejected or ended early with a named outcome",
    SLOW: "were not inside after twenty seconds",
    REPORTED: "ended outside, and their summary says why", SILENT: "ended outside without a report",
}  # fmt: skip


@dataclass(frozen=True)
class Cell:
    """How an integrator did on a case.

    setting, share, steps, cpu : of the run that came closest, and the part of the band that it
        used; infinite when none reached the end
    first : the share at the ERROR of the deck;  outcome : how the last run ended
    report : the sentence of a rejection or of the summary
    """

    case: str
    integrator: str
    verdict: str
    setting: str = ""
    share: float = np.inf
    first: float = np.inf
    steps: int = 0
    cpu: float = 0.0
    outcome: str = ""
    report: str = ""

    @property
    def rejected_before(self) -> bool:
        """Whether the method does not take the deck."""
        return self.verdict == STOPPED and self.outcome == "UsageError"


def columns() -> list[Variant]:
    """Every integrator of the INTEGRATOR statement, those that do the same once."""
    return [*variants(), Variant(CONSTANT), Variant(AUTO)]


def heading(variant: Variant) -> str:
    """All names of a column."""
    return ", ".join((variant.label, *variant.also))


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


def write(cells: Iterable[Cell], folder: Path) -> None:
    """Write the table of a folder, cases and integrators in their order."""
    rows = [case.name for case in CASES]
    heads = [variant.label for variant in columns()]
    known = [cell for cell in cells if cell.case in rows and cell.integrator in heads]
    known.sort(key=lambda cell: (rows.index(cell.case), heads.index(cell.integrator)))
    with whole_file(folder / NAME) as stream:
        writer = csv.writer(stream, lineterminator="\n")
        writer.writerow([field.name for field in fields(Cell)])
        for cell in known:
            values = asdict(cell).values()
            writer.writerow([f"{v:.3g}" if isinstance(v, float) else v for v in values])


def read(folder: Path) -> list[Cell]:
    """The table of a folder; nothing where there is none."""
    path = folder / NAME
    if not path.exists():
        return []
    made = {"share": float, "first": float, "steps": int, "cpu": float}
    with path.open(newline="") as file:
        return [
            Cell(**{key: made.get(key, str)(text) for key, text in row.items()})
            for row in csv.DictReader(file)
        ]


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


def table_of(cells: Sequence[Cell]) -> str:
    """Cases by integrators."""
    found = {(cell.case, cell.integrator): cell for cell in cells}
    heads = [variant for variant in columns() if any(c.integrator == variant.label for c in cells)]
    body = [
        [case.name, case.why, *(_shown(found.get((case.name, v.label))) for v in heads)]
        for case in CASES if any(cell.case == case.name for cell in cells)
    ]  # fmt: skip
    if not body:
        return ""
    return table(("case", "", *map(heading, heads)), body)


def counts(cells: Sequence[Cell]) -> str:
    """How many runs ended in which way, in words."""
    return ", ".join(
        f"{sum(cell.verdict == verdict for cell in cells)} {words}"
        for verdict, words in WORDS.items()
    )


def _shown(cell: Cell | None) -> str:
    """A cell in few signs."""
    if cell is None:
        return ""
    reached = f"{cell.share:.2g} at {cell.setting}"
    if cell.verdict == PASSED:
        return f"{cell.share:.2g}" if cell.share == cell.first else reached
    if cell.verdict == STOPPED:
        return "rejected" if cell.rejected_before else f"`{cell.outcome}`"
    sign = {SLOW: "slow", REPORTED: "reported", SILENT: "**silent**"}[cell.verdict]
    return f"{sign}, {reached}" if np.isfinite(cell.share) else sign


def main() -> int:
    """Measure what the command line requests."""
    from benchmarks import report

    parser = argparse.ArgumentParser(prog="python -m benchmarks.matrix", description=__doc__)
    parser.add_argument("--case", nargs="+", default=[""], metavar="PART")
    parser.add_argument("--only", nargs="+", default=[""], metavar="PART")
    parser.add_argument("--seconds", type=float, default=SECONDS)
    parser.add_argument("--out", type=Path, default=report.FOLDER)
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
