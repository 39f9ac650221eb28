"""Files that the program goes on from: of unfinished runs, of SAVE, of sweeps, and measurements."""

from __future__ import annotations

import os
from functools import cache
from pathlib import Path
from random import Random
from tempfile import TemporaryDirectory
from unittest.mock import patch

import numpy as np

import adamslite
from adamslite.analyses.dynamics import history
from adamslite.caching import secret
from adamslite.errors import FormatError, UsageError
from adamslite.fitting.measured import measured_of
from adamslite.outputs.part_file import PartFile
from adamslite.results.results import Results
from adamslite.sweeps.origin import origin_of
from adamslite.verification.reference_file import read_reference

from . import byte_changes, material, text_changes
from .calls import call
from .cases import Case

DECK, COMMANDS, PART, SAVED = "deck.adm", "deck.acf", "out.csv.part", "kept"
STORE, MEASURED = "out.nc", "measured.csv"
SWINGS = """a mass on a spring and a damper
UNITS/SYSTEM=MKS
PART/1, GROUND
MARKER/1, PART=1
POINT_MASS/2, MASS=2, CM=2, QG=1.2,0,0
MARKER/2, POINT_MASS=2
SPRINGDAMPER/1, TRANSLATIONAL, I=2, J=1, K=200, C=2, LENGTH=1
INTEGRATOR/GSTIFF, SI2, ERROR=1E-4
"""
SHORT = SWINGS + "SIMULATE/DYNAMIC, END=0.05, STEPS=5\nEND\n"
FREE = SWINGS + "END\n"
KEEPS = f"SIMULATE/DYNAMIC, END=0.02, STEPS=2\nSAVE/SYSTEM, FILE={SAVED}\n"
GOES_ON = f"RELOAD/SYSTEM, FILE={SAVED}\nSIMULATE/DYNAMIC, END=0.03, STEPS=2\n"
TABLE = """\
# measured in the hall
# tolerance POINT_MASS/2.x: abs 0.01 rel 1e-3
# tolerance POINT_MASS/2.v*: rel 0.01 abs 1e-3 digits 6
time [ms],POINT_MASS/2.x [mm],POINT_MASS/2.vx
0.0,1200,0
10.0,1199.1,-0.19
20.0,1196.5,nan
30.0,1192.1,-0.5
50.0,nan,-0.7
"""
#: Descriptions that become decks: the shortest.
CABLES = 16
#: Of the cases these are met by the whole command, which takes a hundred times as long.
WHOLE = 0.02
#: The secret of the user who has written the files.
OWN = b"of the user of the cases"

Files = dict[str, bytes]


def _secret() -> bytes:
    return OWN


@cache
def written(deck: str, commands: str, name: str, *words: str) -> bytes:
    """A file that a command leaves beside the deck."""
    here = Path.cwd()
    with TemporaryDirectory() as folder:
        os.chdir(folder)
        try:
            Path(DECK).write_text(deck)
            if commands:
                Path(COMMANDS).write_text(commands)
            assert call(words[0], DECK, *words[1:]) == "done"
            return Path(name).read_bytes()
        finally:
            os.chdir(here)


@cache
def _part() -> bytes:
    """What a run leaves that is killed between its end and its results."""
    found: list[bytes] = []
    removed = PartFile.remove

    def remove(part: PartFile) -> None:
        found.append(part.path.read_bytes())
        removed(part)

    with (
        patch.object(history, "SETTLED", 0.0), patch.object(PartFile, "remove", remove),
        patch.object(secret, "_secret", _secret),
        patch.object(os.path, "abspath", str),  # the same bytes wherever it is written
    ):  # fmt: skip
        written(SHORT, "", "out.csv", "solve", "-o", "out.csv", "--quiet")
    return found[-1]


@cache
def _cable_decks() -> tuple[str, ...]:
    """Decks that descriptions become: with the description in their comments, and without."""
    texts = sorted(material.descriptions().texts, key=len)[:CABLES]
    decks = [_cable_deck(each) for each in texts]
    plain = ("\n".join(line for line in each.splitlines() if line[:1] != "!") for each in decks)
    return (*decks, *plain)


def _cable_deck(description: str) -> str:
    with TemporaryDirectory() as name:
        spec, deck = Path(name, "scene.toml"), Path(name, DECK)
        spec.write_text(description, "utf-8")
        assert call("cable", str(spec), "--no-trial", "-o", str(deck)) == "done"
        return deck.read_text("utf-8")


def cabled(random: Random) -> Case:
    """A deck with cables, with other numbers: what they are is worked out from them."""
    text = random.choice(_cable_decks())
    for _ in range(random.randint(1, 3)):
        usual = random.random() < 0.9
        change = text_changes.other_value if usual else random.choice(text_changes.CHANGES)
        text = change(random, text, _cable_decks())
    return Case({DECK: text.encode("utf-8", "surrogatepass")})


def part(random: Random) -> Case:
    """An unfinished run, damaged; seldom by nobody but another user."""
    data = _part()
    if random.random() < 0.98:
        data = byte_changes.changed(random, data)
    return Case({DECK: SHORT.encode(), PART: data}, ("trust",) * (random.random() < 0.02))


def resume(case: Case, folder: Path) -> str:
    """`adamslite solve --resume`, by the user who wrote it and by another one.  What is trusted is
    code, so only what is whole is.
    """
    (folder / PART).unlink(missing_ok=True)  # the one before may still be open
    case.put_into(folder)
    whole = case.files[PART] == _part()
    stranger = whole and not case.arguments
    with patch.object(secret, "_secret", (lambda: b"another") if stranger else _secret):
        word = call(
            "solve", "--resume", PART, "--quiet", *("--trust",) * bool(whole and case.arguments)
        )
    assert not stranger or word == "usage"
    return word


def save(random: Random) -> Case:
    """A saved state, changed; the commands that go on from it."""
    text = written(FREE, KEEPS, SAVED, "solve", "-o", "out.csv", "--quiet").decode()
    if random.random() < 0.3:
        data = byte_changes.changed(random, text.encode())
    else:
        for _ in range(random.randint(1, 3)):
            text = random.choice(text_changes.NUMERIC)(random, text, [text])
        data = text.encode("utf-8", "surrogatepass")
    return Case({DECK: FREE.encode(), COMMANDS: GOES_ON.encode(), SAVED: data})


def reload(case: Case, folder: Path) -> str:
    """`adamslite solve` with a RELOAD."""
    case.put_into(folder)
    return call("solve", DECK, "-o", "out.csv", "--quiet", "--cpu-limit", "0.5")


def store(random: Random) -> Case:
    """The file of a sweep, changed."""
    words = ("SPRINGDAMPER/1.K=100:200:3", "--measure", "max POINT_MASS/2.x", "--quiet",
             "--outputs", "POINT_MASS/2.x", "-o", STORE, "--workers", "1", "--threads")  # fmt: skip
    data = byte_changes.changed(random, written(SHORT, "", STORE, "sweep", *words))
    whole = ("sweep", *words) if random.random() < WHOLE else ()
    return Case({DECK: SHORT.encode(), STORE: data}, whole)


def load(case: Case, folder: Path) -> str:
    """A sweep is loaded with its deck; some are gone on with by the command."""
    case.put_into(folder)
    if case.arguments:
        return call(case.arguments[0], DECK, *case.arguments[1:])
    try:
        sweep = adamslite.load_sweep(STORE)
        str(sweep)
        assert len(sweep.outcomes) == len(sweep.values)
        origin_of(sweep)[0].read()
    except (FormatError, UsageError, adamslite.DeckError) as fault:
        assert str(fault)
        return "not read"
    return "read"


def measurement(random: Random) -> Case:
    """A measurement, changed, to which a deck is fitted."""
    if random.random() < 0.2:
        data = byte_changes.changed(random, TABLE.encode())
    else:
        text = text_changes.changed(random, TABLE, [TABLE, material.TABLE])
        data = text.encode("utf-8", "surrogatepass")
    by = ("SPRINGDAMPER/1.K",) if random.random() < 0.5 else ("SPRINGDAMPER/1.K", "POINT_MASS/2.VX")
    return Case({DECK: SHORT.encode(), MEASURED: data}, by if random.random() < WHOLE else ())


@cache
def _run() -> Results:
    return adamslite.simulate(adamslite.read(SHORT))


def fit(case: Case, folder: Path) -> str:
    """A measurement is read as a fit takes it; some are fitted by the command."""
    case.put_into(folder)
    if case.arguments:
        return call("fit", DECK, MEASURED, "--by", *case.arguments, "--quiet")
    try:
        found = measured_of(read_reference(MEASURED), _run())
    except (FormatError, UsageError) as fault:
        assert str(fault)
        return "not read"
    assert not np.isnan(found.bands).any()
    return "read"
