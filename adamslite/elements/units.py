"""UNITS: the units of the deck.

Equation::

    force * UCF = mass * acceleration
"""

from __future__ import annotations

from adamslite.language import units
from adamslite.language.statement import Statement, choice, number, statement


@statement("UNITS", singleton=True)
class Units(Statement):
    """Names the four units, or a system of units, or gives the factor UCF directly.

    Give ``FORCE``, ``MASS``, ``LENGTH`` and ``TIME`` together, or ``SYSTEM``, or ``UCF``.
    Without this statement UCF is 1: any coherent units.  As a command it changes UCF; all other
    numbers of the deck stay as they are.
    """

    alternatives = ((("force", "mass", "length", "time"), ("system",), ("ucf",)),)

    force: str | None = choice("FORCE", options=tuple(units.FORCE), help="unit of force")
    mass: str | None = choice("MASS", options=tuple(units.MASS), help="unit of mass")
    length: str | None = choice("LENGTH", options=tuple(units.LENGTH), help="unit of length")
    time: str | None = choice("TIME", options=tuple(units.TIME), help="unit of time")
    system: str | None = choice(
        "SYSTEM",
        options=(*units.SYSTEMS, units.NO_SYSTEM),
        help="MKS, CGS, FPS (pound-force, pound-mass, foot), IPS (the same with inch) or NONE",
    )
    ucf: float | None = number(
        "UCF", unit="mass length / (force time^2)", help="factor in force*UCF = mass*acceleration"
    )

    @property
    def names(self) -> tuple[str, str, str, str] | None:
        """Units of force, mass, length and time; None when the deck does not name them."""
        if self.system in units.SYSTEMS:
            return units.SYSTEMS[self.system]
        if self.force and self.mass and self.length and self.time:
            return self.force, self.mass, self.length, self.time
        return None

    @property
    def factor(self) -> float:
        """UCF [mass length / (force time^2)]."""
        if self.ucf is not None:
            return self.ucf
        return units.conversion(*self.names) if self.names else 1.0

    def constants(self) -> dict[str, float]:
        """``Gc``, the factor UCF."""
        return {"GC": self.factor}
