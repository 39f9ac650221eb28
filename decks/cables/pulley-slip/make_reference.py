"""Write the decks and references of the slipping cables; the equations are in slip.py."""

from pathlib import Path

import numpy as np
from slip import Pulley
from slip_deck import deck

HERE = Path(__file__).resolve().parent
HOLD = "Cable that holds on a locked pulley, creeping"
SLIDE = "Cable that slides over a locked pulley"
BRAKE = "Braked pulley: the cable grips, slips at T1/T2 = exp(mu wrap), and slides over the pulley"
HEAVY = "Heavy cable, variable-length elements on both sides, sliding over a locked pulley"
CASES = {
    "holding": Pulley(HOLD, (12, 8), 0.2, 0.05, 0.3, np.pi, 3, 1e6),
    "holding-three-turns": Pulley(HOLD, (300, 0.5), 0.1, 0.05, 0.35, 6 * np.pi, 2, 1e6, creep=2e-4),
    "sliding": Pulley(SLIDE, (30, 8), 0.2, 0.05, 0.3, np.pi, 3, 1e6),
    "sliding-quarter": Pulley(SLIDE, (4, 3), 0.1, 0.05, 0.12, np.pi / 2, 2, 4e5),
    "braked": Pulley(BRAKE, (12, 8), 0.2, 0.05, 0.3, np.pi, 5, 2e6, 3.0, 40.0, 25.0),
    "braked-small": Pulley(BRAKE, (3, 2), 0.1, 0.004, 0.2, np.pi, 4, 4e5, 2.0, 6.0, 2.5, end=0.8),
    "heavy": Pulley(HEAVY, (30, 8), 0.2, 0.05, 0.3, np.pi, 3, 1e6, rho=1.0, sections=4),
    "heavy-finer": Pulley(HEAVY, (20, 5), 0.2, 0.05, 0.2, np.pi, 4, 5e5, rho=2.0, sections=8),
}
NAMES = [
    "DIFF/paid",
    "REQUEST/1.F7",
    "REQUEST/1.F8",
    "REQUEST/1.F3",
    "REQUEST/1.F4",
    "REQUEST/1.F2",
]
DEAD = 15 * 9.81
"""Weight of pulley and mount."""


def tolerances(p):
    """Lines of tolerance: see README.md."""
    weight = sum(p.weights) * 9.81
    return [
        f"# {p.title}: see README.md",
        "# tolerance: abs 1e-3",
        "# tolerance REQUEST/1.F[78]: abs 2e-3",
        f"# tolerance REQUEST/1.F[234]: abs {3e-3 * weight:.3g}",
        "# written by make_reference.py",
    ]


def main():
    for name, p in CASES.items():
        times = np.linspace(0, p.end, 101)
        motion = p.motion(times)
        table = np.column_stack([times, motion, -motion[:, 3] - motion[:, 4] - DEAD])
        rows = [",".join(f"{x:.10g}" for x in row) for row in table + 0.0]
        head = [*tolerances(p), ",".join(["time", *NAMES])]
        (HERE / f"{name}.reference.csv").write_text("\n".join([*head, *rows]) + "\n")
        (HERE / f"{name}.adm").write_text(deck(p))
        simulate = f"SIMULATE/DYNAMIC, END={p.end:g}, STEPS=100"
        (HERE / f"{name}.acf").write_text(f"file/model={name}\n{simulate}\nSTOP\n")


if __name__ == "__main__":
    main()
