"""Write the reference of friction that holds: scalar equations integrated by DOP853.

The rest deflection and the sliding distance are closed forms, written as measures.
"""

from pathlib import Path

import numpy as np
from scipy.integrate import quad, solve_ivp

DOWN, PRESS = 3.3552, 9.2184
MASS, INERTIA, PIN = 2.0, 0.01, 0.05
EDGE, GIVE, YIELDING = 0.1, 1e-4, 0.1
END = 1.2
HEADER = """# Friction that holds, DOP853 at rtol 1e-11: see README.md
# written by make_reference.py
# solve: --error 1e-8
# tolerance: abs 1e-6
# tolerance PART/2.x: abs 1e-8
# tolerance VARIABLE/turn: abs 1e-7
"""


def mu(speed, rest, moving):
    """Coefficient at a slip >= 0."""
    d = min(max((speed / EDGE - 1) / 0.5, 0), 1)
    return rest + (moving - rest) * d * d * (3 - 2 * d)


def friction(v, b, rest, moving):
    """Friction over the load, and db/dt."""
    u = min(max(v / EDGE, -1), 1)
    share = u * (3 - u * u) / 2
    left = 1 - b if v > 0 else 1 + b
    rate = v / GIVE * min(max(left / YIELDING, 0), 1)
    return mu(abs(v), rest, moving) * (b + (1 - abs(b)) * share), rate


def block(rest, moving, pull=lambda t: 0.0):
    def f(t, y):
        held, rate = friction(y[1], y[2], rest, moving)
        return [y[1], DOWN + pull(t) / MASS - held * PRESS, rate]

    return f


def step(t, t0, t1):
    d = min(max((t - t0) / (t1 - t0), 0), 1)
    return d * d * (3 - 2 * d)


def wheel(t, y):
    held, rate = friction(PIN * y[1], y[2], 0.5, 0.3)
    torque = 0.3 * (step(t, 0, 0.2) - 2 * step(t, 0.5, 0.7))
    load = MASS * np.hypot(DOWN, PRESS)
    return [y[1], (torque - held * load * PIN) / INERTIA, rate]


def solve(f, speed, times):
    """Position, speed and deflection (3, nt)."""
    steps = {"rtol": 1e-11, "atol": 1e-13, "max_step": 2e-4}
    return solve_ivp(f, (0, times[-1]), [0.0, speed, 0.0], "DOP853", times, **steps).y


def sliding_distance(speed, rest, moving):
    """Way to the first standstill: int v dv / (mu(v) PRESS - DOWN); the bristle is bent at once."""

    def way(v):
        return v / (mu(v, rest, moving) * PRESS - DOWN)

    return sum(quad(way, *ends)[0] for ends in ((0, EDGE), (EDGE, 1.5 * EDGE), (1.5 * EDGE, speed)))


times = np.linspace(0, END, 61)
low, high = solve(block(0.8, 0.6), 0, times), solve(block(0.3, 0.2), 0, times)
thrown = solve(block(0.8, 0.6), 1.5, times)
pulled = solve(block(0.8, 0.6, lambda t: 10 * t), 0, times)
turned = solve(wheel, 0, times)

# The closed forms, against the integration before they are written.
rest = GIVE * DOWN / (0.8 * PRESS)
assert abs(low[0, -1] - rest) < 1e-11
fine = solve(block(0.8, 0.6), 1.5, np.linspace(0, 0.7, 7001))
way = sliding_distance(1.5, 0.8, 0.6)
assert abs(fine[0].max() - way) < 1e-6
sprung = way - GIVE * (1 - DOWN / (0.8 * PRESS))

names = {
    "PART/2.x": low[0], "PART/2.vx": low[1], "DIFF/FRICTION_2": low[2],
    "PART/3.x": high[0], "PART/3.vx": high[1],
    "PART/4.x": thrown[0], "PART/4.vx": thrown[1],
    "PART/5.x": pulled[0], "PART/5.vx": pulled[1],
    "VARIABLE/turn": turned[0], "PART/6.wy": turned[1],
}  # fmt: skip
measures = f"""# measure: last PART/2.x = {rest:.12g} tol abs 1e-8
# measure: last PART/4.x = {sprung:.12g} tol abs 1e-7
"""
table = np.column_stack([times, *names.values()])
rows = [",".join(f"{value:.12g}" for value in row) for row in table]
text = HEADER + measures + ",".join(["time", *names]) + "\n" + "\n".join(rows) + "\n"
Path(__file__).with_name("reference.csv").write_text(text)
