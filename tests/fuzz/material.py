"""The files that are changed: decks, command files, descriptions and results of the project."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from functools import cache
from itertools import accumulate
from pathlib import Path
from random import Random
from tempfile import TemporaryDirectory

import numpy as np
from adams_decks import stone_res, text_form

from adamslite.resources import find
from adamslite.results.results import Results
from adamslite.results.source import RunSource

ROOT = Path(__file__).resolve().parents[2]
#: Characters of the largest text that is changed; shorter ones are chosen more often.
LONGEST = 20_000
#: Folders whose files are changed; a command may add others.
FOLDERS = [find("decks")]

if str(ROOT) not in sys.path:  # the random decks of the benchmarks
    sys.path.append(str(ROOT))


class Texts:
    """Texts of one kind, of which shorter ones are chosen more often."""

    def __init__(self, texts: list[str]) -> None:
        self.texts = [each for each in texts if len(each) < LONGEST]
        self._weights = list(accumulate(1.0 / (len(each) + 200) for each in self.texts))

    def any(self, random: Random) -> str:
        """One of them."""
        return random.choices(self.texts, cum_weights=self._weights)[0]


def _files(suffix: str) -> Iterator[Path]:
    for folder in FOLDERS:
        yield from sorted(folder.rglob(f"*{suffix}"))


@cache
def decks() -> Texts:
    """Decks without the files they name."""
    return Texts([path.read_text("latin-1") for path in _files(".adm")])


@cache
def commanded() -> tuple[tuple[str, str], ...]:
    """Decks with command files beside them."""
    pairs = ((path, path.with_suffix(".acf")) for path in _files(".adm"))
    texts = [
        (deck.read_text("latin-1"), acf.read_text("latin-1"))
        for deck, acf in pairs
        if acf.is_file()
    ]
    return tuple(each for each in texts if sum(map(len, each)) < LONGEST / 4)


@cache
def command_files() -> Texts:
    """Command files alone."""
    return Texts([path.read_text("latin-1") for path in _files(".acf")])


@cache
def descriptions() -> Texts:
    """Descriptions of cable scenes."""
    texts = [path.read_text("utf-8") for path in _files(".toml")]
    return Texts([each for each in texts if "[[route]]" in each])


# ---- results -------------------------------------------------------------------------------------

DECK = """a mass that falls, and a part
UNITS/SYSTEM=MKS
PART/1, GROUND
MARKER/1, PART=1
PART/2, MASS=1, CM=2, IP=1,2,3
MARKER/2, PART=2, QP=0.5,0,0
REQUEST/7, F2=DX(2)
SIMULATE/DYNAMIC, END=1, STEPS=4
END
"""
MOTION = ("x", "y", "z", "psi", "theta", "phi", "vx", "vy", "vz", "wx", "wy", "wz",
          "ax", "ay", "az", "alx", "aly", "alz")  # fmt: skip
TABLE = """\
# adamslite 0.1.0
# deck: a mass that falls
# tolerance: abs 1e-6 rel 1e-3 peak 1e-6
# tolerance PART/*.x: abs 1e-3 digits 6
# interpolate: cubic
# outcome: STEP_TOO_SMALL at t = 1
time [ms],PART/2.x [mm],"REQUEST/7.F2",VARIABLE/1
0.0,0.01,0,nan
0.25,-0.02,1e-300,inf
0.5,0.03,1e300,1
"""


def _results() -> Results:
    """Results that know their deck."""
    time = np.linspace(0.0, 1.0, 5)
    names = (*(f"PART/2.{each}" for each in MOTION), "REQUEST/7.F2")
    values = np.sin(np.outer(1.0 + time, np.arange(len(names))))
    source = RunSource(deck=DECK, commands="")
    return Results(time=time, names=names, values=values, source=source, meta={"deck": "falls"})


@cache
def result_files(suffix: str) -> tuple[bytes, ...]:
    """Files of results in a format: written by the program, and some of others."""
    with TemporaryDirectory() as folder:
        path = Path(folder, f"written{suffix}")
        _results().save(path)
        found = [path.read_bytes()]
        of_adams = stone_res(Path(folder)).read_bytes()
    if suffix == ".csv":
        found.append(TABLE.encode())
    elif suffix == ".res":
        found += [text_form([0.0, 0.5]).encode(), of_adams]
    return tuple(found)
