"""A tape drive: equations of reels, rollers, capstan and the tape between them; its deck.

Four spans of fixed geometric length L hold the unstretched length l of tape, e = L/l - 1:

    T = EA (e + beta e'),     l' = what comes in - what goes out   (unstretched length per time)

A roller at the rim speed v passes on tape as it arrives, with the strain of the span before it:
v/(1 + e).  Reels take and give unstretched tape, r w.  Packs of tape of thickness h and mass rho
per length change their radius and inertia with the length s that has left or arrived,

    r**2 = r0**2 -+ h s/pi,    J = J0 + rho pi (r**4 - c**4)/(2 h)     (core of radius c)

The tape that leaves takes its angular momentum along, so that J w' = torque, without a term J' w:
J' = -rho r**3 w is just the flux rho r w times r**2.
"""

from dataclasses import dataclass

import numpy as np
from scipy.integrate import solve_ivp


@dataclass(frozen=True)
class Tape:
    """Data of a tape drive [m, kg, N, s]."""

    title: str
    ea: float
    beta: float
    rho: float
    thickness: float
    spans: tuple[float, float, float, float]
    packs: tuple[float, float]  # radii at the start
    rollers: tuple[float, float, float]  # roller, capstan, roller
    inertias: tuple[float, float, float]
    drag: float  # of the rollers
    pull: float  # tension at rest, from the motors of the reels
    gain: float  # of the capstan's motor
    speed: float  # which it is told to run at
    core: float = 0.01
    core_inertia: float = 2.0e-5
    end: float = 1.5

    @property
    def free(self):
        """Unstretched lengths at the start."""
        return np.array(self.spans) / (1 + self.pull / self.ea)

    def pack(self, side, moved):
        """Radius and inertia of supply (0) and take-up (1) after `moved` metres of tape."""
        sign = (-1, 1)[side]
        r = np.sqrt(self.packs[side] ** 2 + sign * self.thickness * moved / np.pi)
        more = self.rho * np.pi * (r**4 - self.core**4) / 2 / self.thickness
        return r, self.core_inertia + more

    def tape(self, y):
        """Tensions (4,) and rates of the free lengths (4,) in the state y."""
        w, free, moved = y[:5], y[5:9], y[9:]
        rims = w[1:4] * self.rollers
        (ra, _), (rb, _) = self.pack(0, moved[0]), self.pack(1, moved[1])
        length = np.array(self.spans)
        strain = length / free - 1
        flow = np.array([ra * w[0], *(rims / (1 + strain[:3])), rb * w[4]])
        rate = flow[:-1] - flow[1:]
        return self.ea * (strain - self.beta * length * rate / free**2), rate

    def rates(self, y):
        """y' of y = (five angular velocities, four free lengths, tape that left and arrived)."""
        w, moved = y[:5], y[9:]
        (ra, ja), (rb, jb) = self.pack(0, moved[0]), self.pack(1, moved[1])
        t, rate = self.tape(y)
        own = np.array([0, self.gain * (self.speed / self.rollers[1] - w[2]), 0])
        turn = (np.diff(t) * self.rollers - self.drag * w[1:4] + own) / self.inertias
        supply = (t[0] * ra - self.pull * self.packs[0]) / ja
        take_up = (self.pull * self.packs[1] - t[3] * rb) / jb
        return np.concatenate([[supply, *turn, take_up], rate, [ra * w[0], rb * w[4]]])

    def motion(self, times):
        """States at `times` (nt, 11)."""
        start = np.concatenate([np.zeros(5), self.free, np.zeros(2)])
        runs = [
            solve_ivp(lambda _, y: self.rates(y), (0, times[-1]), start, "Radau", times,
                      rtol=rtol, atol=rtol * 1e-2).y.T
            for rtol in (1e-9, 1e-8)
        ]  # fmt: skip
        assert np.allclose(*runs, rtol=1e-6, atol=1e-6)
        return runs[0]
