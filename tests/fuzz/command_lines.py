"""Command lines: every command with any of its options, and values that are often odd."""

from __future__ import annotations

from functools import cache
from pathlib import Path
from random import Random

from . import kept_files, material, text_changes
from .calls import call
from .cases import Case

DECK, COMMANDS, TABLE, RESULTS, SWEEP = "deck.adm", "deck.acf", "measured.csv", "run.nc", "runs.nc"
SPEC = "scene.toml"
COLUMN = "POINT_MASS/2.x"
NUMBER = "SPRINGDAMPER/1.K"

#: Values of options, by what they are; "" stands for a flag.
NUMBERS = ("0.02", "0", "1", "2", "1e-3", "-1", "1e300", "1e-300", "nan", "inf", "1e400", "x", "",
           "9" * 30, "0x10", "1_0", "٣", "1e999999999")  # fmt: skip
COUNTS = ("1", "2", "3", "0", "-1", "1.5", "9" * 30, "x", "", "²", "1e2")
FILES = ("out.csv", "out.nc", "out.mat", "out.req", "out.res", "out.parquet", "-", "out", ".csv",
         "", ".", "..", "none/out.csv", DECK, TABLE, RESULTS, "out.csv.part", "a\nb.csv",
         "a\x1b[2J.csv", "/dev/full", "/dev/null", "x" * 300 + ".csv", "out.adm", "out.html",
         "out.png", "con.csv", "out.json", "out.glb")  # fmt: skip
COLUMNS = (COLUMN, "POINT_MASS/2.*", "*", "time", "none", "", "[", "TIME", "*.x",
           "POINT_MASS/2.x*", "\x1b[2J", "POINT_MASS/2.x [mm]", "time [s]")  # fmt: skip
MEASURES = (f"max {COLUMN}", f"min {COLUMN}", f"final {COLUMN}", "max *", "max", "",
            f"mean {COLUMN}", f"rms {COLUMN}", f"max  {COLUMN}", "none x",
            f"max {COLUMN} {COLUMN}")  # fmt: skip
VALUES = (f"{NUMBER}=210", "SPRINGDAMPER/1.C=1:3:2", f"{NUMBER}=1,2", f"{NUMBER}=", "=", NUMBER,
          "x=1", f"{NUMBER}=nan", f"{NUMBER}=1e400", f"{NUMBER}=0", f"{NUMBER}=1:2",
          f"{NUMBER}=1:2:1e9", f"{NUMBER}=1:2:-1", f"{NUMBER}=1:2:0", "POINT_MASS/2.MASS=0",
          "POINT_MASS/2.MASS=-1", "POINT_MASS/2.QG.x=3", f"{NUMBER}=1:2:3:4", f"{NUMBER}=TIME",
          "==", "a=b=c")  # fmt: skip
METHODS = ("GSTIFF", "RADAU", "HHT", "WSTIFF", "none", "", "*")
RUN = {
    "--end": NUMBERS, "--steps": ("1", "3", *COUNTS[:6]), "--integrator": METHODS,
    "--formulation": ("I3", "SI2", "SI1", ""), "--error": NUMBERS, "--hmax": NUMBERS,
    "--cpu-limit": NUMBERS, "--max-steps": COUNTS,
}  # fmt: skip
DECKED = {
    "--user": ("VARSUB=none:none", "VARSUB", "x=", "VARSUB=installed", "VARSUB=os:system"),
    "--allow-path": (".", "..", "none", "", "/"), "--set": VALUES,
}  # fmt: skip
MEMORY = {"--memory-limit": ("1G", "100M", "1", "0", "-1", "x", "", "1e9", "nanG", "9" * 30 + "G")}
OWN_COMMANDS = {"--commands": (COMMANDS, "none", DECK, "", "-")}
ORDINARY = {**RUN, **DECKED, **MEMORY}
PLOTTED = {
    "-o": ("out.png", "out.svg", "out.pdf", *FILES), "--against": (RESULTS, TABLE, DECK, "none"),
    "--x": COLUMNS, "--dark": ("",), "--by": (NUMBER, "none"),
    "--band": ("5:95", "95:5", "a:b", ":"), "--pairs": ("",), "--indices": ("",), **ORDINARY,
}  # fmt: skip
#: Positional arguments with their forms, options, and how often a command is called.
CALLS = {
    "check": ([(DECK, TABLE, "none", "-", ".")], {
        **DECKED, "--format": ("text", "json", "sarif", "gcc", "x")}, 6),
    "solve": ([(DECK, DECK, "none", ".", RESULTS), (COMMANDS, "", "none")], {
        **ORDINARY, "-o": FILES, "--outputs": COLUMNS, "--page": ("out.html", *FILES),
        "--resume": ("out.csv.part", "none"), "--trust": ("",), "--audit": ("",),
        "--no-reduction": ("all", "x", "planar"), "--summary": ("text", "json", "x")}, 6),
    "names": ([(DECK, "none", "."), (*COLUMNS, NUMBER)], DECKED, 4),
    "diff": ([(RESULTS, TABLE, DECK, SWEEP), (RESULTS, TABLE, SWEEP, "none")], {
        "--tol": ("1e-3", "abs 1", "nan", "abs nan", "rel", "", "abs 1e400", "digits 99999999999"),
        "--interpolate": ("linear", "cubic", "x"), "--deck": (DECK, "none"), "--all": ("",)}, 4),
    "fmt": ([(DECK, COMMANDS, TABLE, "none", "-", ".")], {"--check": ("",)}, 3),
    "linear": ([(DECK, "none")], {**DECKED, "--time": NUMBERS, "--rm": ("2", "1", "99", "x", ""),
        "-o": ("out.csv", "out.json", *FILES), "--max-steps": COUNTS}, 4),
    "sens": ([(DECK,)], {"--of": (*MEASURES, f"{COLUMN}@end", f"{COLUMN}@0.01", f"{COLUMN}@nan",
        f"{COLUMN}@1e9", f"{COLUMN}@"), "--by": (NUMBER, "all", "none", "*"), "--adjoint": ("",),
        "-o": FILES, **OWN_COMMANDS, **ORDINARY}, 4),
    "fit": ([(DECK,), (TABLE, RESULTS, DECK, "none")], {"--by": (NUMBER, "all", "none"),
        "--bounds": (f"{NUMBER}=1:1e3", f"{NUMBER}=2:1", f"{NUMBER}=a", "="), "--of": COLUMNS,
        "--from": NUMBERS, "--to": NUMBERS, "-o": FILES, **OWN_COMMANDS, **ORDINARY}, 4),
    "sweep": ([(DECK,), VALUES], {"--sample": ("lhs:3", "saltelli:1", "random:2", "x", "lhs:-1",
        "saltelli:99999999999", "lhs:", "grid"), "--seed": COUNTS, "--measure": MEASURES,
        "--outputs": COLUMNS, "-o": ("out.nc", SWEEP, *FILES), **OWN_COMMANDS, **RUN, **DECKED}, 4),
    "indices": ([(SWEEP, RESULTS, DECK), MEASURES], {"-o": FILES}, 2),
    "plot": ([(RESULTS, SWEEP, TABLE, DECK), COLUMNS], PLOTTED, 1),
    "view": ([(RESULTS, SWEEP, DECK, TABLE)], {**ORDINARY, "--deck": (DECK, "none", TABLE),
        "-o": ("out.html", "out.glb", *FILES[:24]), "--against": (RESULTS, TABLE, "none"),
        "--size": ("10x10", "0x0", "x", "9999999x9999999"), "--along": ("x", "iso", ""),
        "--dark": ("",), "--runs": (SWEEP, RESULTS, "none"), "--channels": COLUMNS}, 2),
    "verify": ([(DECK, ".", "none", TABLE)], {
        **MEMORY, "--share": NUMBERS, "--max-steps": COUNTS}, 1),
    "cable": ([(SPEC, DECK, "none", "."), ], {"-o": FILES, "--trial": NUMBERS}, 1),
    "help": ([("SFORCE", "QP", "x", "", "formats", "integrators", "\x1b[2J", "a/b", "*")], {}, 2),
    "editors": ([("folder", DECK, "")], {}, 1),
    "cache": ([], {}, 1),
    "lsp": ([("x",)], {}, 1),
    "none": ([("x",)], {}, 1),
}  # fmt: skip
#: What keeps a case short, or from a browser.
ALWAYS = {
    "view": ("--no-open",), "sweep": ("--workers", "1", "--threads", "--quiet"),
    "cable": ("--no-trial",),
}  # fmt: skip
#: How often a value is the first one, which is as it should be.
SOUND = 0.6
#: How often a value is changed besides.
CHANGED = 0.1


def line(random: Random) -> Case:
    """A command line, and the files that it names."""
    weights = [each[2] for each in CALLS.values()]
    command = random.choices([*CALLS], weights=weights)[0]
    places, options, _ = CALLS[command]
    words = [command]
    for forms in places:
        chosen = forms[0] if random.random() < SOUND else random.choice(forms)
        words += [_changed(random, chosen)] if chosen else []
    for name in random.sample([*options], min(len(options), random.choice([0, 1, 1, 2, 3]))):
        values = options[name]
        value = values[0] if random.random() < SOUND else random.choice(values)
        words += [name] if values == ("",) else [f"{name}={_changed(random, value)}"]
    words += ALWAYS.get(command, ())
    if command == "fit" and not any(each.startswith("--by") for each in words):
        words += ["--by", NUMBER]
    if command == "sens":
        words += ["--of", f"max {COLUMN}", "--by", NUMBER]
    files = {DECK: kept_files.SHORT.encode(), TABLE: kept_files.TABLE.encode()}
    return Case({**files, **_made(), SPEC: _description().encode()}, tuple(words))


def _changed(random: Random, value: str) -> str:
    """The value, or another one that a command line can hold."""
    if random.random() > CHANGED:
        return value
    changed = text_changes.changed(random, value, [COLUMN], 2)
    return changed.replace("\0", "").replace("\ud800", "")


@cache
def _made() -> dict[str, bytes]:
    """Results and a sweep of the deck."""
    words = (f"{NUMBER}=100:200:3", "--measure", f"max {COLUMN}", "--quiet", "--outputs", COLUMN,
             "-o", SWEEP, "--workers", "1", "--threads")  # fmt: skip
    return {
        RESULTS: kept_files.written(
            kept_files.SHORT, "", RESULTS, "solve", "-o", RESULTS, "--quiet"
        ),
        SWEEP: kept_files.written(kept_files.SHORT, "", SWEEP, "sweep", *words),
    }


@cache
def _description() -> str:
    return min(material.descriptions().texts, key=len)


def typed(case: Case, folder: Path) -> str:
    """The command; what it wrote is removed by the next one."""
    case.put_into(folder)
    try:
        return call(*case.arguments)
    except SystemExit as end:  # of argparse
        assert end.code in (0, 2)
        return "usage" if end.code else "done"
