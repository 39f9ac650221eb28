"""KINEMATICS: settings of the kinematic analysis.

Equation (at each output time, with as many independent constraints as coordinates)::

    g(q, t) = 0,    G u + g_t = 0,    M a + G^T lam = F
"""

from __future__ import annotations

from math import radians

from adamslite.language.statement import Statement, flag, integer, number, statement, words


@statement(
    "KINEMATICS", singleton=True, repeatable=True, place="both",
)  # fmt: skip
class Kinematics(Statement):
    """How ADAMS iterates in SIMULATE/KINEMATICS.

    This program solves for positions, velocities and accelerations to round-off, in steps that no
    part turns far in, so that none of these arguments changes its results.
    """

    default: bool = flag("DEFAULT", inert=True, help="resets all arguments to their defaults")
    error: float = number(
        "ERROR", unit="1", default=1e-4, inert=True, help="allowed correction of positions"
    )
    aerror: float = number(
        "AERROR", unit="1", default=1e-4, inert=True, help="allowed correction of accelerations"
    )
    tlimit: float = number(
        "TLIMIT", unit="length", default=1e10, inert=True,
        help="largest translation of an iteration",
    )  # fmt: skip
    alimit: float = number(
        "ALIMIT", unit="angle", default=radians(30), inert=True,
        help="largest rotation of an iteration",
    )  # fmt: skip
    maxit: int = integer("MAXIT", default=25, inert=True, help="largest number of iterations")
    pattern: tuple[str, ...] = words(
        "PATTERN", options=("T", "F"), inert=True, help="iterations that renew the Jacobian"
    )
    hmax: float | None = number("HMAX", unit="time", inert=True, help="largest step")
    apattern: tuple[str, ...] = words(
        "APATTERN", options=("T", "F"), inert=True, help="the same of accelerations"
    )
    amaxit: int | None = integer(
        "AMAXIT", inert=True, help="largest number of iterations for accelerations"
    )
