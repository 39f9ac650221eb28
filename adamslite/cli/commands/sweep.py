"""run a deck many times with other numbers

Each NAME=VALUES varies a number of the deck (`adamslite names` lists them): FROM:TO:COUNT values at
equal distances, a list 1,2,4, or FROM:TO with a sample that draws. A grid runs all combinations.
All runs go to one NetCDF file, DECK's name with .sweep.nc in the current directory or OUT; a run
that fails is kept with its outcome. Interrupted, the file has what is done, and the same command
goes on; it tries those again that the program itself failed at (FAULT), and those that ran out of
memory (MEMORY_LIMIT).
"""

import argparse
import sys
import time as clock
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from adamslite.cli.commands.codes import DONE, STOPPED_EARLY
from adamslite.run_flags import (
    add_integration_flags,
    add_limit_flags,
    add_scene_flags,
    count,
    run_options,
)

if TYPE_CHECKING:
    from adamslite.deck.deck import Deck
    from adamslite.sweeps.ranges import Varied
    from adamslite.sweeps.record import Sweep

MOST_TOLD = 3


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments of `adamslite sweep`."""
    parser.add_argument("deck", metavar="DECK", type=Path, help="deck (.adm)")
    parser.add_argument(
        "varied", metavar="NAME=VALUES", nargs="+",
        help="SPRINGDAMPER/1.K=80:120:5, PART/2.MASS=1,2,4, L_0=1:2",
    )  # fmt: skip
    parser.add_argument(
        "--sample",
        default="grid",
        metavar="SAMPLE",
        help="grid (default), sobol:N, lhs:N, or saltelli:N for Sobol indices",
    )
    parser.add_argument("--seed", type=_seed, default=0, metavar="N", help="of samples that draw")
    parser.add_argument(
        "--measure", dest="measures", action="append", default=[], metavar="'WORD COLUMN'",
        help="keep one number of a column: 'max REQUEST/1.F2'; words are max, min, absmax, range, "
        "mean, rms, first, final, maxtime, mintime; may be repeated",
    )  # fmt: skip
    parser.add_argument(
        "--outputs", metavar="PATTERN", nargs="+", default=[],
        help="keep the histories of these columns: 'REQUEST/*', PART/2.y; after NAME=VALUES",
    )  # fmt: skip
    parser.add_argument("-o", "--output", metavar="OUT", help="file (.nc)")
    parser.add_argument(
        "--workers", type=count, metavar="N", help="as many as there are processors unless given"
    )
    parser.add_argument("--threads", action="store_true", help="workers are threads, not processes")
    parser.add_argument(
        "--scheduler", metavar="ADDRESS",
        help="workers are those of a Dask cluster: tcp://host:8786, or the scheduler's .json file",
    )  # fmt: skip
    add_scene_flags(parser)
    add_integration_flags(parser)
    add_limit_flags(parser, "a run that reaches one is kept with its outcome", "each run")
    parser.add_argument("--quiet", action="store_true", help="print nothing unless runs fail")


def _seed(text: str) -> int:
    if not text.isdecimal():
        raise argparse.ArgumentTypeError(f"'{text}' must be a whole number, 0 or more")
    return int(text)


def run(args: argparse.Namespace) -> int:
    """Carry the runs out and write them; return the exit code."""
    from adamslite.errors import UsageError
    from adamslite.progress import Progress, TalkingProgress
    from adamslite.scene import load_scene, stem_of
    from adamslite.sweeps.sweep import Means, Wanted, sweep

    output = Path(args.output or f"{stem_of(args.deck)}.sweep.nc")
    if output.suffix.lower() != ".nc":
        raise UsageError(f"-o {output}: the file of a sweep ends in .nc")
    scene = load_scene(args.deck, args.commands, args.user, args.values)
    _need_one_source(scene.deck, args.varied, args.values)
    wanted = Wanted(args.varied, args.sample, args.seed, args.measures, args.outputs)
    options = run_options(args)
    means = Means(args.workers, "threads" if args.threads else "processes", args.scheduler)
    progress = Progress() if args.quiet else TalkingProgress()
    began = clock.perf_counter()
    try:
        found = sweep(
            scene.deck, wanted, output, scene.commands, options, means, progress, scene.read
        )
    finally:
        progress.close()
    _tell(found, output, clock.perf_counter() - began, args)
    return STOPPED_EARLY if found.ahead or found.failed else DONE


def _need_one_source(deck: "Deck", varied: "Varied", given: Sequence[str]) -> None:
    """Reject a number that is varied and has a value by --set: one would win silently."""
    from adamslite.errors import UsageError
    from adamslite.sweeps.ranges import ranges_of
    from adamslite.variation.decks import variable_of

    if not given:
        return
    find = variable_of(deck.base or deck).numbers.find
    set_here = {find(text.partition("=")[0]).name: text for text in given}
    for each in ranges_of(varied):
        name = find(each.name).name
        if name in set_here:
            raise UsageError(
                f"{name} is varied, and has one value by --set {set_here[name]}: leave one of them "
                "out"
            )


def _tell(found: "Sweep", output: Path, taken: float, args: argparse.Namespace) -> None:
    """How the runs ended."""
    done = len(found) - len(found.ahead)
    ends = ", ".join(f"{number} {ending}" for ending, number in found.endings.most_common())
    if not args.quiet:
        sys.stderr.write(
            f"{args.deck}: {done} of {len(found)} runs, {ends or 'none'}\n"
            f"  took                 {taken:.1f} s\n"
            f"  results              {output}\n"
        )
    for number in found.failed[:MOST_TOLD]:
        row = zip(found.names, found.values[number], strict=True)
        numbers = ", ".join(f"{name}={value:.6g}" for name, value in row)
        ending = f"{found.outcomes[number]}: {found.messages[number]}".rstrip(": ")
        sys.stderr.write(f"adamslite: run {number} ({numbers}): {ending}\n")
    if len(found.failed) > MOST_TOLD:
        sys.stderr.write(f"adamslite: and {len(found.failed) - MOST_TOLD} more runs failed\n")
    if found.ahead:
        sys.stderr.write("adamslite: interrupted; the same command goes on with the rest\n")
