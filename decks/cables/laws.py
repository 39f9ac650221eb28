"""What a drive does: smooth steps of a place or of a payout, as numbers and as text of a deck."""

from dataclasses import dataclass

import numpy as np

from adamslite.cables.statements.forms import number


@dataclass(frozen=True)
class Move:
    """By `way` between `start` and `end`, with D = (t - start)/(end - start):

        way D^3 (10 - 15 D + 6 D^2)

    This is the STEP5 of the decks; speed and acceleration are zero at both ends.
    """

    start: float
    end: float
    way: float

    def __call__(self, t: float) -> np.ndarray:
        """Place, speed, acceleration."""
        span = self.end - self.start
        d = min(max((t - self.start) / span, 0.0), 1.0)
        return self.way * np.array(
            [
                d**3 * (10 - 15 * d + 6 * d**2),
                30 * d**2 * (1 - d) ** 2 / span,
                60 * d * (1 - d) * (1 - 2 * d) / span**2,
            ]
        )


@dataclass(frozen=True)
class Law:
    """Several moves, one added to the other."""

    moves: tuple[Move, ...] = ()

    def __call__(self, t: float) -> np.ndarray:
        """Place, speed, acceleration: (3,)."""
        return sum((move(t) for move in self.moves), np.zeros(3))

    def text(self, unit: float = 1.0) -> str:
        """The same in the deck's language, in `unit`s."""
        return (
            "\n, ".join(
                f"+STEP5(TIME,{number(m.start)},0,{number(m.end)},{number(m.way / unit)})"
                for m in self.moves
            )
            or "0*TIME"
        )


def law(*moves: tuple[float, float, float]) -> Law:
    """Of (start, end, way) each."""
    return Law(tuple(Move(*move) for move in moves))


@dataclass(frozen=True)
class Travel:
    """Constant acceleration for `ramp`, constant speed for `cruise`, the opposite acceleration."""

    acceleration: float
    ramp: float
    cruise: float

    @property
    def text(self) -> str:
        """The place in the deck's language."""
        ends = (self.ramp, self.ramp + self.cruise, 2 * self.ramp + self.cruise)
        parts = (
            f"{sign}MAX(0,TIME-{number(end)})**2" for sign, end in zip("--+", ends, strict=True)
        )
        return f"{number(self.acceleration / 2)}*(TIME**2{''.join(parts)})"

    def __call__(self, t: np.ndarray) -> np.ndarray:
        """The place [m], shaped like t."""
        ends = (self.ramp, self.ramp + self.cruise, 2 * self.ramp + self.cruise)
        since = [np.maximum(0, t - end) ** 2 for end in ends]
        return self.acceleration / 2 * (t**2 - since[0] - since[1] + since[2])
