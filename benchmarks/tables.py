"""What was measured, as tables to read and as CSV."""

from __future__ import annotations

import csv
import json
from pathlib import Path

from benchmarks.measure import Point, cheapest
from benchmarks.peers import PROGRAMS

KINDS = ("ours", "implicit", "explicit", "limit")
COLUMNS = (
    "scene", "n", "program", "kind", "settings", "ok", "error", "drift", "steps", "setup_cpu_s",
    "solve_cpu_s", "solve_cpu_min_s", "repeats", "reason",
)  # fmt: skip


def milliseconds(seconds: float) -> str:
    """Three digits."""
    return f"{1e3 * seconds:.3g}" if seconds < 1 else f"{1e3 * seconds:.0f}"


def settings_text(point: Point) -> str:
    """Settings as a reader writes them; the absolute tolerance follows the relative one."""
    return " ".join(f"{k}={v:g}" for k, v in point.settings.items() if k != "atol")


def accuracy_table(points: list[Point], target: float) -> str:
    """Cheapest CPU to an error <= target: one scene, one N, one row a program."""
    scene, n = points[0].scene, points[0].n
    unit = "rad" if scene in ("S3", "S4") else "m"
    lines = [
        f"{scene} N={n}: cheapest CPU to error <= {target:g} {unit} [ms]",
        "",
        "| program | kind | setting | error | set-up | solve | x ours |",
        "|---|---|---|---|---|---|---|",
    ]
    best_of = {name: cheapest(ps, target) for name, ps in by_program(points).items()}
    own = min((p.solve for name, p in best_of.items() if p and is_ours(name)), default=None)
    order = sorted(best_of, key=lambda name: (KINDS.index(PROGRAMS[name].kind), name))
    for name in order:
        best = best_of[name]
        lines.append(row(best, own) if best else missing_row(name, points))
    return "\n".join([*lines, "", *verdict(best_of, own)]) + "\n"


def by_program(points: list[Point]) -> dict[str, list[Point]]:
    """Points by the name of their program."""
    found: dict[str, list[Point]] = {}
    for point in points:
        found.setdefault(point.program, []).append(point)
    return found


def is_ours(name: str) -> bool:
    """Whether a program is adamslite."""
    return PROGRAMS[name].kind == "ours"


def row(best: Point, own: float | None) -> str:
    """One line of the table."""
    ratio = f"{best.solve / own:.2f}" if own else "-"
    return (
        f"| {best.program} | {PROGRAMS[best.program].kind} | {settings_text(best)} "
        f"| {best.error:.1e} | {milliseconds(best.setup)} | {milliseconds(best.solve)} | {ratio} |"
    )


def missing_row(name: str, points: list[Point]) -> str:
    """A program that did not get there, with the best it did."""
    mine = [p for p in points if p.program == name]
    good = [p for p in mine if p.ok and p.error is not None]
    if good:
        best = min(good, key=lambda p: p.error)
        told = f"{settings_text(best)}: {best.error:.1e} in {milliseconds(best.solve)} ms"
    else:
        told = mine[-1].reason or "no reference"
    return f"| {name} | {PROGRAMS[name].kind} | not reached; {told} | - | - | - | - |"


def verdict(best_of: dict[str, Point | None], own: float | None) -> list[str]:
    """Ours against the best of each kind, in words."""
    lines = []
    for kind in KINDS[1:]:
        rivals = [p for name, p in best_of.items() if p and PROGRAMS[name].kind == kind]
        if rivals:
            best = min(rivals, key=lambda p: p.solve)
            ratio = f": ours is {best.solve / own:.2f} times as fast" if own else ""
            lines.append(f"best {kind}: {best.program}, {milliseconds(best.solve)} ms{ratio}")
    return lines


def cost_table(points: list[Point]) -> str:
    """Where there is no reference: what each program's last setting costs."""
    lines = [f"{points[0].scene} N={points[0].n}: CPU [ms], no reference", ""]
    lines += ["| program | setting | set-up | solve |", "|---|---|---|---|"]
    for name, mine in by_program(points).items():
        last = mine[-1]
        told = (milliseconds(last.setup), milliseconds(last.solve)) if last.ok else ("-", "failed")
        lines.append(f"| {name} | {settings_text(last)} | {told[0]} | {told[1]} |")
    return "\n".join(lines) + "\n"


def write_points(points: list[Point], path: Path) -> None:
    """All points, one line each."""
    with path.open("w", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(COLUMNS)
        for p in points:
            writer.writerow(
                (p.scene, p.n, p.program, PROGRAMS[p.program].kind, json.dumps(p.settings), p.ok,
                 p.error, p.drift, p.steps, p.setup, p.solve, p.fastest, len(p.solves), p.reason)
            )  # fmt: skip
