"""Write deck and reference of the spinning cable ring: 40 masses on a circle."""

import sys
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1]))

from minimal import write  # noqa: E402  (it lies beside the folders of the cases)

N, RADIUS, SPEED, LINE_MASS, STIFFNESS = 40, 0.5, 200.0, 5.536, 6e7
TENSION = LINE_MASS * (SPEED * RADIUS) ** 2 * (np.pi / N) / np.sin(np.pi / N)
HEAD = """Spinning cable ring: {n} masses, {n} sections, no gravity
! Written by make_reference.py. Each section is stretched by the tension that keeps its masses on
! the circle.

UNITS/SYSTEM=MKS

PART/1, GROUND
MARKER/1, PART=1

VARIABLE/EA, FUNCTION=6.0E7
VARIABLE/free_length, FUNCTION={free:.16g}
"""
NODE = """
POINT_MASS/{k}, MASS={mass:.16g}, CM={k}, QG={x:.16g},{y:.16g},0, VX={vx:.16g}, VY={vy:.16g}
MARKER/{k}, POINT_MASS={k}
SFORCE/{k}, TRANSLATION, I={k}, J={next}
, FUNCTION=-VARVAL(EA)/VARVAL(free_length)*(DM({k},{next})-VARVAL(free_length))
"""
TAIL = """
INTEGRATOR/HHT, ERROR=2.0E-10
SIMULATE/DYNAMIC, END=0.1, STEPS=100
END
"""
LINES = """
The ring keeps its circle and its tension: see README.md
tolerance: rel {tension}
tolerance POINT_MASS/*: abs {place}
"""


def deck():
    chord = 2 * RADIUS * np.sin(np.pi / N)
    parts = [HEAD.format(n=N, free=chord / (1 + TENSION / STIFFNESS))]
    for k in range(N):
        s, c = np.sin(2 * np.pi * k / N), np.cos(2 * np.pi * k / N)
        parts.append(
            NODE.format(
                k=k + 2, next=(k + 1) % N + 2, mass=LINE_MASS * 2 * np.pi * RADIUS / N,
                x=RADIUS * c, y=RADIUS * s, vx=-RADIUS * SPEED * s, vy=RADIUS * SPEED * c,
            )
        )  # fmt: skip
    return "".join([*parts, TAIL])


def main():
    assert abs(LINE_MASS * (SPEED * RADIUS) ** 2 - 55360) < 1e-8
    (HERE / "spinning-ring.adm").write_text(deck())
    t = np.linspace(0, 0.1, 101)
    angle = SPEED * t
    columns = {
        "POINT_MASS/2.x": RADIUS * np.cos(angle), "POINT_MASS/2.y": RADIUS * np.sin(angle),
        "SFORCE/2.f": -TENSION, "SFORCE/15.f": -TENSION, "SFORCE/30.f": -TENSION,
    }  # fmt: skip
    runs = {
        "reference": ("1e-6", "2e-6", ""),
        "reference-abam": ("1e-8", "1e-9", "solve: --integrator ABAM"),
        "reference-gstiff": ("2e-5", "1e-7", "solve: --integrator GSTIFF"),
    }
    for name, (tension, place, flags) in runs.items():
        lines = LINES.format(tension=tension, place=place) + flags
        write(HERE / f"{name}.csv", lines, list(columns), [t, *columns.values()])


if __name__ == "__main__":
    main()
