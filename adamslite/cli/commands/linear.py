"""eigenvalues and modes of small motions

Prints number, undamped frequency, damping ratio and eigenvalue of every mode about the state the
commands lead to: COMMANDS.acf, else the .acf of the deck's name beside the deck. Without either it
is the equilibrium that the deck's own SIMULATE statements begin with, else the initial state. With
--time the motion is followed up to T from there, or from the initial state without commands:
--time 0 is the initial state. With --rm MARKER motions are those that an observer on its body
sees; without, what the last LINEAR command requires, else those seen from the ground. A line below
the table says where the linear system varies with time. FILE.csv takes the table, FILE.json
everything: mode shapes and state matrix too.
"""

import argparse
import sys

from adamslite.cli.commands.codes import DONE
from adamslite.run_flags import add_deck, add_limit_flags, instant, run_options


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments of `adamslite linear`."""
    add_deck(parser)
    parser.add_argument("--time", type=instant, metavar="T", help="linearise at this time")
    parser.add_argument("--rm", metavar="MARKER", help="marker of the body of the observer")
    parser.add_argument("-o", "--output", metavar="FILE", help="result file, .csv or .json")
    add_limit_flags(parser, "modes that need more are not found", "the command")


def run(args: argparse.Namespace) -> int:
    """Print the mode table; return the exit code."""
    import adamslite
    from adamslite.language.diagnostics import render
    from adamslite.outputs.modes import mode_table, need_suffix, save
    from adamslite.outputs.whole_files import need_writable
    from adamslite.scene import load_scene

    if args.output:
        need_suffix(args.output)
    scene = load_scene(args.deck, args.commands, args.user, args.values)
    if args.output:
        need_writable(args.output, scene.read)
    if scene.beside:
        sys.stderr.write(f"{scene.title}\n")
    if scene.warnings:
        sys.stderr.write(render(scene.warnings) + "\n\n")
    seen = run_options(args) | ({} if args.rm is None else {"rm": args.rm})
    found = adamslite.linearize(scene.deck, commands=scene.commands, time=args.time, **seen)
    sys.stdout.write(mode_table(found))
    if args.output:
        save(found, args.output)
    return DONE
