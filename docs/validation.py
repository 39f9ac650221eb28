"""The page of published cases: what others published, what is exact, what this program computes.

python docs/validation.py

Each ``published.toml`` below decks/ describes a case; tests/test_published.py compares.
"""

from __future__ import annotations

import tomllib
from dataclasses import dataclass, field
from pathlib import Path
from time import process_time
from typing import Any

import numpy as np

import adamslite as al
from adamslite.verification.reference_file import parse_measure

ROOT = Path(__file__).resolve().parent.parent
PAGE = ROOT / "docs" / "validation.md"
HEAD = """<!-- Written by docs/validation.py: do not edit. -->
# Published cases

Numbers from handbooks, test sets and the documentation of other programs beside what this program
computes from a deck. *Exact* is the closed form, or the solution of the differential equation to
all digits that are printed; where it is missing, the published number is itself the reference.
Where *published* is empty, the source prints a formula, which gives the exact value. The deviation
is ours from the exact value (from the published one where there is no other). A value may be
published with few digits, or be off itself: then ours follows the exact one. Each name leads to
the deck with its equations and its source. CPU is that of the second run on one core: what is
compiled is kept. What programs for moorings and for reeving give on some of these scenes is on
[another page](background/ropes-beside.md).

{printed} of {all} quantities have a printed number.

| case | quantity | published | exact | ours | deviation | CPU [s] |
|---|---|---|---|---|---|---|
"""


@dataclass(frozen=True)
class Quantity:
    """A published number, and how a run gives it.

    `measure` is one of a reference file without its value, `mode` the number of the
    oscillation whose frequency [1/time] is meant, `eigenvalue` a part, real or imag, of the
    eigenvalue for which it is nearest; `scale` times it is in the published unit.
    """

    name: str
    deck: str
    published: str = ""
    unit: str = ""
    exact: float | None = None
    measure: str = ""
    mode: int = 0
    eigenvalue: str = ""
    scale: float = 1.0

    @property
    def expected(self) -> float:
        """The exact value, or the published one."""
        return float(self.published) if self.exact is None else self.exact


@dataclass(frozen=True)
class Case:
    """A folder with a published.toml.

    `within` is the relative deviation that is allowed, `flags` the options of the run.
    """

    folder: Path
    title: str
    source: str
    within: float
    quantities: tuple[Quantity, ...]
    flags: dict[str, Any] = field(default_factory=dict)


def cases() -> list[Case]:
    """All of them, by folder."""
    found = []
    for path in sorted((ROOT / "decks").rglob("published.toml")):
        given = tomllib.loads(path.read_text(encoding="utf-8"))
        quantities = tuple(Quantity(**each) for each in given.pop("quantity"))
        found.append(Case(folder=path.parent, quantities=quantities, **given))
    return found


def run(case: Case, deck: str) -> tuple[al.Results, float]:
    """The run of one deck of a case, and its CPU [s]."""
    start = process_time()
    flags = dict(case.flags)
    if "commands" in flags:
        flags["commands"] = case.folder / flags["commands"]
    results = al.simulate(case.folder / f"{deck}.adm", **flags)
    return results, process_time() - start


def ours(quantity: Quantity, results: al.Results) -> float:
    """What a run gives for a quantity, in the unit that was published."""
    if quantity.mode:
        found = results.linearizations[0].model.eigenvalues
        upper = np.sort(np.abs(found[found.imag > 0])) / (2 * np.pi)
        return float(upper[quantity.mode - 1]) * quantity.scale
    if quantity.eigenvalue:
        parts = getattr(results.linearizations[0].model.eigenvalues, quantity.eigenvalue)
        nearest = np.argmin(np.abs(parts * quantity.scale - quantity.expected))
        return float(parts[nearest]) * quantity.scale
    measure = parse_measure(f"{quantity.measure} = 0 tol abs 1")
    return measure.measured(results, "cubic") * quantity.scale


def rows(case: Case) -> list[str]:
    """Lines of the table."""
    lines, first = [], True
    place = next(p for p in (case.folder, *case.folder.parents) if (p / "README.md").exists())
    place = place.relative_to(ROOT).as_posix()
    decks = {q.deck: run(case, q.deck) for q in case.quantities}
    decks = {deck: run(case, deck) for deck in decks}
    for q in case.quantities:
        results, cpu = decks[q.deck]
        value = ours(q, results)
        off = value / q.expected - 1
        cells = [
            f"[{case.title}](../{place}/README.md): {case.source}" if first else "",
            q.name,
            f"{q.published} {q.unit}".strip() if q.published else "",
            "" if q.exact is None else f"{q.exact:.7g}",
            f"{value:.7g}",
            f"{off:.1e}",
            f"{cpu:.2g}",
        ]
        lines.append("| " + " | ".join(cells) + " |")
        first = False
    return lines


def main() -> None:
    """Write the page."""
    lines = [line for case in cases() for line in rows(case)]
    printed = [bool(quantity.published) for case in cases() for quantity in case.quantities]
    head = HEAD.format(printed=sum(printed), all=len(printed))
    PAGE.write_text(head + "\n".join(lines) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
