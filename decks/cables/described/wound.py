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
DAMPING_TIME = 8.9e-5


class Gripped(Tape):
    """Rollers pass on as much unstretched tape as their rims turn; T = EA (e - tau l' L/l^2) in
    the middle of a span, whose mass lies half at either wheel, T -+ m s" there.
    """

    def tape(self, y: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Tensions (4,) and rates of the free lengths (4,) in the state y."""
        w, free, moved = y[:5], y[5:9], y[9:]
        ra, rb = self.pack(0, moved[0])[0], self.pack(1, moved[1])[0]
        flow = np.array([ra * w[0], *(w[1:4] * self.rollers), rb * w[4]])
        rate, length = flow[:-1] - flow[1:], np.array(self.spans)
        return self.ea * (length / free - 1 - DAMPING_TIME * rate * length / free**2), rate

    def rates(self, y: np.ndarray) -> np.ndarray:
        """y' with the mass of the spans: (J + m r^2) w' = torque - m r r' w of a reel."""
        w, moved = y[:5], y[9:]
        (ra, ja), (rb, jb) = self.pack(0, moved[0]), self.pack(1, moved[1])
        (t, rate), half = self.tape(y), self.halves(y)
        own = np.array([0, self.gain * (self.speed / self.rollers[1] - w[2]), 0])
        more = np.array(self.rollers) ** 2 * (half[:-1] + half[1:])
        turn = (np.diff(t) * self.rollers - self.drag * w[1:4] + own) / (self.inertias + more)
        change = self.thickness / (2 * np.pi) * w[[0, 4]] * (-1, 1)  # r' of the packs
        supply = (t[0] - half[0] * change[0] * w[0]) * ra - self.pull * self.packs[0]
        take_up = self.pull * self.packs[1] - (t[3] + half[3] * change[1] * w[4]) * rb
        ends = supply / (ja + half[0] * ra**2), take_up / (jb + half[3] * rb**2)
        return np.concatenate([[ends[0], *turn, ends[1]], rate, [ra * w[0], rb * w[4]]])

    def halves(self, y: np.ndarray) -> np.ndarray:
        """Mass of half of each span (4,)."""
        return self.rho * y[5:9] / 2

    def starts(self, y: np.ndarray) -> np.ndarray:
        """Tension of each span at the wheel where it begins (4,)."""
        ra, speedup = self.pack(0, y[9])[0], self.rates(y)[:4]
        first = ra * speedup[0] - self.thickness / (2 * np.pi) * y[0] ** 2
        return self.tape(y)[0] - self.halves(y) * [first, *(speedup[1:] * self.rollers)]


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
               enumerate(np.array([tape.starts(row) for row in y]).T)}  # fmt: skip
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
