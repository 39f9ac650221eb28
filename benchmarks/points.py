"""Measured points as a table: one CSV that tables and charts are made from."""

from __future__ import annotations

import csv
from collections.abc import Iterable
from dataclasses import asdict, dataclass, fields
from pathlib import Path

from adamslite.outputs.whole_files import whole_file
from benchmarks.measure import TIME_UP, Point
from benchmarks.peers import PROGRAMS

NAME = "points.csv"


@dataclass(frozen=True)
class Row:
    """One setting of one program on one scene; CPU in s, memory in MB.

    kind : ours, implicit, explicit or limit;  error : [m] or [rad], empty where there is no truth
    peak : of the resident memory of the whole process;  reason : why there is no result
    """

    scene: str
    n: int
    program: str
    kind: str
    setting: str
    error: float | None
    drift: float | None
    cpu_median: float | None
    cpu_least: float | None
    runs: int
    setup: float | None
    steps: int
    peak: float | None
    reason: str

    @property
    def ok(self) -> bool:
        """Whether there is a result."""
        return not self.reason

    @property
    def missed(self) -> bool:
        """Whether this setting had no turn."""
        return self.reason == TIME_UP

    def meets(self, target: float) -> bool:
        """Whether the error is known and small enough."""
        return self.ok and self.error is not None and self.error <= target


def row(p: Point) -> Row:
    """A measured point as a row."""
    return Row(
        scene=p.scene, n=p.n, program=p.program, kind=PROGRAMS[p.program].kind, setting=p.setting,
        error=p.error, drift=p.drift, cpu_median=p.median if p.cpu else None,
        cpu_least=p.least if p.cpu else None, runs=len(p.cpu), setup=p.setup, steps=p.steps,
        peak=p.peak, reason=p.reason,
    )  # fmt: skip


def write(rows: Iterable[Row], folder: Path) -> None:
    """Write the table of a folder."""
    with whole_file(folder / NAME) as stream:
        writer = csv.writer(stream, lineterminator="\n")
        writer.writerow([field.name for field in fields(Row)])
        for each in rows:
            writer.writerow([_text(value) for value in asdict(each).values()])


def read(folder: Path) -> list[Row]:
    """The table of a folder; nothing where there is none."""
    path = folder / NAME
    if not path.exists():
        return []
    with path.open(newline="") as file:
        return [_row(record) for record in csv.DictReader(file)]


def merged(old: Iterable[Row], new: Iterable[Row]) -> list[Row]:
    """New rows in place of all old ones of the same scene and N: only one run is comparable."""
    new = list(new)
    measured = {(each.scene, each.n) for each in new}
    return [*(each for each in old if (each.scene, each.n) not in measured), *new]


def _text(value: object) -> object:
    if value is None:
        return ""
    return f"{value:.4g}" if isinstance(value, float) else value


def _row(record: dict[str, str]) -> Row:
    whole = ("n", "runs", "steps")
    words = ("scene", "program", "kind", "setting", "reason")
    values = {
        key: text if key in words else int(text) if key in whole else float(text) if text else None
        for key, text in record.items()
    }
    return Row(**values)
