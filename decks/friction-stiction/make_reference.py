"""Write the reference of friction that holds: scalar equations integrated by DOP853.

The rest creep, the force of breakaway and the travel of a block that stays are closed forms,
compared before they are written as measures.
"""

import sys
from pathlib import Path

import numpy as np
from scipy.optimize import brentq

HERE = Path(__file__).parent
sys.path.insert(0, str(HERE.parent / "friction"))
from stick_slip import Law, odd, solve  # noqa: E402

DOWN, PRESS = 3.3552, 9.2184
MASS, INERTIA, PIN = 2.0, 0.01, 0.05
GIVE, END = 1e-4, 1.2
HIGH, LOW = Law(0.8, 0.6, give=GIVE), Law(0.3, 0.2, give=GIVE)
BEARING = Law(0.5, 0.3, give=GIVE)
HEADER = """# Friction that holds, DOP853 at rtol 1e-11: see README.md
# written by make_reference.py
# solve: --error 1e-9
# tolerance: abs 1e-6
# tolerance PART/2.x: abs 1e-8
# tolerance VARIABLE/turn: abs 1e-7
# tolerance FRICTION/2.creep_z: abs 1e-8
"""


def block(law, speed=0.0, pull=lambda t: 0.0):
    """Position and speed, and creep, of a block on the slope."""

    def rates(t, y, mu, _):
        return [y[1], DOWN + pull(t) / MASS - mu[0] * PRESS]

    return solve(law, lambda y: y[1:], rates, [0.0, speed], times, longest=5e-4)


def step(t, t0, t1):
    d = min(max((t - t0) / (t1 - t0), 0), 1)
    return d * d * (3 - 2 * d)


def wheel(t, y, mu, _):
    torque = 0.3 * (step(t, 0, 0.2) - 2 * step(t, 0.5, 0.7))
    load = MASS * np.hypot(DOWN, PRESS)
    return [y[1], (torque - mu[0] * load * PIN) / INERTIA]


times = np.linspace(0, END, 61)
(low_x, low_v), (creep,) = block(HIGH)
(high_x, high_v), _ = block(LOW)
(thrown_x, thrown_v), (thrown_creep,) = block(HIGH, 1.5)
pull = MASS * (HIGH.rest * PRESS - DOWN)
(pulled_x, pulled_v), _ = block(HIGH, pull=lambda t: 10 * t)
(turn, spin), _ = solve(BEARING, lambda y: PIN * y[1:], wheel, [0, 0], times, longest=5e-4)

# The closed forms, against the integration before they are written.
rest = GIVE * brentq(lambda x: odd(x) - DOWN / (HIGH.rest * PRESS), 0, 1, xtol=1e-14)
assert abs(low_x[-1] - rest) < 1e-10 and abs(thrown_creep[-1] - rest) < 1e-10
sliding = (thrown_v > 1.5 * HIGH.vs) & (times < 0.6)
slowed = 1.5 - (HIGH.moving * PRESS - DOWN) * times
assert sliding.sum() > 20 and abs(thrown_v - slowed)[sliding].max() < 1e-10
before = pulled_x[times < 0.95 * pull / 10].max()
assert before < GIVE < pulled_x[times > 1.02 * pull / 10].min()

names = {
    "PART/2.x": low_x, "PART/2.vx": low_v, "FRICTION/2.creep_z": creep,
    "PART/3.x": high_x, "PART/3.vx": high_v,
    "PART/4.x": thrown_x, "PART/4.vx": thrown_v,
    "PART/5.x": pulled_x, "PART/5.vx": pulled_v,
    "VARIABLE/turn": turn, "PART/6.wy": spin,
}  # fmt: skip
measures = f"""# measure: last PART/2.x = {rest:.12g} tol abs 1e-9
# measure: last FRICTION/2.fz = {-MASS * DOWN:.12g} tol abs 1e-6
# measure: last FRICTION/4.creep_z = {rest:.12g} tol abs 1e-9
"""
table = np.column_stack([times, *names.values()])
rows = [",".join(f"{value:.12g}" for value in row) for row in table]
text = HEADER + measures + ",".join(["time", *names]) + "\n" + "\n".join(rows) + "\n"
(HERE / "reference.csv").write_text(text)
