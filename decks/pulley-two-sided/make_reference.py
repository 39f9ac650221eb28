"""Write the references of the two-sided pulley: guided in closed form, free by Lagrange."""

import sys
from pathlib import Path

import numpy as np
import sympy as sp

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.parent), str(HERE.parent / "pulley-one-sided")]

from minimal import coordinates, equations, solve, write  # noqa: E402  (beside the cases)
from pulley import Side  # noqa: E402

RADIUS, INERTIA = 0.1, 0.02
SIDES = (
    Side(RADIUS, 1, 0.0, 2.0, 5.0, 0.02, 0.02),
    Side(RADIUS, -1, -np.pi / 2, 2.5, 3.0, 0.02, 0.02),
)
LEANS, PULLS = (np.arcsin(0.6), -np.arcsin(0.28)), (60.0, 40.0)
GUIDED = """
Both ends guided along straight lines, closed form: see README.md
tolerance: abs 1e-8
tolerance PART/*.phi: abs 1e-8
"""
FREE = """
Five minimal coordinates, DOP853 at rtol 1e-12: see README.md
tolerance: abs 1e-6
tolerance *.w*: abs 2e-5
tolerance JOINT/1.*: abs 2e-4
"""
XYZ = "xyz"


def mount(sides, angles, leans, lengths, tensions):
    """Force (3, nt) and torque (3, nt) of the mount on the pulley, as its ends are guided."""
    force, torque = 0, 0
    for side, b, p, length, tension in zip(sides, angles, leans, lengths, tensions, strict=True):
        r = np.array(side.frame(b)[0], float)
        k = np.array(side.direction(b, p), float)
        aside = -tension * side.radius * (1 - np.cos(p)) / (length * np.cos(p))
        end = tension * k + aside * r
        force = force - end
        torque = torque - np.cross(side.radius * r + length * k, end, axis=0)
    torque[2] = 0
    return force, torque


def check_guided(a, mass):
    """The generalised forces of links and turrets vanish with the sideways force of the guides."""
    tensions = PULLS[0] - SIDES[0].mass * a, PULLS[1] + SIDES[1].mass * a
    assert np.isclose(mass * a, PULLS[0] - PULLS[1])
    assert np.isclose(INERTIA * a / RADIUS, RADIUS * (tensions[0] - tensions[1]))
    for side, p, tension in zip(SIDES, LEANS, tensions, strict=True):
        q, _ = coordinates("f b p")
        end = side.end(*q)
        at = {q[0]: 0, q[1]: side.angle, q[2]: p}
        aside = -tension * RADIUS * (1 - np.cos(p)) / (side.length * np.cos(p))
        force = tension * side.direction(side.angle, p) + aside * side.frame(side.angle)[0]
        general = (end.jacobian(q).subs(at).T * force).evalf()
        assert np.allclose(
            np.array(general, float).ravel(), [side.sense * RADIUS * tension, 0, 0], atol=1e-12
        )
    return tensions


def write_guided(t):
    mass = SIDES[0].mass + SIDES[1].mass + INERTIA / RADIUS**2
    a = (PULLS[0] - PULLS[1]) / mass
    tensions = check_guided(a, mass)
    way = a * t**2 / 2
    lengths = SIDES[0].length + way, SIDES[1].length - way
    force, torque = mount(SIDES, (0.0, -np.pi / 2), LEANS, lengths, tensions)
    force = np.broadcast_to(force, (3, len(t)))
    directions = [
        np.array(s.direction(s.angle, p), float).ravel() for s, p in zip(SIDES, LEANS, strict=True)
    ]
    columns = {"VARIABLE/speed": a * t}
    for part, k, sign in ((40, directions[0], 1), (70, directions[1], -1)):
        columns |= {f"PART/{part}.v{c}": sign * a * t * k[i] for i, c in enumerate(XYZ)}
        columns |= {f"PART/{part}.a{c}": sign * a * k[i] for i, c in enumerate(XYZ)}
    columns |= {"PART/10.alz": a / RADIUS}
    columns |= {f"JOINT/1.f{c}": force[i] for i, c in enumerate(XYZ)}
    columns |= {f"JOINT/1.t{c}": torque[i] for i, c in enumerate(XYZ)}
    write(HERE / "pulley-two-sided.reference.csv", GUIDED, list(columns), [t, *columns.values()])


def write_free(t):
    q, v = coordinates("f b p c s")
    f, b, p, c, s = q
    dummies = {"turret": 0.05, "turret_inertia": 0.0003, "link_inertia": 0.002}
    left = Side(RADIUS, 1, sp.pi, 0.8, 1.0, 0.01, 0.002, **dummies)
    right = Side(RADIUS, -1, 0, 0.7, 1.2, 0.01, 0.002, **dummies)
    kinetic = left.kinetic(q, v, f, b, p) + right.kinetic(q, v, f, c, s) + INERTIA * v[0] ** 2 / 2
    potential = left.potential(9.81, f, b, p) + right.potential(9.81, f, c, s)
    rhs = equations(q, v, kinetic, potential)
    start = [0, np.pi, 0, 0, 0, 0, 0.8, 0.5, -0.6, -0.7]
    y = solve(rhs, start, t).T
    assert np.allclose(solve(rhs, start, t, 1e-10).T, y, rtol=0, atol=1e-7)
    energy = sp.lambdify([*q, *v], kinetic + potential)(*y)
    assert np.allclose(energy, energy[0], rtol=0, atol=1e-9)
    ends = [sp.lambdify(q, list(side.end(f, *own)))(*y[:5]) for side, own in
            ((left, (b, p)), (right, (c, s)))]  # fmt: skip
    columns = {f"PART/40.{x}": ends[0][i] for i, x in enumerate(XYZ)}
    columns |= {f"PART/70.{x}": ends[1][i] for i, x in enumerate(XYZ)}
    columns |= {"PART/10.wz": y[5], "PART/20.wz": y[6], "PART/50.wz": y[8]}
    force = mount_by_momentum(q, v, rhs, y, (left, (b, p)), (right, (c, s)))
    columns |= {f"JOINT/1.f{x}": force[i] for i, x in enumerate(XYZ)}
    write(HERE / "free.reference.csv", FREE, list(columns), [t, *columns.values()])


def mount_by_momentum(q, v, rhs, y, *sides):
    """Force (3, nt) of the mount: rate of the momentum of all bodies, less their weight."""
    momentum, mass = sp.zeros(3, 1), 2.0
    for side, (b, p) in sides:
        for place, m in ((side.end(q[0], b, p), side.mass), (side.contact(b), side.turret)):
            momentum += m * place.jacobian(list(q)) * sp.Matrix(v)
            mass += m
        mass += 0.1
    state = [*q, *v]
    slope = sp.lambdify(state, momentum.jacobian(state), cse=True)
    change = [np.asarray(slope(*s), float) @ rhs(0, s) for s in y.T]
    return np.array(change).T + [[0], [mass * 9.81], [0]]


if __name__ == "__main__":
    times = np.linspace(0, 1, 51)
    write_guided(times / 10)
    write_free(times)
