"""Every command that writes files, with what it reads, to be run under faults of the system."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

from adamslite.resources import find

DECK = """\
A mass that swings on a spring and a damper
UNITS/SYSTEM=MKS
PART/1, GROUND
MARKER/1, PART=1
POINT_MASS/2, MASS=2, CM=2, QG=1.2,0,0
MARKER/2, POINT_MASS=2
SPRINGDAMPER/1, TRANSLATIONAL, I=2, J=1, K=150, C=1, LENGTH=1
REQUEST/1, F3=DX(2,1)
INTEGRATOR/GSTIFF, ERROR=1.0E-6
{requested}END
"""
COMMANDS = """\
swing
swing
SIMULATE/DYNAMIC, END=1, STEPS=50
SAVE/FILE=halfway
LINEAR/STATEMAT, FILE=matrices
LINEAR/EIGENSOL, COORDS=1, KINETIC=1
STOP
"""
RUN = "SIMULATE/DYNAMIC, END=1, STEPS=50\n"
FILES = {
    "swing.adm": DECK.format(requested=RUN),
    "asking.adm": DECK.format(requested=f"OUTPUT/REQSAVE\nRESULTS/XRF\n{RUN}"),
    "commanded.adm": DECK.format(requested=""),
    "commanded.acf": COMMANDS,
    "untidy.adm": DECK.format(requested=RUN).replace("PART/1, GROUND", "part/1 , ground"),
}  # fmt: skip


class Writing(NamedTuple):
    """A command, and the files that it writes; what is read is made by :func:`prepare`."""

    command: str
    files: tuple[str, ...]


EDITORS = (
    "adams.snippets.json", "adams.tmLanguage.json", "adams-command.snippets.json",
    "adams-command.tmLanguage.json", "vscode/adams.snippets.json",
    "vscode/adams.tmLanguage.json", "vscode/adams-command.snippets.json",
    "vscode/adams-command.tmLanguage.json", "vscode/extension.js",
    "vscode/language-configuration.json", "vscode/package.json",
)  # fmt: skip
OF_K = "SPRINGDAMPER/1.K"
WRITING = {
    "a table": Writing("solve swing.adm -o out.csv", ("out.csv",)),
    "NetCDF": Writing("solve swing.adm -o out.nc", ("out.nc",)),
    "MATLAB": Writing("solve swing.adm -o out.mat", ("out.mat",)),
    "Parquet": Writing("solve swing.adm -o out.parquet", ("out.parquet",)),
    "ADAMS": Writing("solve swing.adm -o out.res", ("out.res",)),
    "files of OUTPUT and RESULTS": Writing(
        "solve asking.adm -o out.csv", ("out.csv", "out.req", "out.res")
    ),
    "files of SAVE and LINEAR": Writing(
        "solve commanded.adm commanded.acf -o out.csv",
        ("halfway", "out.csv", "out.modes.csv", "out.shapes.csv", "out.kinetic.csv", "matrices"),
    ),
    "a page of a run": Writing("solve swing.adm -o out.csv --page", ("out.csv", "out.html")),
    "a page": Writing("view swing.csv --no-open -o out.html", ("out.html",)),
    "a scene": Writing("view swing.csv --glb -o out.glb", ("out.glb",)),
    "a drawing": Writing("plot swing.csv POINT_MASS/2.x -o out.svg", ("out.svg",)),
    "a picture": Writing("plot swing.csv POINT_MASS/2.x -o out.png", ("out.png",)),
    "modes": Writing("linear swing.adm -o out.csv", ("out.csv",)),
    "a sweep": Writing(
        f"sweep swing.adm {OF_K}=100,200 -o out.nc --workers 1 --outputs POINT_MASS/2.x",
        ("out.nc",),
    ),
    "indices": Writing("indices sampled.nc -o out.csv", ("out.csv",)),
    "derivatives": Writing(
        f"sens swing.adm --of POINT_MASS/2.x --by {OF_K} -o out.csv", ("out.csv",)
    ),
    "a fit": Writing(
        f"fit swing.adm swing.csv --by {OF_K} -o out.adm --plot out.svg", ("out.adm", "out.svg")
    ),
    "a chart": Writing(
        "chart swing.adm -o out --integrator GSTIFF --error 1e-3 1e-4 --repeats 1",
        ("out.csv", "out.png", "out.svg"),
    ),
    "a deck of a cable": Writing("cable hoist.toml -o out.adm --no-trial", ("out.adm",)),
    "a layout": Writing("fmt untidy.adm", ("untidy.adm",)),
    "files of editors": Writing("editors out", tuple(f"out/{name}" for name in EDITORS)),
}  # fmt: skip


def careful() -> list[str]:
    """What begins a command that keeps to the permissions of files: root does not, by itself. Empty
    where the system has no such command.
    """
    if not hasattr(os, "geteuid"):
        return []
    words = ["env"]
    if os.geteuid() == 0:
        words = ["setpriv", "--bounding-set=-dac_override,-dac_read_search"]
    there = shutil.which(words[0]) and not subprocess.call([*words, "true"])
    return words if there else []


CAREFUL = careful()


def prepare(folder: Path) -> None:
    """Put what the commands read into a folder: decks, a description, results, a sample."""
    for name, text in FILES.items():
        (folder / name).write_text(text)
    shutil.copy(find("docs") / "tutorials" / "hoist.toml", folder)
    sample = f"sweep swing.adm {OF_K}=100:200 SPRINGDAMPER/1.C=1:2 --sample saltelli:2 --quiet"
    sampled = [
        *sample.split(),
        *"--workers 1 -o sampled.nc --measure".split(),
        "max POINT_MASS/2.x",
    ]
    for argv in ("solve swing.adm --quiet".split(), sampled):
        done = adamslite(folder, argv)
        assert done.returncode == 0, done.stderr


#: Python's own start ignores the signal of a file that has become too large: writing fails.
LIMITED = """\
import resource, sys
resource.setrlimit(resource.RLIMIT_FSIZE, ({most}, resource.RLIM_INFINITY))
"""
CALL = """\
import sys
from adamslite.cli.main import main
sys.exit(main())
"""


def adamslite(
    folder: Path, argv: Sequence[str], before: str = "", prefix: Sequence[str] = ()
) -> subprocess.CompletedProcess[str]:
    """The command in a process of its own, after some lines of Python."""
    command = [*prefix, sys.executable, "-c", before + CALL, *argv]
    return subprocess.run(command, cwd=folder, capture_output=True, text=True, env=environment())


def environment() -> dict[str, str]:
    """That of a process in another folder which runs this program."""
    return {**os.environ, "PYTHONPATH": str(find("decks").parent)}


def contents(folder: Path) -> dict[str, bytes]:
    """Every file below a folder, hidden ones too, and its content."""
    return {
        str(path.relative_to(folder)): path.read_bytes()
        for path in sorted(folder.rglob("*"))
        if path.is_file()
    }
