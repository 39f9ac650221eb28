"""The look of all figures: colours that colour-blind people can tell apart, markers, fonts, files.

The colours are those of Okabe and Ito (Color Universal Design, 2008). Every colour comes with a
marker or a dash pattern of its own, so that a figure printed in grey can be read, too. matplotlib,
an optional extra, is imported when the first figure is made.
"""

from __future__ import annotations

import re
import sys
from collections.abc import Callable, Iterable, Sequence
from contextlib import AbstractContextManager, chdir
from importlib import import_module
from io import BytesIO
from itertools import pairwise
from math import floor, log10
from pathlib import Path
from textwrap import wrap
from typing import TYPE_CHECKING, Any, NamedTuple
from warnings import catch_warnings, filterwarnings

from adamslite.errors import UsageError
from adamslite.outputs.whole_files import whole_file
from adamslite.plots import style

if TYPE_CHECKING:
    from matplotlib.axis import Axis
    from matplotlib.figure import Figure

ABSENT = (
    "plots and charts are drawn by matplotlib, which is not installed: "
    "python -m pip install matplotlib"
)
#: Suffixes of files that figures are written to.
SUFFIXES = (".png", ".svg", ".pdf")

BLACK, ORANGE, SKY, GREEN, YELLOW, BLUE, RED, PURPLE = (
    "#000000", "#E69F00", "#56B4E9", "#009E73", "#F0E442", "#0072B2", "#D55E00", "#CC79A7",
)  # fmt: skip
FAINT, MUTED, DARK, BAND = "#dddddd", "#777777", "#333333", "#d5e5dd"
#: Colour and dash pattern of the curves of one axis, in turns.
CURVES = (
    (BLUE, "-"), (RED, (0, (6, 2))), (GREEN, (0, (2, 1.2))), (ORANGE, (0, (6, 2, 1.5, 2))),
    (PURPLE, (0, (9, 2.5))), (SKY, "-"), (BLACK, (0, (3, 1.5, 1, 1.5, 1, 1.5))),
    (MUTED, (0, (1, 1.5))),
)  # fmt: skip
MARKERS = "os^DvPX*<>hpd8"

#: Text as text keeps an SVG small; without salt and date the same figure is the same file.
SETTINGS: Any = {
    "font.size": 9.0,
    "font.family": ["sans-serif"],
    # Of equal width: an SVG fits where the first is not installed, too.
    "font.sans-serif": ["DejaVu Sans", "Verdana"],
    "axes.titlesize": 9.0,
    "axes.titlelocation": "left",
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.edgecolor": MUTED,
    "axes.grid": True,
    "axes.axisbelow": True,
    "grid.color": FAINT,
    "grid.linewidth": 0.6,
    "xtick.color": DARK,
    "ytick.color": DARK,
    "legend.frameon": False,
    "legend.fontsize": 8.0,
    "svg.fonttype": "none",
    "svg.hashsalt": "adamslite",
    "savefig.dpi": 130.0,
    "text.parse_math": False,
}


#: Minus and digits as exponents.
RAISED = "\u207b\u2070\u00b9\u00b2\u00b3\u2074\u2075\u2076\u2077\u2078\u2079"


class Look(NamedTuple):
    """How the line of one program is drawn; ``outlined`` puts a dark line under a light one."""

    color: str
    marker: str
    width: float = 2.0
    dashes: Any = "-"
    outlined: bool = False


#: Integrators of the program, by the name in a chart.
METHODS = {
    "GSTIFF SI2": Look(BLUE, "o"),
    "GSTIFF I3": Look(SKY, "s"),
    "ABAM": Look(RED, "D"),
    "RADAU": Look(GREEN, "^"),
    "HHT": Look(PURPLE, "v"),
    "NEWMARK": Look(ORANGE, "P"),
    "VERLET": Look(BLACK, "X"),
    "AUTO": Look(YELLOW, "*", outlined=True),
}
#: Muted colours of the libraries that the program is compared with.
LIBRARIES = {
    "scipy": "#a08972", "scikit-sundae": "#7ba08c", "CasADi": "#7b93ad", "Exudyn": "#a283a0",
    "MuJoCo": "#a0a06a", "heyoka": "#8b8b98",
}  # fmt: skip
EXPLICIT = (0, (4, 2))
LIMIT = (0, (1, 1.5))


def looks_of_methods(names: Iterable[str]) -> dict[str, Look]:
    """A look for each integrator; those without one of their own take what is left, in turns."""
    names = list(names)
    found = {name: METHODS[name] for name in names if name in METHODS}
    free = [(c, d) for c, d in CURVES if c not in {look.color for look in found.values()}] or CURVES
    used = {look.marker for look in METHODS.values()}
    markers = [m for m in MARKERS if m not in used]
    for k, name in enumerate(name for name in names if name not in METHODS):
        color, dashes = free[k % len(free)]
        found[name] = Look(color, markers[k % len(markers)], dashes=dashes)
    return found


def looks_of_peers(names: Iterable[str], explicit: Callable[[str], bool]) -> dict[str, Look]:
    """Muted looks of other programs: a colour for each library, a marker for each of its methods.

    ``explicit`` is whether a program is drawn with dashes.
    """
    found: dict[str, Look] = {}
    for name in names:
        library = name.partition(" ")[0]
        before = sum(other.partition(" ")[0] == library for other in found)
        color = LIBRARIES.get(library, "#999999")
        dashes = EXPLICIT if explicit(name) else "-"
        found[name] = Look(color, MARKERS[before % len(MARKERS)], 1.1, dashes)
    return found


def looks_of_limits(names: Iterable[str]) -> dict[str, Look]:
    """Dotted grey: what no program can be expected to reach."""
    return {name: Look(DARK, MARKERS[k], 1.2, LIMIT) for k, name in enumerate(names)}


def need_matplotlib() -> None:
    """Raise UsageError with one sentence when nothing can be drawn.

    matplotlib takes a `matplotlibrc` of the current folder before the user's own, and its older
    versions evaluate parts of it; the folder may have come with a deck.
    """
    from importlib.util import find_spec

    if find_spec("matplotlib") is None:
        raise UsageError(ABSENT)
    if "matplotlib" not in sys.modules:
        with chdir(Path(__file__).parent):
            import_module("matplotlib")


def styled() -> AbstractContextManager[None]:
    """The settings of matplotlib in which figures are made, drawn and written."""
    need_matplotlib()
    from matplotlib import style

    return style.context(["default", SETTINGS])  # whatever the user's own file of settings says


def need_suffix(path: str | Path) -> None:
    """Raise UsageError when no figure can be written to a file of this name."""
    suffix = Path(path).suffix.lower()
    if suffix not in SUFFIXES:
        raise UsageError(
            f"figures cannot be written to {path}: '{suffix}' is none of {', '.join(SUFFIXES)}"
        )


def save(figure: Figure, path: str | Path) -> None:
    """Write a figure to a file, whole or not at all, in the format of its suffix."""
    need_suffix(path)
    kind = Path(path).suffix.lower().lstrip(".")
    dated = {"svg": {"Date": None}, "pdf": {"CreationDate": None}}
    content = BytesIO()
    with styled(), catch_warnings():
        # A letter that the font lacks is a box in a PNG; an SVG has the letter itself.
        filterwarnings("ignore", "Glyph .* missing")
        figure.savefig(content, format=kind, metadata=dated.get(kind, {}))
    with whole_file(path, binary=True) as stream:
        stream.write(content.getvalue())


def plain_ticks(axis: Axis) -> None:
    """Numbers beside an axis, all with the digits that tell them apart, and no common factor."""
    from matplotlib.ticker import FuncFormatter, MaxNLocator

    axis.set_major_locator(MaxNLocator("auto", steps=[1, 2, 2.5, 5, 10]))
    axis.set_major_formatter(
        FuncFormatter(lambda value, _: tick_text(value, [*axis.get_majorticklocs()]))
    )


def tick_text(value: float, places: Sequence[float]) -> str:
    """A number with as many digits as the numbers ``places`` beside an axis need.

    ``0.25`` where the others are ``0.50``; ``1.5e-7`` where they are that small.
    """
    gap = min((b - a for a, b in pairwise(sorted(places))), default=abs(value) or 1.0)
    largest = max(*map(abs, places), abs(value), gap)
    if gap <= 0.0 or abs(value) < 1e-6 * gap:
        value = 0.0
    decimals = next((n for n in range(16) if abs(round(gap, n) - gap) <= 1e-6 * gap), 16)
    if largest < 1e6 and decimals <= 5:
        return f"{value:.{decimals}f}"
    if value == 0.0:
        return "0"
    digits = floor(log10(abs(value))) - floor(log10(gap)) + 2
    text = f"{value:.{min(max(digits, 1), 15)}g}"
    return re.sub(r"e([+-])0*(\d)", lambda m: "e" + m[1].replace("+", "") + m[2], text)


def power_ticks(axis: Axis) -> None:
    """Powers of ten beside a logarithmic axis, the multiples of few between them."""
    from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

    low, high = sorted(axis.get_view_interval())
    decades = log10(high / low)
    subs = (1.0, 2.0, 5.0) if decades < 2.5 else (1.0,)
    axis.set_major_locator(LogLocator(subs=subs, numticks=20))
    axis.set_major_formatter(FuncFormatter(lambda value, _: power_text(value)))
    axis.set_minor_formatter(NullFormatter())


def power_text(value: float) -> str:
    """``0.5``, ``20``, or a power of ten: ``10⁻⁵``."""
    if 1e-3 < value < 1e5:
        return f"{value:g}"
    power = floor(log10(value) + 1e-9)
    factor = round(value / 10.0**power)
    raised = str(power).translate(str.maketrans("-0123456789", RAISED))
    return f"10{raised}" if factor == 1 else f"{factor}·10{raised}"


#: Heights of a line of the title, of the subtitle and of the small print [in].
HEAD, SUB, PRINT = 0.22, 0.17, 0.17
#: Characters for each inch of width, of the title and of the small print.
TITLE_LETTERS, PRINT_LETTERS = 10.0, 13.5


def framed(title: str, subtitle: str, notes: Sequence[str], width: float, height: float) -> Figure:
    """An empty figure.

    Parameters
    ----------
    title, subtitle : str
        The title is broken into lines, the subtitle cut at the end of its line.
    notes : sequence of str
        Small print below, each with lines of its own.
    width, height : float
        Of the whole figure, and of the part between [in].
    """
    from matplotlib.figure import Figure
    from matplotlib.layout_engine import ConstrainedLayoutEngine

    heads = balanced(title, int(TITLE_LETTERS * width))
    prints = [line for note in notes for line in wrap(note, int(PRINT_LETTERS * width))]
    above = HEAD * len(heads) + SUB + 0.14
    below = PRINT * len(prints) + (0.1 if prints else 0.0)
    whole = height + above + below
    strip = (0.0, below / whole, 1.0, height / whole)
    layout = ConstrainedLayoutEngine(rect=strip, h_pad=0.05, w_pad=0.08)
    figure = Figure(figsize=(width, whole), layout=layout)
    for k, line in enumerate(heads):
        top = 1.0 - (0.08 + HEAD * k) / whole
        figure.text(0.012, top, line, va="top", fontsize=11, fontweight="bold")
    top = 1.0 - (0.1 + HEAD * len(heads)) / whole
    under = wrap(subtitle, int(PRINT_LETTERS * width) - 8, max_lines=1, placeholder=" ...")
    figure.text(0.012, top, "".join(under), va="top", color=style.MUTED)
    for k, line in enumerate(reversed(prints)):
        figure.text(0.012, (0.06 + PRINT * k) / whole, line, va="bottom", fontsize=8)
    return figure


def balanced(text: str, longest: int) -> list[str]:
    """The fewest lines that a text can be broken into, of about equal length."""
    lines = wrap(text, longest)
    if len(lines) < 2:
        return lines
    shorter = (wrap(text, width) for width in range(len(text) // len(lines), longest))
    return next((found for found in shorter if len(found) == len(lines)), lines)
