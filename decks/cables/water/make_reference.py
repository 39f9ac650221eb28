"""Write scenes of cables in water, on a bed and with bending, and their references."""

import sys
from pathlib import Path

import numpy as np
from scipy.optimize import fsolve

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.parent), str(HERE.parents[1] / "published")]

import catenary  # noqa: E402  (it lies beside the published cases)
import elastica  # noqa: E402
from described_cases import write  # noqa: E402


def lines(*measures: tuple[str, float, str]) -> str:
    """A reference: measures with their values and tolerances."""
    rows = ["# Closed forms: README.md", "# written by make_reference.py"]
    rows += [f"# measure: {name} = {value:.8g} tol {within}" for name, value, within in measures]
    return "\n".join(rows) + "\n"


def chain(length: float, away: float, depth: float, n: int, lumps: float = 1) -> str:
    """Elastic catenary from the fairlead to where it lies; nothing rubs on the bed."""
    size = 0.252
    weight = (390 - 1025 * np.pi / 4 * size**2) * 9.8
    line = catenary.Cable(weight, 390, 1.674e9, length)

    def misses(u: np.ndarray) -> list[float]:
        level, upright = np.exp(u[0]), u[1]
        lifted = upright / weight
        lying = (length - lifted) * (1 + level / line.stiffness)
        x, z = line.place(level, upright, lifted)
        return [(x + lying) / away - 1, z / (depth - size / 2) - 1]

    u = fsolve(misses, [np.log(2 * weight * length), 0.5 * weight * length], xtol=1e-13)
    assert np.abs(misses(u)).max() < 1e-10 and u[1] < weight * length
    within = f"rel {lumps / n**2:.2g}"
    return lines(
        ("last REQUEST/10.F6", float(np.hypot(np.exp(u[0]), u[1])), within),
        ("last REQUEST/20.F6", float(np.exp(u[0])), within),
    )


def moored() -> str:
    return chain(410, 400, 50, 164, 4)


def moored_deep() -> str:
    return chain(760, 700, 200, 76)


def jumper() -> str:
    """Heavy elastica between two hinges."""
    weight = (165 - 1000 * np.pi / 4 * 0.396**2) * 9.807
    line = catenary.Cable(weight, 165, 5e8, 170)
    ends = np.array([[-100.0, -55.0], [0.0, -5.0]])

    def misses(u: np.ndarray) -> np.ndarray:
        x, z = line.place(np.exp(u[0]), u[1], 170)
        return (np.array([x, -z]) - (ends[1] - ends[0])) / 100

    u = fsolve(misses, [9.0, 2.4e4], xtol=1e-13)
    level, upright = float(np.exp(u[0])), float(u[1])
    s = np.linspace(0, 170, 2001)
    places = np.array([ends[0] + line.place(level, upright, k) * [1, -1] for k in s])
    guess = np.vstack([places.T, np.arctan2(weight * s - upright, level)])
    level, low, _ = elastica.between_hinges(line, 120.8e3, ends, guess, (level, -upright))
    return lines(
        ("last REQUEST/10.F2", level, "rel 1e-4"),
        ("last REQUEST/10.F3", low, "rel 1e-4"),
        ("last REQUEST/20.F3", -(low + weight * 170), "rel 1e-4"),
    )


def held() -> str:
    """Heavy elastica; nodes of weight w h and second differences sag by 5 + 4/n^2 instead of 5."""
    line, n = catenary.Cable(980.665, 100, 1.5e9, 10), 80
    sag = 5 * 980.665 * 1e4 / 384 / 1e7
    s = np.linspace(0, 1, 2001)
    slope = -sag * np.pi / 10 * np.cos(np.pi * s)
    guess = np.vstack([10 * s, -sag * np.sin(np.pi * s), slope])
    ends = np.array([[0.0, 0.0], [10.0, 0.0]])
    _, _, down = elastica.between_hinges(line, 1e7, ends, guess, (6e3, -4903.0))
    return lines(("last POINT_MASS/1040.y", float(down[1000]) * (1 + 0.8 / n**2), "rel 5e-5"))


def sinking() -> str:
    """v = V tanh(t/tau), V = sqrt(w/k), tau = (rho + m)/sqrt(w k), k = rho_w D Cn/2."""
    displaced = 1000 * np.pi / 4 * 0.04**2
    w, k, m = (2 - displaced) * 9.81, 1000 * 0.04 * 1.2 / 2, 2 + displaced
    tau, rows = m / np.sqrt(w * k), []
    for t in (0.2, 0.4, 4.0):
        fall = -np.sqrt(w / k) * tau * np.log(np.cosh(t / tau))
        rows.append((f"value POINT_MASS/10.vy at {t:g}", -np.sqrt(w / k) * np.tanh(t / tau)))
        rows.append((f"value POINT_MASS/1005.y at {t:g}", fall))
    return lines(*((name, float(value), "rel 1e-5") for name, value in rows))


def towed() -> str:
    """It is straight: rho_w D Cn U^2 sin^2 a/2 = w cos a, a from the current; at the ship
    T = l (w sin a + rho_w D pi Ct U^2 cos^2 a/2), the drag of the half section there left out."""
    w, c = (2 - 1000 * np.pi / 4 * 0.04**2) * 9.81, 1000 * 0.04 / 2 * 2**2
    q = c * 1.2 / w
    cosine = (np.sqrt(1 + 4 * q * q) - 1) / (2 * q)
    sine = np.sqrt(1 - cosine**2)
    pull = 10 * (w * sine + 0.95 * c * np.pi * 0.01 * cosine**2)
    # The description draws it as it hangs at rest.
    stretched = (1 + pull / 2e6) / (1 + 10 * w / 2e6)
    return lines(
        ("last POINT_MASS/20.x", 10 * float(cosine) * stretched, "rel 1e-6"),
        ("last POINT_MASS/20.y", -10 * float(sine) * stretched, "rel 1e-6"),
    )


CASES = {"moored": moored, "moored-deep": moored_deep, "jumper": jumper, "held": held,
         "sinking": sinking, "towed": towed}  # fmt: skip


if __name__ == "__main__":
    write(HERE, CASES)
