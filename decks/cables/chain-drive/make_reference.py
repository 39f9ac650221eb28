"""Write the decks and references of the chain drives; the kinematics are in chain.py."""

from pathlib import Path

import numpy as np
from chain import Chain
from chain_deck import deck

HERE = Path(__file__).resolve().parent
CASES = {
    "chain-drive": Chain((8, 12), 8, 2.0, 300.0, 1.0),
    "coarse": Chain((6, 10), 7, 3.0, 400.0, 1.5, pitch=0.06, mass=0.03, ea=2.0e6),
    "equal": Chain((8, 8), 8, 2.0, 300.0, 1.0),
}
"""Teeth, pins of a strand, speed, pull, load."""
PASSES = 3


def reference(c):
    """Instructions of the reference, and the end of the run."""
    period = 2 * np.pi / c.teeth[0] / c.speed
    window = f"from {period:.9g} to {(1 + PASSES) * period:.9g}"
    t = np.linspace(0, period, 801)
    _, distance, rate, _ = c.motion(t).T
    mean = c.teeth[0] / c.teeth[1]
    chordal = np.trapezoid(2 * rate / c.speed * np.cos(c.teeth[0] * c.speed * t), t) / period
    assert abs(np.trapezoid(rate / c.speed, t) / period - mean) < 1e-5
    chordal = round(chordal, 12) + 0.0
    # The pull along the rim that makes pins give way grows as 1 - cos(pi/z): README.md.
    seat = 8e-4 * (1 - np.cos(np.pi / c.teeth[0])) / (1 - np.cos(np.pi / 8))
    lines = [
        f"# {c.teeth[0]} and {c.teeth[1]} teeth, taut strands between polygons: see README.md",
        "# written by make_reference.py",
        f"# measure: mean VARIABLE/ratio {window} = {mean:.9g} tol rel 2e-4",
        f"# measure: mean VARIABLE/chordal {window} = {chordal:.6g} tol abs {seat:.2g}",
        f"# measure: range PART/1003.x {window} = {np.ptp(distance):.6g} tol abs 5e-5",
        f"# measure: range VARIABLE/ahead {window} = {ahead(c, t):.6g} tol abs 1e-3",
        f"# measure: mean MOTION/1.tz {window} = {mean * c.load:.6g} tol rel 5e-2",
    ]
    return lines, np.ceil((1 + PASSES) * period * 20) / 20


def ahead(c, t):
    """Range of the teeth by which the driven sprocket is ahead of the mean ratio."""
    turn = c.motion(t)[:, 0]
    return np.ptp(c.teeth[1] * turn - c.teeth[0] * c.speed * t) / 2 / np.pi


def main():
    for name, c in CASES.items():
        lines, end = reference(c)
        simulate = f"SIMULATE/DYNAMIC, END={end:g}, STEPS={round(end / 1e-3)}"
        (HERE / f"{name}.adm").write_text(deck(c))
        (HERE / f"{name}.acf").write_text(f"file/model={name}\n{simulate}\nSTOP\n")
        (HERE / f"{name}.reference.csv").write_text("\n".join(lines) + "\n")


if __name__ == "__main__":
    main()
