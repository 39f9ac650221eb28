"""Write the tackles (their stages are in tackle.py) and their references from closed forms."""

import sys
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))

from minimal import write  # noqa: E402  (it lies beside the folders of the cases)
from tackle import (  # noqa: E402
    BLOCK,
    CABLE,
    DOWN,
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
    strand_length,
)  # fmt: skip

#: A tenth of the size [m] and 20 degrees.
ROUGH = (0.36, 20.0)
G, CARGO, EFFORT, HEAD = 9.81, 100.0, 20.0, 5.0
REST = """
Rest, rope forces halved by each stage: see README.md
tolerance: abs 1e-8
tolerance JOINT/*.fx: abs 1e-6
tolerance JOINT/*.fz: abs 1e-6
"""
MOVING = """
Constant accelerations, closed form: see README.md
tolerance: abs 1e-8
tolerance PART/*.y: abs 1e-6
"""


def anchors(stages):
    """Ground markers 1, 2, ... of the beckets and the place of the fall, marker 9."""
    places = [(k, centre(k) - RADIUS, FALL[k - 1], f"becket of stage {k}")
              for k in range(1, stages + 1)]  # fmt: skip
    return places, (9, centre(stages) + RADIUS, 3.8 if stages == 3 else 1.4, "fall")


def drawn(stages, sloppy=(0.02, 3.0), seed=1):
    """The deck of a tackle of `stages` stages, drawn apart by up to `sloppy` metres and degrees,
    its fall tied to the ground.
    """
    words = {1: "One stage", 3: "Three stages"}[stages]
    shift, turn = sloppy
    how = "built misaligned" if shift < 0.1 else "roughly drawn"
    deck = Deck(
        f"{words} of block and tackle, {how}, at rest",
        f"{LOAD:g} N hang on the hook of stage 1; the parts weigh nothing (no gravity):\n"
        "the ropes carry halves of it. "
        f"Every part is up to {100 * shift:g} cm and {turn:g} degrees off its place.\n"
        "Level 1 pulleys. Written by make_reference.py",
        sloppy=sloppy,
        seed=seed,
    )  # fmt: skip
    beckets, fall = anchors(stages)
    deck.ground(*beckets, fall)
    for k in range(1, stages + 1):
        at = HEIGHTS[k - 1]
        deck.stage(k, FALL[k - 1] - at, strand_length(k, stages, fall[2]))
        deck.add(f"JOINT/{100 * k + 10}, SPHERICAL, I={100 * k + 40}, J={k}  ! becket")
        above = 9 if k == stages else 100 * (k + 1) + 1
        deck.add(f"JOINT/{100 * k + 11}, SPHERICAL, I={100 * k + 70}, J={above}", "")
    deck.add(f"VFORCE/1, I=101, JFLOAT=8, RM=7, FX=0\\FY=-{LOAD:g}\\FZ=0")
    deck.add("MARKER/7, PART=1", "MARKER/8, PART=1, FLOATING", "")
    return deck.text(STATIC)


def strands(stages):
    """The reactions on beckets and hooks: name and force [N]."""
    return {f"JOINT/{100 * k + joint}.f{c}": LOAD / 2**k if c == "y" else 0.0
            for k in range(1, stages + 1) for joint in (10, 11) for c in "xzy"}  # fmt: skip


def standing(name, stages, **how):
    """A tackle drawn apart, and its rest."""
    (HERE / f"{name}.adm").write_text(drawn(stages, **how))
    columns = strands(stages)
    write(HERE / f"{name}.reference.csv", REST, list(columns), [[0.0], *columns.values()])


def hoisting():
    """Three stages, a head sheave and an effort weight that lifts the cargo."""
    deck = Deck(
        "Three stages of block and tackle: 20 kg lift 100 kg",
        "The fall goes up over a head sheave to the effort weight. Everything hangs plumb and\n"
        "starts at rest; dummies have their centre of mass on the axle of their pulley.\n"
        "Level 1 pulleys. Written by make_reference.py",
        gravity=f"ACCGRAV/JGRAV=-{G:g}",
    )  # fmt: skip
    beckets, _ = anchors(3)
    head = (centre(3) + 2 * RADIUS, 3.8)
    deck.ground(*beckets, (9, *head, "head sheave"))
    for k in (1, 2, 3):
        at = HEIGHTS[k - 1]
        fall = head[1] - 0.4
        deck.stage(k, FALL[k - 1] - at, strand_length(k, 3, fall))
        deck.add(f"JOINT/{100 * k + 10}, SPHERICAL, I={100 * k + 40}, J={k}  ! becket")
        if k < 3:
            up = 100 * (k + 1) + 1
            deck.add(f"JOINT/{100 * k + 11}, SPHERICAL, I={100 * k + 70}, J={up}", "")
    deck.add(
        "! Head sheave; its rope on the left is the strand of stage 3",
        f"MARKER/372, PART=370, REULER={DOWN}",
    )
    deck.part(410, PULLEY, (INERTIA / 2, INERTIA / 2, INERTIA), 410, head, "head sheave")
    deck.add("MARKER/410, PART=410", "JOINT/401, REVOLUTE, I=410, J=9", "")
    deck.side(420, 410, head, True, 0.0, "fall", up=False, cable=370, joint=402)
    deck.side(450, 410, head, False, 1.0, "effort", up=False, end_mass=EFFORT, joint=406)
    deck.part(500, CARGO, (0.5, 0.5, 0.5), 500, (0.0, -HOOK), "cargo")
    deck.add("MARKER/500, PART=500", "JOINT/501, SPHERICAL, I=500, J=101", "")
    (HERE / "hoisting.adm").write_text(deck.text(DYNAMIC.format(steps=50)))
    t = np.linspace(0, 1, 51)
    a, beckets, mount = closed_form()
    columns = {"PART/500.ay": a, "PART/500.y": -HOOK + a * t**2 / 2, "PART/470.ay": -8 * a,
               "PART/470.y": head[1] - 1.0 - 4 * a * t**2, "JOINT/401.fy": mount}  # fmt: skip
    for k, force in enumerate(beckets, 1):
        columns[f"JOINT/{100 * k + 10}.fy"] = force + CABLE * G
    write(HERE / "hoisting.reference.csv", MOVING, list(columns), [t, *columns.values()])


def closed_form():
    """Acceleration of the cargo, becket forces of stages 1 to 3, mount of the head sheave."""
    dummies = 2 * (LINK + TURRET)
    stage = BLOCK + PULLEY + dummies
    # Masses that rise 1, 2, 4, 8 times as fast as the cargo: blocks with the ropes at their hooks.
    rising = {1: CARGO + stage, 2: stage + CABLE, 4: stage + CABLE, 8: CABLE}
    inertia = sum(m * k**2 for k, m in rising.items()) + EFFORT * 64
    inertia += INERTIA / RADIUS**2 * (1 + 4 + 16 + 64)
    a = (8 * EFFORT - sum(m * k for k, m in rising.items())) * G / inertia
    # The same pulley by pulley, from the cargo up: strand x at the contact, becket x - I a/R^2.
    drag, beckets, load = INERTIA / RADIUS**2, [], CARGO * (G + a)
    for k in (1, 2, 4):
        strand = (load + stage * (G + k * a) + drag * k * a) / 2
        beckets.append(strand - drag * k * a)
        load = strand + CABLE * (G + 2 * k * a)
    effort = load + drag * 8 * a
    assert np.isclose(effort, EFFORT * (G - 8 * a))
    return a, beckets, load + effort + (PULLEY + dummies) * G


if __name__ == "__main__":
    standing("one-stage", 1)
    standing("three-stage", 3)
    standing("rough", 3, sloppy=ROUGH, seed=6)
    hoisting()
