"""Hand-coded C on S1 and S2: the limit, not a product. Its sources stay outside of the project.

``BENCHMARKS_LIMIT`` names their folder; its Makefile builds ``genalpha``, ``rk4`` and
``verlet_soa``, which read the model as the flat file written here.
"""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import tempfile
from functools import cache, partial
from pathlib import Path
from typing import Any

import numpy as np

from benchmarks.peers.exudyn_chain import explicit_ladder, implicit_ladder
from benchmarks.peers.program import Program, Settings, Solution
from benchmarks.scenes import Chain, chain

VARIABLE = "BENCHMARKS_LIMIT"


def installed() -> bool:
    """Whether the folder has been named, and there is a compiler."""
    tools = all(shutil.which(tool) for tool in ("make", os.environ.get("CC", "cc")))
    return bool(os.environ.get(VARIABLE)) and tools


@cache
def workshop() -> tempfile.TemporaryDirectory:
    """A folder for the built programs and their files, removed at the end."""
    folder = tempfile.TemporaryDirectory(prefix="benchmarks-limit-")
    command = ["make", "-s", "-C", os.environ[VARIABLE], f"BIN={folder.name}"]
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
    return folder


def write(c: Chain, path: Path) -> None:
    """The flat file: counts, constants, anchors, masses, positions, velocities."""
    right = np.zeros(3) if c.right is None else c.right
    with path.open("wb") as file:
        np.array([c.n, c.n_segments, c.right is not None, c.n // 2], dtype=np.int32).tofile(file)
        np.array([c.k, c.d, c.l0, c.gravity, c.end]).tofile(file)
        for values in (c.left, right, c.mass, c.position, c.velocity):
            values.tofile(file)


def solve(name: str, extra: list[str], scene: str, n: int, settings: Settings) -> Solution:
    """Run one of the C programs; it times itself."""
    folder = Path(workshop().name)
    model, out = folder / f"{scene}-{n}.bin", folder / "out.bin"
    write(chain(scene, n), model)
    command = [folder / name, model, str(settings["steps"]), *extra, out]
    told = subprocess.run(command, check=True, capture_output=True, text=True).stdout
    run = json.loads(told)
    values = np.fromfile(out).reshape(n, 3)
    ok = not run.get("rc", 0) and bool(np.isfinite(values).all())
    return Solution(values, run["setup_cpu"], run["solve_cpu"], settings["steps"], ok)


def program(title: str, name: str, extra: list[str], ladder: Any, order: int) -> Program:
    """One C program."""
    run = partial(solve, name, extra)
    return Program(
        f"C {title}", "limit", ("S1", "S2"), ladder, run, installed, order, compiles=True
    )


# Spectral radius 0.9, Newton tolerance 1e-8 m, full Newton.
PROGRAMS = [
    program("generalised alpha", "genalpha", ["0.9", "1e-8", "0"], implicit_ladder, 2),
    program("RK4", "rk4", [], partial(explicit_ladder, 2.6), 4),
    program("Verlet", "verlet_soa", [], partial(explicit_ladder, 1.8), 2),
]
