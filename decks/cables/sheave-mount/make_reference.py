"""Write the references of the sheave on a bracket: two coordinates, and momentum balances."""

import sys
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import sympy as sp

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1]))

from minimal import coordinates, equations, solve, write  # noqa: E402  (beside the cases)

G = 9.81
LINES = """
Lagrange's equations in two coordinates, balances of momentum: see README.md
tolerance: abs {load:g}
tolerance REQUEST/cable.*: abs 1e-6
tolerance REQUEST/cable.F3: abs 1e-6
tolerance REQUEST/cable.F6: abs {load:g}
tolerance REQUEST/cable.F7: abs 1e-6
"""


@dataclass(frozen=True)
class Sheave:
    """Data of a deck: weights, sheave, bracket (foot), lengths, swing at the start."""

    left: float
    right: float
    radius: float
    foot: tuple[float, float]
    mass: float
    inertia: float
    drag: float
    left_length: float
    right_length: float
    swing: float
    right_inertia: float
    bracket: float = 20.0

    def weights(self, q):
        """Places of both weights and the length of the right side at the turn f and lean b."""
        f, b = q
        length = self.right_length - self.radius * (f - b)
        left = sp.Matrix([-self.radius, -self.left_length - self.radius * f])
        right = self.radius * sp.Matrix([sp.cos(b), sp.sin(b)])
        return left, right + length * sp.Matrix([sp.sin(b), -sp.cos(b)]), length

    def solve(self, times):
        """Columns of the reference."""
        q, v = coordinates("f b")
        left, right, length = self.weights(q)
        speeds = [place.jacobian(q) * sp.Matrix(v) for place in (left, right)]
        kinetic = (
            self.left * speeds[0].dot(speeds[0]) + self.right * speeds[1].dot(speeds[1])
            + self.inertia * v[0] ** 2 + self.right_inertia * v[1] ** 2
        ) / 2  # fmt: skip
        potential = G * (self.left * left[1] + self.right * right[1])
        rhs = equations(q, v, kinetic, potential, [-self.drag * v[0], 0])
        y = solve(rhs, [0, 0, 0, self.swing], times)
        assert np.allclose(solve(rhs, [0, 0, 0, self.swing], times, 1e-9), y, rtol=0, atol=1e-6)
        a = sp.symbols("a_f a_b")
        state = [*q, *v, *a]
        rates = sp.Matrix([*v, *a])
        momentum = self.left * speeds[0] + self.right * speeds[1]
        spin = self.inertia * v[0] + self.right_inertia * v[1]
        for mass, place, speed in zip((self.left, self.right), (left, right), speeds, strict=True):
            arm = place - sp.Matrix(self.foot)
            spin += mass * (arm[0] * speed[1] - arm[1] * speed[0])
        change = sp.Matrix([*momentum, spin]).jacobian(state[:4]) * rates
        weight = self.left * left[0] + self.right * right[0]
        weight += -(self.left + self.right + self.mass + self.bracket) * self.foot[0]
        total = (self.left + self.right + self.mass + self.bracket) * G
        bearing = change[:2, 0] + sp.Matrix([0, total - self.bracket * G])
        columns = {
            "REQUEST/mount.F2": -change[0],
            "REQUEST/mount.F3": -change[1] - total,
            "REQUEST/mount.F8": -change[2] - G * weight,
            "REQUEST/cable.F2": sp.pi - q[1],
            "REQUEST/cable.F3": self.radius * v[0],
            "REQUEST/cable.F4": length,
            "REQUEST/cable.F6": sp.sqrt(bearing.dot(bearing)),
            "REQUEST/cable.F7": self.drag * v[0],
        }
        found = sp.lambdify(state, list(columns.values()))
        second = [rhs(0, row)[2:] for row in y]
        return dict(zip(columns, found(*np.column_stack([y, second]).T), strict=True))


def main():
    cases = {
        "sheave-mount": (Sheave(6, 4, 0.2, (0.3, -1.5), 5, 0.1, 0.2, 1.5, 1.2, 0.8, 0.01), 0.9),
        "sheave-mount-small": (
            Sheave(1, 1.5, 0.05, (-0.8, -0.4), 0.6, 0.001, 0.01, 0.6, 0.4, -2, 0.001), 0.5,
        ),
    }  # fmt: skip
    for name, (sheave, end) in cases.items():
        times = np.linspace(0, end, 91)
        columns = sheave.solve(times)
        lines = LINES.format(load=1e-6 * (sheave.left + sheave.right))
        write(HERE / f"{name}.reference.csv", lines, list(columns), [times, *columns.values()])


if __name__ == "__main__":
    main()
