"""Measure every scene of decks/cables and the acceptance table; write both into cables.md.

python docs/background/cable_scenes.py [folder ...]     some minutes of CPU, one deck at a time

Folders are relative to decks: `cables/crane`; without any, all. Rows of other folders stay.

Seconds are the CPU of the solution, without reading, compiling or comparing. Tables stand between
`<!-- scenes -->` or `<!-- acceptance -->` and `<!-- end -->`.
"""

import re
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent
sys.path.insert(0, str(ROOT))

from adamslite.results.results import Results  # noqa: E402
from adamslite.verification.reference_file import Reference, read_reference  # noqa: E402  (a checkout need not be installed)
from adamslite.verification.verification import Case, find_cases, solve_quietly  # noqa: E402

DECKS, PAGE = ROOT / "decks", HERE / "cables.md"

#: Number, quantity, folder, beginning of the deck's name, and of the measure or of the column.
ACCEPTANCE = (
    ("K1", "T1 behind the impact [N]", "cables/kink-free-running", "", "mean", 0),
    ("K2", "arrival of the kink [s]", "cables/kink-free-running", "", "arrival", 0),
    ("K3", "T2, free-running sheave [N]", "cables/kink-free-running", "", "mean", 1),
    ("K4", "raw peak [N]", "cables/kink-free-running", "", "max", 0),
    ("K5", "T2, anchored [N]", "cables/kink-anchored", "", "mean", 0),
    ("K6", "axial step, T0 + rho c V [N]", "cables/axial-step", "", "mean", 0),
    ("K7", "dlnT1/dlnV", "cables/speed-scan", "", "mean", 2),
    ("M1", "growing mass: speed", "growing-mass-dalembert", "", "PART/2.vy", 0),
    ("M1", "growing mass: speed", "cables/second-sets", "growing", "POINT_MASS/2.vy", 0),
    ("M2", "growing mass on a spring: place", "growing-mass-spring", "", "PART/2.x", 0),
    ("M2", "growing mass on a spring: place", "cables/second-sets", "spring", "POINT_MASS/2.x", 0),
    ("M3", "printed sign: speed up to Dm/m0 = 0.99", "growing-mass-printed", "", "PART/2.vy", 0),
    ("M3", "printed sign: stops at Dm = m0", "growing-mass-singular", "", "PART/2.vy", 0),
    ("M3", "printed sign: stops at Dm = m0", "cables/second-sets", "printed", "POINT_MASS/2.vy", 0),
    ("P1", "steady payout, paper [N]", "cables/payout-level", "paper", "mean", 0),
    ("P2", "steady payout, ale [N]", "cables/payout-level", "ale", "mean", 0),
    ("P3", "transverse arrival, paper [s]", "cables/transverse-arrival", "paper", "arrival", 0),
    ("P3", "transverse arrival, ale [s]", "cables/transverse-arrival", "ale", "arrival", 0),
    ("S1", "snatch, largest tension [N]", "torture/snatch", "", "max", 0),
    ("S1", "snatch, energy over 10 bounces [J]", "torture/snatch", "", "range", 0),
    ("S1", "snatch, largest tension [N]", "cables/second-sets", "snatch", "max", 0),
    ("S1", "snatch, energy over 10 bounces [J]", "cables/second-sets", "snatch", "range", 0),
    ("L1", "Atwood: acceleration", "atwood", "", "PART/20.ay", 0),
    ("L1", "Atwood: load on the mount", "atwood", "", "JOINT/1.fy", 0),
    ("L1", "Atwood: acceleration", "cables/second-sets", "atwood", "PART/20.ay", 0),
    ("L1", "Atwood: load on the mount", "cables/second-sets", "atwood", "JOINT/1.fy", 0),
)


def form(text: str) -> str:
    """What the statements of a deck are, by the words they use."""
    if re.search(r"\*\*2/H", text):
        return "ale"
    if "VARIABLE/Dm" in text:
        return "paper"
    return "rigid rope" if re.search(r"GCON/\d+, FUNCTION=DM\(", text) else "sections"


def scene(case: Case, reference: Reference, results: Results) -> str:
    """A row: scene, form, elements, integrator, steps, CPU, worst error over allowed."""
    text, summary = case.deck.read_text(), results.summary
    elements = len(re.findall(r"^(?:POINT_MASS|PART)/\d+, .*MASS=", text, re.M))
    worst, method = reference.judge(results).worst, results.meta["integrator"]
    return (
        f"| {case.name} | {form(text)} | {elements} | {method} | {summary['steps']}"
        f" | {summary['solve_cpu_s']:.2f} | {worst.severity if worst else 0:.2g} |\n"
    )


def checked(reference: Reference, results: Results, what: str, which: int) -> str:
    """Three cells: expected, measured, allowed; of a column where it uses up most."""
    measures = [m for m in reference.measures if m.kind == what]
    if measures:
        m = measures[which]
        allowed = m.difference(results).allowed
        return f"{m.value:.9g} | {m.measured(results):.9g} | {allowed:.2g}"
    worst = next(d for d in reference.judge(results) if d.name == what)
    return f"closed form | {worst.worst:.2g} off at t = {worst.time:.3g} | {worst.allowed:.2g}"


def measure(folder: Path) -> tuple[list[str], list[str]]:
    """Rows of both tables from the decks of a folder."""
    scenes, accepted = [], []
    where = folder.relative_to(DECKS).as_posix()
    for case in find_cases([folder]):
        reference = read_reference(case.reference)
        # The first run may compile; the second is what is measured.
        results = [solve_quietly(case.deck, reference.options) for _ in range(2)][1]
        if where.startswith("cables/"):
            scenes.append(scene(case, reference, results))
        for number, quantity, at, name, what, which in ACCEPTANCE:
            if where == at and case.deck.stem.startswith(name):
                cells = checked(reference, results, what, which)
                accepted.append(f"| {number} | {quantity} | {case.name} | {cells} |\n")
    return scenes, accepted


def fill(page: str, mark: str, rows: list[str], cells: int) -> str:
    """The page with `rows` in the table below the marker; a row is known by its first `cells`."""
    head, _, rest = page.partition(f"<!-- {mark} -->\n")
    table, _, tail = rest.partition("<!-- end -->")
    title, rule, *old = table.splitlines(keepends=True)
    merged = {tuple(row.split("|")[1 : cells + 1]): row for row in (*old, *rows)}
    body = "".join(merged[name] for name in sorted(merged))
    return f"{head}<!-- {mark} -->\n{title}{rule}{body}<!-- end -->{tail}"


def main(wanted: list[str]) -> None:
    """Measure and write, folder by folder."""
    folders = {case.deck.parent for case in find_cases([DECKS / "cables"])}
    folders |= {DECKS / row[2] for row in ACCEPTANCE}
    for folder in [DECKS / name for name in wanted] or sorted(folders):
        scenes, accepted = measure(folder)
        page = PAGE.read_text(encoding="utf-8")
        page = fill(fill(page, "scenes", scenes, 1), "acceptance", accepted, 3)
        PAGE.write_text(page, encoding="utf-8")


if __name__ == "__main__":
    main(sys.argv[1:])
