"""Write the reference of the pair: polynomials in time."""

from pathlib import Path

import numpy as np

FORCE, TORQUE, RAMP = 3.0, 0.2, 0.3
MASS, INERTIA = (2.0, 5.0), (0.5, 0.8)
GAP, SPEED = 1.5, 0.4
HEADER = """# Constant force and torque between two free bodies, closed form: see README.md
# written by make_reference.py
# solve: --error 1e-9
# tolerance: abs 1e-6
time,PART/2.x,PART/2.y,VARIABLE/turn2,PART/3.y,VARIABLE/turn3,GFORCE/1.fy,GFORCE/1.tz,VARIABLE/px,VARIABLE/py,VARIABLE/spin"""

t = np.linspace(0, 2, 41)
one = np.ones_like(t)
x2 = GAP + SPEED * t
y2, y3 = FORCE * t**2 / 2 / MASS[0], -FORCE * t**2 / 2 / MASS[1]
turn2 = TORQUE * t**2 / 2 / INERTIA[0]
turn3 = -(TORQUE * t**2 / 2 + FORCE * (GAP * t**2 / 2 + SPEED * t**3 / 6)) / INERTIA[1]
kept = [MASS[0] * SPEED * one, 0 * one, 0 * one]
table = np.column_stack([t, x2, y2, turn2, y3, turn3, FORCE * one, TORQUE + RAMP * t, *kept])
rows = [",".join(f"{value:.12g}" for value in row) for row in table]
Path(__file__).with_name("reference.csv").write_text("\n".join([HEADER, *rows]) + "\n")
