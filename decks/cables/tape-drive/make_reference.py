"""Write the decks and references of the tape drives; the equations are in tape.py."""

from pathlib import Path

import numpy as np
from tape import Tape
from tape_deck import deck

HERE = Path(__file__).resolve().parent
CASES = {
    "tape-drive": Tape(
        "Tape drive started by its capstan: reels whose packs shrink and grow, rollers",
        5000, 1e-3, 4.4e-4, 25e-6, (0.2, 0.3, 0.2, 0.3), (0.05, 0.03), (0.015, 0.02, 0.015),
        (1e-5, 5e-5, 1e-5), 2e-6, 1.5, 2e-4, 5.0, end=2.5,
    ),
    "tape-drive-wide": Tape(
        "Tape drive with a wide, thick tape that is fast drawn off a small pack",
        30000, 5e-4, 4e-3, 1e-4, (0.2, 0.3, 0.2, 0.3), (0.05, 0.06), (0.02, 0.03, 0.025),
        (5e-5, 3e-4, 8e-5), 1e-5, 8.0, 1.5e-3, 8.0, core_inertia=1e-4, end=1.5,
    ),
}  # fmt: skip
LINES = """# {title}: see README.md
# tolerance: abs {force:g}
# tolerance VARIABLE/w*: abs {turn:g}
# tolerance VARIABLE/r*: abs 1e-8
# tolerance REQUEST/capstan.F6: abs {torque:g}
# written by make_reference.py
"""


def columns(tape, times):
    """Columns of the reference."""
    y = tape.motion(times)
    w, moved = y[:, :5], y[:, 9:]
    t = np.array([tape.tape(row)[0] for row in y])
    out = {f"VARIABLE/w{10 * (k + 1)}": w[:, k] for k in range(5)}
    out |= {f"VARIABLE/T{k + 1}": t[:, k] for k in range(4)}
    out["VARIABLE/r10"] = tape.pack(0, moved[:, 0])[0]
    out["VARIABLE/r50"] = tape.pack(1, moved[:, 1])[0]
    out |= {"REQUEST/capstan.F2": -t[:, 1], "REQUEST/capstan.F3": -t[:, 2]}
    out["REQUEST/capstan.F6"] = tape.gain * (tape.speed / tape.rollers[1] - w[:, 2])
    steady(tape, y[-1], t)
    return out


def steady(tape, y, t):
    """At the end unstretched tape passes all wheels at one rate, and nowhere it is slack."""
    rims = y[1:4] * tape.rollers / (1 + t[-1, :3] / tape.ea)
    assert np.ptp(rims) < 1e-4 * rims.mean()
    assert t.min() > 0


def main():
    for name, tape in CASES.items():
        times = np.linspace(0, tape.end, 151)
        table = columns(tape, times)
        spin = tape.speed / min(tape.rollers)
        lines = LINES.format(
            title=tape.title, force=5e-5 * tape.pull, turn=3e-7 * spin,
            torque=3e-7 * tape.gain * spin,
        )  # fmt: skip
        rows = np.column_stack([times, *table.values()]) + 0.0
        text = "\n".join(",".join(f"{x:.11g}" for x in row) for row in rows)
        header = ",".join(["time", *table])
        (HERE / f"{name}.reference.csv").write_text(f"{lines}{header}\n{text}\n")
        (HERE / f"{name}.adm").write_text(deck(tape))
        simulate = f"SIMULATE/DYNAMIC, END={tape.end:g}, STEPS=150"
        (HERE / f"{name}.acf").write_text(f"file/model={name}\n{simulate}\nSTOP\n")


if __name__ == "__main__":
    main()
