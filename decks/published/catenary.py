"""The elastic catenary, and the text of a chain of point masses that stands for it in a deck.

A cable of unstretched length L, weight w per unstretched length and stiffness EA, pulled at its
left end by H level and V upright (x to the right, z downwards from that end):

    x(s) = H s/EA + H/w (asinh(V/H) - asinh((V - w s)/H))
    z(s) = s/EA (V - w s/2) + (sqrt(H^2 + V^2) - sqrt(H^2 + (V - w s)^2))/w

H. M. Irvine, Cable Structures, 1981, section 2.2.
"""

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Cable:
    """Weight [N/m] and mass [kg/m] per unstretched length, EA [N], unstretched length [m]."""

    weight: float
    mass: float
    stiffness: float
    length: float

    def place(self, level: float, upright: float, s: float) -> np.ndarray:
        """(x, z) of the point s of a cable pulled by (level, upright) at its left end."""
        w, ahead = self.weight, upright - self.weight * s
        away = level * s / self.stiffness
        away += level / w * (np.arcsinh(upright / level) - np.arcsinh(ahead / level))
        down = s / self.stiffness * (upright - w * s / 2)
        down += (np.hypot(level, upright) - np.hypot(level, ahead)) / w
        return np.array([away, down])


def head(title: str, *notes: str, gravity: float = 9.81) -> str:
    """Top of a deck in SI units, gravity [m/s^2] along -y, ground with MARKER/1 at the origin."""
    lines = [title, *(f"! {note}" for note in ("Written by make_reference.py.", *notes))]
    falls = [f"ACCGRAV/JGRAV=-{gravity:.16g}"] if gravity else []
    lines += ["", "UNITS/SYSTEM=MKS", *falls, ""]
    return "\n".join([*lines, "PART/1, GROUND", "MARKER/1, PART=1", ""])


def node(i: int, mass: float, place: tuple[float, float], more: str = "") -> str:
    """POINT_MASS and MARKER i at `place` [m]."""
    x, y = place
    return (
        f"\nPOINT_MASS/{i}, MASS={mass:.12g}, CM={i}, QG={x:.9g},{y:.9g},0{more}\n"
        f"MARKER/{i}, POINT_MASS={i}\n"
    )


def pull(pair: str, cable: Cable, free: str) -> str:
    """Expression of the tension [N] of a section of free length `free` between two MARKERs."""
    return f"{cable.stiffness:.12g}*(DM({pair})/{free}-1)"


def section(i: int, before: int, after: int, cable: Cable, free: str) -> str:
    """SFORCE/i of one section between MARKERs; `free` is its free length in the deck."""
    pair = f"{after},{before}"
    return (
        f"SFORCE/{i}, TRANSLATIONAL, I={after}, J={before}, FUNCTION=-{pull(pair, cable, free)}\n"
    )


def stand_in(depth: float, share: float) -> float:
    """A parabola, from which statics starts: -depth in the middle, 0 at share = 0 and 1."""
    return -4 * depth * share * (1 - share)
