"""Write the reference of the three-joint couplers from their closed form."""

import sys
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))

from minimal import write  # noqa: E402  (it lies beside the folders of the cases)

LINES = """
Three coupled freedoms, constant accelerations: see README.md
tolerance: abs 1e-8
tolerance PART/*.z: abs 1e-6
tolerance PART/*.wz: abs 1e-6
"""


def accelerations(inertia, load, scale):
    """q" of I_i q_i" = load_i + s_i x, s.q" = 0; and the generalised forces s_i x."""
    inertia, load, scale = np.array(inertia), np.array(load), np.array(scale)
    x = -(scale * load / inertia).sum() / (scale**2 / inertia).sum()
    a = (load + scale * x) / inertia
    matrix = np.block([[np.diag(inertia), -scale[:, None]], [scale, 0.0]])
    assert np.allclose(np.linalg.solve(matrix, [*load, 0.0]), [*a, x])
    return a, scale * x


def main():
    t = np.linspace(0, 1, 51)
    hoist, pull = accelerations([0.02, 0.05, 12.0], [9.0, 5.0, -12 * 9.81], [0.1, 0.1, -2.0])
    shaft, twist = accelerations([0.01, 0.03, 0.02], [0.2, -0.1, 0.3], [1.0, 1.0, -2.0])
    assert np.isclose(hoist[2], 0.05 * (hoist[0] + hoist[1]))
    columns = {
        # The axles of the drums point along -y.
        "PART/10.aly": -hoist[0], "PART/20.aly": -hoist[1], "PART/30.az": hoist[2],
        "PART/30.z": hoist[2] * t**2 / 2, "COUPLER/1.ty": -pull[0],
        "PART/40.alz": shaft[0], "PART/50.alz": shaft[1], "PART/60.alz": shaft[2],
        "PART/60.wz": shaft[2] * t, "COUPLER/2.tz": twist[0],
    }  # fmt: skip
    write(HERE / "reference.csv", LINES, list(columns), [t, *columns.values()])


if __name__ == "__main__":
    main()
