"""EQUILIBRIUM: settings of the static analysis.

Equation (Newton iteration for forces F, stiffness K, mass M and damping C)::

    (K + STABILITY (M + C)) dq = F,    |dx| <= TLIMIT,  |angle| <= ALIMIT

until the relative correction is below ERROR and every residual below IMBALANCE.
"""

from __future__ import annotations

from math import radians

from adamslite.language.statement import (
    Statement,
    choice,
    flag,
    integer,
    number,
    statement,
    words,
)


def _advanced(key: str, what: str) -> float | None:
    return number(key, unit="1", inert=True, help=f"{what} of the advanced methods of ADAMS")


def _settling(key: str, what: str) -> float | None:
    return number(
        key, unit="that of the deck", inert=True, help=f"{what} of settling in a dynamic run"
    )


@statement("EQUILIBRIUM", singleton=True, repeatable=True, place="both")
class Equilibrium(Statement):
    """How SIMULATE/STATICS finds the position of rest; omitted arguments keep their values.

    After MAXIT iterations, and where an iteration leads to another equilibrium than the nearest
    stable one, the search goes on by relaxation.
    """

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
    method: str | None = choice(
        "METHOD", options=("ORIGINAL", "ADVANCED", "AGGRESSIVE", "ALL"), inert=True,
        help="the methods that ADAMS tries",
    )  # fmt: skip
    atol: float | None = _advanced("ATOL", "absolute tolerance")
    rtol: float | None = _advanced("RTOL", "relative tolerance")
    maxitl: int | None = integer(
        "MAXITL", inert=True, help="most inner iterations of the advanced methods of ADAMS"
    )
    eta: float | None = _advanced("ETA", "forcing term")
    etamax: float | None = _advanced("ETAMAX", "largest forcing term")
    global_damping: float | None = _settling("GLOBAL_DAMPING", "damping of every body")
    settling_time: float | None = _settling("SETTLING_TIME", "longest time")
    acceleration_error: float | None = _settling("ACCELERATION_ERROR", "accelerations at its end")
    kinetic_energy_error: float | None = _settling("KINETIC_ENERGY_ERROR", "energy at its end")
