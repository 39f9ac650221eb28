"""Write the tackles with springs in their ropes, and their references by linear modes."""

import sys
from pathlib import Path

import numpy as np
from scipy.linalg import eigh

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.parent), str(HERE.parent / "tackle")]

from minimal import solve, write  # noqa: E402  (it lies beside the folders of the cases)
from tackle import (  # noqa: E402
    BLOCK,
    CABLE,
    DYNAMIC,
    FALL,
    HEIGHTS,
    HOOK,
    INERTIA,
    LINK,
    LOAD,
    PULLEY,
    RADIUS,
    STATIC,
    TURRET,
    Deck,
    centre,
)  # fmt: skip

CARGO, FREE, SPEED = 50.0, 0.2, 0.2
STIFF = np.array([40000.0, 10000.0, 5000.0])
FORCES = LOAD / 2 ** np.arange(1, 4)
TOP = 3.8
REST = """
Rest of a tackle with springs: see README.md
tolerance: abs 1e-10
tolerance SPRINGDAMPER/*: abs 1e-6
tolerance JOINT/*: abs 1e-6
"""
MOVING = """
Vibration of a tackle with springs, linear modes: see README.md
tolerance: abs 1e-6
tolerance *.vy: abs 1e-4
tolerance SPRINGDAMPER/*: abs 1e-2
"""


def tackle(deck):
    """Three stages whose strands end in springs below the hook above; stretched if not sloppy."""
    deck.ground(*((k, centre(k) - RADIUS, FALL[k - 1], "becket") for k in (1, 2, 3)),
                (9, centre(3) + RADIUS, TOP, "fall"))  # fmt: skip
    for k in (1, 2, 3):
        at = HEIGHTS[k - 1]
        above = TOP if k == 3 else HEIGHTS[k] - HOOK
        stretched = FREE + FORCES[k - 1] / STIFF[k - 1]
        deck.stage(k, FALL[k - 1] - at, above - at - stretched)
        deck.add(f"JOINT/{100 * k + 10}, SPHERICAL, I={100 * k + 40}, J={k}  ! becket")
        hook = 9 if k == 3 else 100 * (k + 1) + 1
        deck.add(f"SPRINGDAMPER/{k}, TRANSLATIONAL, I={100 * k + 70}, J={hook}")
        deck.add(f", K={STIFF[k - 1]:g}, LENGTH={FREE:g}")
        deck.add(f"VARIABLE/stretch{k}, FUNCTION=DM({100 * k + 70},{hook})-{FREE:g}", "")
    deck.part(500, CARGO, (0.5, 0.5, 0.5), 500, (0.0, -HOOK), "cargo")
    deck.add("MARKER/500, PART=500", "JOINT/501, SPHERICAL, I=500, J=101")
    deck.add(f"VFORCE/1, I=500, JFLOAT=8, RM=7, FX=0\\FY=-{LOAD:g}\\FZ=0")
    deck.add("MARKER/7, PART=1", "MARKER/8, PART=1, FLOATING", "")


def at_rest():
    deck = Deck(
        "Three stages of block and tackle with springs in the ropes, built misaligned, at rest",
        "The tackle of ../tackle with a spring between each strand and the hook above it.\n"
        "Written by make_reference.py",
        sloppy=(0.02, 3.0), seed=2,
    )  # fmt: skip
    tackle(deck)
    (HERE / "rest.adm").write_text(deck.text(STATIC))
    columns = {f"VARIABLE/stretch{k}": FORCES[k - 1] / STIFF[k - 1] for k in (1, 2, 3)}
    columns |= {f"JOINT/{100 * k + 10}.fy": FORCES[k - 1] for k in (1, 2, 3)}
    write(HERE / "rest.reference.csv", REST, list(columns), [[0.0], *columns.values()])


def moving(line):
    """Speeds of what moves with block 1, added to the line that opens its part."""
    number = line.removeprefix("PART/").partition(",")[0]
    if not line.startswith("PART/") or number not in SPEEDS:
        return line
    return line + SPEEDS[number]


SPEEDS = {str(n): f", VY={SPEED:g}" for n in (100, 120, 130, 150, 160, 500)} | {
    "110": f", VY={SPEED:g}, WZ={SPEED / RADIUS:g}", "170": f", VY={2 * SPEED:g}",
}  # fmt: skip


def modes():
    """Mass matrix, stretches and stiffness matrix of the ways of the three blocks."""
    stage = BLOCK + PULLEY + 2 * (LINK + TURRET) + INERTIA / RADIUS**2 + 4 * CABLE
    mass = np.diag([CARGO + stage, stage, stage])
    stretch = np.array([[-2.0, 1, 0], [0, -2, 1], [0, 0, -2]])
    return mass, stretch, stretch.T @ np.diag(STIFF) @ stretch


def vibrating():
    deck = Deck(
        "Three stages of block and tackle with springs in the ropes, vibrating",
        "Drawn at rest under the load; the cargo is knocked upwards at 0.2 m/s, and what hangs on\n"
        "block 1 moves with it. Written by make_reference.py",
    )  # fmt: skip
    tackle(deck)
    deck.lines = [moving(line) for line in deck.lines]
    (HERE / "vibration.adm").write_text(deck.text(DYNAMIC.format(steps=100)))
    t = np.linspace(0, 1, 101)
    mass, stretch, stiffness = modes()
    squares, shapes = eigh(stiffness, mass)
    w = np.sqrt(squares)
    amplitude = (shapes.T @ mass @ [SPEED, 0, 0]) / w
    way = shapes @ (amplitude[:, None] * np.sin(np.outer(w, t)))
    speed = shapes @ (amplitude[:, None] * w[:, None] * np.cos(np.outer(w, t)))
    inverse = np.linalg.solve(mass, stiffness)
    run = solve(lambda _, y: np.concatenate([y[3:], -inverse @ y[:3]]), [0, 0, 0, SPEED, 0, 0], t)
    assert np.allclose(run.T, np.vstack([way, speed]), rtol=0, atol=1e-9)
    force = FORCES[:, None] + STIFF[:, None] * (stretch @ way)
    assert force.min() > 0
    columns = {"PART/500.y": -HOOK + way[0], "PART/500.vy": speed[0]}
    columns |= {f"PART/{100 * k}.y": HEIGHTS[k - 1] + way[k - 1] for k in (1, 2, 3)}
    columns |= {f"SPRINGDAMPER/{k}.f": -force[k - 1] for k in (1, 2, 3)}
    lines = MOVING + "natural frequencies [rad/s]: " + ", ".join(f"{x:.9g}" for x in w)
    write(HERE / "vibration.reference.csv", lines, list(columns), [t, *columns.values()])


if __name__ == "__main__":
    at_rest()
    vibrating()
