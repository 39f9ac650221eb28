"""A cable that slips on its pulley, between two spans of varying length: equations and deck.

The cable runs at the speed v = s' towards side 1, the rim at R w; m_w is the cable on the rim, b
the angle of wrap.  With the sliding speed x = v - R w and S a STEP from -1 to 1 over -vs < x < vs

    ln(T1/T2) = mu b S(x) (+ inertia of m_w):   m_w v' = T1 - T2 - F,   I w' = R F - brake
    F = (T1 + T2) tanh(mu b S(x)/2)

The cable grips, creeping at |x| < vs, while T1/T2 stays below q = exp(mu b); it slides at q.

Side j has the free length l_j = l0 + s, l0 - s in N sections of the variable-length element (equal
shares of length and mass, d'Alembert's sign).  With stiff sections its top carries

    T_j = M_j (g - a_j) + (N - 1)/N rho l_j g - (N - 1)/(2 N) rho (l_j a_j + v**2),  a_1 = a = -a_2
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

G = 9.81


@dataclass(frozen=True)
class Pulley:
    """Data of a deck [m, kg, N, s]."""

    title: str
    weights: tuple[float, float]
    radius: float
    inertia: float
    mu: float
    wrap: float
    length: float
    ea: float
    speed: float = 0.0  # at the start
    rise: float = 0.0  # of the brake's torque per time; 0: the pulley is locked
    brake: float = 0.0  # its greatest torque
    rho: float = 0.0
    sections: int = 1
    rim: float = 0.02  # mass of the cable on the rim
    creep: float = 1.0e-3  # sliding speed at which friction is full
    end: float = 1.0

    @cached_property
    def hold(self):
        """(T1 - T2)/(T1 + T2) of a sliding cable."""
        return np.tanh(self.mu * self.wrap / 2)

    def tops(self, s, v):
        """T_j = fixed_j - moving_j a_j at the places and speeds given: two pairs."""
        share, out = (self.sections - 1) / self.sections, []
        for mass, length in zip(self.weights, (self.length + s, self.length - s), strict=True):
            fixed = mass * G + share * self.rho * (length * G - v**2 / 2)
            out.append((fixed, mass + share * self.rho * length / 2))
        return out

    def sliding(self, s, v):
        """Acceleration of a cable that slides towards side 1, and the tensions."""
        (f1, m1), (f2, m2) = self.tops(s, v)
        h = self.hold
        a = (f1 * (1 - h) - f2 * (1 + h)) / (self.rim + m1 * (1 - h) + m2 * (1 + h))
        return a, f1 - m1 * a, f2 + m2 * a

    def gripping(self, s, v, brake):
        """The same for a cable that turns the pulley against a brake."""
        (f1, m1), (f2, m2) = self.tops(s, v)
        a = (f1 - f2 - brake / self.radius) / (m1 + m2 + self.rim + self.inertia / self.radius**2)
        return a, f1 - m1 * a, f2 + m2 * a

    def creeping(self, acceleration, t1, t2):
        """Sliding speed at which friction carries what is asked for."""
        asked = 2 * np.arctanh((t1 - t2 - self.rim * acceleration) / (t1 + t2))
        share = min(1.0, asked / self.mu / self.wrap)
        d = brentq(lambda d: 2 * d * d * (3 - 2 * d) - 1 - share, 0, 1, xtol=1e-14)
        return self.creep * (2 * d - 1)

    def torque(self, t):
        """Greatest torque of the brake at t."""
        return min(self.rise * t, self.brake)

    def motion(self, times):
        """Columns s, v, R w, T1, T2 (nt, 5)."""
        if not self.rise:
            return self.locked(times)
        return self.braked(times)

    @property
    def holds(self):
        """Whether the cable grips a locked pulley at the start."""
        (f1, _), (f2, _) = self.tops(0, 0)
        return (f1 - f2) / (f1 + f2) < self.hold

    @property
    def start(self):
        """Acceleration and speed of the cable at the start."""
        if self.rise:
            return self.gripping(0, self.speed, 0)[0], self.speed
        return (0.0 if self.holds else self.sliding(0, 0)[0]), 0.0

    def locked(self, times):
        """A locked pulley: the cable slides, or creeps where it can hold."""
        zero = 0 * times
        if self.holds:
            (f1, _), (f2, _) = self.tops(0, 0)
            x = self.creeping(0, f1, f2)
            return np.column_stack([x * times, zero + x, zero, zero + f1, zero + f2])
        run = solve_ivp(
            lambda t, y: [y[1], self.sliding(*y)[0]], (0, times[-1]), [0, 0], "DOP853", times,
            rtol=1e-11, atol=1e-12,
        )  # fmt: skip
        tensions = [self.sliding(*y)[1:] for y in run.y.T]
        return np.column_stack([run.y.T, zero, tensions])

    @cached_property
    def slips_at(self):
        """When a growing brake makes the cable slip; massless spans."""
        a = self.sliding(0, 0)[0]
        return brentq(lambda t: self.gripping(0, 0, self.torque(t))[0] - a, 0, 1e3)

    def braked(self, times):
        """A pulley whose brake grows until the cable slips, and then stands; massless spans."""
        slip, (a2, t1, t2) = self.slips_at, self.sliding(0, 0)
        a0, rate = self.gripping(0, 0, 0)[0], (a2 - self.gripping(0, 0, 0)[0]) / self.slips_at
        out = []
        for t in times:
            u, after = min(t, slip), max(t - slip, 0.0)
            s = self.speed * u + a0 * u * u / 2 + rate * u**3 / 6
            v = self.speed + a0 * u + rate * u * u / 2
            a, *pulls = self.gripping(0, 0, self.torque(t)) if t < slip else (a2, t1, t2)
            x = self.creeping(a, *pulls)
            rim = v - x
            if after:
                force = t1 - t2 - self.rim * a2
                fall = self.radius / self.inertia * (self.braking(t) - force * self.radius * after)
                rim = max(0.0, rim - fall)
            out.append([s + v * after + a2 * after**2 / 2, v + a2 * after, rim, *pulls])
        return np.array(out)

    def braking(self, t):
        """Angular momentum that the brake takes from the time of slip to t."""
        full = self.brake / self.rise

        def taken(x):
            return self.rise * min(x, full) ** 2 / 2 + self.brake * max(0.0, x - full)

        return taken(t) - taken(self.slips_at)
