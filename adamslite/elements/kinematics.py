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
    """How SIMULATE/KINEMATICS solves; omitted arguments keep their values."""

    default: bool = flag("DEFAULT", help="resets all arguments to their defaults")
    error: float = number("ERROR", unit="1", default=1e-4, help="allowed correction of positions")
    aerror: float = number(
        "AERROR", unit="1", default=1e-4, help="allowed correction of accelerations"
    )
    tlimit: float = number(
        "TLIMIT", unit="length", default=1e10, help="largest translation of an iteration"
    )
    alimit: float = number(
        "ALIMIT", unit="angle", default=radians(30), help="largest rotation of an iteration"
    )
    maxit: int = integer("MAXIT", default=25, help="largest number of iterations")
    pattern: tuple[str, ...] = words(
        "PATTERN", options=("T", "F"), help="iterations that renew the Jacobian; all unless given"
    )
    hmax: float | None = number("HMAX", unit="time", inert=True, help="largest step")
    apattern: tuple[str, ...] = words(
        "APATTERN", options=("T", "F"), inert=True,
        help="the same of accelerations, which take one linear solution",
    )  # fmt: skip
    amaxit: int | None = integer(
        "AMAXIT", inert=True, help="iterations for accelerations, which take one linear solution"
    )
