"""fit numbers of a deck to a measurement

MEASURED is a table with `time` first and columns that are called as the results of DECK; units may
stand behind names (`REQUEST/1.F2 [kN]`). Lines `# tolerance NAME: abs A rel R` are its bands, by
which residuals are weighted; of channels without one the noise is estimated. The numbers of --by
(`adamslite names` lists them) are fitted by least squares and printed with standard errors and
correlations, and what the measurement does not determine is named. DECK with the fitted numbers
goes to its name with .fitted.adm in the current directory, or to OUT. Exit code 1: some numbers
are not identifiable, or the deck does not do what was measured; 4: the fit stopped early.
"""

import argparse
import sys
from pathlib import Path

from adamslite.cli.commands.codes import DONE, OUTSIDE_TOLERANCE, STOPPED_EARLY
from adamslite.run_flags import add_integration_flags, add_limit_flags, add_scene_flags, run_options


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments of `adamslite fit`."""
    parser.add_argument("deck", metavar="DECK", type=Path, help="deck (.adm)")
    parser.add_argument("measured", metavar="MEASURED", type=Path, help="what was measured (.csv)")
    parser.add_argument(
        "--by", metavar="NAME", nargs="+", action="extend", required=True,
        help="numbers to fit: SPRINGDAMPER/1.K, L_0; may be repeated",
    )  # fmt: skip
    parser.add_argument(
        "--bounds", metavar="NAME=LOW:HIGH", nargs="+", action="extend", default=[],
        help="limits of a number, either end may be left out; one above zero stays there unless "
        "LOW is below zero",
    )  # fmt: skip
    parser.add_argument(
        "--of", metavar="COLUMN", nargs="+", action="extend", default=[],
        help="fit these columns of MEASURED alone: 'REQUEST/*', PART/2.y",
    )  # fmt: skip
    parser.add_argument("--from", dest="start", type=float, metavar="T", help="fit from this time")
    parser.add_argument("--to", dest="until", type=float, metavar="T", help="fit up to this time")
    parser.add_argument("-o", "--output", metavar="OUT", help="file of the fitted deck (.adm)")
    parser.add_argument(
        "--plot", metavar="FIGURE", help="draw measured and fitted curves (.png, .svg, .pdf)"
    )
    add_scene_flags(parser)
    add_integration_flags(parser)
    add_limit_flags(parser, "the best numbers by then are kept", "all runs together")
    parser.add_argument("--quiet", action="store_true", help="show no progress")


def run(args: argparse.Namespace) -> int:
    """Fit, print the table and write the deck; return the exit code."""
    from adamslite.fitting.fit import Wanted, fit
    from adamslite.outputs.whole_files import need_writable
    from adamslite.progress import Progress, TalkingProgress
    from adamslite.scene import load_scene, stem_of
    from adamslite.variation.decks import with_values
    from adamslite.verification.reference_file import read_reference

    output = args.output or f"{stem_of(args.deck)}.fitted.adm"
    if args.plot:
        _need_figure(args.plot)
    scene = load_scene(args.deck, args.commands, args.user)
    reference = read_reference(args.measured)
    for path, named in ((output, bool(args.output)), (args.plot, True)):
        if path:
            need_writable(path, [*scene.read, args.measured], named)
    options = run_options(args)
    wanted = Wanted(args.by, args.bounds, args.of, (args.start, args.until))
    progress = Progress() if args.quiet else TalkingProgress()
    deck = with_values(scene.deck, args.values) if args.values else scene.deck
    try:
        found = fit(deck, reference, wanted, scene.commands, options, progress)
    finally:
        progress.close()
    sys.stdout.write(f"{found}\n")
    found.save(output)
    sys.stderr.write(f"{output}: the deck with these numbers\n")
    if args.plot:
        found.plot(args.plot)
        sys.stderr.write(f"{args.plot}: measured and fitted curves\n")
    if found.stopped:
        return STOPPED_EARLY
    return DONE if found.is_identifiable and found.is_close else OUTSIDE_TOLERANCE


def _need_figure(path: str) -> None:
    """Fail before the fit rather than after it."""
    from adamslite.plots.style import need_matplotlib, need_suffix

    need_matplotlib()
    need_suffix(path)
