"""what accuracy costs with each integrator

Runs the deck with every integrator that can, at several values of ERROR, measures each run against
a tight reference, and prints a table and a recommendation. NAME.csv takes all points, NAME.png and
NAME.svg the chart; drawing needs matplotlib. How long to run is found as `adamslite solve` does.
The error is that of the motion: places against the longest way any body goes, attitudes in radians;
or, with --channel, that of the channels named, each against its largest value.
"""

import argparse
import sys
from pathlib import Path
from typing import TYPE_CHECKING

from adamslite.cli.commands.codes import DONE, OUTSIDE_TOLERANCE
from adamslite.run_flags import add_deck, count, positive

if TYPE_CHECKING:
    from adamslite.scene import Scene
    from adamslite.verification.variants import Run, Variant
    from adamslite.verification.work_precision import Chart

PICTURES = ("png", "svg")
COLUMNS = (
    "program", "setting", "error", "digits", "cpu_median_s", "cpu_least_s", "runs", "steps",
    "reason",
)  # fmt: skip


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments of `adamslite chart`."""
    add_deck(parser)
    parser.add_argument(
        "-o", "--output", metavar="NAME", help="of the files, without suffix (DECK's name-chart)"
    )
    parser.add_argument("--end", type=positive, metavar="T", help="end time")
    parser.add_argument("--steps", type=count, metavar="N", help="number of output steps")
    parser.add_argument(
        "--hmax", type=positive, metavar="H", help="largest step (as the deck has it)"
    )
    parser.add_argument(
        "--integrator", type=str.upper, nargs="+", metavar="NAME", help="only these methods"
    )
    parser.add_argument("--error", type=positive, nargs="+", metavar="TOL", help="only these ERROR")
    parser.add_argument("--channel", nargs="+", default=[], metavar="C", help="result that counts")
    parser.add_argument(
        "--digits", type=count, default=3, metavar="D", help="recommend for D digits (3)"
    )
    parser.add_argument("--repeats", type=count, default=3, metavar="R", help="runs of each (3)")
    parser.add_argument(
        "--patience", type=positive, default=20.0, metavar="S", help="CPU [s] a run may take (20)"
    )


def run(args: argparse.Namespace) -> int:
    """Measure, write, print; return the exit code."""
    from adamslite.outputs.whole_files import need_file, need_writable
    from adamslite.plots.accuracy_text import table, verdict
    from adamslite.scene import load_scene
    from adamslite.verification.work_precision import ERRORS, measure

    name = args.output or f"{args.deck.stem}-chart"
    need_file(name)
    scene = load_scene(args.deck, args.commands, args.user, args.values)
    for suffix in ("csv", *PICTURES):
        need_writable(f"{name}.{suffix}", scene.read, bool(args.output))
    tried, runs = _runs(args, scene)
    errors = sorted(args.error or ERRORS, reverse=True)
    chart = measure(runs, tried, errors, args.repeats, args.channel)
    sys.stdout.write(table(chart))
    _write(chart, Path(f"{name}.csv"))
    _draw(chart, name, args)
    sys.stdout.write(verdict(chart, args.digits))
    return OUTSIDE_TOLERANCE if chart.useless else DONE


def _runs(args: argparse.Namespace, scene: "Scene") -> tuple[list["Variant"], "Run"]:
    """The integrators to try, and what runs the deck with one of them."""
    from functools import partial

    import adamslite
    from adamslite.language.diagnostics import render
    from adamslite.progress import TalkingProgress
    from adamslite.verification.variants import chosen, patient

    if scene.beside:
        sys.stderr.write(f"{scene.title}\n")
    if scene.warnings:
        sys.stderr.write(render(scene.warnings) + "\n\n")
    model = adamslite.assemble(scene.deck)
    tried = chosen(args.integrator or ())
    progress = TalkingProgress()
    kernels = adamslite.compile_model(model, progress)
    fixed = {k: v for k in ("end", "steps", "hmax") if (v := getattr(args, k)) is not None}
    solve = partial(adamslite.simulate, kernels, commands=scene.commands, **fixed)
    return tried, patient(solve, args.patience, progress)


def _write(chart: "Chart", path: Path) -> None:
    import csv

    from adamslite.outputs.whole_files import whole_file

    with whole_file(path) as stream:
        writer = csv.writer(stream, lineterminator="\n")
        writer.writerow(COLUMNS)
        for p in chart.points:
            writer.writerow(
                (p.program, p.setting, "" if p.error is None else p.error, p.digits,
                 p.median, p.least, len(p.cpu), p.steps, p.reason)
            )  # fmt: skip


def _draw(chart: "Chart", name: str, args: argparse.Namespace) -> None:
    """The chart; without matplotlib a sentence instead."""
    from adamslite.errors import UsageError
    from adamslite.plots.accuracy_chart import accuracy_chart
    from adamslite.plots.style import save

    try:
        figure = accuracy_chart(chart, args.deck.name, args.digits, args.channel)
    except UsageError as absent:
        sys.stderr.write(f"adamslite: {absent}\n")
        return
    if figure is not None:
        for kind in PICTURES:
            save(figure, f"{name}.{kind}")
