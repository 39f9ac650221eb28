"""A heavy line that bends, between two hinges, and the text of a chain of BEAMs in its place.

With s from the first end, slope a, curvature k, pull (H, V) of what follows, V = V0 + w s:

    x' = e cos a,  y' = e sin a,  a' = k,  EI k' = -e (V cos a - H sin a)
    e = 1 + (H cos a + V sin a)/EA
    both ends: places given, k = 0

S. S. Antman, Nonlinear Problems of Elasticity, 2nd ed. 2005, chapter 4 (planar, without shear).
"""

import numpy as np
from catenary import Cable
from scipy.integrate import solve_bvp


def between_hinges(
    c: Cable, bending: float, ends: np.ndarray, guess: np.ndarray, pulls: tuple[float, float]
) -> tuple[float, float, np.ndarray]:
    """H, V0 [N] and y at 2001 places, for EI = `bending` [N m2] and `ends` (2, 2) [m].

    `guess` (3, 2001) has x, y, slope.
    """
    size = c.length

    def slopes(s: np.ndarray, y: np.ndarray, p: np.ndarray) -> np.ndarray:
        level, up = p[0], p[1] + c.weight * s * size
        x, z = np.cos(y[2]), np.sin(y[2])
        e = 1 + (level * x + up * z) / c.stiffness
        return size * np.array([e * x, e * z, y[3], -e * (up * x - level * z) / bending])

    def misses(a: np.ndarray, b: np.ndarray, p: np.ndarray) -> np.ndarray:
        return np.array([*(a[:2] - ends[0]), *(b[:2] - ends[1]), a[3], b[3]])

    s = np.linspace(0, 1, 2001)
    start = np.vstack([guess, np.gradient(guess[2], size * s)])
    found = solve_bvp(slopes, misses, s, start, p=list(pulls), tol=1e-8, max_nodes=100000)
    assert found.success, found.message
    return float(found.p[0]), float(found.p[1]), found.sol(s)[1]


def part(i: int, mass: float, place: np.ndarray, turn: float, lift: float = 0.0) -> str:
    """PART/i and its MARKER, turned by `turn` [rad] about z; `lift` [N] of water on it."""
    text = (
        f"\nPART/{i}, MASS={mass:.9g}, CM={i}, IP={mass:.9g},{mass:.9g},{mass:.9g}"
        f", QG={place[0]:.6f},{place[1]:.6f},0, REULER={turn:.6f},0,0\nMARKER/{i}, PART={i}\n"
    )
    if lift:
        text += f"MARKER/{i + 1000}, PART=1, FLOATING\n"
        text += f"VFORCE/{i}, I={i}, JFLOAT={i + 1000}, RM=1, FX=0\\ FY={lift:.9g}\\ FZ=0\n"
    return text


def beam(i: int, c: Cable, bending: float, h: float) -> str:
    """BEAM/i of h [m] from PART/i-1 to PART/i: an area of 1 m2, no shear."""
    second = bending / c.stiffness
    return (
        f"BEAM/{i}, I={i}, J={i - 1}, LENGTH={h:.12g}, AREA=1, EMODULUS={c.stiffness:g}"
        f", GMODULUS={c.stiffness / 2:g}\n"
        f", IYY={second:.9g}, IZZ={second:.9g}, IXX={2 * second:.9g}, ASY=0, ASZ=0\n"
    )
