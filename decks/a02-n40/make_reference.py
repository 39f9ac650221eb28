"""Write the deck and the references of forty four-bars in a row, whose cranks stay parallel.

((N + 1)/3 + N) a" = -g ((N + 1)/2 + N) cos(a),   a(0) = 90 degrees, a'(0) = -1 rad/s
"""

import sys
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))

from minimal import solve, write  # noqa: E402  (it lies beside the folders of the cases)

G, N = 9.81, 40
HEAD = f"""Forty four-bars in a row (IFToMM benchmark A02 with N = 40)
! Written by make_reference.py
! {2 * N + 1} uniform links of 1 m and 1 kg: cranks at x = 0..{N} and {N} couplers. Full
! revolutes have {15 * N + 5} rows for {12 * N + 6} freedoms. When the cranks lie flat, which is
! at about t = 1.6 first, the links could fold apart in {N} ways.

UNITS/SYSTEM=MKS
ACCGRAV/JGRAV=-9.81

PART/1, GROUND
"""
TAIL = """
REQUEST/1, DISPLACEMENT, I=1001
REQUEST/2, DISPLACEMENT, I=1401

INTEGRATOR/GSTIFF, SI2, ERROR=1.0E-6
SIMULATE/DYNAMIC, END=20, STEPS=400
END
"""
ROD = "MASS=1, CM={cm}, IP=0.001,0.083333333333333333,0.083333333333333333"
LINES = """
A02, N = 40, one equation, DOP853 at rtol 1e-12: see README.md
solve: --integrator {integrator} --error {error:g}
tolerance: abs {band:g}
"""
PUBLISHED = {
    1: (-0.11535688, -0.99332411),
    5: (-0.54019005, -0.84154305),
    10: (0.18051223, 0.98357274),
    20: (0.41090115, 0.91167990),
}


def deck():
    """Part 100 + k is the crank at x = k, its frame's x axis along it; part 200 + k the coupler."""
    lines = [f"MARKER/{k + 1}, PART=1, QP={k},0,0" for k in range(N + 1)]
    for k in range(N + 1):
        part, lines = 100 + k, [*lines, ""]
        lines.append(f"PART/{part}, {ROD.format(cm=10 * part + 2)}, QG={k},0,0, REULER=90D,0,0")
        lines.append(", VX=0.5, WZ=-1")
        lines += [
            f"MARKER/{10 * part + m}, PART={part}, QP={x},0,0" for m, x in enumerate((0, 1, 0.5))
        ]
    for k in range(N):
        part, lines = 200 + k, [*lines, ""]
        lines.append(f"PART/{part}, {ROD.format(cm=10 * part + 2)}, QG={k},1,0, VX=1")
        lines += [
            f"MARKER/{10 * part + m}, PART={part}, QP={x},0,0" for m, x in enumerate((0, 1, 0.5))
        ]
    lines.append("")
    lines += [f"JOINT/{k + 1}, REVOLUTE, I={10 * (100 + k)}, J={k + 1}" for k in range(N + 1)]
    for k in range(N):
        lines.append(f"JOINT/{100 + k}, REVOLUTE, I={10 * (200 + k)}, J={10 * (100 + k) + 1}")
        lines.append(f"JOINT/{200 + k}, REVOLUTE, I={10 * (200 + k) + 1}, J={10 * (101 + k) + 1}")
    return HEAD + "\n".join(lines) + "\n" + TAIL


def main():
    (HERE / "a02-n40.adm").write_text(deck())
    inertia, arm = (N + 1) / 3 + N, (N + 1) / 2 + N
    t = np.linspace(0, 20, 401)

    def rhs(_, y):
        return np.array([y[1], -G * arm / inertia * np.cos(y[0])])

    y = solve(rhs, [np.pi / 2, -1], t)
    x, h = np.cos(y[:, 0]), np.sin(y[:, 0])
    for time, place in PUBLISHED.items():
        k = int(np.argmin(np.abs(t - time)))
        assert np.allclose([x[k], h[k]], place, rtol=0, atol=1e-8)
    columns = {
        "REQUEST/1.F2": x, "REQUEST/1.F3": h, "REQUEST/1.F4": 0,
        "REQUEST/2.F2": x + N, "REQUEST/2.F3": h, "PART/220.theta": 0,
    }  # fmt: skip
    for name, integrator, error, band in (
        ("reference", "RKF45", 1e-6, 1e-5),
        ("reference-gstiff", "GSTIFF", 1e-8, 1e-3),
    ):
        lines = LINES.format(integrator=integrator, error=error, band=band)
        write(HERE / f"{name}.csv", lines, list(columns), [t, *columns.values()])


if __name__ == "__main__":
    main()
