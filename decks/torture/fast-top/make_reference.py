"""Write decks and references of the fast top: its two steady precessions, which are circles."""

import sys
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1]))

from minimal import write  # noqa: E402  (it lies beside the folders of the cases)

MASS, ARM, GRAVITY = 2.5, 0.04, 9.81
DISC, ALONG = 0.001, 0.002  # of a disc about its centre: across, along the axis
ACROSS = DISC + MASS * ARM**2  # about the tip
LEAN, SPIN = np.radians(30.0), 300.0
DECK = """Fast top: steady {name} precession on a ball joint
! Written by make_reference.py. The axis leans by 30 degrees towards x and circles about the
! vertical at {rate:.9g} rad/s. Inertia about the tip: 0.005 across, 0.002 along the axis.

UNITS/SYSTEM=MKS
ACCGRAV/KGRAV=-9.81

PART/1, GROUND
MARKER/1, PART=1

PART/2, MASS=2.5, CM=3, IP=0.001,0.001,0.002, REULER=90D,30D,-90D
, VY={vy:.12g}, WX={wx:.12g}, WZ=300
MARKER/2, PART=2
MARKER/3, PART=2, QP=0,0,0.04

JOINT/1, SPHERICAL, I=2, J=1

! Direction of the axis, its lean from the vertical, the spin about it.
VARIABLE/east, FUNCTION=DX(3,2)/0.04
VARIABLE/north, FUNCTION=DY(3,2)/0.04
VARIABLE/lean, FUNCTION=ACOS(DZ(3,2)/0.04)
VARIABLE/spin, FUNCTION=WZ(3,0,3)

INTEGRATOR/GSTIFF, SI2, ERROR={error}
SIMULATE/DYNAMIC, END={end}, STEPS=200
END
"""
LINES = """
Steady {name} precession, a circle: see README.md
tolerance: abs {band:.2g}
tolerance VARIABLE/lean: abs 1e-6
tolerance VARIABLE/spin: rel 1e-6
tolerance JOINT/1.*: peak {band:.2g}
"""


def precessions():
    """Roots p of I1 p^2 cos(lean) - I3 w3 p + m g l = 0, the slow one first."""
    return np.sort(np.roots([ACROSS * np.cos(LEAN), -ALONG * SPIN, MASS * GRAVITY * ARM]))


def main():
    rates = precessions()
    assert np.allclose(rates, [1.6547615, 136.909303], rtol=1e-7)
    across = np.sin(LEAN)
    runs = {"slow": (rates[0], 4, "1.0E-8"), "fast": (rates[1], 0.5, "1.0E-9")}
    for name, (p, end, error) in runs.items():
        start = {"vy": ARM * across * p, "wx": -p * across}
        deck = DECK.format(name=name, rate=p, **start, end=end, error=error)
        (HERE / f"fast-top-{name}.adm").write_text(deck)
        t = np.linspace(0, end, 201)
        east, north = across * np.cos(p * t), across * np.sin(p * t)
        inward = -MASS * ARM * p**2
        columns = {
            "VARIABLE/east": east, "VARIABLE/north": north, "VARIABLE/lean": LEAN,
            "VARIABLE/spin": SPIN, "JOINT/1.fx": inward * east, "JOINT/1.fy": inward * north,
            "JOINT/1.fz": MASS * GRAVITY,
        }  # fmt: skip
        lines = LINES.format(name=name, band=1e-5 * p * end)
        write(HERE / f"fast-top-{name}.reference.csv", lines, list(columns), [t, *columns.values()])


if __name__ == "__main__":
    main()
