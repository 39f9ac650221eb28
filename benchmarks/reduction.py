"""What the reductions of a model save: CPU of a run with all of them and without one.

The decks are reference decks of the project, each with the rules that apply to it.  ``+ n``: with n
further parts FIXED to each of its own, as machines have that are drawn piece by piece.
"""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from statistics import median

import numpy as np

import adamslite
from adamslite.deck.deck import Deck
from adamslite.deck.redefinition import Command
from adamslite.equations.result_columns import ALIGNED
from adamslite.model.attitude_angles import angles_313
from adamslite.model.model import Body, Model
from adamslite.scene import load_scene
from benchmarks.figures import Figure

DECKS = Path(__file__).parent.parent / "decks"
SCENES = {
    "four-bar/four-bar": ("plane",),
    "slider-crank/slider-crank": ("plane",),
    "andrews/andrews": ("plane",),
    "a02-n40/a02-n40": ("plane",),
    "cables/belt-drive/creeping": ("plane", "points"),
    "pulley-drive/pulley-drive": ("plane", "variables"),
    "cable-level3-n40/cable-level3-n40": ("plane", "points", "variables"),
    "swinging-cable-n50/swinging-cable-n50": ("points",),
    "a02-n2/a02-n2": ("plane",),
    "car-axis/car-axis": ("points",),
    "cable-level3-n10/cable-level3-n10": ("plane", "points", "variables"),
    "hanging-mass/hanging-mass": ("points",),
    "atwood/atwood-coupler": ("fixed", "plane"),
    "cables/winches/reeved": ("fixed",),
    "cables/winches/reeved-heavy": ("fixed",),
    "cables/pulley-slip/heavy": ("fixed",),
    "cables/sheave-mount/sheave-mount": ("fixed",),
    "cables/described/mount": ("fixed",),
    "a02-n2/a02-n2 + 1": ("fixed",),
    "slider-crank/slider-crank + 1": ("fixed",),
    "slider-crank/slider-crank + 3": ("fixed",),
    "andrews/andrews + 1": ("fixed",),
    "bricard/bricard + 1": ("fixed",),
    "heavy-top/heavy-top + 2": ("fixed",),
    "pendulum-revolute/pendulum-revolute + 2": ("fixed",),
}
PIECE = """PART/{part}, MASS={mass!r}, CM={marker}, IP={moments}
, QG={place}, REULER={angles}
, {started}
MARKER/{marker}, PART={part}
MARKER/{own}, PART={base}, QP={centre}
JOINT/{part}, FIXED, I={marker}, J={own}"""
SPEEDS = ("VX", "VY", "VZ", "WX", "WY", "WZ")
#: Ids of what is added, and masses of the pieces as shares of the part's.
FIRST, SHARE = 9_000_000, 0.01
#: One run after the other until this much CPU [s] is used, but at least this many of each.
PATIENCE, FEWEST = 10.0, 2


def scene_of(name: str) -> tuple[Deck, Iterable[Command]]:
    """A deck with its commands; ``name + n`` with n pieces FIXED to every part of it."""
    path, _, pieces = name.partition(" + ")
    scene = load_scene(DECKS / f"{path}.adm")
    if not pieces:
        return scene.deck, scene.commands
    model = adamslite.assemble(scene.deck)
    parts = [body for body in model.bodies if body.statement.keyword == "PART" and body.mass]
    found = [_piece(FIRST + 10 * k, model, body) for k, body in enumerate(parts * int(pieces))]
    lines = scene.deck.source.text.rstrip().splitlines()
    at = next(k for k, line in enumerate(lines) if line.strip().upper() == "END")
    return adamslite.read("\n".join([*lines[:at], *found, "END", ""])), scene.commands


def _piece(number: int, model: Model, body: Body) -> str:
    """A part of a hundredth of the mass at the mass centre of another, which moves as that does."""
    ucf = model.deck.ucf
    centre, _ = model.marker_in_body(body.statement.cm)
    angles = angles_313(body.attitude[None], ALIGNED)[0]
    speeds = zip(SPEEDS, (*body.v, *(body.attitude.T @ body.w)), strict=True)
    started = ", ".join(f"{word}={float(value)!r}" for word, value in speeds)
    return PIECE.format(
        part=number, marker=number + 1, own=number + 2, base=body.statement.key,
        mass=SHARE * body.mass * ucf, moments=_list(SHARE * ucf * np.diag(body.inertia)),
        place=_list(body.x), angles=_list(angles), started=started, centre=_list(centre),
    )  # fmt: skip


def _list(values: np.ndarray) -> str:
    return ",".join(repr(float(value)) for value in values)


def reduction(repeats: int) -> list[Figure]:
    """CPU of every run, and how many times that of the reduced model it is."""
    found = []
    for path, rules in SCENES.items():
        deck, commands = scene_of(path)
        tried = [(), *((rule,) for rule in rules)]
        cpu: dict[tuple[str, ...], list[float]] = {left_off: [] for left_off in tried}
        turns = 0
        while turns < FEWEST or (turns < repeats and sum(map(sum, cpu.values())) < PATIENCE):
            for left_off in tried:
                results = adamslite.simulate(deck, commands=commands, no_reduction=left_off)
                cpu[left_off].append(results.summary["solve_cpu_s"])
            turns += 1
        name, reduced = path.rpartition("/")[2], median(cpu[()])
        found.append(Figure("reduction", name, 1e3 * reduced, "ms"))
        for rule in rules:
            factor = median(cpu[rule,]) / reduced
            found.append(Figure("reduction", f"{name} without {rule}", factor, "times that"))
    return found
