"""The reference of `reels`: the tape drive of ../tape-drive with what its description has."""

import sys
from math import dist
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.parent), str(HERE.parent / "tape-drive")]

from spans import table  # noqa: E402
from tape import Tape  # noqa: E402

PLACES = ((0, 0), (0, 0.2), (0.3, 0.2), (0.3, 0), (0.6, 0))
# Radii, positive for wheels that the tape turns counterclockwise.
TURNED = (0.05, -0.015, -0.02, 0.015, 0.03)


class Gripped(Tape):
    """Rollers pass on as much unstretched tape as their rims turn; T = EA e - z l' L/l."""

    @property
    def damper(self) -> float:
        """Half the critical damping of a section."""
        return 0.5 * 2 * np.sqrt(self.ea * self.rho)

    def tape(self, y: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Tensions (4,) and rates of the free lengths (4,) in the state y."""
        w, free, moved = y[:5], y[5:9], y[9:]
        ra, rb = self.pack(0, moved[0])[0], self.pack(1, moved[1])[0]
        flow = np.array([ra * w[0], *(w[1:4] * self.rollers), rb * w[4]])
        rate, length = flow[:-1] - flow[1:], np.array(self.spans)
        return self.ea * (length / free - 1) - self.damper * rate * length / free, rate


def drive() -> Gripped:
    """The description: free pieces between the circles are tangents."""
    wheels = list(zip(PLACES, TURNED, strict=True))
    spans = tuple(
        float(np.sqrt(dist(p, q) ** 2 - (b - a) ** 2))
        for (p, a), (q, b) in zip(wheels, wheels[1:], strict=False)
    )
    return Gripped(
        "", 5000, 0, 4.4e-4, 25e-6, spans, (0.05, 0.03), (0.015, 0.02, 0.015), (1e-5, 5e-5, 1e-5),
        0, 1.5, 2e-4, 5.0, end=2.5,
    )  # fmt: skip


def reels() -> str:
    """Tensions, speeds of the wheels, radii of the packs."""
    tape, t = drive(), np.linspace(0, 2.5, 151)
    y = tape.motion(t)
    columns = {f"REQUEST/{p + 1}.F2": pull for p, pull in
               enumerate(np.array([tape.tape(row)[0] for row in y]).T)}  # fmt: skip
    packs = [tape.pack(side, y[:, 9 + side])[0] for side in (0, 1)]
    rims = (packs[0], *tape.rollers, packs[1])
    for i, rim in enumerate(rims):
        columns[f"REQUEST/{10 * (i + 1)}.F3"] = rim * y[:, i]
    columns |= {"VARIABLE/R_10": packs[0], "VARIABLE/R_50": packs[1]}
    lines = [
        "Tensions, speeds of rims, radii of packs: README.md",
        "written by describe.py",
        "tolerance REQUEST/*.F2: abs 2.3e-3",
        "tolerance REQUEST/*.F3: abs 1e-4",
        "tolerance VARIABLE/R_*: abs 3e-8",
    ]
    return table(["time", *columns], lines, [t, *columns.values()], 1e-7)
