"""Write the references of forces and motions by tables from closed forms."""

import sys
from pathlib import Path

import numpy as np
from scipy.interpolate import CubicSpline
from scipy.special import airy, ellipj

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))

from minimal import solve, write  # noqa: E402  (it lies beside the folders of the cases)

HEAD = "{what}, closed form: see README.md\ntolerance: {tolerance}"
PLACE, SPEED = "POINT_MASS/2.x", "POINT_MASS/2.vx"


def checked(t, found, acceleration, start):
    """The closed form, compared with a numerical solution."""
    states = solve(lambda time, y: np.array([y[1], acceleration(time, y[0])]), start, t)
    for column, closed in zip(states.T, found, strict=True):
        assert np.allclose(column, closed, rtol=0, atol=1e-8 * np.abs(closed).max())
    return found


def quadratic(t, mass, k, c, x0):
    """m x" = -k x - c x^2 from rest at x0: place and speed by Jacobi's functions."""
    energy = k * x0**2 / 2 + c * x0**3 / 3
    other = np.sort(np.roots([c / 3, k / 2 + c * x0 / 3, (k / 2 + c * x0 / 3) * x0]).real)
    # x0, the turning point on the other side of zero, and the third root.
    turning = min(other, key=abs)
    third = max(other, key=abs)
    rate = np.sqrt(c * (x0 - third) / (6 * mass))
    sn, cn, dn, _ = ellipj(rate * t, (x0 - turning) / (x0 - third))
    x = x0 - (x0 - turning) * sn**2
    v = -2 * (x0 - turning) * rate * sn * cn * dn
    assert np.allclose(mass * v**2 / 2 + k * x**2 / 2 + c * x**3 / 3, energy, rtol=1e-11)
    return checked(t, (x, v), lambda _, x: -(k * x + c * x**2) / mass, [x0, 0.0])


def varying(t, mass, k, rate, x0, v0):
    """m x" = -(k + rate t) x: place and speed by Airy's functions."""
    scale = -np.cbrt(rate / mass)
    a, da, b, db = airy(scale * (t + k / rate))
    start = np.array([[a[0], b[0]], [scale * da[0], scale * db[0]]])
    one, other = np.linalg.solve(start, [x0, v0])
    found = one * a + other * b, scale * (one * da + other * db)
    return checked(t, found, lambda time, x: -(k + rate * time) * x / mass, [x0, v0])


def springs():
    for name, mass, k, c, x0, end, steps, tolerance in (
        ("quadratic-spring", 2.0, 40.0, 60.0, 0.3, 3, 150, "abs 3e-7 peak 3e-6"),
        ("quadratic-spring-mm", 3e-3, 5.0, -0.02, -60.0, 1, 100, "abs 1e-7 peak 3e-6"),
    ):
        t = np.linspace(0, end, steps + 1)
        x, v = quadratic(t, mass, k, c, x0)
        columns = {PLACE: x, SPEED: v, "VARIABLE/force": -(k * x + c * x**2)}
        columns |= {"VARIABLE/stiffness": k + 2 * c * x, "VARIABLE/bend": 2 * c + 0 * x}
        head = HEAD.format(what="A spring with a quadratic force", tolerance=tolerance)
        write(HERE / f"{name}.reference.csv", head, list(columns), [t, *columns.values()])


def families():
    t = np.linspace(0, 4, 201)
    for name, mass, k, rate, x0, v0 in (
        ("stiffening-spring", 1.5, 20.0, 12.0, 0.4, 1.0),
        ("softening-spring", 2.5e-3, 4.0, -0.7, -120.0, 800.0),
    ):
        x, v = varying(t, mass, k, rate, x0, v0)
        columns = {PLACE: x, SPEED: v, "VARIABLE/force": -(k + rate * t) * x}
        head = HEAD.format(what="A spring that changes with time", tolerance="peak 3e-6")
        write(HERE / f"{name}.reference.csv", head, list(columns), [t, *columns.values()])


def motions():
    t = np.linspace(0, 3, 151)
    spline = CubicSpline(
        [0, 0.3, 0.7, 1, 1.6, 2, 2.2, 3], [0, 0.1, 0.45, 0.3, -0.2, -0.1, 0.15, 0.2],
        bc_type="natural",
    )  # fmt: skip
    columns = {"PART/2.x": spline(t), "PART/2.vx": spline(t, 1), "MOTION/1.fx": 4 * spline(t, 2)}
    columns |= {"VARIABLE/speed": spline(t, 1), "VARIABLE/acceleration": spline(t, 2)}
    head = HEAD.format(what="A slide driven by a table", tolerance="abs 5e-9")
    write(HERE / "driven-slide.reference.csv", head, list(columns), [t, *columns.values()])

    spline = CubicSpline([0, 0.5, 0.8, 1.5, 2], [0, 0.4, 1.1, 2, 3.5], bc_type="natural")
    inside, end = np.minimum(t, 2.0), np.maximum(t - 2.0, 0.0)
    speed, bend = spline(inside, 1), np.where(t < 2, spline(inside, 2), 0.0)
    angle = spline(inside) + end * speed
    columns = {"VARIABLE/speed": speed, "VARIABLE/acceleration": bend, "PART/2.wz": speed}
    columns |= {"VARIABLE/angle": angle, "MOTION/1.tz": 30 * bend}
    head = HEAD.format(what="A wheel driven by a table", tolerance="abs 2e-8")
    write(HERE / "driven-wheel.reference.csv", head, list(columns), [t, *columns.values()])


def main():
    springs()
    families()
    motions()


if __name__ == "__main__":
    main()
