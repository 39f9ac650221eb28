"""Write two masses on a spring, one of which sticks and slips, and where it comes to rest.

Stuck, 0 to t1: x2 = (F/k)(1 - cos w t), w^2 = k/m, until F (1 - cos w t1) = mu_s N. Slipping, to t3
with x1' = 0: the middle of both is accelerated by (F - mu_d N)/(2 m), F = 0 from t2 on, and they
swing against each other with w sqrt(2) about (F + mu_d N)/(2 k).
"""

from pathlib import Path

import numpy as np
from scipy.optimize import brentq

HERE = Path(__file__).resolve().parent
MASS, STIFFNESS, NORMAL, STATIC, SLIDING, PULL, OFF = 5.0, 1e4, 1e4, 0.3, 0.2, 3e3, 0.2
DECK = """\
Two masses on a spring, one sticks and slips
! Written by make_reference.py.
! PART/2 is pressed on by 10 kN and has friction; PART/3 is pulled by 3 kN for 0.2 s.

UNITS/SYSTEM=MKS

PART/1, GROUND
MARKER/1, PART=1, REULER=90D,90D,0
MARKER/5, PART=1, FLOATING
MARKER/7, PART=1

PART/2, MASS=5, CM=2, IP=1,1,1
MARKER/2, PART=2, REULER=90D,90D,0
JOINT/2, TRANSLATIONAL, I=2, J=1
VFORCE/2, I=2, JFLOAT=5, RM=7, FX=0\\ FY=-1E4\\ FZ=0
FRICTION/2, JOINT=2, MU_STATIC=0.3, MU_DYNAMIC=0.2, INPUTS=REACTION_FORCE
, STICTION_TRANSITION_VELOCITY=1E-5, MAX_STICTION_DEFORMATION=1E-7

PART/3, MASS=5, CM=3, IP=1,1,1, QG=1,0,0
MARKER/3, PART=3, REULER=90D,90D,0
MARKER/6, PART=1, QP=1,0,0, REULER=90D,90D,0
JOINT/3, TRANSLATIONAL, I=3, J=6
SFORCE/3, TRANSLATIONAL, ACTIONONLY, I=3, J=6, FUNCTION=IF(TIME-0.2:3E3,0,0)

SPRINGDAMPER/1, TRANSLATIONAL, I=3, J=2, K=1E4, C=0, LENGTH=1

VARIABLE/stuck, FUNCTION=DX(2,1)
VARIABLE/pulled, FUNCTION=DX(3,6)

INTEGRATOR/GSTIFF, SI2, ERROR=1.0E-8
SIMULATE/DYNAMIC, END=0.6, STEPS=600
END
"""


def slip(start: np.ndarray, pull: float) -> tuple[np.ndarray, np.ndarray, float, float]:
    """Place and speed of the middle; swing (cos, sin) of x2 - x1 about its rest; rest; gain."""
    middle = np.array([start[0] + start[1], start[2] + start[3]]) / 2
    rest = (pull + SLIDING * NORMAL) / (2 * STIFFNESS)
    turn = np.sqrt(2 * STIFFNESS / MASS)
    swing = np.array([start[1] - start[0] - rest, (start[3] - start[2]) / turn])
    return middle, swing, rest, (pull - SLIDING * NORMAL) / (2 * MASS)


def state(start: np.ndarray, begin: float, pull: float, t: float) -> np.ndarray:
    """x1, x2, x1', x2' at `t`, slipping from `start` at `begin` on."""
    middle, swing, rest, gain = slip(start, pull)
    s, turn = t - begin, np.sqrt(2 * STIFFNESS / MASS)
    c, d = np.cos(turn * s), np.sin(turn * s)
    apart = rest + swing @ [c, d]
    parting = turn * (swing @ [-d, c])
    place = middle[0] + middle[1] * s + gain * s**2 / 2
    speed = middle[1] + gain * s
    return np.array(
        [place - apart / 2, place + apart / 2, speed - parting / 2, speed + parting / 2]
    )


def path() -> tuple[float, float, float]:
    """t1 and t3 [s], and where PART/2 comes to rest [m]."""
    w = np.sqrt(STIFFNESS / MASS)
    first = np.arccos(1 - STATIC * NORMAL / PULL) / w
    loose = PULL / STIFFNESS * np.array([1 - np.cos(w * first), w * np.sin(w * first)])
    start = np.array([0, loose[0], 0, loose[1]])
    times = np.linspace(first, OFF, 20001)[1:]
    assert min(state(start, first, PULL, t)[2] for t in times) > 0
    behind = state(start, first, PULL, OFF)
    times = np.linspace(OFF, 1, 20001)
    speeds = np.array([state(behind, OFF, 0, t)[2] for t in times])
    k = np.flatnonzero(speeds < 0)[0]
    last = brentq(lambda t: state(behind, OFF, 0, t)[2], times[k - 1], times[k], xtol=1e-15)
    end = state(behind, OFF, 0, last)
    # From here on it holds: the spring never pulls with more than friction at rest.
    assert STIFFNESS * np.hypot(end[1] - end[0], end[3] / w) < STATIC * NORMAL
    return first, last, end[0]


if __name__ == "__main__":
    (HERE / "stick-and-slip.adm").write_text(DECK)
    first, last, place = path()
    lines = ["# Where the slipping mass comes to rest: see README.md"]
    lines += ["# written by make_reference.py"]
    lines += [f"# measure: last VARIABLE/stuck = {place:.9f} tol rel 1e-4"]
    (HERE / "stick-and-slip.reference.csv").write_text("\n".join(lines) + "\n")
