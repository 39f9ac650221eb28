"""Write reference.csv: 2 x'' = 4 and 2 z'' = 6 t - 6 - 8 z', closed forms."""

from pathlib import Path

import numpy as np

HEADER = """# A mass that routines of the user push, closed form: see README.md
# written by make_reference.py
# solve: --user VARIABLE/7=6 --user wind::gust=4,0,-6
# tolerance: rel 1e-6 abs 1e-6
time,POINT_MASS/2.x,POINT_MASS/2.vx,POINT_MASS/2.z,POINT_MASS/2.vz"""


def main():
    t = np.linspace(0, 2, 9)
    x, vx = 3 * t + t**2, 3 + 2 * t
    # vz' + 4 vz = 3 t - 3: a line and exp(-4 t), from rest.
    start = 15 / 16
    fall = np.exp(-4 * t)
    vz = 3 / 4 * t - start + start * fall
    z = 3 / 8 * t**2 - start * t + start / 4 * (1 - fall)
    path = Path(__file__).with_name("reference.csv")
    table = np.column_stack([t, x, vx, z, vz])
    np.savetxt(path, table, fmt="%.12g", delimiter=",", header=HEADER, comments="")


if __name__ == "__main__":
    main()
