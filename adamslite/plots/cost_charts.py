"""Charts of cost against accuracy, or against size, of several programs on logarithmic axes.

Every integrator has a colour and a marker; other programs are muted, with a colour for each library
and a marker for each of its methods. A pale line below all others is the Pareto front: the least
cost with an error of so much at most.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from adamslite.plots import style
from adamslite.plots.style import Look, framed

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

#: Width of a chart, height of its axes with their numbers [in].
SIZE = (9.6, 5.4)
#: Part of the height below the lowest point, where the arrow has room.
FREE = 0.17
OURS, IMPLICIT, EXPLICIT, LIMIT = "ours", "implicit", "explicit", "limit"
GROUPS = {
    OURS: "adamslite",
    IMPLICIT: "other programs, implicit",
    EXPLICIT: "other programs, explicit",
    LIMIT: "C, written by hand\nfor this scene alone",
}
FRONT = "#f2dfa6"
#: Full markers that are told apart better with a white edge.
EDGED = "os^vD"


@dataclass(frozen=True)
class Line:
    """Points of one program, in the order they are joined; ``kind`` is a key of ``GROUPS``."""

    name: str
    kind: str
    x: Sequence[float]
    y: Sequence[float]


@dataclass(frozen=True, kw_only=True)
class Words:
    """What is written on a chart.

    title : the result;  subtitle : the scene;  x, y : what the axes are relative to
    notes : lines of small print
    """

    title: str
    subtitle: str
    x: str
    y: str
    notes: tuple[str, ...] = ()


@dataclass(frozen=True)
class Mark:
    """A point that is ringed, and the word beside it."""

    x: float
    y: float
    text: str


def cost_chart(
    lines: Sequence[Line], words: Words, towards_less: bool = True, mark: Mark | None = None
) -> Figure:
    """Draw lines on logarithmic axes.

    Parameters
    ----------
    lines : sequence of Line
    words : Words
    towards_less : bool
        Whether x is an error, which falls to the right; then there is a Pareto front.
    mark : Mark, optional

    Raises
    ------
    UsageError
        Without matplotlib.
    """
    style.need_matplotlib()
    shown = [line for line in lines if len(line.x)]
    with style.styled():
        figure = framed(words.title, words.subtitle, words.notes, *SIZE)
        axes = figure.subplots()
        _axes(axes, words, shown, towards_less)
        handles: dict[str, Any] = {}
        if towards_less:
            handles["front"] = _front(axes, shown)
        for name, look in looks(shown).items():
            line = next(each for each in shown if each.name == name)
            (handles[name],) = _drawn(axes, line, look)
        if mark:
            _ring(axes, mark)
        _legend(axes, shown, handles)
        _arrow(axes, (1.0, -1.0) if towards_less else (0.0, -1.0))
    return figure


def looks(lines: Iterable[Line]) -> dict[str, Look]:
    """How each program is drawn, the prominent ones last, above the others."""
    kinds = {line.name: line.kind for line in lines}

    def of(*wanted: str) -> list[str]:
        return sorted(name for name, kind in kinds.items() if kind in wanted)

    peers = style.looks_of_peers(of(IMPLICIT, EXPLICIT), lambda name: kinds[name] == EXPLICIT)
    return {**peers, **style.looks_of_limits(of(LIMIT)), **style.looks_of_methods(of(OURS))}


def front(lines: Iterable[Line]) -> list[tuple[float, float]]:
    """The points of least cost: no other has a smaller error at no more cost; from small errors on.

    Hand-written limits are no programs that anybody could take.
    """
    points = [p for each in lines if each.kind != LIMIT for p in zip(each.x, each.y, strict=True)]
    found: list[tuple[float, float]] = []
    for error, cost in sorted(points):
        if not found or cost < found[-1][1]:
            found.append((error, cost))
    return found


def _axes(axes: Axes, words: Words, lines: Sequence[Line], towards_less: bool) -> None:
    """Logarithmic axes around the points, with room for the arrow below them."""
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.set_xlabel(words.x)
    axes.set_ylabel(words.y)
    across = [x for line in lines for x in line.x]
    up = [y for line in lines for y in line.y]
    axes.set_xlim(*sorted(_wider(across, 0.05, 0.05), reverse=towards_less))
    axes.set_ylim(*_wider(up, FREE, 0.06))
    for axis in (axes.xaxis, axes.yaxis):
        style.power_ticks(axis)


def _wider(values: Sequence[float], below: float, above: float) -> tuple[float, float]:
    """Limits around positive values, with parts of their logarithmic range as margins."""
    low, high = min(values), max(values)
    ratio = max(high / low, 10.0)
    return low / ratio**below, high * ratio**above


def _drawn(axes: Axes, line: Line, look: Look) -> Any:
    from matplotlib.patheffects import Normal, Stroke

    outline = [Stroke(linewidth=look.width + 1.2, foreground=style.DARK), Normal()]
    ours = line.kind == OURS
    return axes.plot(
        line.x, line.y, color=look.color, marker=look.marker, linewidth=look.width,
        linestyle=look.dashes, markersize=7.0 if ours else 4.5,
        markerfacecolor=look.color if ours else "white",
        markeredgecolor="white" if ours and look.marker in EDGED else look.color,
        markeredgewidth=0.7 if ours else 1.0, zorder=5 if ours else 3,
        path_effects=outline if look.outlined else None,
    )  # fmt: skip


def _front(axes: Axes, lines: Sequence[Line]) -> Any:
    """The Pareto front as a staircase, up to the margin of larger errors."""
    points = front(lines)
    loosest = max(axes.get_xlim())
    x, y = zip(*points, (loosest, points[-1][1]), strict=True)
    (line,) = axes.plot(x, y, drawstyle="steps-post", color=FRONT, linewidth=6.0, zorder=1,
                        solid_joinstyle="miter", solid_capstyle="butt")  # fmt: skip
    return line


def _ring(axes: Axes, mark: Mark) -> None:
    """A ring around a point, and its word below it, or above where the arrow is below."""
    axes.plot([mark.x], [mark.y], "o", markersize=15, markerfacecolor="none",
              markeredgecolor=style.DARK, markeredgewidth=1.2, zorder=6)  # fmt: skip
    across, _ = axes.transAxes.inverted().transform(axes.transData.transform((mark.x, mark.y)))
    up = 1.0 if across > 0.6 else -1.0
    axes.annotate(
        mark.text, (mark.x, mark.y), (0, 12 * up), textcoords="offset points",
        ha="right" if across > 0.9 else "left" if across < 0.1 else "center",
        va="bottom" if up > 0 else "top", fontweight="bold", fontsize=8, zorder=7,
        bbox={"facecolor": "white", "edgecolor": "none", "alpha": 0.8, "pad": 1.0},
    )  # fmt: skip


def _legend(axes: Axes, lines: Sequence[Line], handles: dict[str, Any]) -> None:
    """Programs by group, the most expensive end of a line first, as lines end in the chart."""
    from matplotlib.lines import Line2D

    entries: list[tuple[Any, str]] = []
    headings = []
    for kind, heading in GROUPS.items():
        mine = sorted((line for line in lines if line.kind == kind), key=lambda line: -line.y[-1])
        if mine:
            headings.append(len(entries))
            entries.append((Line2D([], [], linestyle=""), heading))
            entries += [(handles[line.name], _label(line)) for line in mine]
    if "front" in handles:
        entries.append((handles["front"], "Pareto front: the least\nCPU for an accuracy"))
    legend = axes.legend(
        *zip(*entries, strict=True), loc="upper left", bbox_to_anchor=(1.01, 1.02),
        borderaxespad=0.0, handlelength=2.6, labelspacing=0.32,
    )  # fmt: skip
    for k in headings:
        legend.get_texts()[k].set_fontweight("bold")


def _label(line: Line) -> str:
    return line.name.removeprefix("C ") if line.kind == LIMIT else line.name


def _arrow(axes: Axes, direction: tuple[float, float]) -> None:
    """Where the better ones are: an arrow in the free strip at the lower right."""
    right, down = direction
    tip = (0.985, 0.02)
    tail = (tip[0] - 0.055 * right, tip[1] - 0.09 * down)
    axes.annotate(
        "", tip, tail, xycoords="axes fraction",
        arrowprops={"arrowstyle": "-|>", "color": style.DARK, "linewidth": 1.6},
    )  # fmt: skip
    axes.text(tail[0] - 0.012, tail[1], "better", transform=axes.transAxes, ha="right",
              va="center", color=style.DARK, fontweight="bold")  # fmt: skip
