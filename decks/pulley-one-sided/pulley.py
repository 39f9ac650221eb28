"""Kinetic energy and places of a Level 1 pulley in minimal coordinates.

A side is a tangency link at the angle b about the axle z, a turret turned by p about the radius
and a cable of free length u (r, t, z: radius, tangent, axle; w: place along the axle):

    contact = R r(b) + w z,   k = s cos(p) t(b) + sin(p) z,   end = contact + u k
    u = u0 + s R (f - b + b0)

with the turn f of the pulley, s = 1 for a cable that leaves counterclockwise, else -1.
The angular velocity of turret and cable is b' z + p' s r (the axis of the turret is s r).
"""

from dataclasses import dataclass

import sympy as sp
from minimal import rate


@dataclass(frozen=True)
class Side:
    """Data of one side; masses and inertias of link, turret (its contact) and cable (its end)."""

    radius: float
    sense: int
    angle: float
    length: float
    mass: float
    across: float = 0.0
    along: float = 0.0
    turret: float = 0.0
    turret_inertia: float = 0.0
    link_inertia: float = 0.0

    def frame(self, b):
        """Radius and tangent at the angle b."""
        return sp.Matrix([sp.cos(b), sp.sin(b), 0]), sp.Matrix([-sp.sin(b), sp.cos(b), 0])

    def direction(self, b, p):
        """Unit vector k along the cable, away from the pulley."""
        return self.sense * sp.cos(p) * self.frame(b)[1] + sp.sin(p) * sp.Matrix([0, 0, 1])

    def feed(self, f, b):
        """Free length u."""
        return self.length + self.sense * self.radius * (f - b + self.angle)

    def contact(self, b, w=0):
        """Where the cable leaves the pulley."""
        return self.radius * self.frame(b)[0] + w * sp.Matrix([0, 0, 1])

    def end(self, f, b, p, w=0):
        """Place of the end of the cable."""
        return self.contact(b, w) + self.feed(f, b) * self.direction(b, p)

    def kinetic(self, q, v, f, b, p, w=0):
        """Kinetic energy of link, turret and cable."""
        db, dp = v[q.index(b)], v[q.index(p)]
        spin = db * sp.Matrix([0, 0, 1]) + self.sense * dp * self.frame(b)[0]
        twist = spin.dot(self.direction(b, p))
        square = spin.dot(spin)
        speeds = rate(self.end(f, b, p, w), q, v), rate(self.contact(b, w), q, v)
        total = self.mass * speeds[0].dot(speeds[0]) + self.turret * speeds[1].dot(speeds[1])
        total += self.across * (square - twist**2) + self.along * twist**2
        return (total + self.turret_inertia * square + self.link_inertia * db**2) / 2

    def potential(self, g, f, b, p, w=0):
        """Potential energy with the gravitational acceleration -g along y."""
        return g * (self.mass * self.end(f, b, p, w)[1] + self.turret * self.contact(b)[1])
