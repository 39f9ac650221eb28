"""Write a flexible jumper, a chain of BEAMs in water, and the pulls of the heavy elastica."""

import sys
from pathlib import Path

import numpy as np
from scipy.optimize import fsolve

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))

import catenary  # noqa: E402  (they lie beside the folders of the cases)
import elastica  # noqa: E402

LENGTH, MASS, DIAMETER, EA, EI, WATER, G = 170.0, 165.0, 0.396, 5e8, 120.8e3, 1000.0, 9.807
LOW, HIGH = np.array([-100.0, -55.0]), np.array([0.0, -5.0])
LIFT = WATER * np.pi / 4 * DIAMETER**2
CABLE = catenary.Cable((MASS - LIFT) * G, MASS, EA, LENGTH)
END = """
! Pulls on what holds the ends, each with its half lump.
VARIABLE/level, FUNCTION=-BEAM({low},0,2)
VARIABLE/bottom, FUNCTION=BEAM({low},0,3)+{half:.9g}
VARIABLE/top, FUNCTION={half:.9g}-BEAM({high},0,3)

EQUILIBRIUM/ERROR=1.0E-10, IMBALANCE=1.0E-4, MAXIT=2000
SIMULATE/STATICS
END
"""


def without_bending() -> np.ndarray:
    """H and the pull V upright at the lower end of the cable that does not resist bending."""

    def residual(u: np.ndarray) -> np.ndarray:
        x, z = CABLE.place(np.exp(u[0]), u[1], LENGTH)
        return (np.array([x, -z]) - (HIGH - LOW)) / 100

    u = fsolve(residual, [9.0, 2.4e4], xtol=1e-13)
    assert np.abs(residual(u)).max() < 1e-9
    return np.array([np.exp(u[0]), u[1]])


def posture(s: np.ndarray) -> np.ndarray:
    """x, y and slope of that cable at the places s [m]."""
    level, upright = without_bending()
    places = np.array([LOW + CABLE.place(level, upright, k) * [1, -1] for k in s])
    return np.vstack([places.T, np.arctan2(CABLE.weight * s - upright, level)])


def exact() -> tuple[float, float, float]:
    """Level pull, upright pulls on the bottom and on the top [N]."""
    level, upright = without_bending()
    guess = posture(np.linspace(0, LENGTH, 2001))
    level, low, _ = elastica.between_hinges(
        CABLE, EI, np.array([LOW, HIGH]), guess, (level, -upright)
    )
    return level, -low, low + CABLE.weight * LENGTH


def deck(n: int) -> str:
    """Its text, with n beams; statics starts from the cable that does not resist bending."""
    h = LENGTH / n
    text = catenary.head(f"A flexible jumper between two platforms, {n} beams", gravity=G)
    text += "MARKER/2, PART=1, QP=-100,-55,0\nMARKER/3, PART=1, QP=0,-5,0\n"
    for k, (x, y, turn) in enumerate(posture(np.linspace(0, LENGTH, n + 1)).T):
        i, share = 1000 + k, h * (0.5 if k in (0, n) else 1)
        text += elastica.part(i, MASS * share, np.array([x, y]), turn, LIFT * G * share)
        if k:
            text += elastica.beam(i, CABLE, EI, h)
    text += f"\nJOINT/1, REVOLUTE, I=1000, J=2\nJOINT/2, REVOLUTE, I={1000 + n}, J=3\n"
    return text + END.format(low=1001, high=1000 + n, half=CABLE.weight * h / 2)


def main(n: int = 68) -> None:
    (HERE / "jumper.adm").write_text(deck(n))
    lines = [
        "# Pulls on the ends, of the heavy elastica: see README.md",
        "# written by make_reference.py",
    ]
    for name, value in zip(("level", "bottom", "top"), exact(), strict=True):
        lines.append(f"# measure: last VARIABLE/{name} = {value:.3f} tol rel 5e-5")
    (HERE / "jumper.reference.csv").write_text("\n".join(lines) + "\n")


main()
