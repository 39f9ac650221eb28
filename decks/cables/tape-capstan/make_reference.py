"""Write the decks and references of the capstan with tape on both sides: seven coordinates."""

import sys
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import sympy as sp

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.parents[1]), str(HERE.parents[1] / "pulley-one-sided")]

from minimal import coordinates, equations, rate, solve, write  # noqa: E402  (other cases)
from pulley import Side  # noqa: E402

LINES = """
Seven minimal coordinates, DOP853 at rtol 1e-11: see README.md
tolerance: abs 1e-6
tolerance *.wz: abs 2e-5
tolerance JOINT/1.f?: abs 1e-4
"""
TOP = """{title}
! Two sides of a tape on one capstan of R = {radius:g} m with a brake; sliders let the tape wander
! along the axle on either side, against a spring and a damper each. 7 degrees of freedom.

UNITS/SYSTEM=MKS
ACCGRAV/JGRAV=-9.81

PART/1, GROUND
MARKER/1, PART=1                                   ! axle, along z

PART/10, MASS=4, CM=10, IP={inertia:g},{inertia:g},{inertia:g}
MARKER/10, PART=10                                 ! the capstan
JOINT/1, REVOLUTE, I=10, J=1
SFORCE/1, ROTATIONAL, I=10, J=1, FUNCTION=-{brake:g}*WZ(10,1)
"""
SIDE = """
PART/{a}20, MASS=0.1, CM={a}20, IP=0.001,0.001,0.002, WZ={lean:g} ! tangency link
MARKER/{a}20, PART={a}20
MARKER/{a}21, PART={a}20, QP={x:g},0,0             ! where the tape leaves, z along the axle
MARKER/{a}22, PART={a}20, QP={x:g},0,-0.5          ! anchor of the spring

PART/{a}50, MASS=0.15, CM={a}50, IP=0.0004,0.0004,0.0004, QG={x:g},0,0
, VY={rim:.12g}, VZ={wander:g}, WZ={lean:g}
MARKER/{a}50, PART={a}50                           ! the slider, z along the axle
MARKER/{a}51, PART={a}50, REULER={out}D,90D,0      ! z outwards

PART/{a}30, MASS=0.05, CM={a}32, IP=0.0003,0.0003,0.0003, QG={x:g},0,0
, VY={rim:.12g}, VZ={wander:g}, WX={roll:g}, WZ={lean:g}
MARKER/{a}30, PART={a}30, REULER={out}D,90D,0      ! z outwards
MARKER/{a}31, PART={a}30, REULER=0,90D,0           ! z along the tape
MARKER/{a}32, PART={a}30

PART/{a}40, MASS={mass:g}, CM={a}40, IP=0.01,0.002,0.01, QG={x:g},-{length:g},0
, VX={vx:.12g}, VZ={vz:.12g}, WX={roll:g}, WZ={lean:g}
MARKER/{a}40, PART={a}40
MARKER/{a}41, PART={a}40, REULER=0,90D,0           ! z along the tape

JOINT/{a}2, REVOLUTE, I={a}20, J=10
JOINT/{a}3, TRANSLATIONAL, I={a}50, J={a}21
JOINT/{a}4, REVOLUTE, I={a}30, J={a}51
JOINT/{a}5, TRANSLATIONAL, I={a}41, J={a}31
COUPLER/{a}1, JOINTS={a}5,{a}2, SCALES=1,{feed:g}, TYPE=T:R ! feed +- R (link - capstan) = 0
SPRINGDAMPER/{a}1, TRANSLATIONAL, I={a}50, J={a}22, K={spring:g}, C={damper:g}, LENGTH=0.5
VARIABLE/wander{a}, FUNCTION=DZ({a}50,{a}21,{a}21)
"""
BOTTOM = """
INTEGRATOR/GSTIFF, SI2, ERROR=1.0E-8
END
"""


@dataclass(frozen=True)
class Capstan:
    """Data of a deck; lengths, masses and starts (b', p', w') of the left and the right side."""

    title: str
    radius: float
    inertia: float
    brake: float
    spring: float
    damper: float
    lengths: tuple[float, float]
    masses: tuple[float, float]
    starts: tuple[tuple[float, float, float], tuple[float, float, float]]
    end: float

    def sides(self):
        """The two sides; the slider (0.15 kg) turns with the link, sits with the turret."""
        return [
            Side(self.radius, sense, angle, length, mass, 0.01, 0.002,
                 turret=0.2, turret_inertia=0.0003, link_inertia=0.0024)
            for sense, angle, length, mass in zip(
                (1, -1), (sp.pi, 0), self.lengths, self.masses, strict=True)
        ]  # fmt: skip

    def deck(self):
        """The text of the deck."""
        text = TOP.format(**vars(self))
        for a, (s, start) in enumerate(zip((1, -1), self.starts, strict=True), 1):
            lean, turn, wander = start
            length = self.lengths[a - 1]
            text += SIDE.format(
                a=a, x=-s * self.radius, out=-90 * s, rim=-s * self.radius * lean, lean=lean,
                wander=wander, roll=-turn, mass=self.masses[a - 1], length=length,
                vx=length * lean, vz=length * turn + wander, feed=s * self.radius,
                spring=self.spring, damper=self.damper,
            )  # fmt: skip
        return text + BOTTOM

    def columns(self, times):
        """Columns of the reference."""
        q, v = coordinates("f b1 p1 w1 b2 p2 w2")
        left, right = self.sides()
        given = ((left, q[1:4]), (right, q[4:]))
        kinetic = self.inertia * v[0] ** 2 / 2
        potential = self.spring * (q[3] ** 2 + q[6] ** 2) / 2
        momentum = sp.zeros(3, 1)
        for side, own in given:
            kinetic += side.kinetic(q, v, q[0], *own)
            potential += side.potential(9.81, q[0], *own)
            momentum += side.mass * rate(side.end(q[0], *own), q, v)
            momentum += side.turret * rate(side.contact(own[0], own[2]), q, v)
        forces = [-self.brake * v[0], 0, 0, -self.damper * v[3], 0, 0, -self.damper * v[6]]
        rhs = equations(q, v, kinetic, potential, forces)
        start = [float(side.angle) for side in (left, right)]
        y0 = [0, start[0], 0, 0, start[1], 0, 0, 0, *self.starts[0], *self.starts[1]]
        y = solve(rhs, y0, times, 1e-11)
        assert np.allclose(solve(rhs, y0, times, 1e-9), y, rtol=0, atol=1e-6)
        a = sp.symbols("a0:7")
        load = momentum.jacobian([*q, *v]) * sp.Matrix([*v, *a])
        dead = 9.81 * (4 + sum(side.mass + side.turret + 0.1 for side, _ in given))
        out = {}
        for name, (side, own) in zip("12", given, strict=True):
            for axis, place in zip("xyz", side.end(q[0], *own), strict=True):
                out[f"PART/{name}40.{axis}"] = place
            out[f"VARIABLE/wander{name}"] = own[2]
        out |= {"PART/10.wz": v[0], "JOINT/1.fx": load[0], "JOINT/1.fy": load[1] + dead}
        found = sp.lambdify([*q, *v, *a], list(out.values()), cse=True)
        second = [rhs(0, row)[7:] for row in y]
        return dict(zip(out, found(*np.column_stack([y, second]).T), strict=True))


CASES = {
    "tape-capstan": Capstan(
        "Tape over a capstan: it wanders on both sides",
        0.1, 0.1, 2.0, 50.0, 0.5, (0.6, 0.7), (1.0, 1.2),
        ((1.0, 0.5, 0.4), (-0.6, -0.7, -0.3)), 1.2,
    ),
    "tape-capstan-large": Capstan(
        "Tape over a large capstan with a strong brake and weak springs",
        0.25, 0.4, 8.0, 20.0, 0.2, (1.0, 0.8), (1.5, 1.0),
        ((-0.5, 0.4, -0.2), (0.7, 0.3, 0.4)), 1.2,
    ),
}  # fmt: skip


def main():
    for name, capstan in CASES.items():
        times = np.linspace(0, capstan.end, 61)
        table = capstan.columns(times)
        write(HERE / f"{name}.reference.csv", LINES, list(table), [times, *table.values()])
        (HERE / f"{name}.adm").write_text(capstan.deck())
        simulate = f"SIMULATE/DYNAMIC, END={capstan.end:g}, STEPS=60"
        (HERE / f"{name}.acf").write_text(f"file/model={name}\n{simulate}\nSTOP\n")


if __name__ == "__main__":
    main()
