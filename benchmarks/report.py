"""The pages accuracy.md and accuracy-tables.md of docs/background, and the charts beside them.

    python -m benchmarks --docs      measures everything but the matrix and ends with this
    python -m benchmarks.matrix      measures the matrix and ends with this
    python -m benchmarks.report      only writes pages and charts again

Each keeps what the others have measured.  The first page has the conclusions and the charts, the
second one the tables behind them.
"""

from __future__ import annotations

import sys
from collections.abc import Mapping, Sequence
from pathlib import Path

from adamslite.errors import UsageError
from adamslite.outputs.whole_files import whole_file
from benchmarks import conclusions, figures, hard_cases, points, tables
from benchmarks.charts import GROWTH, draw_all, file_name, title
from benchmarks.points import Row
from benchmarks.tables import by_scene

PAGE = Path(__file__).parent.parent / "docs" / "background" / "accuracy.md"
FOLDER = PAGE.with_suffix("")

HEAD = """# Speed against accuracy

How much CPU adamslite takes for how much accuracy, beside other programs, and how each of its
integrators does on hard cases. CPU is user and system time of one core, the median of runs in
turns; milliseconds are those of one machine, so only their ratios mean anything elsewhere. Errors
are absolute, at the end of a scene, against references that none of the programs computed.

The tables behind this page: [{tables}]({tables}). The scenes, and how they are
measured: [benchmarks/README.md](../../benchmarks/README.md).
Written by `python -m benchmarks --docs`.
"""

SECTIONS = {
    "conclusions": ("Conclusions", ""),
    "scenes": (
        "Each scene at an error of 1e-5",
        "The cheapest setting with an error of 1e-5 m or rad at most. *ratio*: CPU of the other\n"
        "program over that of adamslite. *none*: no setting was as accurate. Bricard and Top were\n"
        "given to one other program only, Exudyn.",
    ),
    "charts": (
        "Charts",
        "More accurate to the right, cheaper below. Each integrator of adamslite has a colour and\n"
        "a marker; other programs are muted, with a colour for each library, and dashed where\n"
        "explicit. The pale line is the Pareto front: the least CPU for an error of so much.",
    ),
    "cases": (
        "Hard cases",
        "Reference decks that are hard on methods, with every integrator. *Inside*: within the\n"
        "band of the reference, at the ERROR of the deck or at a smaller one.",
    ),
}

TABLES_HEAD = """# Tables behind the comparison of speed and accuracy

The figures behind [{page}]({page}), from [points.csv]({folder}/points.csv),
[figures.csv]({folder}/figures.csv) and [matrix.csv]({folder}/matrix.csv); `python -m
benchmarks.report` writes the pages again.
"""

TABLES = {
    "summary": (
        "The cheapest way to an accuracy",
        "The cheapest measured setting of adamslite and of the others. *times ours* is the CPU of\n"
        "the other one over that of adamslite.",
    ),
    "equal_steps": (
        "The same method with the same steps",
        "HHT with equal steps beside generalised alpha with the same damping, in hand-coded C\n"
        "that solves these two scenes and nothing else, and in Exudyn. The errors agree within a\n"
        "fifth, so it is the same numerical work.",
    ),
    "growth": (
        "The cost of a step, and how it grows",
        "CPU per step [us] of the start of S1, long enough not to be that of the first steps; the\n"
        "exponent is that from N = 50 on.",
    ),
    "singular": (
        "Singular positions",
        "S4: loops that pass positions in which they could branch off, for ten seconds, with\n"
        "every integrator.",
    ),
    "matrix": (
        "Hard cases",
        "Reference decks that are hard on methods, with every integrator\n"
        "(`python -m benchmarks.matrix`). A number is the part of the band of its reference\n"
        "(decks/README.md) that a run used at the ERROR of the deck, or at the first smaller one\n"
        "(a tenth, a hundredth, ...) that was enough; CONSTANT_BDF has a step in its place.\n"
        "*rejected*: before the run, with a sentence that names another method. A name is the\n"
        "outcome with which the run ended early. *reported*: ERROR = 1e-12 was not enough, and\n"
        "the summary of the run says why.",
    ),
    "single": ("Start, memory, machine", ""),
    "programs": (
        "Every program",
        "CPU [ms] of the cheapest setting that met a target; `-` where none did.",
    ),
}


def page(
    rows: Sequence[Row],
    single: Sequence[figures.Figure],
    cells: Sequence[hard_cases.Cell],
    drawn: Sequence[str],
    folder: str,
) -> str:
    """The sections of the first page: conclusions and charts."""
    parts = {
        "conclusions": conclusions.conclusions(rows, single, cells),
        "scenes": conclusions.scenes(rows), "charts": _charts(rows, drawn, folder),
        "cases": conclusions.cases(cells),
    }  # fmt: skip
    return _sections(SECTIONS, parts)


def tables_page(
    rows: Sequence[Row], single: Sequence[figures.Figure], cells: Sequence[hard_cases.Cell]
) -> str:
    """The sections of the second page."""
    parts = {
        "summary": tables.summary(rows), "equal_steps": tables.equal_steps(rows),
        "growth": tables.growth(rows), "singular": _singular(rows),
        "matrix": hard_cases.table_of(cells), "single": tables.single(single),
        "programs": _programs(rows),
    }  # fmt: skip
    return _sections(TABLES, parts)


def _sections(heads: Mapping[str, tuple[str, str]], parts: Mapping[str, str]) -> str:
    """Headings, words and parts; a part that is empty was not measured."""
    return "".join(
        f"\n## {name}\n\n" + (f"{words}\n\n" if words else "") + parts[key]
        for key, (name, words) in heads.items() if parts[key]
    )  # fmt: skip


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
    """Write both pages from the tables in ``folder``, and all charts, or ``few`` of them, there."""
    rows, single, cells = points.read(folder), figures.read(folder), hard_cases.read(folder)
    if not rows and not single and not cells:
        raise UsageError(f"there is nothing measured in {folder}: python -m benchmarks --docs")
    try:
        drawn = draw_all(rows, folder, suffixes, few)
    except UsageError as absent:
        print(absent, file=sys.stderr)
        drawn = [path.stem for path in folder.glob("*.svg")]
    link = folder.name if folder.parent == target.parent else "."
    behind = target.with_name(f"{target.stem}-tables.md")
    first = HEAD.format(tables=behind.name) + page(rows, single, cells, drawn, link)
    second = TABLES_HEAD.format(page=target.name, folder=link) + tables_page(rows, single, cells)
    for path, text in ((target, first), (behind, second)):
        with whole_file(path) as stream:
            stream.write(text.rstrip("\n") + "\n")


if __name__ == "__main__":
    write(FOLDER, PAGE, [".svg"], few=True)
