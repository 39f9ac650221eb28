"""Write the decks below this folder and their references; one function per family of statements.

    python generate.py [case ...]

formulas.py has the closed forms, statements.py the text of the elements. Every case comes with two
sets of data. Expected values are computed here from the formulas, none is stored.
"""

import sys
from collections.abc import Callable, Iterator
from pathlib import Path

import arrest
import cranes
import draglines
import drum
import kinks
import moving
import payouts
import ropeways
import seconds
import waves

#: Folder -> the function that yields its decks: (name, text of the deck, text of the reference).
CASES: dict[str, Callable[[], Iterator[tuple[str, str, str]]]] = {
    **kinks.CASES,
    **waves.CASES,
    **payouts.CASES,
    **moving.CASES,
    **ropeways.CASES,
    **seconds.CASES,
    **arrest.CASES,
    **cranes.CASES,
    **draglines.CASES,
    **drum.CASES,
}


def main(wanted: list[str]) -> None:
    here = Path(__file__).resolve().parent
    for case in wanted or CASES:
        folder = here / case
        folder.mkdir(exist_ok=True)
        for name, deck, reference in CASES[case]():
            (folder / f"{name}.adm").write_text(deck)
            (folder / f"{name}.reference.csv").write_text(reference)


if __name__ == "__main__":
    main(sys.argv[1:])
