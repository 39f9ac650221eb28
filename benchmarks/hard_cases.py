"""Outcomes of the hard cases: a cell for each case and integrator, their file and their table."""

from __future__ import annotations

import csv
from collections.abc import Iterable, Sequence
from dataclasses import asdict, dataclass, fields
from pathlib import Path

import numpy as np

from adamslite.language.method import AUTO
from adamslite.outputs.whole_files import whole_file
from adamslite.verification.variants import Variant, variants
from benchmarks.tables import table
from benchmarks.torture import CASES

NAME = "matrix.csv"
#: The method of fixed steps.
CONSTANT = "CONSTANT_BDF"

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
