"""Measure the kink load at a sheave against the number of elements; draw kink-load.svg.

python docs/background/kink_load.py        about two minutes of CPU; needs nothing but the package

The decks are those of decks/cables/kink-free-running at other numbers of elements. Rows of the
tables of cables.md are printed as they are measured.
"""

import csv
import sys
import tempfile
from pathlib import Path
from typing import Any

import numpy as np

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent
sys.path[:0] = [str(ROOT / "decks" / "cables"), str(ROOT)]

from kinks import REFERENCE, brute_force, growing, windows  # noqa: E402  (beside the decks)

from adamslite.plots import style  # noqa: E402
from adamslite.results.results import Results  # noqa: E402
from adamslite.verification.measures import moving_average, plateau  # noqa: E402
from adamslite.verification.verification import solve_quietly  # noqa: E402

SIZES = (15, 30, 60, 120, 240, 480)
#: Equivalent masses of the sheave [kg].
INERTIAS = (500.0, 2000.0, 10000.0, 100000.0)
FORMS = {
    "brute force": lambda n: brute_force(REFERENCE, n, max(n // 4, 12), max(n // 6, 4)),
    "ale": lambda n: growing("ale", REFERENCE, n),
    "paper": lambda n: growing("paper", REFERENCE, n),
}
TITLE = (
    "With {n} elements ale meets the closed form to {ale:.1%}, the paper's is {paper:.0%} below;"
    "\nthe raw peak of a chain of lumps stays {peak:.0%} above it at least"
)
#: Column, its name, dashes and whether markers are full.
CURVES = (("T2", "mean load", "-", True), ("peak", "raw peak", (0, (5, 3)), False))
TABLE = HERE / "kink-load.csv"
#: Of each form the columns of a row of the table.
COLUMNS = ("T1", "T2", "peak")


def solve(deck: str) -> Results:
    """Run the text of a deck."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "kink.adm"
        path.write_text(deck)
        return solve_quietly(path, {})


def loads(deck: str) -> tuple[float, float, float]:
    """T1 over its closed form; T2 and raw peak over the closed form of T2."""
    results, w = solve(deck), windows(REFERENCE)
    t, f = results.time, results["REQUEST/1.F2"]
    return (
        plateau(t, f, w["a"], w["b"]) / REFERENCE.tension,
        plateau(t, f, w["c"], w["d"]) / REFERENCE.free_running,
        float(f.max()) / REFERENCE.free_running,
    )


def heavy(inertia: float, sections: int = 120) -> float:
    """Largest deviation of the paper's element from ale, of means over 4 ms, with such a sheave."""
    smooth, width = [], 0.004
    for form in ("paper", "ale"):
        results = solve(growing(form, REFERENCE, sections, inertia))
        t = results.time
        whole = (t > width / 2) & (t < t[-1] - width / 2)
        smooth.append(moving_average(t, results["REQUEST/1.F2"], width)[whole])
    return float(np.abs(smooth[0] - smooth[1]).max() / smooth[1].max())


def title(rows: list[dict[str, str]]) -> str:
    """What the figure shows."""
    last = rows[-1]
    return TITLE.format(
        n=last["N"], ale=abs(float(last["ale T2"])), paper=-float(last["paper T2"]),
        peak=min(float(row[f"{form} peak"]) for row in rows for form in FORMS),
    )  # fmt: skip


def draw(rows: list[dict[str, str]]) -> Any:
    """The figure: the load after the kink as a full line, the raw peak dashed, over T2."""
    from matplotlib.figure import Figure

    looks = dict(zip(FORMS, ((style.MUTED, "o"), (style.BLUE, "s"), (style.RED, "^")), strict=True))
    sizes = [int(row["N"]) for row in rows]
    with style.styled():
        figure = Figure(figsize=(9.0, 5.2), layout="constrained")
        axes = figure.subplots()
        for form, (color, marker) in looks.items():
            for column, what, dashes, full in CURVES:
                values = [1.0 + float(row[f"{form} {column}"]) for row in rows]
                axes.plot(
                    sizes, values, color=color, marker=marker, linestyle=dashes, linewidth=1.8,
                    markerfacecolor=color if full else "white", label=f"{form}: {what}",
                )  # fmt: skip
        overshoot = REFERENCE.raw_peak / REFERENCE.free_running
        for load, text in ((1.0, "closed form T2"), (overshoot, "T1 + 1.274 (T2 - T1)")):
            axes.axhline(load, color=style.BLACK, linewidth=0.8, zorder=1)
            axes.annotate(
                text, (1.0, load), (8, 0), xycoords=("axes fraction", "data"),
                textcoords="offset points", va="center", fontsize=8,
            )  # fmt: skip
        axes.set_title(title(rows), fontsize=11, fontweight="bold", pad=12)
        axes.set_xscale("log")
        axes.set_xticks(sizes, [str(n) for n in sizes], minor=False)
        axes.set_xticks([], minor=True)
        axes.set_xlabel("number of elements N on the span that the hook catches")
        axes.set_ylabel("load at the free-running sheave, over its closed form T2 = 371.3 kN")
        style.plain_ticks(axes.yaxis)
        axes.legend(loc="upper left", bbox_to_anchor=(1.01, 1.0), borderaxespad=0.0)
    return figure


def measure() -> None:
    """Print the rows of the table of cables.md, and write them to the table beside this file."""
    names = [f"{form} {column}" for form in FORMS for column in COLUMNS]
    with TABLE.open("w", encoding="utf-8", newline="") as stream:
        stream.write(",".join(["N", *names]) + "\n")
        for n in SIZES:
            errors = [value - 1.0 for deck in FORMS.values() for value in loads(deck(n))]
            stream.write(",".join([str(n), *(f"{e:.3g}" for e in errors)]) + "\n")
            cells = (f"{100 * e:+.3g} %" for e in errors)
            sys.stdout.write(f"| {n} | " + " | ".join(cells) + " |\n")
            sys.stdout.flush()
    for inertia in INERTIAS:
        tau = inertia / REFERENCE.cable.impedance
        sys.stdout.write(
            f"| {inertia:g} kg | {1e3 * tau:.0f} ms | {100 * heavy(inertia):.2g} % |\n"
        )


def main() -> None:
    """Measure unless only the figure is wanted; draw."""
    if "--draw" not in sys.argv[1:]:
        measure()
    with TABLE.open(encoding="utf-8", newline="") as stream:
        style.save(draw(list(csv.DictReader(stream))), HERE / "kink-load.svg")


if __name__ == "__main__":
    main()
