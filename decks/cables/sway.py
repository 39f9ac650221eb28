"""Sway of a load under a trolley of constant acceleration, in closed form for any amplitude."""

from dataclasses import dataclass

import numpy as np
from formulas import G
from scipy.special import ellipj, ellipk


@dataclass(frozen=True)
class Ramp:
    """Sway of a load under a trolley that starts with the acceleration a, rope of the length l.

    In the trolley gravity is g_e = sqrt(g^2 + a^2), at the angle atan(a/g). The load swings about
    it from rest, with the amplitude |atan(a/g)|: with w^2 = g_e/l, k = sin(amplitude/2)

        sin(angle/2) = k cd(w t, k),    period 4 K(k)/w
    """

    acceleration: float
    length: float

    def swing(self, amplitude: float, gravity: float, t: np.ndarray) -> np.ndarray:
        """Angle and its rate [rad, rad/s] of a pendulum let go at t = 0: (2, nt)."""
        w, m = np.sqrt(gravity / self.length), np.sin(amplitude / 2) ** 2
        sn, cn, dn, _ = ellipj(w * t, m)
        angle = 2 * np.arcsin(np.sin(amplitude / 2) * cn / dn)
        rate = -2 * np.sin(amplitude / 2) * w * (1 - m) * sn / dn**2
        return np.array([angle, rate / np.cos(angle / 2)])

    @property
    def tilt(self) -> float:
        """Angle of the apparent vertical [rad]."""
        return float(np.arctan(-self.acceleration / G))

    @property
    def gravity(self) -> float:
        """g_e [m/s^2]."""
        return float(np.hypot(G, self.acceleration))

    @property
    def period(self) -> float:
        """Of the swing while the trolley accelerates [s]."""
        return 4 * ellipk(np.sin(self.tilt / 2) ** 2) * np.sqrt(self.length / self.gravity)

    def accelerating(self, t: np.ndarray) -> np.ndarray:
        """Angle from the vertical, its rate, pull per mass: (3, nt)."""
        angle, rate = self.swing(-self.tilt, self.gravity, t)
        pull = self.length * rate**2 + self.gravity * np.cos(angle)
        return np.array([self.tilt + angle, rate, pull])

    def coasting(self, amplitude: float, t: np.ndarray) -> np.ndarray:
        """The same under a trolley of constant speed, let go at `amplitude`."""
        angle, rate = self.swing(amplitude, G, t)
        return np.array([angle, rate, self.length * rate**2 + G * np.cos(angle)])


def no_sway(ramp: Ramp, cruise: float, t: np.ndarray) -> np.ndarray:
    """Starts and stops for one period each: (3, nt)."""
    ends = np.cumsum([ramp.period, cruise, ramp.period])
    at_rest = np.array([np.zeros_like(t), np.zeros_like(t), np.full_like(t, G)])
    back = Ramp(-ramp.acceleration, ramp.length)
    starts, stops = t < ends[0], (t >= ends[1]) & (t < ends[2])
    return np.where(
        starts, ramp.accelerating(t), np.where(stops, back.accelerating(t - ends[1]), at_rest)
    )


def most_sway(ramp: Ramp, t: np.ndarray) -> np.ndarray:
    """Starts for half a period: at its end the load hangs back by 2 atan(a/g) and rests."""
    half = ramp.period / 2
    coasts = ramp.coasting(2 * ramp.tilt, t - half)
    return np.where(t < half, ramp.accelerating(t), coasts)
