"""Write the references of the car axis: constraints differentiated twice, DOP853.

    m p" = f(p, t) + G^T lam,   g(p, t) = 0,   so   [m, -G^T; G, 0] (p", lam) = (f, -g'')

with p = (x_l, y_l, x_r, y_r) and g = (x_l x_b + y_l y_b, (x_l - x_r)^2 + (y_l - y_r)^2 - 1).
"""

import sys
from pathlib import Path

import numpy as np
import sympy as sp

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))

from minimal import solve, write  # noqa: E402  (it lies beside the folders of the cases)

MASS, HALF = 5e-4, 0.5
LINES = """
Car axis, constraints differentiated twice, DOP853 at rtol 1e-13: see README.md
solve: --error {error:g}
tolerance: abs {band:g}
tolerance POINT_MASS/*.v*: abs {speed:g}
tolerance GCON/*: abs {strength:g}
"""
PUBLISHED = (
    (0.0493455784275402809, 0.496989460230171154, 1.04174252488542152, 0.373911027265361257),
    (-0.0770583684040972358, 0.00744686658723778553, 0.0175568157537232222, 0.770341043779251976),
    (-0.00473688659084893325, -0.00110468033125734369),
)


def equations():
    """The function (t, p, v) -> (p", lam)."""
    t = sp.Symbol("t")
    p, v = sp.symbols("p:4"), sp.symbols("v:4")
    y_b = sp.sin(10 * t) / 10
    x_b = sp.sqrt(1 - y_b**2)
    left, right = sp.sqrt(p[0] ** 2 + p[1] ** 2), sp.sqrt((p[2] - x_b) ** 2 + (p[3] - y_b) ** 2)
    pull = (HALF - left) / left, (HALF - right) / right
    f = sp.Matrix([p[0] * pull[0], p[1] * pull[0] - MASS, (p[2] - x_b) * pull[1],
                   (p[3] - y_b) * pull[1] - MASS])  # fmt: skip
    g = sp.Matrix([p[0] * x_b + p[1] * y_b, (p[0] - p[2]) ** 2 + (p[1] - p[3]) ** 2 - 1])
    slope = g.jacobian(p)
    rate = slope * sp.Matrix(v) + g.diff(t)
    bias = rate.jacobian(p) * sp.Matrix(v) + rate.diff(t)
    matrix = sp.Matrix(sp.BlockMatrix([[MASS * sp.eye(4), -slope.T], [slope, sp.zeros(2)]]))
    compiled = sp.lambdify((t, p, v), (matrix, sp.Matrix([*f, *-bias])), "numpy", cse=True)

    def accelerations(time, place, speed):
        a, b = compiled(time, place, speed)
        return np.linalg.solve(a, b.ravel())

    return accelerations


def main():
    accelerations = equations()

    def rhs(t, y):
        return np.concatenate([y[4:], accelerations(t, y[:4], y[4:])[:4]])

    t = np.linspace(0, 3, 151)
    y = solve(rhs, [0, 0.5, 1, 0.5, -0.5, 0, -0.5, 0], t, 1e-13)
    lam = np.array(
        [accelerations(s, state[:4], state[4:])[4:] for s, state in zip(t, y, strict=True)]
    )
    assert np.allclose(lam[0], 0, atol=1e-15)
    assert np.allclose(y[-1, :4], PUBLISHED[0], rtol=0, atol=1e-9)
    assert np.allclose(y[-1, 4:], PUBLISHED[1], rtol=0, atol=1e-8)
    assert np.allclose(lam[-1], PUBLISHED[2], rtol=0, atol=1e-10)
    names = [f"POINT_MASS/{k}.{c}" for c in ("x", "y", "vx", "vy") for k in (2, 3)]
    order = [0, 2, 1, 3, 4, 6, 5, 7]
    columns = [t, *y.T[order], *lam.T]
    for tag, error, band in (("", 1e-6, 1e-4), ("-tight", 1e-8, 1e-6)):
        lines = LINES.format(error=error, band=band, speed=50 * band, strength=band / 20)
        write(HERE / f"reference{tag}.csv", lines, [*names, "GCON/1.f", "GCON/2.f"], columns)


if __name__ == "__main__":
    main()
