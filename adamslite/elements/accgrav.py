"""ACCGRAV: gravity.

Equation::

    force on each body at its centre of mass = mass * (IGRAV, JGRAV, KGRAV)      in ground axes
"""

from __future__ import annotations

from adamslite.language.statement import Statement, number, statement


@statement("ACCGRAV", singleton=True)
class Accgrav(Statement):
    """The acceleration of gravity itself, signed: downward along -y is ``JGRAV=-9.81``.

    Accelerations measured in the deck (ACCX ...) of a freely falling body equal these values.
    Without this statement there is no gravity.
    """

    igrav: float = number("IGRAV", unit="length/time^2", default=0.0, help="x component in ground")
    jgrav: float = number("JGRAV", unit="length/time^2", default=0.0, help="y component in ground")
    kgrav: float = number("KGRAV", unit="length/time^2", default=0.0, help="z component in ground")

    def constants(self) -> dict[str, float]:
        """The components, by the names of the arguments."""
        return {"IGRAV": self.igrav, "JGRAV": self.jgrav, "KGRAV": self.kgrav}
