"""Random mechanisms of which a part of the model is more or less needed, and the same without it.

Every scene is one text with a place for what is asked about; masses, lengths, stiffnesses and units
are drawn over decades.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

#: Words of UNITS; metre, kilogram and newton in them.
SYSTEMS = (
    ("SYSTEM=MKS", 1.0, 1.0, 1.0),
    ("FORCE=NEWTON, MASS=TONNE, LENGTH=MILLIMETER, TIME=SECOND", 1e3, 1e-3, 1.0),
    ("FORCE=POUND_FORCE, MASS=POUND_MASS, LENGTH=INCH, TIME=SECOND",
     1 / 0.0254, 1 / 0.45359237, 1 / 4.4482216152605),
)  # fmt: skip
GRAVITY = 9.80665


@dataclass(frozen=True)
class Scene:
    """A deck, the note it may get, and the decks that the note advises or would.

    ``parts``: those whose places are compared; ``size``: of the model.
    """

    kind: str
    code: str
    text: str
    advised: Callable[[str], str]
    parts: tuple[str, ...]
    size: float


class Drawn:
    """Numbers of a scene in its units."""

    def __init__(self, seed: int) -> None:
        self.rng = np.random.default_rng(seed)
        self.units, self.length, self.mass, self.force = SYSTEMS[seed % len(SYSTEMS)]

    def decades(self, low: float, high: float) -> float:
        return float(10 ** self.rng.uniform(np.log10(low), np.log10(high)))

    def head(self, title: str, tilt: tuple[float, float] = (0.0, 0.0)) -> str:
        g = -GRAVITY * self.length
        return (
            f"{title}\nUNITS/{self.units}\n"
            f"ACCGRAV/IGRAV={g * tilt[0]!r}, JGRAV={g!r}, KGRAV={g * tilt[1]!r}\n"
            "PART/1, GROUND\nMARKER/1, PART=1\n"
        )

    def part(self, number: int, mass: float, at: tuple[float, ...], gyration: float) -> str:
        """A part, mass in kg and lengths in metres, with its mass centre at its marker."""
        m, r = mass * self.mass, gyration * self.length
        place = ",".join(repr(float(x) * self.length) for x in at)
        moments = ",".join(repr(float(m * r * r * f)) for f in (1.0, 1.2, 1.1))
        return (
            f"PART/{number}, MASS={float(m)!r}, CM={number}0, IP={moments}, QG={place}\n"
            f"MARKER/{number}0, PART={number}\n"
        )

    def marker(self, number: int, part: int, at: tuple[float, ...]) -> str:
        place = ",".join(repr(float(x) * self.length) for x in at)
        return f"MARKER/{number}, PART={part}, QP={place}\n"

    def arm(self, mass: float, half: float) -> str:
        """PART/2 along x from the origin, with MARKER/21 and MARKER/22 at its ends."""
        ends = self.marker(21, 2, (-half, 0, 0)) + self.marker(22, 2, (half, 0, 0))
        return self.part(2, mass, (half, 0, 0), 0.5 * half) + ends

    def run(self, length: float, longest: float = 2.0) -> str:
        """A run of 0.5 to `longest` times sqrt(length/g)."""
        seconds = float(self.rng.uniform(0.5, longest) * (length / GRAVITY) ** 0.5)
        return f"SIMULATE/DYNAMIC, END={seconds!r}, STEPS=40\nEND\n"


def bushing(seed: int) -> Scene:
    """Two arms, one hinged to ground, the other on it by a bushing, like a ball joint or a weld."""
    d = Drawn(seed)
    L, ratio = d.decades(0.1, 5), d.decades(0.2, 5)
    m = d.decades(0.5, 50)
    kind = ("SPHERICAL", "FIXED")[d.rng.integers(2)]
    k = d.decades(1e3, 1e9) * m * GRAVITY / L
    damping = 0.05 * (k * m) ** 0.5
    rows = {"K": k, "C": damping}
    if kind == "FIXED":
        rows |= {"KT": k * L * L, "CT": damping * L * L}
    scale = {"K": d.force / d.length, "C": d.force / d.length, "KT": d.force * d.length,
             "CT": d.force * d.length}  # fmt: skip
    words = ", ".join(f"{w}={','.join([repr(float(v * scale[w]))] * 3)}" for w, v in rows.items())
    head = d.head("Arms on a bushing", (float(d.rng.uniform(-0.3, 0.3)), 0.0))
    body = (
        d.arm(m, L)
        + d.part(3, m * ratio, (3 * L, 0, 0), 0.5 * L) + d.marker(31, 3, (-L, 0, 0))
        + "JOINT/1, REVOLUTE, I=21, J=1\n"
    )  # fmt: skip
    tail = d.run(L)
    return Scene(
        f"bushing as {kind}", "stiff-bushing",
        head + body + f"BUSHING/1, I=31, J=22, {words}\n" + tail,
        lambda _: head + body + f"JOINT/2, {kind}, I=31, J=22\n" + tail,
        ("PART/2", "PART/3"), 4 * L * d.length,
    )  # fmt: skip


def spring(seed: int) -> Scene:
    """An arm on a ball joint that a stiff line holds to another arm: a spring or a force."""
    d = Drawn(seed)
    L, m = d.decades(0.1, 5), d.decades(0.5, 50)
    k = d.decades(1e3, 1e9) * m * GRAVITY / L * d.force / d.length
    c = 0.02 * (k * m * d.force / d.length) ** 0.5
    head = d.head("Arms on a stiff line", (0.1, float(d.rng.uniform(0.0, 0.2))))
    high, short = float(d.rng.uniform(0.5, 1.5)) * L, float(d.rng.uniform(0.3, 0.8)) * L
    out = float(d.rng.uniform(-0.3, 0.3)) * L
    body = (
        d.arm(m, L)
        + d.part(3, m * d.decades(0.2, 5), (short, -high, out), 0.5 * short)
        + d.marker(31, 3, (-short, 0, 0)) + d.marker(32, 3, (short, 0, 0))
        + d.marker(5, 1, (0, -high, out))
        + "JOINT/1, SPHERICAL, I=21, J=1\nJOINT/2, SPHERICAL, I=31, J=5\n"
    )  # fmt: skip
    far = float(np.linalg.norm([2 * L - 2 * short, high, out])) * d.length
    law = (
        f"SPRINGDAMPER/1, I=32, J=22, K={k!r}, C={c!r}, LENGTH={far!r}\n",
        "SFORCE/1, TRANSLATIONAL, I=32, J=22\n"
        f", FUNCTION=-{k!r}*(DM(32,22)-{far!r})-{c!r}*VR(32,22)\n",
    )[d.rng.integers(2)]
    tail = d.run(L)
    return Scene(
        "spring", "stiff-spring", head + body + law + tail,
        lambda _: head + body + f"GCON/1, FUNCTION=DM(32,22)-{far!r}\n" + tail,
        ("PART/2", "PART/3"), 2 * L * d.length,
    )  # fmt: skip


def link(seed: int) -> Scene:
    """Two rockers joined by a link, in space on ball joints or in a plane on hinges."""
    d = Drawn(seed)
    L, m = d.decades(0.1, 5), d.decades(0.5, 50)
    share, flat = d.decades(1e-7, 1e-1), bool(d.rng.integers(2))
    out = 0.0 if flat else float(d.rng.uniform(0.1, 0.3)) * L
    far, other = float(d.rng.uniform(1.5, 3)) * L, float(d.rng.uniform(0.7, 1.4)) * L
    head = d.head("Rockers and a link", (float(d.rng.uniform(-0.5, 0.5)), 0.0))
    body = (
        d.part(2, m, (0, -0.5 * L, 0), 0.3 * L) + d.marker(21, 2, (0, 0.5 * L, 0))
        + d.marker(22, 2, (0, -0.5 * L, 0))
        + d.part(3, m * d.decades(0.2, 5), (far, -0.5 * other, out), 0.3 * L)
        + d.marker(31, 3, (0, 0.5 * other, 0)) + d.marker(32, 3, (0, -0.5 * other, 0))
        + d.marker(5, 1, (far, 0, out))
        + "JOINT/1, REVOLUTE, I=21, J=1\nJOINT/2, REVOLUTE, I=31, J=5\n"
    )  # fmt: skip
    a, b = np.array([0, -L, 0.0]), np.array([far, -other, out])
    long = float(np.linalg.norm(b - a))
    middle = tuple(float(x) for x in (a + b) / 2)
    half = tuple(float(x) for x in (b - a) / 2)
    hinge = "REVOLUTE" if flat else "SPHERICAL"
    rod = (
        d.part(4, m * share, middle, 0.3 * long) + d.marker(42, 4, half)
        + d.marker(41, 4, tuple(-x for x in half))
        + f"JOINT/3, {hinge}, I=41, J=22\nJOINT/4, {hinge}, I=42, J=32\n"
    )  # fmt: skip
    tail = d.run(L, 1.5)
    return Scene(
        "link in a plane" if flat else "link in space", "light-link", head + body + rod + tail,
        lambda _: head + body + f"GCON/1, FUNCTION=DM(22,32)-{long * d.length!r}\n" + tail,
        ("PART/2", "PART/3"), 2 * L * d.length,
    )  # fmt: skip


def lump(seed: int) -> Scene:
    """An arm of two parts that are held together in more than one way, or only nearly."""
    d = Drawn(seed)
    L, m = d.decades(0.1, 5), d.decades(0.5, 50)
    ways = (
        "JOINT/2, REVOLUTE, I=31, J=22\nMOTION/1, JOINT=2, FUNCTION=0\n",
        "JOINT/2, SPHERICAL, I=31, J=22\nJPRIM/1, ORIENTATION, I=31, J=22\n",
        "JOINT/2, REVOLUTE, I=31, J=22\nJOINT/3, SPHERICAL, I=33, J=23\n",
        "JOINT/2, REVOLUTE, I=31, J=22\n",
    )
    way = ways[d.rng.integers(len(ways))]
    head = d.head("An arm in two pieces", (0.2, 0.3))
    body = (
        d.arm(m, L)
        + d.marker(23, 2, (L, 0.5 * L, 0))
        + d.part(3, m * d.decades(0.2, 5), (3 * L, 0.3 * L, 0), 0.5 * L)
        + d.marker(31, 3, (-2 * L, -0.3 * L, 0)) + d.marker(33, 3, (-2 * L, 0.2 * L, 0))
        + "JOINT/1, SPHERICAL, I=21, J=1\n"
    )  # fmt: skip
    tail = d.run(L)
    return Scene(
        "two pieces", "one-body", head + body + way + tail,
        lambda _: head + body + "JOINT/2, FIXED, I=31, J=22\n" + tail,
        ("PART/2", "PART/3"), 4 * L * d.length,
    )  # fmt: skip


KINDS = (bushing, spring, link, lump)
