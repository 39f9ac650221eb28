"""What is round a cable: water and a sea bed, and how a description gives them."""

from dataclasses import dataclass
from math import inf, pi

from adamslite.cables.vectors import Vector, dot, unit


@dataclass(frozen=True)
class Drag:
    """Coefficients of Morison's equation: across the cable for its diameter, along it for its
    surface pi D."""

    normal: float
    tangential: float = 0.0


@dataclass(frozen=True)
class Water:
    """Water of `density` [kg/m^3] below the height `level` [m], which flows with `current` [m/s].

    `added_mass` is the share of the displaced water that is accelerated with the cable across it.
    """

    density: float
    level: float = inf
    current: tuple[str, str, str] = ("", "", "")
    drag: Drag | None = None
    added_mass: float = 0.0
    buoyancy: bool = True

    def displaced(self, diameter: float) -> float:
        """Mass of the water in whose place a cable of `diameter` [m] is [kg/m]."""
        return self.density * pi / 4 * diameter**2


@dataclass(frozen=True)
class Bed:
    """Ground at the height `level` [m], on which the cable lies with its underside.

    `stiffness` [N/m^2] and `damping` [N s/m^2] are per length of cable. `friction` is reached above
    the sliding speed `creep` [m/s].
    """

    level: float
    stiffness: float
    damping: float = 0.0
    friction: float = 0.0
    creep: float = 1e-3


def height(gravity: Vector, place: Vector) -> float:
    """Of a place, against gravity [m]."""
    return -dot(unit(gravity), place)
