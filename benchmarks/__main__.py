"""Our CPU and accuracy beside those of other programs, in one run on one core."""

from __future__ import annotations

import argparse
import os
import sys
import time
from functools import partial
from pathlib import Path

from benchmarks import figures, points, report
from benchmarks.measure import Crew, Effort, Point
from benchmarks.mechanisms import WATCHED
from benchmarks.scenes import parameters, sizes
from benchmarks.tables import TARGETS

MEASURED = ("accuracy", "steps", "growth", "startup", "scenes", "reduction")
RESULTS = Path(__file__).parent / "results"
SCENES = (*parameters(), *WATCHED)
#: What `--quick` looks at: small scenes; no new run is begun after so long [s].
QUICK = {
    "scenes": {"S1": 50, "S2": 100, "S3": 1, "A01": 1, "Andrews": 1}, "largest": 100, "time": 120.0,
}  # fmt: skip


def arguments() -> argparse.Namespace:
    """The parts to measure; none given means all."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks", description=__doc__)
    parser.add_argument("--what", nargs="+", choices=MEASURED, default=MEASURED)
    parser.add_argument("--scene", nargs="+", choices=SCENES, help="all unless given")
    parser.add_argument("--n", nargs="+", type=int, help="sizes; those of the scene unless given")
    parser.add_argument("--only", nargs="+", default=[""], metavar="PART",
                        help="programs with this in their name or kind, such as ours")  # fmt: skip
    parser.add_argument("--target", nargs="+", type=float, default=TARGETS, help="errors to reach")
    parser.add_argument("--budget", type=float, default=10.0, help="CPU [s] a run may take (10)")
    parser.add_argument("--repeats", type=int, default=5, help="runs of every setting (5)")
    parser.add_argument("--coarse", action="store_true", help="every second setting only")
    parser.add_argument("--core", type=int, default=max(os.sched_getaffinity(0)))
    parser.add_argument("--limit", type=Path, help="folder of the hand-coded C programs")
    parser.add_argument("--quick", action="store_true", help="small scenes, under three minutes")
    parser.add_argument("--out", type=Path, default=RESULTS, help="folder of tables and charts")
    parser.add_argument("--docs", action="store_true", help="write the pages on accuracy")
    parser.add_argument("--decks", type=Path, metavar="FOLDER", help="only write all decks there")
    args = parser.parse_args()
    if args.quick:
        args.budget, args.repeats = min(args.budget, 0.5), min(args.repeats, 3)
        args.target = args.target[:2]
    args.scene = args.scene or tuple(QUICK["scenes"] if args.quick else SCENES)
    args.sizes = (
        (lambda scene: [QUICK["scenes"].get(scene, min(sizes(scene)))]) if args.quick else sizes
    )
    args.largest = QUICK["largest"] if args.quick else sys.maxsize
    args.out = report.FOLDER if args.docs else args.out
    if args.limit:
        os.environ["BENCHMARKS_LIMIT"] = str(args.limit.resolve())
    return args


def chosen(args: argparse.Namespace) -> list[str]:
    """Names of the requested programs that are installed; the others are reported as left out."""
    from benchmarks.peers import PROGRAMS
    from benchmarks.peers.ours import FIXED_STEPS

    asked = [p for p in PROGRAMS.values() if any(w in f"{p.name} {p.kind}" for w in args.only)]
    for p in asked:
        if not p.installed():
            print(f"{p.name} is left out: it is not installed.")
    return [p.name for p in asked if p.installed() and p.name != FIXED_STEPS.name]


def keep(made: list[Point], folder: Path) -> None:
    """Merge the measured points into the table of the folder."""
    rows = points.merged(points.read(folder), map(points.row, made))
    points.write(rows, folder)


def wanted(args: argparse.Namespace) -> list[tuple[str, int]]:
    """Scenes and sizes."""
    return [
        (scene, n)
        for scene in args.scene
        for n in sizes(scene)
        if (not args.n or n in args.n or len(sizes(scene)) == 1) and n in args.sizes(scene)
    ]


def accuracy(args: argparse.Namespace, names: list[str], crew: Crew, scene: str, n: int) -> None:
    """Every program on one scene."""
    from benchmarks.measure import measure
    from benchmarks.peers import PROGRAMS

    mine = [name for name in names if scene in PROGRAMS[name].scenes]
    keep(measure(scene, n, mine, crew), args.out)


def measure_all(args: argparse.Namespace) -> None:
    """Everything requested, into the tables of the folder."""
    from benchmarks.growth import growth
    from benchmarks.same_method import same_method

    names = chosen(args)
    coarse = args.coarse or args.quick
    crew = Crew(Effort(tuple(args.target), args.budget, args.repeats, coarse, args.quick))
    tasks = {}
    if "steps" in args.what:
        tasks["equal steps"] = lambda: keep(same_method(crew, args.largest), args.out)
    if "accuracy" in args.what:
        for scene, n in wanted(args):
            tasks[f"{scene} N={n}"] = partial(accuracy, args, names, crew, scene, n)
    if "growth" in args.what:
        tasks["growth"] = lambda: keep(growth(names, crew, 10 * args.largest), args.out)
    end = time.monotonic() + (QUICK["time"] if args.quick else float("inf"))
    for left, (name, task) in zip(range(len(tasks), 0, -1), tasks.items(), strict=True):
        began = time.monotonic()
        crew.share(began + (end - began) / left)
        task()
        short = ", not all of it: the time was up" if crew.effort.over else ""
        print(f"{name}: {time.monotonic() - began:.0f} s{short}", flush=True)
    crew.close()
    told = figures.machine()
    if "startup" in args.what and not args.quick:
        from benchmarks.startup import startup

        told += startup(args.repeats)
    if "scenes" in args.what and not args.quick:
        from benchmarks.whole_scenes import scenes

        told += scenes(args.repeats)
    if "reduction" in args.what and not args.quick:
        from benchmarks.reduction import reduction

        told += reduction(args.repeats)
    figures.write(figures.merged(figures.read(args.out), told), args.out)


def main() -> int:
    """Measure what the command line requests, and report."""
    args = arguments()
    if args.decks:
        from benchmarks.decks import write_all

        for path in write_all(args.decks):
            print(path)
        return 0
    os.sched_setaffinity(0, {args.core})
    args.out.mkdir(parents=True, exist_ok=True)
    measure_all(args)
    if args.docs:
        report.write(report.FOLDER, report.PAGE, [".svg"], few=True)
    else:
        report.write(args.out, args.out / "report.md", [".png", ".svg"])
        for name in ("report.md", "report-tables.md"):
            print((args.out / name).read_text())
    return 0


if __name__ == "__main__":
    sys.exit(main())
