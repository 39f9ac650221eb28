"""The references of `mount` and `wander`: weights on links about an axle, by Lagrange's equations.

With r, t, z radius, tangent and axle at the angle b of a link, w its way along the axle:

    end of a side = R r + w z + u k,  k = s cos(p) t + sin(p) z,  u = u0 + s R (f - b + b0)
"""

import sys
from pathlib import Path

import numpy as np
import sympy as sp

HERE = Path(__file__).resolve().parent
DECKS = HERE.parents[1]
sys.path[:0] = [str(HERE.parent), str(DECKS), str(DECKS / "pulley-one-sided")]

from minimal import coordinates, equations, rate, solve  # noqa: E402
from pulley import Side  # noqa: E402
from spans import table  # noqa: E402


def tangent(radius: float, place: tuple[float, float]) -> tuple[float, float]:
    """Angle of the link, and length, of a cable to the right of a wheel that hangs at `place`."""
    x, y = place
    return np.arctan2(y, x) + np.arccos(radius / np.hypot(x, y)), np.sqrt(x * x + y * y - radius**2)


def mount() -> str:
    """Load and torque on the ground about the foot: weights less the change of momentum."""
    g, radius, inertia, drag, foot = 9.81, 0.2, 0.1, 0.2, (0.3, -1.5)
    still = 20 + inertia / radius**2
    lean, length = tangent(radius, (0.65, -1.0))
    q, v = coordinates("f b")
    f, b = q
    right = Side(radius, -1, lean, length, 4.0)
    places = [
        (6.0, sp.Matrix([-radius, -1.5 - radius * f, 0])),
        (right.mass, right.end(f, b, 0)),
    ]
    speeds = [rate(place, q, v) for _, place in places]
    kinetic = sum(m * s.dot(s) for (m, _), s in zip(places, speeds, strict=True)) / 2
    kinetic += inertia * v[0] ** 2 / 2
    rhs = equations(q, v, kinetic, g * sum(m * p[1] for m, p in places), [-drag * v[0], 0])
    t = np.linspace(0, 0.9, 91)
    y = solve(rhs, [0, lean, 0, 0], t)
    assert np.allclose(solve(rhs, [0, lean, 0, 0], t, 1e-9), y, rtol=0, atol=1e-7)

    a = sp.symbols("a_f a_b")
    momentum, spin, moment = sp.zeros(3, 1), inertia * v[0], -still * g * -foot[0]
    load = -still * g
    for (m, place), speed in zip(places, speeds, strict=True):
        arm = place - sp.Matrix([*foot, 0])
        momentum += m * speed
        spin += m * (arm[0] * speed[1] - arm[1] * speed[0])
        load, moment = load - m * g, moment - m * g * arm[0]
    change = sp.Matrix([*momentum[:2], spin]).jacobian([*q, *v]) * sp.Matrix([*v, *a])
    columns = {
        "REQUEST/21.F2": -change[0],
        "REQUEST/21.F3": load - change[1],
        "REQUEST/21.F8": moment - change[2],
        "REQUEST/20.F3": -radius * v[0],
        "REQUEST/20.F4": sp.sqrt(change[0] ** 2 + (change[1] - load - 20 * g) ** 2),
        "REQUEST/20.F7": sp.pi - b,
    }
    found = sp.lambdify([*q, *v, *a], list(columns.values()))
    second = [rhs(0, row)[2:] for row in y]
    lines = [
        "Load and torque on a mount, on the axle; speed of the cable, wrap angle: README.md",
        "written by describe.py",
        "tolerance REQUEST/21.*: abs 1e-5",
        "tolerance REQUEST/20.F4: abs 1e-5",
        "tolerance REQUEST/20.F3: abs 1e-6",
        "tolerance REQUEST/20.F7: abs 1e-6",
    ]
    values = np.broadcast_arrays(t, *found(*np.column_stack([y, second]).T))
    return table(["time", *columns], lines, values, 1e-10)


def wander() -> str:
    """Ends and guides of both sides: the turn f, and b, p, w of either side."""
    gravity = sp.Matrix([1.5, -9, 2])
    q, v = coordinates("f b1 p1 w1 b2 p2 w2")
    left = Side(0.1, 1, sp.pi, 0.6, 1.0, turret=0.2)
    right = Side(0.1, -1, 0, 0.7, 1.2, turret=0.2)
    given = ((left, q[1:4]), (right, q[4:]))
    kinetic, potential, out = 0.1 * v[0] ** 2 / 2, 0, {}
    for n, (side, (b, p, w)) in zip((1, 2), given, strict=True):
        kinetic += side.kinetic(q, v, q[0], b, p, w)
        end = side.end(q[0], b, p, w)
        potential += 50 * w**2 / 2 - side.mass * gravity.dot(end)
        potential -= side.turret * gravity.dot(side.contact(b, w))
        out |= {f"POINT_MASS/{20 * n - 10}.{x}": c for x, c in zip("xyz", end, strict=True)}
        out[f"VARIABLE/wander_{n}000"] = w
    out["PART/20.wz"] = v[0]
    forces = [-2 * v[0], 0, 0, -0.5 * v[3], 0, 0, -0.5 * v[6]]
    rhs = equations(q, v, kinetic, potential, forces)
    start = [0.0, np.pi, *[0.0] * 12]
    t = np.linspace(0, 1.2, 61)
    y = solve(rhs, start, t, 1e-11)
    assert np.allclose(solve(rhs, start, t, 1e-9), y, rtol=0, atol=1e-6)
    found = sp.lambdify([*q, *v], list(out.values()), cse=True)(*y.T)
    lines = [
        "Ends of the tape and its guides: README.md",
        "written by describe.py",
        "tolerance: abs 1e-6",
        "tolerance PART/20.wz: abs 2e-5",
    ]
    return table(["time", *out], lines, np.broadcast_arrays(t, *found), 1e-9)
