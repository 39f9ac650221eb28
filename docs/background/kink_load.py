"""Measure the kink load at a sheave against the number of elements; draw kink-load.svg.

python docs/background/kink_load.py        about two minutes of CPU; needs nothing but the package

The decks are those of decks/cables/kink-free-running at other numbers of elements. Rows of the
tables of cables.md are printed as they are measured.
"""

import sys
import tempfile
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent
sys.path[:0] = [str(ROOT / "decks" / "cables"), str(ROOT)]

from kinks import REFERENCE, brute_force, growing, windows  # noqa: E402  (beside the decks)

from adamslite.results.results import Results  # noqa: E402
from adamslite.verification.signals import moving_average, plateau  # noqa: E402
from adamslite.verification.verification import solve_quietly  # noqa: E402

SIZES = (15, 30, 60, 120, 240, 480)
#: Equivalent masses of the sheave [kg].
INERTIAS = (500.0, 2000.0, 10000.0, 100000.0)
FORMS = {
    "brute force": lambda n: brute_force(REFERENCE, n, max(n // 4, 12), max(n // 6, 4)),
    "ale": lambda n: growing("ale", REFERENCE, n),
    "paper": lambda n: growing("paper", REFERENCE, n),
}
LOOKS = {"brute force": "#8a8a8a", "ale": "#0b3c8c", "paper": "#c2410c"}
FRAME = """<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 640 400" font-family="sans-serif" \
font-size="12">
<rect width="640" height="400" fill="white"/>
<text x="60" y="22" font-size="14">Load at a free-running sheave when a kink arrives, over T2</text>
"""
LEFT, RIGHT, TOP, BOTTOM, LOW, HIGH = 60, 480, 40, 350, 0.75, 1.75


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


def place(n: float, load: float) -> tuple[float, float]:
    """Where a point is drawn: N on a logarithmic axis."""
    share = np.log2(n / SIZES[0]) / np.log2(SIZES[-1] / SIZES[0])
    return LEFT + share * (RIGHT - LEFT), BOTTOM - (load - LOW) / (HIGH - LOW) * (BOTTOM - TOP)


def chart(measured: dict[str, list[tuple[float, float, float]]]) -> str:
    """The figure: means are drawn through, raw peaks dashed."""
    out = [FRAME]
    for load in np.arange(0.8, 1.71, 0.1):
        y = place(15, load)[1]
        out.append(f'<path d="M{LEFT} {y:.1f}H{RIGHT}" stroke="#e2e2e2"/>\n')
        out.append(f'<text x="{LEFT - 8}" y="{y + 4:.1f}" text-anchor="end">{load:.1f}</text>\n')
    for n in SIZES:
        x = place(n, 1)[0]
        out.append(f'<text x="{x:.1f}" y="{BOTTOM + 18}" text-anchor="middle">{n}</text>\n')
    out.append(f'<text x="{(LEFT + RIGHT) / 2}" y="{BOTTOM + 38}" text-anchor="middle">')
    out.append("elements on the deck span, N</text>\n")
    for load, what in (
        (1.0, "closed form T2"),
        (REFERENCE.raw_peak / REFERENCE.free_running, "T1 + 1.274 (T2 - T1)"),
    ):
        y = place(15, load)[1]
        out.append(f'<path d="M{LEFT} {y:.1f}H{RIGHT}" stroke="black" stroke-width="0.8"/>\n')
        out.append(f'<text x="{LEFT + 250}" y="{y - 4:.1f}" font-size="11">{what}</text>\n')
    for form, rows in measured.items():
        for column, name, dash in ((1, "mean", ""), (2, "raw peak", "5 3")):
            points = [place(n, row[column]) for n, row in zip(SIZES, rows, strict=True)]
            line = " ".join(f"{x:.1f},{y:.1f}" for x, y in points)
            look = f'fill="none" stroke="{LOOKS[form]}" stroke-width="2"'
            out.append(f'<polyline points="{line}" {look} stroke-dasharray="{dash}"/>\n')
            x, y = points[-1]
            # Brute force and ale end in one point: the names stand above and below it.
            y += {"brute force": -8, "ale": 8}.get(form, 0) + 4
            out.append(f'<text x="{x + 8:.1f}" y="{y:.1f}" fill="{LOOKS[form]}">{form}, {name}')
            out.append("</text>\n")
    return "".join(out) + "</svg>\n"


def main() -> None:
    """Print the rows, write the figure."""
    measured = {form: [] for form in FORMS}
    for n in SIZES:
        for form, deck in FORMS.items():
            measured[form].append(loads(deck(n)))
        cells = (f"{100 * (value - 1):+.3g} %" for form in FORMS for value in measured[form][-1])
        sys.stdout.write(f"| {n} | " + " | ".join(cells) + " |\n")
        sys.stdout.flush()
    for inertia in INERTIAS:
        tau = inertia / REFERENCE.cable.impedance
        sys.stdout.write(
            f"| {inertia:g} kg | {1e3 * tau:.0f} ms | {100 * heavy(inertia):.2g} % |\n"
        )
    (HERE / "kink-load.svg").write_text(chart(measured))


if __name__ == "__main__":
    main()
