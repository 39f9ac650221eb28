"""Write decks and references of a string that runs through two eyelets below and above wave speed.

Nodes at rest along the string, which flows through them at W; y the displacement across:

    m (y" + 2 W y'_S + W^2 y_SS) = m c^2 y_SS,      central differences over sections of length H

is linear, Y' = A Y, and solved by the exponential of the matrix A.
"""

import sys
from pathlib import Path

import numpy as np
from scipy.linalg import expm

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1]))

from minimal import write  # noqa: E402  (it lies beside the folders of the cases)

N, LENGTH, RHO, WAVE, HEIGHT = 10, 10.0, 1.0, 50.0, 0.01
H, MASS = LENGTH / N, RHO * LENGTH / N
TENSION = RHO * WAVE**2
# Transport over wave speed, end [s].
CASES = {"below": (0.9, 4.0), "above": (1.1, 0.2)}
TEXT = """A string that runs through eyelets at {share:g} times the speed of its waves
! The nodes stay where they are along the string, which flows through them at W = {speed:g} m/s.
! Written by make_reference.py

UNITS/SYSTEM=MKS

VARIABLE/W, FUNCTION={speed:g}

PART/1, GROUND
MARKER/1, PART=1
MARKER/{last}, PART=1, QP={length:g},0,0
"""
NODE = """
POINT_MASS/{k}, MASS={mass:g}, CM={k}, QG={x:g},{y:.16g},0
MARKER/{k}, POINT_MASS={k}
VFORCE/{k}, I={k}, J_PART=1, FX=0\\
, FY=({tension:g}-{rho:g}*VARVAL(W)**2)*(DY({up})-2*DY({k})+DY({low}))/{h:g}
, -{rho:g}*VARVAL(W)*(VY({up})-VY({low}))\\
, FZ=0
"""
LINES = """
Exponential of the linear equations: see README.md
tolerance: abs 1e-6 rel 1e-4
"""


def start():
    """Half a sine."""
    return HEIGHT * np.sin(np.pi * np.arange(1, N) / N)


def matrix(speed):
    """A of Y = (y, y'), N - 1 inner nodes."""
    bend = (np.eye(N - 1, k=1) - 2 * np.eye(N - 1) + np.eye(N - 1, k=-1)) / H**2
    slope = (np.eye(N - 1, k=1) - np.eye(N - 1, k=-1)) / (2 * H)
    zero, one = np.zeros((N - 1, N - 1)), np.eye(N - 1)
    return np.block([[zero, one], [(WAVE**2 - speed**2) * bend, -2 * speed * slope]])


def deck(share, end):
    """The text of a deck."""
    text = TEXT.format(share=share, speed=share * WAVE, last=N + 1, length=LENGTH)
    for k, y in enumerate(start(), 2):
        text += NODE.format(
            k=k, low=k - 1, up=k + 1, mass=MASS, x=(k - 1) * H, y=y, tension=TENSION, rho=RHO, h=H
        )
    run = f"SIMULATE/DYNAMIC, END={end:g}, STEPS=80\nEND\n"
    return f"{text}\nINTEGRATOR/GSTIFF, SI2, ERROR=1.0E-8\n{run}"


def main():
    for name, (share, end) in CASES.items():
        a = matrix(share * WAVE)
        grows = np.linalg.eigvals(a).real.max()
        assert (grows > 1.0) == (share > 1.0), grows
        t = np.linspace(0, end, 81)
        y = np.array([expm(a * x) @ np.concatenate([start(), np.zeros(N - 1)]) for x in t])
        names = [f"POINT_MASS/{k}.y" for k in (3, 6, 9)]
        write(HERE / f"{name}.reference.csv", LINES, names, [t, y[:, 1], y[:, 4], y[:, 7]])
        (HERE / f"{name}.adm").write_text(deck(share, end))


if __name__ == "__main__":
    main()
