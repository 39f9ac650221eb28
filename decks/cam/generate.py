"""Write the deck of the cam: the points of its circle and of the follower's plane."""

from pathlib import Path

import numpy as np

RADIUS, ECCENTRIC, POINTS = 0.05, 0.02, 300
DECK = """An eccentric cam under a flat follower
! A circle about a shaft that is not in its middle; the follower, 0.8 kg on a guide, rests on it.
! The cam speeds up. Written by generate.py: the cam is the MATRIX of {points} points of the circle.

UNITS/SYSTEM=MKS
ACCGRAV/JGRAV=-9.80665

PART/1, GROUND
MARKER/1, PART=1
MARKER/2, PART=1, REULER=0,-90D,0      ! z up: the guide of the follower

PART/2, MASS=2, CM=20, IP=1E-3,1E-3,2E-3
MARKER/20, PART=2
PART/3, MASS=0.8, CM=30, IP=1E-4,1E-4,1E-4, QG=0,{radius},0
MARKER/30, PART=3
MARKER/31, PART=3, REULER=0,-90D,0

JOINT/1, REVOLUTE, I=20, J=1
JOINT/2, TRANSLATIONAL, I=31, J=2
MOTION/1, JOINT=1, FUNCTION=2*TIME**2+3*TIME

! the cam, closed, about the shaft; the follower's plane, a straight line
MATRIX/1, FULL=RORDER, ROWS={rows}, COLUMNS=3, VALUES=
{values}
CURVE/1, CLOSED, MATRIX=1, CURVE_POINTS
MATRIX/2, FULL=RORDER, ROWS=2, COLUMNS=3, VALUES=-0.1,0,0, 0.1,0,0
CURVE/2, OPEN, MATRIX=2, CURVE_POINTS

MARKER/21, PART=2, FLOATING
MARKER/32, PART=3, FLOATING
CVCV/1, IFLOAT=32, JFLOAT=21, ICURVE=2, JCURVE=1, IRM=30, JRM=20

VARIABLE/lift, FUNCTION=DY(30,1)
VARIABLE/speed, FUNCTION=VY(30,1)
! force of the cam on the follower: along the normal, and none along the plane
VARIABLE/force, FUNCTION=CVCV(1,0,3,0)
VARIABLE/across, FUNCTION=CVCV(1,0,2,0)
! by the markers between which it acts
REQUEST/1, FORCE, I=32, J=21
! torque that turns the cam
VARIABLE/drive, FUNCTION=MOTION(1,0,8,0)

INTEGRATOR/GSTIFF, ERROR=1E-7
SIMULATE/DYNAMIC, END=3, STEPS=150
END
"""


def main():
    angle = np.linspace(0.0, 2.0 * np.pi, POINTS + 1)
    ring = np.column_stack([ECCENTRIC + RADIUS * np.cos(angle), RADIUS * np.sin(angle), 0 * angle])
    ring[-1] = ring[0]
    lines = [", " + ",".join(f"{v:.15g}" for v in row) for row in ring.round(15)]
    deck = DECK.format(points=POINTS, rows=POINTS + 1, radius=RADIUS, values=",\n".join(lines))
    Path(__file__).with_name("cam.adm").write_text(deck)


if __name__ == "__main__":
    main()
