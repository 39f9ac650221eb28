"""Write the references of a crank that ADAMS View wrote: closed form, see README.md."""

import sys
from pathlib import Path

import numpy as np
import sympy as sp

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))

from minimal import write  # noqa: E402  (beside the cases)

CRANK, ROD = 6.0, np.sqrt(180.0)
MASSES, INERTIAS = (0.2249795587, 0.4862494147), (0.7699990204, 7.731451846)
#: Speed of the crank [rad/s], clockwise; inch pound_mass / (second^2 pound_force).
SPEED, UCF = np.radians(30.0), 9.80665 / 0.0254
NAMES = ("PART/2.x", "PART/2.y", "PART/3.x", "PART/3.y", "PART/3.vx", "PART/3.wz", "{torque}")
LINES = """
Slider crank at constant speed, closed form: see README.md
solve: --error 1e-6
tolerance: abs 1e-6
tolerance *.vx: abs 1e-5
tolerance *.wz: abs 1e-5
tolerance {torque}: abs 1e-5
"""


def motion():
    """Functions of the angle of the crank from y, and of time: places, rates, moment of inertia."""
    a, rate = sp.symbols("a rate")
    pin = sp.Matrix([CRANK * sp.sin(a), CRANK * sp.cos(a)])
    lean = sp.asin(CRANK * sp.cos(a) / ROD)  # of the rod below the x axis
    slider = sp.Matrix([pin[0] + ROD * sp.cos(lean), 0])
    crank, rod = pin / 2, (pin + slider) / 2
    moment = sum(
        m * place.diff(a).dot(place.diff(a)) + i * turn**2
        for m, i, place, turn in zip(
            MASSES, INERTIAS, (crank, rod), (sp.Integer(1), lean.diff(a)), strict=True
        )
    )
    # The motor has to change the kinetic energy J(a) rate^2 / 2, and turns by -a about z.
    torque = moment.diff(a) * rate**2 / 2 / UCF
    found = [*crank, *rod, rod.diff(a)[0] * rate, -lean.diff(a) * rate, torque]
    return sp.lambdify((a, rate), found)


def step(t, start, end):
    """The cubic STEP from 0 at the start to 1 at the end."""
    s = np.clip((t - start) / (end - start), 0.0, 1.0)
    return s * s * (3.0 - 2.0 * s)


def table(times):
    """The columns; the torque is that on I, which is on the ground, about z."""
    return [np.broadcast_to(column, times.shape) for column in motion()(SPEED * times, SPEED)]


def main():
    """Both references."""
    times = np.linspace(0.0, 20.0, 201)
    torque = "MOTION/1.tz"
    names = [name.format(torque=torque) for name in NAMES]
    path = HERE / "generic_model.reference.csv"
    write(path, LINES.format(torque=torque), names, [times, *table(times)])
    times = np.linspace(0.0, 2.0, 201)
    torque = "VARIABLE/1"
    names = [name.format(torque=torque) for name in NAMES]
    *columns, driving = table(times)
    spike = 10.0 * (step(times, 1.0, 1.01) - step(times, 1.01, 1.02))
    path = HERE / "analysis_with_spikes.reference.csv"
    write(path, LINES.format(torque=torque), names, [times, *columns, driving + spike])


if __name__ == "__main__":
    main()
