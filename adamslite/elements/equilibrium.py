"""EQUILIBRIUM: settings of the static analysis.

Equation (Newton iteration for forces F, stiffness K, mass M and damping C)::

    (K + STABILITY (M + C)) dq = F,    |dx| <= TLIMIT,  |angle| <= ALIMIT

until the relative correction is below ERROR and every residual below IMBALANCE.
"""

from __future__ import annotations

from math import radians

from adamslite.language.statement import Statement, flag, integer, number, statement, words


@statement(
    "EQUILIBRIUM", singleton=True, repeatable=True, place="both",
    planned=(
        "METHOD", "ATOL", "RTOL", "MAXITL", "ETA", "ETAMAX", "GLOBAL_DAMPING", "SETTLING_TIME",
        "ACCELERATION_ERROR", "KINETIC_ENERGY_ERROR",
    ),
)  # fmt: skip
class Equilibrium(Statement):
    """How SIMULATE/STATICS finds the position of rest; omitted arguments keep their values."""

    default: bool = flag("DEFAULT", help="resets all arguments to their defaults")
    alimit: float = number(
        "ALIMIT", unit="angle", default=radians(10), help="largest rotation of an iteration"
    )
    error: float = number("ERROR", unit="1", default=1e-4, help="allowed relative correction")
    imbalance: float = number(
        "IMBALANCE", unit="force", default=1e-4, help="allowed residual of an equation"
    )
    maxit: int = integer("MAXIT", "MAX", default=25, help="largest number of iterations")
    pattern: tuple[str, ...] = words(
        "PATTERN", options=("T", "F"), help="iterations that renew the Jacobian; all unless given"
    )
    stability: float = number(
        "STABILITY", unit="1", default=1e-5, help="share of mass and damping added to the stiffness"
    )
    tlimit: float = number(
        "TLIMIT", unit="length", default=20.0, help="largest translation of an iteration"
    )
