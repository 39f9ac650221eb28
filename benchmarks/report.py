"""The page docs/accuracy.md and its charts, from the tables in docs/accuracy.

    python -m benchmarks --docs      measures everything but the matrix and ends with this
    python -m benchmarks.matrix      measures the matrix and ends with this
    python -m benchmarks.report      only writes page and charts anew

Each keeps what the others have measured.
"""

from __future__ import annotations

import sys
from collections.abc import Sequence
from pathlib import Path

from adamslite.faults import UsageError
from adamslite.outputs.whole import whole_file
from benchmarks import figures, matrix, points, tables
from benchmarks.charts import GROWTH, draw_all, file_name, title
from benchmarks.points import Row
from benchmarks.tables import by_scene

PAGE = Path(__file__).parent.parent / "docs" / "accuracy.md"
FOLDER = PAGE.with_suffix("")

HEAD = """# Speed against accuracy

Written by `python -m benchmarks --docs`; `python -m benchmarks.report` makes page and charts
anew from [points.csv]({folder}/points.csv), [figures.csv]({folder}/figures.csv) and
[matrix.csv]({folder}/matrix.csv). What the scenes are and how they are measured:
[benchmarks/README.md](../benchmarks/README.md).

All CPU is user and system time of one core, medians of runs in turns. Milliseconds are those of one
machine (its rates are below); only their ratios mean anything elsewhere. Errors are absolute, at
the end of a scene, against references that none of the programs made.
"""

SECTIONS = {
    "summary": (
        "The cheapest way to an accuracy",
        "The cheapest measured setting of ours and of the others. *times ours* is the CPU of the\n"
        "other one over ours.",
    ),
    "charts": (
        "Charts",
        "More exact to the right, cheaper below; ours bold, peers grey (explicit ones dashed).",
    ),
    "equal_steps": (
        "The same method with the same steps",
        "HHT of ours with equal steps beside generalised alpha with the same damping, in\n"
        "hand-coded C that can do these two scenes and nothing else, and in Exudyn. That the\n"
        "errors agree within a fifth shows that it is the same numerical work.",
    ),
    "growth": (
        "What a step costs, and how that grows",
        "CPU per step [us] of the start of S1, long enough that it is not that of the first\n"
        "steps; the exponent is that from N = 50 on.",
    ),
    "singular": (
        "Singular positions",
        "S4: loops that pass positions in which they could branch off, for ten seconds, by every\n"
        "integrator of ours.",
    ),
    "matrix": (
        "Where methods fail",
        "Reference decks that are hard on methods, each by every integrator of ours\n"
        "(`python -m benchmarks.matrix`). A number is the part of the band of its reference\n"
        "(decks/README.md) that a run used at the ERROR of the deck, or at the first of smaller\n"
        "ones (a tenth, a hundredth, ...) that was enough; CONSTANT_BDF has a step in its place.\n"
        "*Refused*: before the run, with a sentence that says what to use instead. A name is the\n"
        "outcome with which the run stopped, before any ERROR was enough. *Told*: ERROR = 1e-12\n"
        "was not enough, and the summary of the run says why.",
    ),
    "single": ("Start, memory, machine", ""),
    "programs": (
        "Every program",
        "CPU [ms] of the cheapest setting that met a target; `-` where none did.",
    ),
}


def page(
    rows: Sequence[Row],
    told: Sequence[figures.Figure],
    cells: Sequence[matrix.Cell],
    drawn: Sequence[str],
    folder: str,
) -> str:
    """The page."""
    made = {
        "summary": tables.summary(rows), "charts": _charts(rows, drawn, folder),
        "equal_steps": tables.equal_steps(rows), "growth": tables.growth(rows),
        "singular": _singular(rows), "matrix": matrix.table_of(cells),
        "single": tables.single(told), "programs": _programs(rows),
    }  # fmt: skip
    text = HEAD.format(folder=folder)
    for key, (name, words) in SECTIONS.items():
        if made[key]:
            text += f"\n## {name}\n\n" + (f"{words}\n\n" if words else "") + made[key]
    return text


def _charts(rows: Sequence[Row], drawn: Sequence[str], folder: str) -> str:
    shown = [(file_name(s, n), title(s, n)) for s, n, _ in by_scene(rows)]
    shown.append((GROWTH, "S1: what a step costs"))
    return "\n".join(f"![{text}]({folder}/{name}.svg)\n" for name, text in shown if name in drawn)


def _singular(rows: Sequence[Row]) -> str:
    return "\n".join(
        f"### {tables.named(scene, n)}\n\n{tables.errors_of_ours(mine)}"
        for scene, n, mine in by_scene(rows) if scene == "S4"
    )  # fmt: skip


def _programs(rows: Sequence[Row]) -> str:
    return "\n".join(
        f"### {title(scene, n)}\n\n{tables.programs(mine)}" for scene, n, mine in by_scene(rows)
    )


def write(folder: Path, target: Path, suffixes: Sequence[str], few: bool = False) -> None:
    """Write a page from the tables in ``folder``, where all charts go, too, or ``few`` of them."""
    rows, told, cells = points.read(folder), figures.read(folder), matrix.read(folder)
    if not rows and not told and not cells:
        raise UsageError(f"there is nothing measured in {folder}: python -m benchmarks --docs")
    try:
        drawn = draw_all(rows, folder, suffixes, few)
    except UsageError as absent:
        print(absent, file=sys.stderr)
        drawn = [path.stem for path in folder.glob("*.svg")]
    link = folder.name if folder.parent == target.parent else "."
    with whole_file(target) as stream:
        stream.write(page(rows, told, cells, drawn, link) + "\n")


if __name__ == "__main__":
    write(FOLDER, PAGE, [".svg"], few=True)
