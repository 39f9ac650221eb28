"""Charts of measured rows: CPU against error, and CPU per step against N."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from pathlib import Path

from adamslite.outputs.chart import Axes, Line, draw
from benchmarks.mechanisms import WATCHED
from benchmarks.points import Row
from benchmarks.scenes import SCALING, parameters
from benchmarks.tables import KINDS, by_scene, named

GROWTH = "growth"
#: Sizes that the page in docs shows; of other scenes all.
SIZES_IN_DOCS = {"S1": (50, 1000), "S2": (400,), "S4": (16,), "S5": (50,)}
#: A chart shows errors from a whole turn or metre down to where rounding begins.
SHOWN = (1e-11, 3.0)


def title(scene: str, n: int) -> str:
    """What a scene is."""
    what = WATCHED[scene].what if scene in WATCHED else parameters()[scene]["what"]
    return f"{named(scene, n)}: {what.partition(',')[0].partition(':')[0]}"


def file_name(scene: str, n: int) -> str:
    """Of a chart, without suffix."""
    return named(scene, n).replace(" N=", "-").lower()


def unit(scene: str) -> str:
    """Of the error."""
    return WATCHED[scene].unit if scene in WATCHED else "rad" if scene in ("S3", "S4") else "m"


def work_precision(scene: str, n: int, mine: Sequence[Row], paths: Sequence[Path]) -> bool:
    """Draw one scene; False when nothing of it has a known error."""
    low, high = SHOWN
    lines = []
    for name in _ordered(mine):
        own = [r for r in mine if r.program == name and r.ok and r.error is not None]
        own = [r for r in own if low <= r.error <= high]
        if own:
            errors, costs = [r.error for r in own], [1e3 * r.cpu_median for r in own]
            lines.append(Line(_label(name), own[0].kind, errors, costs))
    if lines:
        axes = Axes(title(scene, n), f"error [{unit(scene)}]", "CPU [ms]", towards_less=True)
        draw(lines, axes, paths)
    return bool(lines)


def growth(rows: Iterable[Row], paths: Sequence[Path]) -> bool:
    """Draw CPU per step against N; False when it was not measured."""
    mine = [r for r in rows if r.scene in SCALING and r.ok and r.steps]
    lines = []
    for name in _ordered(mine):
        own = sorted((r for r in mine if r.program == name), key=lambda r: r.n)
        costs = [1e6 * r.cpu_median / r.steps for r in own]
        lines.append(Line(_label(name), own[0].kind, [r.n for r in own], costs))
    if lines:
        draw(lines, Axes("S1: what a step costs", "number of masses", "CPU per step [us]"), paths)
    return bool(lines)


def draw_all(
    rows: Sequence[Row], folder: Path, suffixes: Sequence[str], few: bool = False
) -> list[str]:
    """Draw everything, or ``few`` charts, into a folder; their names, without suffix."""
    made = []
    for scene, n, mine in by_scene(rows):
        if few and n not in SIZES_IN_DOCS.get(scene, (n,)):
            continue
        name = file_name(scene, n)
        if work_precision(scene, n, mine, [folder / f"{name}{s}" for s in suffixes]):
            made.append(name)
    if growth(rows, [folder / f"{GROWTH}{s}" for s in suffixes]):
        made.append(GROWTH)
    return made


def _ordered(rows: Sequence[Row]) -> list[str]:
    """Programs, ours first."""
    return [name for _, name in sorted({(KINDS.index(r.kind), r.program) for r in rows})]


def _label(name: str) -> str:
    return name.removesuffix(", mechanism").removesuffix(", growing")
