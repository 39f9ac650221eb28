"""Write the reference of the bushing: damped oscillators in closed form.

Along each axis of J, and about z of J,  m x" + c x' + k x = f,  x(0) = x0, x'(0) = v0:

    x = f/k + Re(A exp(s1 t)) + Re(B exp(s2 t)),   s the roots of m s^2 + c s + k
"""

from pathlib import Path

import numpy as np

#            m    c     k      f    x0     v0
X = (2.0, 1.0, 200.0, 3.0, 0.10, 0.0)
Y = (2.0, 60.0, 300.0, 0.0, -0.05, 0.0)
Z = (2.0, 0.0, 50.0, -2.0, 0.08, 0.0)
TURN = (0.5, 0.4, 20.0, 1.5, 0.6, 2.0)
HEADER = """# Four damped oscillators, closed form: see README.md
# written by make_reference.py
# solve: --error 1e-8
# tolerance: abs 2e-6
# tolerance VARIABLE/force*: abs 1e-3
# tolerance VARIABLE/torque*: abs 1e-3
time,VARIABLE/x,VARIABLE/y,VARIABLE/z,VARIABLE/turn,VARIABLE/force_x,VARIABLE/torque_i,VARIABLE/torque_j"""


def oscillator(times, m, c, k, f, x0, v0):
    """Displacement and velocity, each (nt,)."""
    s = np.roots([m, c, k]).astype(complex)
    a = np.linalg.solve(np.array([[1, 1], s]), [x0 - f / k, v0])
    modes = a[:, None] * np.exp(np.outer(s, times))
    return f / k + modes.sum(0).real, (s[:, None] * modes).sum(0).real


def pull(x, v, m, c, k, f, *_):
    """Force of the bushing in one direction."""
    return f - k * x - c * v


times = np.linspace(0, 3, 61)
x, y, z, turn = (oscillator(times, *data) for data in (X, Y, Z, TURN))
fx, fy, torque = pull(*x, *X), pull(*y, *Y), pull(*turn, *TURN)
moment = x[0] * fy - y[0] * fx
table = np.column_stack([times, x[0], y[0], z[0], turn[0], fx, torque, -torque - moment])
rows = [",".join(f"{value:.12g}" for value in row) for row in table]
Path(__file__).with_name("reference.csv").write_text("\n".join([HEADER, *rows]) + "\n")
