"""Write the references of the N = 2 four-bar, whose cranks stay parallel: one equation."""

import sys
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))

from minimal import solve, write  # noqa: E402  (it lies beside the folders of the cases)

G, N = 9.81, 2
LINES = """
A02, N = 2, one equation, DOP853 at rtol 1e-12: see README.md
solve: --error {error:g}
tolerance: abs {band:g}
"""


def main():
    inertia, arm = (N + 1) / 3 + N, (N + 1) / 2 + N
    t = np.linspace(0, 10, 201)

    def rhs(_, y):
        return np.array([y[1], -G * arm / inertia * np.cos(y[0])])

    y = solve(rhs, [np.pi / 2, -1], t)
    assert np.allclose(solve(rhs, [np.pi / 2, -1], t, 1e-10), y, rtol=0, atol=1e-7)
    x, h = np.cos(y[:, 0]), np.sin(y[:, 0])
    at = {4.0: (0.11761610, 0.99305914), 10.0: (0.32845811, 0.94451854)}
    for time, place in at.items():
        k = int(np.argmin(np.abs(t - time)))
        assert np.allclose([x[k], h[k]], place, rtol=0, atol=1e-8)
    columns = {
        "REQUEST/1.F2": x, "REQUEST/1.F3": h, "REQUEST/1.F4": 0,
        "REQUEST/2.F2": x + 2, "REQUEST/2.F3": h, "PART/40.theta": 0, "PART/50.theta": 0,
    }  # fmt: skip
    for tag, error, band in (("", 1e-6, 3e-3), ("-tight", 1e-8, 1e-4)):
        lines = LINES.format(error=error, band=band)
        write(HERE / f"reference{tag}.csv", lines, list(columns), [t, *columns.values()])


if __name__ == "__main__":
    main()
