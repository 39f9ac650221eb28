"""How many digits of a run are confirmed: what two other runs of the same deck say."""

from __future__ import annotations

from dataclasses import dataclass
from math import log10

# Largest bound of a confirmed channel, against its quantity.
AGREED = 1e-2
# Digits of numbers of 64 bits.
MOST_DIGITS = 15.0
# Named in a line.
MOST_NAMED = 3


@dataclass(frozen=True)
class Channel:
    """``bound``: how far the column ``name`` may be from the exact value at any output time;
    ``size``: the largest value of its quantity; ``loose``: what a bound may be in any case.
    """

    name: str
    bound: float
    size: float
    loose: float = 0.0

    @property
    def digits(self) -> float:
        """Digits of the largest value that agree."""
        if self.bound == 0.0 or self.size == 0.0:
            return MOST_DIGITS if self.bound == 0.0 else 0.0
        return min(MOST_DIGITS, max(0.0, -log10(self.bound / self.size)))

    @property
    def agrees(self) -> bool:
        """Whether the bound is small enough."""
        return self.bound <= max(AGREED * self.size, self.loose)


@dataclass(frozen=True)
class Confirmation:
    """What the witnesses of a run say.

    Parameters
    ----------
    channels : tuple of Channel
        In the order of the columns.
    witnesses : tuple of str
        Method and ERROR of each run that was compared.
    objections : tuple of str
        What keeps the run from being confirmed besides the bounds.
    interrupted : bool
        Whether the user has ended a witness, and with it the search for others.
    """

    channels: tuple[Channel, ...]
    witnesses: tuple[str, ...]
    objections: tuple[str, ...]
    interrupted: bool = False

    def __getitem__(self, name: str) -> Channel:
        """The channel called ``name``, upper or lower case."""
        return next(c for c in self.channels if c.name.casefold() == name.casefold())

    @property
    def confirmed(self) -> bool:
        """The verdict."""
        return not self.objections and all(channel.agrees for channel in self.channels)

    @property
    def verdict(self) -> str:
        """The verdict as one line."""
        if self.confirmed:
            # Digits of what is zero but for rounding say nothing.
            known = (c.digits for c in self.channels if c.bound > c.loose)
            worst = min(known, default=MOST_DIGITS)
            return f"confirmed by {' and '.join(self.witnesses)}: {worst:.1f} digits or more agree"
        apart = sorted((c for c in self.channels if not c.agrees), key=lambda c: c.digits)
        texts = [
            f"{c.name} may be off by {c.bound:.2g} of {c.size:.3g}" for c in apart[:MOST_NAMED]
        ]
        if len(apart) > MOST_NAMED:
            texts.append(f"and {len(apart) - MOST_NAMED} more")
        return f"NOT CONFIRMED: {'; '.join([*self.objections, *texts])}"

    def table(self) -> str:
        """Digits and bound of every channel, a line each."""
        width = max((len(c.name) for c in self.channels), default=0)
        lines = [
            f"{c.name:<{width}}  {c.digits:4.1f} digits  +- {c.bound:.2g}" for c in self.channels
        ]
        return "\n".join(lines)
