"""what is wrong with a deck, and what it contains

Prints every error and warning with its place, then what the deck consists of and, for cables, how
fast waves are in them and what model they need (docs/background/cables.md). Exit code 3
when there are errors; warnings alone do not count.

For other programs --format writes the messages alone: gcc (one line FILE:LINE:COLUMN: SEVERITY:
MESSAGE [CODE] for each place), json (a list of objects) or sarif (SARIF 2.1.0).

A comment `! adamslite: ignore CODE` takes warnings and notes with that code away from its line.
"""

import argparse
import sys
from collections import Counter
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from adamslite.cli.commands.codes import DECK_ERRORS, DONE
from adamslite.run_flags import add_user_flag

if TYPE_CHECKING:
    from adamslite.deck.deck import Deck
    from adamslite.language.diagnostics import DeckError, Diagnostic
    from adamslite.scene import Scene


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments of `adamslite check`."""
    parser.add_argument("deck", metavar="DECK", type=Path, help="deck (.adm)")
    parser.add_argument(
        "commands", metavar="COMMANDS.acf", type=Path, nargs="?",
        help="command file; without it the .acf beside the deck",
    )  # fmt: skip
    add_user_flag(parser)
    parser.add_argument(
        "--format",
        choices=("text", "json", "sarif", "gcc"),
        default="text",
        help="text to read, or data for an editor or a pipeline (default: text)",
    )


def run(args: argparse.Namespace) -> int:
    """Print what there is to say; return the exit code."""
    from adamslite.language.diagnostics import DeckError, render
    from adamslite.scene import load_scene, with_missing_run

    try:
        scene = with_missing_run(load_scene(args.deck, args.commands, args.user))
    except DeckError as fault:
        if args.format != "text":
            return _data(args.format, fault.diagnostics, DECK_ERRORS)
        sys.stdout.write(f"{render(fault.diagnostics)}\n\n{_tally(fault)}\n")
        return DECK_ERRORS
    if args.format != "text":
        return _data(args.format, scene.warnings, DONE)
    if scene.warnings:
        sys.stdout.write(render(scene.warnings) + "\n\n")
    sys.stdout.write(contents(scene))
    return DONE


def _data(form: str, diagnostics: "Sequence[Diagnostic]", code: int) -> int:
    """Write the messages alone; return the exit code."""
    from adamslite.language.messages.formats import FORMATS

    sys.stdout.write(FORMATS[form](diagnostics))
    return code


def _tally(fault: "DeckError") -> str:
    return _counted(fault.diagnostics, always=("error", "warning"))


def _counted(diagnostics: "Iterable[Diagnostic]", always: Sequence[str] = ()) -> str:
    """How many there are of each severity; those of `always` also where there are none."""
    counted = Counter(each.severity for each in diagnostics)
    shown = [each for each in ("error", "warning", "note") if counted[each] or each in always]
    return ", ".join(_many(counted[each], each) for each in shown)


def contents(scene: "Scene") -> str:
    counted = Counter(statement.keyword for statement in scene.deck.statements)
    listed = ", ".join(f"{number} {keyword}" for keyword, number in counted.items())
    warnings = _counted(scene.warnings) or "no mistakes found"
    return "".join(
        f"{line}\n"
        for line in (
            f"{scene.title}: {warnings}",
            f"  {_many(counted.total(), 'statement')}: {listed}",
            f"  {_freedom(scene.deck)}",
            *_cables(scene),
        )
    )


def _cables(scene: "Scene") -> list[str]:
    """What the cables are like and how they would be modelled."""
    from adamslite.cables.report import about_cables

    return about_cables(scene.deck, scene.commands)


def _freedom(deck: "Deck") -> str:
    """Six coordinates for a part and three for a point mass, less one for each independent row."""
    from adamslite.elements.bases.constraint import Constraint
    from adamslite.elements.part import Part
    from adamslite.elements.point_mass import PointMass

    parts = sum(not each.ground for each in deck.of(Part))
    points = len(deck.of(PointMass))
    constraints = [each for each in deck.statements if isinstance(each, Constraint)]
    held = sum(each.n_rows for each in constraints if deck.is_active(each))
    found: list[str] = []
    if held:
        from adamslite.assembly.start import redundant_rows

        found = redundant_rows(deck)
    free = 6 * parts + 3 * points - held + len(found)
    redundant = f"\n  redundant, left out: {'; '.join(found)}" if found else ""
    return (
        f"{_many(free, 'degree')} of freedom: "
        f"{_many(parts, 'moving part')}, {_many(points, 'point mass', 'point masses')}, "
        f"{_many(held, 'constraint row')}{redundant}"
    )


def _many(number: int, one: str, several: str = "") -> str:
    return f"{number} {one if number == 1 else several or one + 's'}"
