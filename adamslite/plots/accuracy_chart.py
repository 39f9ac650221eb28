"""The chart of what accuracy costs on one deck, with the setting that is recommended."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from math import isfinite
from typing import TYPE_CHECKING

from adamslite.notation import shown
from adamslite.plots.cost_charts import OURS, Line, Mark, Words, cost_chart
from adamslite.verification.work_precision import Chart, Point, alike, by_program, largest_group

if TYPE_CHECKING:
    from matplotlib.figure import Figure

MOTION = "largest error of the motion: of positions, part of the longest travel; of attitudes, rad"
#: The shortest time that is drawn [ms].
LEAST = 1e-3
CHANNELS = "largest error of {names}, part of the largest value of each"


def accuracy_chart(
    chart: Chart, name: str, digits: int = 3, channels: Sequence[str] = ()
) -> Figure | None:
    """Draw a chart; None when no run of it reached its end.

    Parameters
    ----------
    chart : Chart
    name : str
        What was run.
    digits : int
        How many are wanted of the recommended setting.
    channels : sequence of str
        What the error is that of; the motion of everything when empty.
    """
    known = by_program(p for p in chart.points if p.ok and p.error and isfinite(p.error))
    lines = [
        Line(program, OURS, [p.error or 0.0 for p in mine], [_milliseconds(p) for p in mine])
        for program, mine in ((key, _merged(points)) for key, points in known.items())
    ]
    if not lines:
        return None
    best = None if chart.useless else chart.recommended(digits)
    words = Words(
        title=_title(chart, best, digits),
        subtitle=f"{name}: CPU against error of every integrator at several ERROR",
        x=CHANNELS.format(names=", ".join(channels[:3])) if channels else MOTION,
        y="CPU of the solution, median [ms]",
        notes=(f"Reference: {chart.truth.origin}.", *_notes(chart)),
    )
    mark = Mark(best.error or 0.0, _milliseconds(best), best.setting) if best else None
    return cost_chart(lines, words, mark=mark)


def _milliseconds(point: Point) -> float:
    """CPU of a run, which coarse clocks measure as 0, on a logarithmic axis."""
    return max(1e3 * point.median, LEAST)


def limited(chart: Chart) -> list[str]:
    """The integrators whose steps several ERROR do not change, with the number of steps."""
    found = []
    for program, mine in by_program(p for p in chart.points if p.ok).items():
        if same := largest_group(mine):
            found.append(f"{program} ({len(same)} ERROR, {same[0].steps} steps)")
    return found


LIMITED = (
    "the output step, HMAX or the bound of stability limits the steps, whatever ERROR, of {names}; "
    "--hmax or fewer --steps lift the first two"
)


def _merged(points: Sequence[Point]) -> list[Point]:
    return [min(group, key=lambda p: p.median) for group in alike(points)]


def _title(chart: Chart, best: Point | None, digits: int) -> str:
    if chart.useless:
        return "Even tight runs do not agree: no setting can be recommended"
    if best is None:
        return f"No setting has {digits} digits in every tighter run, too"
    more = f" for {best.digits}" if best.digits > digits else ""
    return (
        f"{best.program} at {best.setting} is the cheapest with {digits} digits: "
        f"{1e3 * best.median:.3g} ms{more}"
    )


def _notes(chart: Chart) -> Iterator[str]:
    errors = [p.error for p in chart.points if p.ok]
    if errors.count(chart.truth.doubt) > 1:
        yield (
            f"The reference is known to {chart.truth.doubt:.1e}: errors shown there may be smaller."
        )
    if names := limited(chart):
        text = shown(LIMITED.format(names=", ".join(names)))
        yield f"{text[:1].upper()}{text[1:]}. Runs that are alike are one point."
