"""INTEGRATOR: method and settings of the time integration.

Equation (local error test of the step)::

    || error estimate of the controlled coordinates || <= ERROR
"""

from __future__ import annotations

from adamslite.language.method import AUTO, USUAL, MethodNames
from adamslite.language.statement import (
    Statement,
    choice,
    integer,
    number,
    statement,
    vector,
    words,
)


@statement("INTEGRATOR", singleton=True, repeatable=True, place="both")
class Integrator(Statement):
    """Settings of the integrator; omitted arguments keep their values.

    It may also be in a command file, before the SIMULATE to which it applies.
    """

    method: str | None = choice(
        options=MethodNames(AUTO, "HASTIFF"),
        supported=MethodNames(AUTO),
        discontinued=(("HASTIFF", "GSTIFF, SI2"),),
        help=f"the formula, {USUAL} unless given; {AUTO}: what suits the scene. "
        "`adamslite help integrators` describes all",
    )
    formulation: str | None = choice(
        options=("I3", "SI1", "SI2"), supported=("I3", "SI1", "SI2"),
        help="index 3, or stabilised index 2 (SI2, unless given); SI1 is solved as SI2",
    )  # fmt: skip
    error: float | None = number("ERROR", unit="that of the coordinates", help="error tolerance")
    hmax: float | None = number(
        "HMAX", unit="time", help="largest step; the output step unless given"
    )
    hmin: float | None = number(
        "HMIN", unit="time", help="size at which steps that fail are not cut any more"
    )
    hinit: float | None = number("HINIT", unit="time", help="first step")
    kmax: int | None = integer("KMAX", help="highest order; 5 unless given")
    maxit: int | None = integer(
        "MAXIT", help="most corrector iterations of a step; 10 unless given"
    )
    interpolate: str | None = choice(
        "INTERPOLATE", options=("ON", "OFF"), help="step past output times and interpolate"
    )
    adaptivity: float | None = number(
        "ADAPTIVITY", unit="time", help="loosens the corrector by this over the step"
    )
    corrector: str | None = choice(
        "CORRECTOR",
        options=("ORIGINAL", "MODIFIED", "ORIG_CONSTANT"),
        help="what must converge: all, or what the error test sees (MODIFIED, unless given)",
    )
    pattern: tuple[str, ...] = words(
        "PATTERN",
        options=("T", "F"),
        help="iterations that renew the Jacobian, repeated; as needed unless given",
    )
    alpha: float | None = number(
        "ALPHA", unit="1", help="of HHT, from -1/3 to 0; -0.3 unless given"
    )
    beta: float | None = number("BETA", unit="1", help="of NEWMARK; 0.36 unless given")
    gamma: float | None = number("GAMMA", unit="1", help="of NEWMARK; 0.7 unless given")
    scale: tuple[float, ...] = vector(
        "SCALE", size=1, most=6, unit="1", default=(),
        help="factors of ERROR for displacements, angles, modal coordinates (which no statement "
        "has), their rates in the same order; 1 each unless given",
    )  # fmt: skip
