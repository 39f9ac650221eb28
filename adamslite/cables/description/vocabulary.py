"""What the description of a cable scene says: its stations, and the scene."""

from dataclasses import dataclass, field
from functools import cached_property
from math import pi, sin
from typing import Any

from adamslite.cables.description.components import (
    Brake,
    Cable,
    Floor,
    Motor,
    Mount,
    Reel,
    Wander,
)
from adamslite.cables.description.surroundings import Bed, Water, height
from adamslite.cables.vectors import ZERO, Vector

# Sections of one cable at the most.
MOST_SECTIONS = 900
# What trying models may take, in seconds of a machine on which costs were measured.
TRIAL = 10.0


@dataclass(frozen=True)
class Station:
    """A point of the route: an end, a weight on the cable, a wheel the cable lies on, or a bend
    that it has at the start and nothing holds.

    `mu` is negative where the cable cannot slip, `stored` where it is not written; `mass` is that
    of a weight, or of the carriage of a wheel that is free to move. `grip` is the displacement of
    the cable on the rim at which friction is full, 0 where a sliding speed builds it up. What is
    on a load has its number in the deck, `on`, and its place, `origin`.
    """

    kind: str
    at: Vector
    radius: float = 0.0
    axis: Vector = (0.0, 0.0, 1.0)
    turn: int = 0
    inertia: float = 0.0
    friction: float = 0.0
    mu: float = -1.0
    payout: str = ""
    force: str = ""
    stored: float = -1.0
    mass: float = 0.0
    velocity: Vector = ZERO
    motion: tuple[str, str, str] = ("", "", "")
    slide: Vector = ZERO
    pull: str = ""
    teeth: int = 0
    slides: bool = False
    haul: str = ""
    torque: str = ""
    reel: Reel | None = None
    leans: bool = False
    mount: Mount | None = None
    wander: Wander | None = None
    held: bool = False
    grip: float = 0.0
    mu_static: float = 0.0
    clamped: Vector = ZERO
    speed: str = ""
    motor: Motor | None = None
    brake: Brake | None = None
    limit: tuple[float, ...] = ()
    floor: Floor | None = None
    block: str = ""
    load: str = ""
    on: int = 0
    origin: Vector = ZERO
    name: str = ""

    @property
    def has_states(self) -> bool:
        """Whether an engine has more than a law."""
        return bool(self.motor or self.brake or self.limit)

    @property
    def has_engine(self) -> bool:
        """Whether forces turn it, not a payout."""
        return bool(self.force or self.torque or self.has_states)

    @property
    def is_wheel(self) -> bool:
        """Whether the cable lies on it."""
        return self.kind in WHEELS

    @property
    def feeds(self) -> bool:
        """Whether cable comes over it, or through it."""
        return self.is_wheel or self.slides

    @property
    def is_round(self) -> bool:
        """Whether the cable goes round it at the start."""
        return self.is_wheel or self.kind == "bend"

    @property
    def is_free(self) -> bool:
        """Whether it moves through space with the cable: a weight, or an end without one."""
        return self.kind in ("mass", "body", "free", "hook")

    @property
    def is_moved(self) -> bool:
        """Whether a law moves it."""
        return any(self.motion)

    @property
    def is_carried(self) -> bool:
        """Whether it is a wheel whose axle moves with what it meets."""
        return self.is_wheel and self.mass > 0

    @property
    def is_mobile(self) -> bool:
        """Whether its bearing is not on the ground itself."""
        return self.is_moved or self.is_carried or self.mount is not None or self.on > 0

    @property
    def gives_way(self) -> bool:
        """Whether its axle moves in the plane of the cable."""
        return self.is_mobile and not (self.mount and not self.mount.stiffness)

    @property
    def pitch(self) -> float:
        """Chord between two gaps of a sprocket, whose pins lie on its radius [m]."""
        return 2 * self.radius * sin(pi / self.teeth)

    def turned_inertia(self, density: float) -> float:
        """Of a wheel about its axle at the start, with what a reel holds [kg m^2]."""
        pack = self.reel.inertia(self.radius, density) if self.reel else 0.0
        return self.inertia + pack

    @property
    def slips(self) -> bool:
        """Whether it is a wheel on which the cable may slip."""
        return self.is_wheel and self.mu >= 0


@dataclass(frozen=True)
class Numbers:
    """Where the numbers of a cable begin in a scene of several: stations and spans before its own;
    stations and spans of the scene, 0 for those of the cable; `name` ends the names of its
    variables."""

    stations: int = 0
    spans: int = 0
    all_stations: int = 0
    all_spans: int = 0
    name: str = ""


@dataclass(frozen=True)
class Spec:
    """All of it; `elements`, `level` and `error` are 0 for "auto", `form` is "auto" then.

    `strains` are those of the spans as drawn, where they are not those of the tensions at rest.
    On loads with other cables they have the tensions `rests` at the start, and the free lengths
    `frees` where that of the cable is given.
    """

    title: str
    gravity: Vector
    end: float
    steps: int
    error: float
    closed: bool
    speed: float
    cable: Cable
    route: tuple[Station, ...]
    level: int
    form: str
    elements: int
    accuracy: float
    quantities: tuple[str, ...] = ("tension", "position")
    trial: float = TRIAL
    statics: bool = False
    water: Water | None = None
    bed: Bed | None = None
    strains: tuple[float, ...] = ()
    numbers: Numbers = Numbers()
    rests: tuple[float, ...] = ()
    frees: tuple[float, ...] = ()
    pairs: tuple[tuple[int, int], ...] = field(init=False)

    def __post_init__(self) -> None:
        n = len(self.route)
        last = n if self.closed else n - 1
        object.__setattr__(self, "pairs", tuple((i, (i + 1) % n) for i in range(last)))

    @cached_property
    def winches(self) -> list[int]:
        """Stations that are winches."""
        return [i for i, each in enumerate(self.route) if each.kind == "winch"]

    @cached_property
    def grips(self) -> bool:
        """Whether the cable grips any wheel before it slips."""
        return any(each.grip for each in self.route)

    @property
    def thousands(self) -> int:
        """Thousands that the statements of stations, ten numbers each, take before those of
        spans."""
        return 10 * (self.numbers.all_stations or len(self.route)) // 1000

    def station(self, i: int) -> int:
        """Number of station i in the deck."""
        return i + 1 + self.numbers.stations

    def label(self, i: int) -> str:
        """Station i as messages and comments call it."""
        name = self.route[i].name
        return f"station {self.station(i)}" + f" ({name})" * bool(name)

    def marker(self, i: int) -> int:
        """Marker of station i."""
        return 10 * self.station(i)

    def on_block(self, i: int) -> list[int]:
        """Wheels on the block of station i, itself among them."""
        name = self.route[i].block
        return [j for j, each in enumerate(self.route) if each.block == name] if name else [i]

    @property
    def has_run(self) -> bool:
        """Whether a long run continues from an end."""
        return any(each.kind == "run" for each in self.route)

    @property
    def bends(self) -> list[int]:
        """Stations where the cable is bent and nothing holds it."""
        return [i for i, each in enumerate(self.route) if each.kind == "bend"]

    @property
    def pitch(self) -> float:
        """Of a chain, 0 for a cable [m]."""
        return next((each.pitch for each in self.route if each.teeth), 0.0)

    @property
    def is_surrounded(self) -> bool:
        """Whether anything but tension and gravity acts on the nodes of the cable."""
        return bool(self.water or self.bed or self.cable.bending)

    def lightness(self, place: Vector) -> float:
        """Share of its weight that a cable at rest at `place` has in the water."""
        water = self.water
        if not (water and water.buoyancy and any(self.gravity)):
            return 1.0
        if height(self.gravity, place) > water.level:
            return 1.0
        return 1 - water.displaced(self.cable.diameter) / self.cable.density

    def slips_at(self, i: int) -> bool:
        """Whether the cable has a travel of its own over station i."""
        return self.route[i].slips and not self.is_end(i)

    def is_end(self, i: int) -> bool:
        """Whether the route begins or ends at station i."""
        return not self.closed and i in (0, len(self.route) - 1)

    def beside(self, i: int) -> tuple[int, ...]:
        """Spans at station i: the one before, the one behind; -1 where there is none."""
        n = len(self.pairs)
        if self.closed:
            return (i - 1) % n, i
        return i - 1, i if i < n else -1

    def outwards(self, i: int) -> int:
        """Sense, along the route, in which the winch of station i pays out."""
        return -1 if i == len(self.route) - 1 and not self.closed else 1


WHEELS = ("pulley", "winch")
KINDS = ("fixed", "free", "run", "mass", "body", "hook", "bend", *WHEELS)
Toml = dict[str, Any]
"""A table of a description, as it is read."""
