"""Single figures, as a CSV: what they should stay below stands beside them."""

from __future__ import annotations

import csv
import time
from collections.abc import Iterable
from dataclasses import asdict, dataclass, fields
from pathlib import Path

import numpy as np

from adamslite.outputs.whole_files import whole_file

NAME = "figures.csv"


@dataclass(frozen=True)
class Figure:
    """A measured number; ``bound`` is what it must stay below, if there is such a thing."""

    group: str
    what: str
    value: float
    unit: str
    bound: float | None = None


def write(figures: Iterable[Figure], folder: Path) -> None:
    """Write the figures of a folder."""
    with whole_file(folder / NAME) as stream:
        writer = csv.writer(stream, lineterminator="\n")
        writer.writerow([field.name for field in fields(Figure)])
        for figure in figures:
            values = asdict(figure).values()
            writer.writerow(
                ["" if v is None else f"{v:.4g}" if isinstance(v, float) else v for v in values]
            )


def read(folder: Path) -> list[Figure]:
    """The figures of a folder; nothing where there are none."""
    path = folder / NAME
    if not path.exists():
        return []
    with path.open(newline="") as file:
        return [
            Figure(
                r["group"],
                r["what"],
                float(r["value"]),
                r["unit"],
                float(r["bound"]) if r["bound"] else None,
            )
            for r in csv.DictReader(file)
        ]


def merged(old: Iterable[Figure], new: Iterable[Figure]) -> list[Figure]:
    """New figures in place of old ones of the same group."""
    new = list(new)
    groups = {figure.group for figure in new}
    return [*(figure for figure in old if figure.group not in groups), *new]


def machine() -> list[Figure]:
    """What this core does per second, to compare with another machine."""
    a = np.random.default_rng(1).standard_normal((768, 768))
    product = _least(lambda: a @ a)
    long = np.ones(4_000_000)
    triad = _least(lambda: np.add(long, long, out=long))
    loop = _least(lambda: sum(k & 1 for k in range(1_000_000)))
    return [
        Figure("machine, one core", "matrix product (768)", 2e-9 * 768**3 / product, "Gflop/s"),
        Figure("machine, one core", "sum of long vectors", 24e-9 * long.size / triad, "GB/s"),
        Figure("machine, one core", "a million turns of a Python loop", 1e3 * loop, "ms"),
    ]


def _least(work: object, tries: int = 5) -> float:
    """Least CPU [s] of a piece of work."""
    found = []
    for _ in range(tries):
        before = time.process_time()
        work()
        found.append(time.process_time() - before)
    return min(found)
