"""derivatives of a run by numbers of its deck

--of names what is differentiated: a measure ("max REQUEST/1.F2"), the value of a column at a time
(PART/2.x@end, PART/2.x@0.5), or a column whose history of derivatives is wanted. --by names the
numbers (`adamslite names` lists them). A table of derivatives is printed; -o OUT writes the
histories of derivatives of all these columns, `PART/2.x by SPRINGDAMPER/1.K`. They are worked out
along the steps of the run, by GSTIFF or RADAU, and are about as exact as the run itself.
--adjoint works back from the end of the run: the effort grows with the measures, not with the
numbers, of which `--by all` takes every one.
"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

from adamslite.cli.commands.codes import DONE, STOPPED_EARLY
from adamslite.run_flags import add_integration_flags, add_limit_flags, add_scene_flags, run_options

if TYPE_CHECKING:
    from adamslite.scene import Scene
    from adamslite.sensitivity.record import Sensitivities


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments of `adamslite sens`."""
    parser.add_argument("deck", metavar="DECK", type=Path, help="deck (.adm)")
    parser.add_argument(
        "--of", metavar="MEASURE", nargs="+", action="extend", required=True,
        help="'max REQUEST/1.F2', PART/2.x@end, PART/2.x; words are max, min, absmax, range, mean, "
        "rms, first, final; may be repeated",
    )  # fmt: skip
    parser.add_argument(
        "--by", metavar="NAME", nargs="+", action="extend", required=True,
        help="numbers: SPRINGDAMPER/1.K, L_0; may be repeated",
    )  # fmt: skip
    parser.add_argument(
        "--adjoint", action="store_true",
        help="for many numbers: from the end of the run to its beginning; `--by all`",
    )  # fmt: skip
    parser.add_argument("-o", "--output", metavar="OUT", help="file of histories (.csv, .nc, ...)")
    add_scene_flags(parser)
    add_integration_flags(parser)
    add_limit_flags(parser, "what is worked out by then is printed", "the command")


def run(args: argparse.Namespace) -> int:
    """Work derivatives out and print them; return the exit code."""
    from adamslite.errors import RunFailed, UsageError
    from adamslite.outputs.whole_files import need_writable
    from adamslite.results.formats import format_of
    from adamslite.scene import load_scene

    scene = load_scene(args.deck, args.commands, args.user, args.values)
    if args.output and args.adjoint:
        raise UsageError(f"-o {args.output}: --adjoint gives numbers, and no histories")
    if args.output:
        format_of(args.output)
        need_writable(args.output, scene.read, True)
    options = run_options(args)
    try:
        found = _found(args, scene, options)
    except RunFailed as fault:
        sys.stderr.write(f"adamslite: {fault}\n")
        return STOPPED_EARLY
    if len(found.measures):
        sys.stdout.write(str(found))
    for name, note in found.notes.items():
        sys.stderr.write(f"{name}: {note}\n")
    if args.output:
        found.histories.save(args.output)
        sys.stderr.write(f"{args.output}: histories of derivatives\n")
    elif not len(found.measures):
        sys.stderr.write("columns have histories of derivatives: -o OUT writes them\n")
    if found.stopped:
        sys.stderr.write(f"adamslite: {found.stopped}\n")
    return STOPPED_EARLY if found.stopped else DONE


def _found(args: argparse.Namespace, scene: Scene, options: dict[str, Any]) -> Sensitivities:
    """The derivatives, forwards or backwards."""
    if not args.adjoint:
        from adamslite.sensitivity.study import sensitivities

        return sensitivities(scene.deck, args.by, args.of, scene.commands, **options)
    from adamslite.sensitivity.adjoint import ALL, gradient

    by = ALL if args.by == [ALL] else args.by
    return gradient(scene.deck, args.of, by, scene.commands, **options)
