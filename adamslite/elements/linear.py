"""LINEAR: small motions about the present state.

Equation::

    EIGENSOL   s x = A x
    STATEMAT   dx/dt = A x + B u,   y = C x + D u      u of PINPUT, y of POUTPUT
"""

from __future__ import annotations

from adamslite.statement import Statement, choice, flag, reference, statement, text


@statement(
    "LINEAR", singleton=True, repeatable=True, place="command",
    planned=(
        "COORDS", "DISSIPATION", "ENERGY", "FORMAT", "KINETIC", "NOVECTOR", "ORIGINAL", "PSTATE",
        "STRAIN",
    ),
)  # fmt: skip
class Linear(Statement):
    """Eigenvalues and mode shapes, or the matrices of the linearised model."""

    kind: str = choice(
        options=("EIGENSOL", "STATEMAT"), required=True, help="eigenvalues, or state matrices"
    )
    nodamping: bool = flag("NODAMPING", help="leave out what depends on velocities")
    rm: int | str | None = reference(
        "RM", to="MARKER", help="marker relative to whose body the motion is described"
    )
    file: str | None = text(
        "FILE", help="plain name of the file the matrices are written to, beside the results"
    )
    pinput: int | str | None = reference("PINPUT", to="PINPUT", help="the inputs u")
    poutput: int | str | None = reference("POUTPUT", to="POUTPUT", help="the outputs y")
