"""`python -m benchmarks`: our CPU beside that of other programs, in one run on one core."""

from __future__ import annotations

import argparse
import os
import sys
from pathlib import Path

from benchmarks.scenes import parameters, sizes

MEASURED = ("accuracy", "growth", "startup")
RESULTS = Path(__file__).parent / "results"


def arguments() -> argparse.Namespace:
    """What is asked for; nothing means everything."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks", description=__doc__)
    parser.add_argument("--what", nargs="+", choices=MEASURED, default=MEASURED)
    parser.add_argument("--scene", nargs="+", choices=list(parameters()), default=["S1", "S2"])
    parser.add_argument("--n", nargs="+", type=int, help="sizes; those of the scene unless given")
    parser.add_argument("--program", nargs="+", default=[""], metavar="PART",
                        help="only programs with one of these in their name or kind")  # fmt: skip
    parser.add_argument("--target", nargs="+", type=float, default=[1e-5], help="errors to reach")
    parser.add_argument("--budget", type=float, default=25.0, help="CPU [s] a run may take")
    parser.add_argument("--repeats", type=int, default=5, help="measured runs after the warm-up")
    parser.add_argument("--core", type=int, default=max(os.sched_getaffinity(0)))
    parser.add_argument("--limit", type=Path, help="folder of the hand-coded C programs")
    parser.add_argument("--quick", action="store_true", help="N <= 200, 3 s a run, 3 repeats")
    parser.add_argument("--decks", type=Path, metavar="FOLDER", help="only write all decks there")
    args = parser.parse_args()
    if args.quick:
        args.budget, args.repeats = min(args.budget, 3.0), min(args.repeats, 3)
    if args.limit:
        os.environ["BENCHMARKS_LIMIT"] = str(args.limit.resolve())
    return args


def chosen(args: argparse.Namespace) -> list[str]:
    """Names of the installed programs that are asked for; the others are named as left out."""
    from benchmarks.peers import PROGRAMS

    asked = [p for p in PROGRAMS.values() if any(w in f"{p.name} {p.kind}" for w in args.program)]
    absent = [p.name for p in asked if not p.installed()]
    if absent:
        print(f"absent: {', '.join(absent)}\n")
    return [p.name for p in asked if p.name not in absent]


def wanted_sizes(args: argparse.Namespace, scene: str) -> list[int]:
    """The values of N for a scene."""
    return [
        n for n in sizes(scene)
        if (not args.n or n in args.n or scene == "S3") and not (args.quick and n > 200)
    ]  # fmt: skip


def accuracy(args: argparse.Namespace) -> None:
    """Cheapest CPU to each target, scene after scene."""
    from benchmarks.measure import measure
    from benchmarks.peers import PROGRAMS
    from benchmarks.tables import accuracy_table, cost_table, write_points

    names, everything = chosen(args), []
    for scene in args.scene:
        mine = [name for name in names if scene in PROGRAMS[name].scenes]
        for n in wanted_sizes(args, scene):
            points = measure(scene, n, mine, args.target, args.budget, args.repeats)
            everything += points
            write_points(everything, RESULTS / "accuracy.csv")
            if not points:
                continue
            if all(p.error is None for p in points if p.ok):
                print(cost_table(points), flush=True)
                continue
            for target in args.target:
                print(accuracy_table(points, target), flush=True)


def main() -> int:
    """Measure what is asked for."""
    args = arguments()
    if args.decks:
        from benchmarks.decks import write_all

        for path in write_all(args.decks):
            print(path)
        return 0
    os.sched_setaffinity(0, {args.core})
    RESULTS.mkdir(exist_ok=True)
    if "accuracy" in args.what:
        accuracy(args)
    if "growth" in args.what:
        from benchmarks.growth import growth

        print(growth(args.repeats, RESULTS / "growth.csv"))
    if "startup" in args.what:
        from benchmarks.startup import startup

        print(startup(args.repeats, RESULTS / "startup.csv"))
    return 0


if __name__ == "__main__":
    sys.exit(main())
