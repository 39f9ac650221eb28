"""Charts of measured rows: CPU against error, and CPU per step against N."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path
from textwrap import shorten

from adamslite.plots.cost_charts import LIMIT, OURS, Line, Words, cost_chart
from adamslite.plots.style import save
from adamslite.verification.work_precision import alike, largest_group
from benchmarks.growth import FROM, exponent
from benchmarks.mechanisms import WATCHED
from benchmarks.points import Row
from benchmarks.scenes import SCALING, parameters
from benchmarks.tables import (
    KINDS,
    PEERS,
    TARGETS,
    by_scene,
    cheapest,
    milliseconds,
    named,
    short,
    tried,
)

GROWTH = "growth"
#: Sizes that the page in docs shows; of other scenes all.
SIZES_IN_DOCS = {"S1": (50, 1000), "S2": (400,), "S4": (16,), "S5": (50,)}
#: A chart shows errors from a whole turn or metre down to where rounding begins.
SHOWN = (1e-11, 3.0)
#: The accuracy that a title is about, or the first of these that a program reached.
TITLED = (1e-5, *TARGETS)
#: What the error of the scenes that are written here is; of reference decks see ``WATCHED``.
MEASURED = {
    **dict.fromkeys(("S1", "S2", "S5"), "largest distance of a mass from its reference position"),
    "S3": "angle of the crank, difference from its reference",
    "S4": "angle of the uprights, difference from its reference",
}
#: Characters of a subtitle.
SUBTITLE = 110
C_LIMIT = (
    "C: programs written by hand that solve S1 and S2 and nothing else, in equal steps of a size "
    "known beforehand. They show about the least CPU that a method can take."
)


def title(scene: str, n: int) -> str:
    """What a scene is."""
    return f"{named(scene, n)}: {_what(scene).partition(',')[0].partition(':')[0]}"


def _what(scene: str) -> str:
    return WATCHED[scene].what if scene in WATCHED else parameters()[scene]["what"]


def file_name(scene: str, n: int) -> str:
    """Of a chart, without suffix."""
    return named(scene, n).replace(" N=", "-").lower()


def unit(scene: str) -> str:
    """Of the error."""
    return WATCHED[scene].unit if scene in WATCHED else "rad" if scene in ("S3", "S4") else "m"


def measured(scene: str) -> str:
    """What the error is, relative to what."""
    if scene in WATCHED:
        return f"{_what(scene).partition(': ')[2]}, difference from its reference"
    return MEASURED[scene]


def result(scene: str, mine: Sequence[Row]) -> str:
    """What the chart shows, in a sentence."""
    for target in TITLED:
        own, best = cheapest(mine, target, (OURS,)), cheapest(mine, target, PEERS)
        goal = f"{_power(target)} {unit(scene)}"
        if own and best:
            ratio = best.cpu_median / own.cpu_median
            return (
                f"{short(own.program)} reaches {goal} in {milliseconds(own.cpu_median)} ms; the "
                f"best other program, {short(best.program)}, takes {_times(ratio)}"
            )
        if own:
            return (
                f"{short(own.program)} reaches {goal} in {milliseconds(own.cpu_median)} ms; "
                f"{_nobody(mine)}"
            )
        if best:
            return f"Only {short(best.program)} reaches {goal}: {milliseconds(best.cpu_median)} ms"
    return f"No program reaches {_power(max(TARGETS))} {unit(scene)}"


def _nobody(mine: Sequence[Row]) -> str:
    """That no other program is as accurate; whom that is said of."""
    names = {short(r.program).partition(" ")[0] for r in tried(mine, PEERS)}
    if not names:
        return "no other program was tried"
    if len(names) == 1:
        return f"{names.pop()}, the only other program that was tried, does not get there"
    return "no other program gets there"


def _power(value: float) -> str:
    return f"{value:g}".replace("e-0", "e-")


def _times(ratio: float) -> str:
    return f"{ratio:.2g} times that" if ratio < 100 else f"{ratio:.0f} times that"


def merged(own: Sequence[Row]) -> list[Row]:
    """Rows of one program, of neighbours that are the same run, measured again, the cheapest."""
    return [min(group, key=lambda r: r.cpu_median or 0.0) for group in alike(own)]


def unmoved(names: Sequence[str], mine: Sequence[Row]) -> Iterator[str]:
    """The programs of ours whose steps several ERROR leave as they are."""
    for name in names:
        own = [r for r in mine if r.program == name and r.ok and r.error is not None]
        same = largest_group(own)
        if same and same[0].kind == OURS:
            yield f"{short(name)} ({len(same)} ERROR, {same[0].steps} steps)"


def notes(scene: str, mine: Sequence[Row], names: Sequence[str]) -> tuple[str, ...]:
    """The small print of a chart."""
    found = []
    if stuck := list(unmoved(names, mine)):
        found.append(
            "The bound of stability or the output step limits the steps, whatever ERROR, of "
            f"{', '.join(stuck)}. Runs that are alike are one point."
        )
    errors = [r.error for r in mine if r.ok and r.error is not None]
    if errors and errors.count(min(errors)) > 2:
        floor = f"{_power(min(errors))} {unit(scene)}"
        found.append(f"The reference is known to {floor}: errors shown there may be smaller.")
    if any(r.kind == LIMIT for r in mine):
        found.append(C_LIMIT)
    return tuple(found)


def work_precision(scene: str, n: int, mine: Sequence[Row], paths: Sequence[Path]) -> bool:
    """Draw one scene; False when nothing of it has a known error."""
    low, high = SHOWN
    lines = []
    names = _ordered(mine)
    for name in names:
        own = [r for r in mine if r.program == name and r.ok and r.error is not None]
        own = [r for r in own if low <= r.error <= high]
        if own and own[0].kind == OURS:
            own = merged(own)
        if own:
            errors, costs = [r.error for r in own], [1e3 * r.cpu_median for r in own]
            lines.append(Line(_label(name), own[0].kind, errors, costs))
    if lines:
        words = Words(
            title=result(scene, mine),
            subtitle=shorten(f"{named(scene, n)}: {_what(scene)}", SUBTITLE, placeholder=" ..."),
            x=f"error at the end: {measured(scene)} [{unit(scene)}]",
            y="CPU of the solution on one core, median [ms]",
            notes=notes(scene, mine, names),
        )
        figure = cost_chart(lines, words)
        for path in paths:
            save(figure, path)
    return bool(lines)


def growth(rows: Iterable[Row], paths: Sequence[Path]) -> bool:
    """Draw CPU per step against N; False when it was not measured."""
    mine = [r for r in rows if r.scene in SCALING and r.ok and r.steps]
    lines, exponents = [], []
    for name in _ordered(mine):
        own = sorted((r for r in mine if r.program == name), key=lambda r: r.n)
        costs = [1e6 * r.cpu_median / r.steps for r in own]
        lines.append(Line(_label(name), own[0].kind, [r.n for r in own], costs))
        if own[0].kind == OURS and (grown := exponent(own)) is not None:
            exponents.append(grown)
    if lines:
        how = f" as N^{min(exponents):.2f} to N^{max(exponents):.2f}" if exponents else ""
        words = Words(
            title=f"The CPU of a step of adamslite grows{how} from N = {FROM} on",
            subtitle="S1: the start of a swinging elastic cable of N masses",
            x="number of masses N",
            y="CPU per step on one core, median [us]",
            notes=(C_LIMIT,) if any(r.kind == LIMIT for r in mine) else (),
        )
        figure = cost_chart(lines, words, towards_less=False)
        for path in paths:
            save(figure, path)
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
    return short(name).removesuffix(", growing")
