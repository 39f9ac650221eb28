"""How our solve CPU per step grows with the number of masses: CPU/step ~ N^exponent."""

from __future__ import annotations

import csv
import math
from pathlib import Path

from benchmarks.measure import Point, Worker, first_run, repeat_in_turns
from benchmarks.peers import PROGRAMS

SCENE, SIZES, ERROR = "S1", (50, 200, 1000), 1e-6


def growth(repeats: int, path: Path) -> str:
    """Measure, write a CSV, and return the table."""
    lines = [f"{SCENE} at ERROR={ERROR:g}: solve CPU per step [us]", ""]
    rows = []
    for name, program in PROGRAMS.items():
        if program.kind == "ours" and program.installed():
            points = cpu_per_step(name, repeats)
            rows += [(name, p.n, p.steps, p.solve, p.error) for p in points]
            lines.append(told(name, points))
    with path.open("w", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(("program", "n", "steps", "solve_cpu_s", "error"))
        writer.writerows(rows)
    return "\n".join(lines) + "\n"


def cpu_per_step(name: str, repeats: int) -> list[Point]:
    """The same setting at every size, the sizes taking turns."""
    worker = Worker(name)
    points = [Point(name, SCENE, n, {"error": ERROR}) for n in SIZES]
    points = [p for p in points if first_run(worker, p).ok]
    repeat_in_turns({name: worker}, points, repeats)
    worker.close()
    return points


def told(name: str, points: list[Point]) -> str:
    """One line: cost per step at every size, and the exponent from the first to the last."""
    costs = {p.n: p.solve / p.steps for p in points}
    text = ", ".join(f"N={n} {1e6 * cost:.3g}" for n, cost in costs.items())
    if len(costs) < 2:
        return f"{name}: {text or 'failed'}"
    first, last = min(costs), max(costs)
    exponent = math.log(costs[last] / costs[first]) / math.log(last / first)
    return f"{name}: {text}; exponent {exponent:.2f} from N={first} to {last}"
