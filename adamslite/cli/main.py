"""The command `adamslite`.

    adamslite check  DECK                   what is wrong with a deck, and what it contains
    adamslite solve  DECK [COMMANDS.acf]    run it and write the results
    adamslite view   DECK|RESULT            write a page that shows how it moves, and open it
    adamslite plot   RESULT CHANNEL ...     draw channels of results
    adamslite diff   A B                    compare two result files
    adamslite verify [DIR|DECK ...]         run reference decks and compare
    adamslite linear DECK [COMMANDS.acf]    eigenvalues and modes of small motions
    adamslite chart  DECK [COMMANDS.acf]    what accuracy costs with each integrator
    adamslite cable  SPEC.toml              write the deck of a cable scene from a short description
    adamslite cache  [--clear]              what is kept between runs
    adamslite fmt    FILE ...               put decks and command files into the canonical layout
    adamslite lsp                           serve editors (Language Server Protocol)
    adamslite editors DIR                   write colours, snippets and a folder for VS Code
    adamslite help   [NAME]                 print the page of a statement, a function, ...

Exit codes: 0 done or equal, 1 outside tolerance or not in the canonical layout, 2 usage,
3 the deck has errors, 4 the solver stopped early (results so far are written), 5 reading or
writing failed, 70 a fault of the program itself.

Only argparse and its like are imported here: everything else waits until a command needs it.
"""

import argparse
import os
import sys
from collections.abc import Mapping, Sequence

from adamslite import __version__
from adamslite.cli.commands import (
    cable,
    cache,
    chart,
    check,
    diff,
    editors,
    fmt,
    help,
    linear,
    lsp,
    plot,
    solve,
    verify,
    view,
)
from adamslite.cli.commands.codes import BROKEN, DECK_ERRORS, DONE, IO_FAILED, STOPPED_EARLY, USAGE
from adamslite.notation import COMMAND_LINE, notation

COMMANDS = (
    check, solve, view, plot, diff, verify, linear, chart, cable, cache, fmt, lsp, editors, help,
)  # fmt: skip
EXIT_CODES = """exit codes:
  0 done, or equal        1 outside tolerance, or not in the canonical layout
  2 usage                 3 the deck has errors
  4 solver stopped early, results so far are written
  5 reading or writing failed"""

REPORT = (
    "adamslite: a fault in the program, not in your deck: {fault}\n"
    "Please report it with the deck and the output of the same command with --debug."
)


def main(argv: Sequence[str] | None = None) -> int:
    """Run the command line `argv` (default: of the process) and return the exit code."""
    with notation(COMMAND_LINE):
        return _run(argv)


def _run(argv: Sequence[str] | None) -> int:
    try:
        args = _parser().parse_args(argv)
    except SystemExit as leaving:
        return int(leaving.code or DONE)
    if args.debug:
        return args.run(args)
    try:
        code = args.run(args)
        if not sys.stdout.closed:  # by a server that has served
            sys.stdout.flush()  # a reader that has gone is noticed here, not while the process ends
        return code
    except BrokenPipeError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return IO_FAILED
    except KeyboardInterrupt:
        _tell("adamslite: interrupted")
        return STOPPED_EARLY
    except Exception as fault:
        return _explain(fault)


def command_parsers() -> Mapping[str, argparse.ArgumentParser]:
    """The parser of each command, by its name."""
    return dict(_parser().get_default("parsers"))


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="adamslite",
        description="Solve ADAMS/Solver-like decks of cables, pulleys and mechanisms.",
        epilog=EXIT_CODES,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("--version", action="version", version=f"adamslite {__version__}")
    shared = argparse.ArgumentParser(add_help=False)
    shared.add_argument(
        "--debug", action="store_true", help="show the traceback of a program fault"
    )
    commands = parser.add_subparsers(metavar="COMMAND", required=True)
    for module in COMMANDS:
        name = module.__name__.rpartition(".")[2]
        summary = (module.__doc__ or "").partition("\n")[0]
        command = commands.add_parser(
            name,
            parents=[shared],
            help=summary,
            description=module.__doc__,
            epilog=EXIT_CODES,
            formatter_class=argparse.RawDescriptionHelpFormatter,
        )
        module.add_arguments(command)
        command.set_defaults(run=module.run)
    parser.set_defaults(parsers=commands.choices)
    return parser


def _explain(fault: Exception) -> int:
    """Tell the user what went wrong, in sentences, and return the exit code for it."""
    from adamslite.errors import FormatError, RunFailed, UsageError
    from adamslite.language.diagnostics import DeckError

    if isinstance(fault, DeckError):
        _tell(str(fault))
        return DECK_ERRORS
    if isinstance(fault, UsageError):
        _tell(f"adamslite: {fault}")
        return USAGE
    if isinstance(fault, RunFailed):
        _tell(f"adamslite: {fault}")
        return STOPPED_EARLY
    if isinstance(fault, FormatError):
        _tell(f"adamslite: {fault}")
        return IO_FAILED
    if isinstance(fault, OSError):
        where = f"'{fault.filename}': " if fault.filename else ""
        _tell(f"adamslite: {where}{fault.strerror or fault}")
        return IO_FAILED
    cause = " ".join(f"{type(fault).__name__}: {fault}".split())
    _tell(REPORT.format(fault=cause))
    return BROKEN


def _tell(text: str) -> None:
    sys.stderr.write(text + "\n")
