"""A lumped belt that flows around two pulleys: its closed forms and its deck.

N lumps of mass rho h, joined by sections of free length h, run around a driver at the origin and a
driven pulley at (C, 0), both of radius R.  A tensioner pulls the driven pulley outwards with the
force F.  n lumps lie on each half turn.

Effective tension: a belt of tension T that moves at v pulls a pulley only with tau = T - m f v,
where f is the number of lumps passing in unit time, m f v their momentum.  Hence tau1 + tau2 = F.

Where the belt slides on a whole pulley, tau1/tau2 is `sliding_ratio` of ../formulas.py.

Where the belt grips at the tension T it lies on the radius r = R - P/K (P = 2 tau sin(d/2), normal
force of a lump; K, stiffness of the contact), and a section spans the angle

    d = 2 asin(h (1 + T/EA) / (2 r))

The belt arrives at the driver with T1 and at the driven pulley with T2, and grips where it arrives;
the same number of lumps passes both, f = w1/d1 = w2/d2.  The line of a strand passes the axle at
r cos(x d - d/2), 0 < x < 1, while a lump comes in: a = r sin(d/2)/(d/2) in the mean.
"""

import sys
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np
from scipy.optimize import brentq, fsolve

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from formulas import sliding_ratio  # noqa: E402


@dataclass(frozen=True)
class Belt:
    """Data of a drive [m, kg, N, s]; `slip` is w2/w1 of a driven pulley that is held back."""

    title: str
    half: int  # lumps on half a turn, n
    straight: int  # sections of a strand
    ea: float
    rho: float
    speed: float  # of the driver's rim
    pull: float  # of the tensioner, F
    mu: tuple[float, float]  # driver, driven
    load: float = 0.0  # torque of the driven pulley over its angular velocity [N m s]
    slip: float = 0.0
    radius: float = 0.1
    contact: float = 2.0e6
    contact_damping: float = 40.0
    creep_speed: float = 5.0e-3
    zeta: float = 0.1  # of the sections, against sqrt(EA rho)
    inertia: float = 0.1
    settle: float = 0.3
    periods: int = 12  # of lumps, in the window of the means

    @cached_property
    def chord(self):
        """Stretched length of a section at the start."""
        return 2 * self.radius * np.sin(np.pi / self.half / 2)

    @cached_property
    def free(self):
        """Free length of a section, h."""
        return self.chord / (1 + self.pull / 2 / self.ea)

    @property
    def mass(self):
        """Of a lump."""
        return self.rho * self.free

    @property
    def turn(self):
        """Angular velocity of the driver."""
        return self.speed / self.radius

    @property
    def distance(self):
        """Between the axles at the start."""
        return self.straight * self.chord

    def seat(self, tension, frequency):
        """Radius and angle d of a section where the belt lies at `tension` without sliding."""
        angle = np.pi / self.half
        for _ in range(60):
            stretched = self.free * (1 + tension / self.ea)
            effective = tension - self.mass * frequency * stretched * frequency
            r = self.radius - 2 * effective * np.sin(angle / 2) / self.contact
            angle = 2 * np.arcsin(stretched / 2 / r)
        return r, angle, effective

    def state(self, tight, slack):
        """Lumps per time, w2, effective tensions and torque for the tensions of the strands."""
        f = brentq(lambda f: f * self.seat(tight, f)[1] - self.turn, 1.0, 1e4, xtol=1e-12)
        (r1, d1, tau1), (r2, d2, tau2) = self.seat(tight, f), self.seat(slack, f)
        arms = r1 * np.sinc(d1 / 2 / np.pi), r2 * np.sinc(d2 / 2 / np.pi)
        return f, f * d2, tau1, tau2, tau1 * arms[0] - tau2 * arms[1]

    def creeping(self):
        """Tensions at which the torque is load * w2."""

        def surplus(tensions):
            _, w2, tau1, tau2, torque = self.state(*tensions)
            return tau1 + tau2 - self.pull, torque - self.load * w2

        return fsolve(surplus, [0.7 * self.pull, 0.3 * self.pull], xtol=1e-13)

    def sliding_torque(self):
        """Mean torque on the driven pulley when the belt slides on all of it."""
        q = sliding_ratio(self.mu[1], np.pi, np.pi / self.half)
        arm = self.radius * np.sinc(1 / self.half / 2)
        return self.pull * (q - 1) / (q + 1) * arm

    def passes(self, frequency, first, last):
        """A section and the time it spends between places `first` and `last` of the loop.

        Places count sections as they lie at the start; the one taken gets to `first`
        after `settle`.
        """
        count = 2 * (self.half + self.straight)
        passed = int(np.ceil(self.settle * frequency))
        section, start = (first - passed) % count or count, passed / frequency
        return section, start, start + (last - first) / frequency
