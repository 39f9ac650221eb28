"""Write the decks and references of the belt drives; the closed forms are in belt.py."""

from pathlib import Path

import numpy as np
from belt import Belt
from belt_deck import deck

HERE = Path(__file__).resolve().parent
CREEP = "Belt drive below its capacity: the belt creeps"
SLIDE = "Belt drive beyond its capacity: the belt slides on the driven pulley"
CASES = {
    "creeping": Belt(CREEP, 8, 5, 2.0e4, 0.2, 2.0, 1300.0, (0.4, 0.4), load=2.5),
    "creeping-finer": Belt(
        CREEP,
        12,
        6,
        4.0e4,
        0.05,
        4.0,
        800.0,
        (0.35, 0.5),
        load=0.6,
        inertia=0.02,
    ),  # fmt: skip
    "sliding": Belt(SLIDE, 8, 5, 2.0e4, 0.2, 2.0, 1300.0, (0.6, 0.3), slip=0.8),
    "sliding-finer": Belt(
        SLIDE, 12, 6, 4.0e4, 0.05, 4.0, 800.0, (0.6, 0.25), slip=0.7, inertia=0.02
    ),
}


def measure(kind, name, window, value, tolerance):
    """A line of the reference."""
    start, stop = window
    return f"# measure: {kind} {name} from {start:.6g} to {stop:.6g} = {value:.8g} tol {tolerance}"


def powers(b, window, torque, driven):
    """Lines on mount, torques, powers, heat."""
    lost = torque * (b.turn - driven) * (window[1] - window[0])
    open_energy = f"abs {2e-4 * torque * b.turn * window[1]:.2g}"
    return [
        measure("mean", "JOINT/1.fx", window, -b.pull, "rel 1e-3"),
        measure("mean", "MOTION/1.tz", window, torque, "rel 3e-3"),
        measure("mean", "REQUEST/1.F4", window, torque * driven, "rel 2e-3"),
        measure("range", "REQUEST/1.F6", window, lost, "rel 2e-2"),
        measure("range", "REQUEST/1.F2", (0, window[1]), 0, open_energy),
    ]


def strand(b, frequency, first, tension, tolerance):
    """Line on the tension of a section while it is within a strand."""
    ways = first + 1, first + b.straight - 1
    section, *window = b.passes(frequency, *ways)
    return measure("mean", f"SFORCE/{section}.f", window, -tension, tolerance)


def lines(b):
    """The reference of b."""
    tight, slack = 2 * b.half + b.straight + 1, b.half + 1
    if b.slip:
        torque, driven = b.sliding_torque(), b.slip * b.turn
        half, effect = b.pull / 2, torque / b.radius / np.sinc(1 / b.half / 2) / 2
        frequency = b.state(half + effect, half - effect)[0]
        flux = b.mass * frequency**2 * b.free
        tensions = half + effect + flux, half - effect + flux
    else:
        tensions = b.creeping()
        frequency, driven, _, _, torque = b.state(*tensions)
    window = b.settle, b.settle + b.periods / frequency
    out = powers(b, window, torque, driven)
    if not b.slip:
        creep = 1 - driven / b.turn
        out.append(
            measure("mean", "PART/1003.wz", window, driven, f"abs {0.02 * creep * b.turn:.3g}")
        )
    out.append(strand(b, frequency, tight, tensions[0], "rel 5e-3"))
    out.append(strand(b, frequency, slack, tensions[1], "rel 1e-2"))
    return out, max(float(line.split(" to ")[1].split()[0]) for line in out)


def main():
    for name, b in CASES.items():
        measures, end = lines(b)
        (HERE / f"{name}.adm").write_text(deck(b))
        end = np.ceil(end * 100) / 100
        steps = int(end / 5e-4)
        simulate = f"SIMULATE/DYNAMIC, END={end:g}, STEPS={steps}"
        (HERE / f"{name}.acf").write_text(f"file/model={name}\n{simulate}\nSTOP\n")
        top = [f"# {b.title}: see README.md", "# written by make_reference.py", *measures]
        (HERE / f"{name}.reference.csv").write_text("\n".join(top) + "\n")


if __name__ == "__main__":
    main()
