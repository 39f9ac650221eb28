"""Write a mass on a spring that is thrown against an elastic stop, and its blows.

W = sqrt((k + K)/m) in the stop, w = sqrt(k/m) outside: it sinks in by V/W, is pushed with K V/W,
and leaves after pi/W; pi/w later it comes back as fast as at first.
"""

from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
MASS, SPRING, STOP, SPEED = 100.0, 1e4, 1e6, 1.0
DECK = """\
A mass on a spring is thrown against a stop
! Written by make_reference.py.

UNITS/SYSTEM=MKS

PART/1, GROUND
MARKER/1, PART=1, REULER=90D,90D,0

PART/2, MASS=100, CM=2, IP=1,1,1, VX=1
MARKER/2, PART=2, REULER=90D,90D,0
JOINT/2, TRANSLATIONAL, I=2, J=1

SFORCE/1, TRANSLATIONAL, ACTIONONLY, I=2, J=1, FUNCTION=-1E4*DX(2,1)
SFORCE/2, TRANSLATIONAL, ACTIONONLY, I=2, J=1, FUNCTION=-IMPACT(-DX(2,1),-VX(2,1),0,1E6,1,0,1E-9)

VARIABLE/place, FUNCTION=DX(2,1)
VARIABLE/push, FUNCTION=-SFORCE(2,0,2)

INTEGRATOR/RADAU, ERROR=1.0E-10
SIMULATE/DYNAMIC, END=0.4, STEPS=4000
END
"""

(HERE / "shock-stop.adm").write_text(DECK)
inside, outside = np.sqrt((SPRING + STOP) / MASS), np.sqrt(SPRING / MASS)
leaves = np.pi / inside
lines = [
    "# The blows of a mass against a stop: see README.md",
    "# written by make_reference.py",
    "# interpolate: cubic",
    f"# measure: max VARIABLE/place = {SPEED / inside:.12g} tol rel 1e-4",
    f"# measure: max VARIABLE/push = {STOP * SPEED / inside:.12g} tol rel 1e-4",
    f"# measure: arrival VARIABLE/place through 0 from 0.01 = {leaves:.12g} tol rel 1e-5",
    f"# measure: arrival VARIABLE/place through 0 from 0.2 = {leaves + np.pi / outside:.12g}"
    " tol rel 1e-5",
]
(HERE / "shock-stop.reference.csv").write_text("\n".join(lines) + "\n")
