"""Closed forms of elastic cables: waves, kinks at a sheave, payout, slip of a belt of lumps.

Unstretched cable of stiffness EA [N] and mass rho per unstretched length [kg/m], strain e:

    c = sqrt(EA/rho)               axial wave, in unstretched length
    A(e) = c sqrt(e (1 + e))       transverse wave, in stretched length
    rho c = sqrt(EA rho)           impedance: tension per speed of an axial front

Sources: F. O. Ringleb, Motion and stress of an elastic cable due to impact, J. Appl. Mech. 24(3),
1957, 417; J. C. Smith, F. L. McCrackin, H. F. Schiefer, Textile Res. J. 28, 1958. The forms with
pretension and those at the sheave were derived from the momentum of the fronts:
docs/background/cables.md.
"""

from dataclasses import dataclass
from math import factorial

import numpy as np
from scipy.optimize import brentq

G = 9.81
# First maximum of the integrated Airy function: what a chain of lumps makes of a unit front.
AIRY_PEAK = 1.27435


@dataclass(frozen=True)
class Cable:
    """Stiffness [N], mass per unstretched length [kg/m] and pretension [N]."""

    stiffness: float
    density: float
    pretension: float = 0.0

    @property
    def speed(self) -> float:
        """Axial wave c [m/s]."""
        return float(np.sqrt(self.stiffness / self.density))

    @property
    def impedance(self) -> float:
        """rho c [N s/m]."""
        return self.density * self.speed

    @property
    def strain(self) -> float:
        """That of the pretension."""
        return self.pretension / self.stiffness

    def transverse(self, strain: float) -> float:
        """Transverse wave A(strain) [m/s]."""
        return self.speed * float(np.sqrt(strain * (1 + strain)))


@dataclass(frozen=True)
class Impact:
    """A point of a straight cable meets a hook that moves across at V [m/s] from then on.

    Strain e behind the axial front, e0 before it:

        V^2/c^2 = 2 (e - e0) sqrt(e (1 + e)) - (e - e0)^2
    """

    cable: Cable
    speed: float

    def _solve(self, balance, low: float) -> float:
        return brentq(balance, low, low + 0.1, xtol=1e-17, rtol=1e-14)

    @property
    def strain(self) -> float:
        """Behind the axial front."""
        e0, mach = self.cable.strain, self.speed / self.cable.speed
        return self._solve(
            lambda e: 2 * (e - e0) * np.sqrt(e * (1 + e)) - (e - e0) ** 2 - mach**2, e0
        )

    @property
    def tension(self) -> float:
        """T1 [N]: behind the axial front and behind the kink."""
        return self.cable.stiffness * self.strain

    @property
    def inflow(self) -> float:
        """Speed u = c (e - e0) of the cable between both fronts, towards the hook [m/s]."""
        return self.cable.speed * (self.strain - self.cable.strain)

    @property
    def kink(self) -> float:
        """Speed U = A - u of the kink over the deck [m/s]."""
        return self.cable.transverse(self.strain) - self.inflow

    @property
    def sine(self) -> float:
        """sin of the angle behind the kink, V/A."""
        return self.speed / self.cable.transverse(self.strain)

    @property
    def anchored(self) -> float:
        """T2 [N] where the kink meets an end that does not move.

        With A2 = A(e2), B = c (e2 - e1):  V^2 + 2 (A2 - B) V sin = 2 A2 B - B^2
        """
        c, v, s, e1 = self.cable, self.speed, self.sine, self.strain

        def balance(e2):
            a2, b = c.transverse(e2), c.speed * (e2 - e1)
            return 2 * a2 * b - b**2 - v**2 - 2 * (a2 - b) * v * s

        return c.stiffness * self._solve(balance, e1)

    @property
    def free_running(self) -> float:
        """T2 [N] at a frictionless sheave without inertia that feeds from a long straight run.

        With w = c (e2 - e0):  (A2 + w)^2 = (A2 - B)^2 + 2 (A2 - B) V sin + V^2
        """
        c, v, s, e1 = self.cable, self.speed, self.sine, self.strain

        def balance(e2):
            a2, b, w = c.transverse(e2), c.speed * (e2 - e1), c.speed * (e2 - c.strain)
            return (a2 + w) ** 2 - (a2 - b) ** 2 - 2 * (a2 - b) * v * s - v**2

        return c.stiffness * self._solve(balance, e1)

    @property
    def raw_peak(self) -> float:
        """Highest tension [N] that an undamped chain of lumps shows at the free-running sheave."""
        return self.tension + AIRY_PEAK * (self.free_running - self.tension)


@dataclass(frozen=True)
class Winch:
    """Payout that runs up smoothly to a speed U, with x = t/tau and p the order:

    s" = U/tau x^p/p! exp(-x),   s' = U (1 - exp(-x) sum_i x^i/i!),   i = 0 .. p
    s = U (t - tau (p + 1 - exp(-x) sum_i (p + 1 - i) x^i/i!))
    """

    speed: float
    rise: float
    order: int = 2

    def __call__(self, t: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Payout s, its speed and its acceleration, each shaped like t."""
        x, u, tau, p = t / self.rise, self.speed, self.rise, self.order
        fade = np.exp(-x)
        terms = [x**i / factorial(i) for i in range(p + 1)]
        weighted = sum((p + 1 - i) * term for i, term in enumerate(terms))
        s = u * (t - tau * (p + 1 - weighted * fade))
        return s, u * (1 - sum(terms) * fade), u / tau * terms[p] * fade

    @property
    def text(self) -> str:
        """The same in the deck's language."""
        p, tau = self.order, self.rise
        terms = "".join(
            f"{(p + 1 - i) / factorial(i) / tau**i:+.9g}*TIME**{i}" for i in range(1, p + 1)
        )
        return (
            f"{self.speed:.9g}*(TIME-{tau:.9g}*({p + 1}\n, -({p + 1}{terms})*EXP(-TIME/{tau:.9g})))"
        )


def sliding_ratio(mu: float, wrap: float, section: float) -> float:
    """tau1/tau2 of a lumped belt that slides over the angle `wrap`, the mean over its lumps' ways.

    A section spans the angle d = `section`; x + m + y = wrap/d of them lie on the wheel, the first
    and the last by shares. One lump with the kink a, sliding with the friction mu:

        (tau1 - tau2) cos(a/2) = mu (tau1 + tau2) sin(a/2)
        g(a) = (1 + mu tan(a/2))/(1 - mu tan(a/2)),   tau1/tau2 = g(x d) g(d)^m g(y d), 0 < x < 1
    """
    x = (np.arange(2000) + 0.5) / 2000
    m, y = np.divmod(wrap / section - x, 1)

    def log_g(a):
        t = mu * np.tan(a / 2)
        return np.log((1 + t) / (1 - t))

    ways = log_g(x * section) + m * log_g(section) + log_g(y * section)
    return float(np.exp(ways).mean())
