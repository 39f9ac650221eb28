"""The cable of a scene and what its stations may have: reels, mounts, guides, motors, brakes,
floors."""

from dataclasses import dataclass
from math import pi, sqrt

from adamslite.cables.vectors import Vector


@dataclass(frozen=True)
class Cable:
    """A cable in SI units: stiffness EA [N], density rho [kg/m] of the unstretched cable.

    `pulls_only` says that a slack section carries nothing; else it pushes. With `parts` it parts at
    the tension `breaking`. `length` is that of the
    unstretched cable between two ends, 0 where it follows from the tension [m]. `bending` is EI
    [N m^2], and a rate of the curvature counts for `bending_damping` [s] of it; a rate of the
    strain for `damping_time` [s], which follows from the share `damping` where that is given.
    """

    stiffness: float
    density: float
    pretension: float = 0.0
    breaking: float = 0.0
    parts: bool = False
    damping: float = 0.0
    pulls_only: bool = False
    diameter: float = 0.0
    length: float = 0.0
    bending: float = 0.0
    bending_damping: float = 0.0
    damping_time: float = 0.0
    name: str = ""

    @property
    def speed(self) -> float:
        """Axial wave speed c = sqrt(EA/rho) [m/s]."""
        return sqrt(self.stiffness / self.density)

    def running(self, speed: float) -> float:
        """Tension that keeps the shape of a cable that runs along itself at `speed`: T (1 + T/EA) =
        rho v^2, the momentum rho v/(1 + T/EA) v that passes a place in a second [N].
        """
        half = self.stiffness / 2
        return sqrt(half**2 + self.stiffness * self.density * speed**2) - half


@dataclass(frozen=True)
class Pivot:
    """A hinge at `at` about `axis`, on the ground or on the load of the name `on`."""

    at: Vector
    axis: Vector
    on: str = ""


@dataclass(frozen=True)
class Load:
    """A body that several cables carry, with `inertia` about its mass centre [kg m^2]; a point
    without. `part` is its number in the deck."""

    name: str
    at: Vector
    mass: float
    inertia: Vector = (0.0, 0.0, 0.0)
    velocity: Vector = (0.0, 0.0, 0.0)
    pivot: Pivot | None = None
    part: int = 0

    @property
    def turns(self) -> bool:
        """Whether it is more than a point."""
        return any(self.inertia)


@dataclass(frozen=True)
class Reel:
    """A pack of cable, `thickness` [m] from turn to turn, on a core of the radius `core` [m].

    The radius of the pack grows by the thickness with every turn, r = r0 + h a/(2 pi), so that a
    turn by the angle a winds up s = (r0 + r)/2 a.
    """

    thickness: float
    core: float

    def holds(self, radius: float) -> float:
        """Cable on it when the pack has this radius [m]."""
        return pi * (radius**2 - self.core**2) / self.thickness

    def inertia(self, radius: float, density: float) -> float:
        """Of that cable, which has `density` [kg/m], about the axle [kg m^2]."""
        return density * self.holds(radius) * (radius**2 + self.core**2) / 2


@dataclass(frozen=True)
class Mount:
    """What the bearing of a wheel sits on: a bracket of `mass` [kg] that stands on the ground.

    It is rigid without `stiffness` [N/m]; else it gives way in all directions and does not turn.
    """

    foot: Vector
    mass: float
    stiffness: float = 0.0
    damping: float = 0.0


@dataclass(frozen=True)
class Wander:
    """A guide of `mass` [kg] slides along the axle with the cable, against a spring and a damper
    ([N/m], [N s/m])."""

    mass: float
    stiffness: float
    damping: float = 0.0


@dataclass(frozen=True)
class Motor:
    """What an engine can do: `curve`, pairs of the speed of the drum [rad/s] and its torque [N m].

    `gain` [N m s/m] is that of a controller of the speed.
    """

    curve: tuple[tuple[float, float], ...]
    gain: float = 0.0


@dataclass(frozen=True)
class Brake:
    """A brake of `torque` [N m], of which `applied` says what share acts at a time."""

    torque: float
    applied: str = ""


@dataclass(frozen=True)
class Floor:
    """What a weight lands on, `depth` [m] below its place: a spring and a damper ([N/m], [N s/m])
    that do not pull."""

    depth: float
    stiffness: float
    damping: float = 0.0
