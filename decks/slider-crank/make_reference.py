"""Write the references of slider cranks: closed form when driven, one coordinate when free."""

import sys
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import sympy as sp

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))

from minimal import coordinates, equations, solve, write  # noqa: E402  (beside the cases)

FREE = """
One coordinate, DOP853 at rtol 1e-12: see README.md
tolerance: abs 1e-6
tolerance VARIABLE/crank: abs 1e-5
tolerance PART/2.wz: abs 2e-3
"""
EQUAL = """
The branch on which rod and crank mirror each other, one coordinate: see README.md
tolerance: abs 1e-4
tolerance PART/2.wz: abs 1e-3
"""
DRIVEN = """
In-line slider crank at constant speed, closed form: see README.md
tolerance: abs 1e-6
tolerance PART/4.vx: abs 1e-6
tolerance PART/4.ax: abs 1e-4
tolerance JOINT/4.fy: abs 1e-4
tolerance MOTION/*: abs 1e-5
"""


@dataclass(frozen=True)
class Crank:
    """Lengths and masses of crank and rod (uniform), mass of the slider."""

    crank: float
    rod: float
    masses: tuple[float, float, float]

    def places(self, a):
        """Sine and cosine of the rod (its angle is below the line), centre of the rod, slider."""
        s = self.crank / self.rod * sp.sin(a)
        c = sp.cos(a) if self.crank == self.rod else sp.sqrt(1 - s**2)
        pin = sp.Matrix([self.crank * sp.cos(a), self.crank * sp.sin(a)])
        along = sp.Matrix([c, -s])
        return s, c, pin + along * self.rod / 2, (pin + along * self.rod)[0]

    def kinetic(self, a, w):
        """Kinetic energy at the crank angle a and its rate w."""
        m1, m2, m3 = self.masses
        s, c, centre, slider = self.places(a)
        speed = centre.diff(a) * w
        turn = w * sp.diff(s, a) / c
        turn = sp.simplify(turn) if self.crank == self.rod else turn
        energy = m1 * self.crank**2 / 3 * w**2 + m2 * speed.dot(speed)
        return (energy + m2 * self.rod**2 / 12 * turn**2 + m3 * (sp.diff(slider, a) * w) ** 2) / 2


def free(crank, speed, t):
    """Crank angle, its rate and the place of the slider of a free run."""
    (a,), (w,) = coordinates("a")
    kinetic = crank.kinetic(a, w)
    rhs = equations([a], [w], kinetic)
    y = solve(rhs, [0, speed], t).T
    assert np.allclose(solve(rhs, [0, speed], t, 1e-10).T, y, rtol=1e-8)
    energy = sp.lambdify([a, w], kinetic)(*y)
    assert np.allclose(energy, energy[0], rtol=1e-10)
    slider = sp.lambdify(a, crank.places(a)[3])(y[0])
    return {"VARIABLE/crank": y[0], "PART/2.wz": y[1], "PART/4.x": slider}


def driven(t):
    """Slider, side force on it and torque of the motor at constant speed."""
    crank, speed = Crank(0.1, 0.3, (0.4, 0.6, 0.5)), 100.0
    (a,), (w,) = coordinates("a")
    s, c, centre, slider = crank.places(a)
    torque = sp.diff(crank.kinetic(a, speed), a)
    x, v, acc = (sp.diff(slider, a, n) * speed**n for n in range(3))
    # Rod about its centre: the pin of the slider carries (m3 x", -side), the crank pin the rest.
    turn = -sp.diff(sp.asin(s), a, 2) * speed**2
    pull = sp.diff(centre, a, 2) * speed**2 * crank.masses[1]
    along = sp.Matrix([c, -s]) * crank.rod / 2
    slope = sp.Symbol("side")
    at_slider = sp.Matrix([-crank.masses[2] * acc, slope])
    at_crank = pull - at_slider
    moment = along[0] * (at_slider - at_crank)[1] - along[1] * (at_slider - at_crank)[0]
    side = sp.solve(moment - crank.masses[1] * crank.rod**2 / 12 * turn, slope)[0]
    values = sp.lambdify(a, [x, v, acc, side, torque], cse=True)(speed * t)
    assert np.isclose(values[2][0], -4000 / 3)
    bottom = float(acc.subs(a, sp.pi))
    assert np.isclose(bottom, 2000 / 3)
    # The force of the rod on the slider is minus that of the slider on the rod; the guide holds it.
    names = ("PART/4.x", "PART/4.vx", "PART/4.ax", "JOINT/4.fy", "MOTION/1.tz")
    return {"VARIABLE/crank": speed * t} | dict(zip(names, values, strict=True))


def main():
    t = np.linspace(0, 0.1, 201)
    columns = free(Crank(0.15, 0.3, (0.36, 0.151104, 0.075552)), 150.0, t)
    last = [columns[name][-1] for name in columns]
    assert np.allclose(
        last, [12.135878188931363, 129.02682864754772, 0.4297105801152724], rtol=1e-9
    )
    write(HERE / "slider-crank.reference.csv", FREE, list(columns), [t, *columns.values()])
    t = np.linspace(0, 0.6, 61)
    columns = free(Crank(0.2, 0.2, (0.36, 0.151104, 0.075552)), 10.0, t)
    assert np.allclose([columns["VARIABLE/crank"][-1], columns["PART/4.x"][-1]], [3.8804, -0.2957],
                       atol=5e-5)  # fmt: skip
    write(HERE / "equal-arms.reference.csv", EQUAL, list(columns), [t, *columns.values()])
    t = np.linspace(0, 0.07, 141)
    columns = driven(t)
    write(HERE / "driven.reference.csv", DRIVEN, list(columns), [t, *columns.values()])


if __name__ == "__main__":
    main()
