"""Write the reference.csv of each folder from ADAMS's tables beside its deck.

A table `CASE_Pos.txt` has three lines of heading, then time, x, y, z: the components F2, F3, F4 of
one REQUEST of the deck.
"""

from pathlib import Path

import numpy as np

#: Table -> REQUEST of the decks, and what is allowed beyond the rounding to six digits.
TABLES = {"Pos": (1, 1e-6), "Vel": (2, 1e-6), "Acc": (3, 2e-3), "Rforce": (5, 2e-3)}
COMPONENTS = ("F2", "F3", "F4")
#: ERROR of the runs; that of the body which falls 60 m, where rounding is 7e-15 m.
ERROR, FALLS = 1e-10, 1e-9
HEADER = """# ADAMS's own results: see ../README.md
# written by ../make_reference.py
# solve: --end 5 --steps 500 --error {error:g}
{tolerances}
time,{names}"""


def read(table):
    """Times (nt,) and components (nt, 3) of one of ADAMS's tables."""
    rows = np.loadtxt(table, skiprows=3)
    assert rows.shape == (501, 4)
    assert np.allclose(rows[:, 0], np.arange(501) / 100, rtol=0, atol=1e-12)
    return rows[:, 0], rows[:, 1:]


def write(deck):
    """Write the reference of `deck` from the four tables beside it."""
    case = deck.stem.removeprefix("test_")
    columns, names, tolerances = [], [], []
    for table, (request, allowed) in TABLES.items():
        times, components = read(deck.with_name(f"{case}_{table}.txt"))
        columns.append(components)
        names += [f"REQUEST/{request}.{component}" for component in COMPONENTS]
        tolerances.append(f"# tolerance REQUEST/{request}.*: abs {allowed:g} digits 6")
    np.savetxt(
        deck.with_name("reference.csv"),
        np.column_stack([times, *columns]) + 0.0,
        fmt="%.7g",
        delimiter=",",
        header=HEADER.format(
            error=FALLS if case.startswith("Cylindrical") else ERROR,
            tolerances="\n".join(tolerances),
            names=",".join(names),
        ),
        comments="",
    )


if __name__ == "__main__":
    for deck in sorted(Path(__file__).resolve().parent.glob("*/*.adm")):
        write(deck)
