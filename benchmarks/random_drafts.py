"""A random deck in the making: what it draws its numbers from, its lines and its freedoms."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

#: Speed that freedoms reach, in their reach per time.
FAST = 8.0
HEAD = "UNITS/SYSTEM=MKS\nACCGRAV/JGRAV=-9.81\nPART/1, GROUND\nMARKER/1, PART=1"


@dataclass(frozen=True)
class Freedom:
    """How a freedom is measured and loaded.

    x, v, a : expressions of displacement, speed and acceleration
    load : a statement with {id} and {law}
    inertia : mass or moment of inertia that resists, roughly [kg], [kg m^2]
    reach : how far it goes, roughly [m], [rad]
    """

    x: str
    v: str
    a: str
    load: str
    inertia: float
    reach: float = 1.0


@dataclass
class Draft:
    """A deck in the making; ``finest``: the shortest time that a law was given, or passes in."""

    rng: np.random.Generator
    nudge: float = 0.0
    end: float = 1.0
    finest: float = 1.0
    kinds: list[str] = field(default_factory=list)
    lines: list[str] = field(default_factory=list)
    freedoms: list[Freedom] = field(default_factory=list)
    taken: int = 0

    def between(self, low: float, high: float) -> float:
        """A number between two, of four digits as somebody types it."""
        return float(f"{self.rng.uniform(low, high):.4g}")

    def decade(self, low: float, high: float) -> float:
        """A number between two powers of ten."""
        return float(f"{10.0 ** self.rng.uniform(low, high):.4g}")

    def start(self, low: float, high: float) -> str:
        """A start value; the nudge goes in here."""
        return repr(self.between(low, high) + self.nudge)

    def chance(self, share: float) -> bool:
        """True in this share of the decks."""
        return bool(self.rng.random() < share)

    def new_id(self) -> int:
        """An id for VARIABLE or DIFF."""
        self.taken += 1
        return self.taken

    def resolve(self, time: float) -> None:
        """Something happens within this time."""
        self.finest = min(self.finest, time)

    def deck(self, title: str, steps: int) -> RandomDeck:
        """The deck."""
        run = f"SIMULATE/DYNAMIC, END={self.end!r}, STEPS={steps}"
        text = "\n".join([title, HEAD, *self.lines, run, "END", ""])
        return RandomDeck(title, text, self.end, self.finest, steps)


@dataclass(frozen=True)
class RandomDeck:
    """``text`` of a deck, its ``end`` time, the shortest time of an event, and output steps."""

    title: str
    text: str
    end: float
    finest: float
    steps: int
