"""The flags that change a run, shared by the command line and reference files.

Only argparse is imported here, so that building the parser costs no start-up time.
"""

import argparse
from collections.abc import Sequence
from math import inf
from pathlib import Path
from typing import Any, NoReturn

from adamslite.errors import UsageError


class _RaisingParser(argparse.ArgumentParser):
    def error(self, message: str) -> NoReturn:
        raise UsageError(message)


def positive(text: str) -> float:
    """Return the number written in `text`, which must be positive and finite."""
    value = float(text)
    if not 0 < value < inf:
        raise argparse.ArgumentTypeError(f"'{text}' must be a positive number")
    return value


def instant(text: str) -> float:
    """Return the time written in `text`, finite and not negative."""
    value = float(text)
    if not 0 <= value < inf:
        raise argparse.ArgumentTypeError(f"'{text}' must be a time, zero or above")
    return value


def count(text: str) -> int:
    """Return the whole number written in `text`, at least 1."""
    value = int(text)
    if value < 1:
        raise argparse.ArgumentTypeError(f"'{text}' must be at least 1")
    return value


def add_user_flag(parser: argparse.ArgumentParser) -> None:
    """Declare what stands in for routines that are no part of a deck."""
    parser.add_argument(
        "--user", action="append", default=[], metavar="NAME=VALUE",
        help="what FUNCTION=USER means: VARIABLE/1=0, or VARSUB=module:function for all VARIABLEs; "
        "may be repeated",
    )  # fmt: skip


def add_folder_flag(parser: argparse.ArgumentParser) -> None:
    """Declare folders that decks may read files from; a reference file cannot open any."""
    parser.add_argument(
        "--allow-path", action="append", default=[], metavar="DIR",
        help="let the deck read tables from DIR and below, too; may be repeated",
    )  # fmt: skip


def add_values_flag(parser: argparse.ArgumentParser) -> None:
    """Declare numbers to put into a deck."""
    parser.add_argument(
        "--set", dest="values", action="append", default=[], metavar="NAME=VALUE",
        help="put another number into the deck: SPRINGDAMPER/1.K=90, or L_0=1.2 for a VARIABLE "
        "that is one; may be repeated; `adamslite names` lists them",
    )  # fmt: skip


def add_deck(parser: argparse.ArgumentParser, required: bool = True) -> None:
    """Declare a deck, its command file, what stands in for routines, and other numbers."""
    deck = parser.add_argument("deck", metavar="DECK", type=Path, help="deck (.adm)")
    if not required:
        deck.nargs, deck.required = "?", False
    parser.add_argument(
        "commands", metavar="COMMANDS.acf", type=Path, nargs="?",
        help="command file; without it the .acf beside the deck",
    )  # fmt: skip
    add_user_flag(parser)
    add_folder_flag(parser)
    add_values_flag(parser)


def add_scene_flags(parser: argparse.ArgumentParser) -> None:
    """Declare the command file, and what is read or put in besides the deck."""
    parser.add_argument(
        "--commands", metavar="COMMANDS.acf", type=Path,
        help="command file; without it the .acf beside the deck",
    )  # fmt: skip
    add_user_flag(parser)
    add_folder_flag(parser)
    add_values_flag(parser)


def add_integration_flags(parser: argparse.ArgumentParser) -> argparse._ArgumentGroup:
    """Declare how long a run takes, and how it is integrated."""
    flags = parser.add_argument_group("run", "these win over the deck and the command file")
    flags.add_argument("--end", type=positive, metavar="T", help="end time")
    flags.add_argument("--steps", type=count, metavar="N", help="number of output steps")
    flags.add_argument("--integrator", type=str.upper, metavar="NAME", help="GSTIFF, ...")
    flags.add_argument(
        "--formulation", type=str.upper, choices=("I3", "SI2"), help="index 3 or stabilised index 2"
    )
    flags.add_argument("--error", type=positive, metavar="TOL", help="integration error per step")
    flags.add_argument("--hmax", type=positive, metavar="H", help="largest step")
    return flags


def add_run_flags(parser: argparse.ArgumentParser) -> None:
    """Declare the flags that win over what deck and command file say."""
    flags = add_integration_flags(parser)
    flags.add_argument(
        "--no-reduction", action="append", metavar="RULE",
        help="do without a reduction of the model: fixed, plane, points or variables; may be "
        "repeated",
    )  # fmt: skip
    flags.add_argument(
        "--audit", action="store_true", default=None, help="follow and report the balance of energy"
    )
    flags.add_argument(
        "--confirm", action="store_true", default=None,
        help="run again with a smaller ERROR and with another method; report how many digits agree",
    )  # fmt: skip
    add_limit_flags(parser, "a run that reaches one ends, and keeps what it has", "the run")


def add_limit_flags(parser: argparse.ArgumentParser, about: str, what: str) -> None:
    """Declare what a command may spend, and ``about`` what happens where it has."""
    limits = parser.add_argument_group("limits", about)
    limits.add_argument("--cpu-limit", type=positive, metavar="S", help=f"CPU of {what} in seconds")
    limits.add_argument(
        "--max-steps", type=count, metavar="N",
        help="steps of integration; without, a run ends after 10000 steps below 1e-10 of it",
    )  # fmt: skip
    limits.add_argument(
        "--memory-limit", metavar="SIZE", help="data of the process, as 2GB; kept by Linux alone"
    )


def run_options(args: argparse.Namespace) -> dict[str, Any]:
    """Return the run flags that were given, as keyword arguments of `simulate`."""
    names = (
        "end",
        "steps",
        "integrator",
        "formulation",
        "error",
        "hmax",
        "no_reduction",
        "audit",
        "confirm",
        "cpu_limit",
        "max_steps",
        "memory_limit",
    )
    given = {name: getattr(args, name, None) for name in names}
    return {name: each for name, each in given.items() if each is not None}


def parse_flags(words: Sequence[str]) -> dict[str, Any]:
    """Read run flags written as words; see `run_options`.

    Raises
    ------
    UsageError
        For an unknown flag or a value that does not fit.
    """
    parser = _RaisingParser(add_help=False, allow_abbrev=False)
    add_run_flags(parser)
    add_user_flag(parser)
    add_values_flag(parser)
    args = parser.parse_args(words)
    given = {name: tuple(getattr(args, name)) for name in ("user", "values")}
    return {**run_options(args), **{name: each for name, each in given.items() if each}}
