"""Steady precession of a top whose round tip slides on a plane without friction."""

from __future__ import annotations

from math import cos, pi, sin, sqrt
from pathlib import Path

MASS, I1, I3, LEVER, SPIN, SLANT = 0.5, 4e-4, 6e-4, 0.05, 200.0, pi / 6
TIP, STIFFNESS, G = 0.005, 1e6, 9.81
END, STEPS = 2.0, 100
HEAD = """\
# Steady precession in closed form: see README.md
# written by make_reference.py
# tolerance: abs 2e-6
# tolerance PART/2.*: abs 1e-7
"""


def precession() -> float:
    """The slow root of I1 cos(slant) p^2 - I3 spin p + m g l = 0."""
    a, b, c = I1 * cos(SLANT), I3 * SPIN, MASS * G * LEVER
    return (b - sqrt(b * b - 4 * a * c)) / (2 * a)


def start() -> tuple[float, float]:
    """Height of the mass centre, and the angular velocity across the axis."""
    height = TIP - MASS * G / STIFFNESS + LEVER * cos(SLANT)
    return height, precession() * sin(SLANT)


def main() -> None:
    height, rate = start()[0], precession()
    lines = ["time,REQUEST/1.F2,REQUEST/1.F3,PART/2.x,PART/2.z"]
    for k in range(STEPS + 1):
        t = k * END / STEPS
        across = LEVER * sin(SLANT)
        x, y = -across * sin(rate * t), across * cos(rate * t)
        lines.append(f"{t:.12g},{x:.10g},{y:.10g},0,{height:.10g}")
    Path(__file__).with_name("reference.csv").write_text(HEAD + "\n".join(lines) + "\n")


if __name__ == "__main__":
    main()
