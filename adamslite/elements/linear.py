"""LINEAR: small motions about the present state, at rest or moving.

Equation::

    EIGENSOL   s x = A x
    STATEMAT   dx/dt = A x + B u,   y = C x + D u      u of PINPUT, y of POUTPUT

x holds the small motions that the constraints allow, their speeds, and the states of DIFFs, as an
observer sees them: on the ground, or on the body of RM, whose axes turn with it.  A place is seen
as a vector from him, a change of attitude as a rotation vector, both along his axes; his own body
moves against the ground::

    xi = E^T (dx - dx_b - phi_b x r),    sigma = E^T (phi - phi_b)        r = x - x_b

Where the state is steady for him (at rest, turning with him, or turning about an axis of
symmetry) the eigenvalues s are the exponents of small motions, and gyroscopic, centrifugal and
Coriolis terms are in them.  Otherwise they belong to this moment only: a note says so, and names
an RM for which the state is steady if there is one.  Where it is steady for two observers, one of
whom turns by W against the other, s for one may be s + i W for the other.

NODAMPING leaves out all that depends on speeds, gyroscopic terms too.
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
        "RM", to="MARKER", help="marker on whose body the observer stands, with its axes"
    )
    file: str | None = text(
        "FILE", help="plain name of the file the matrices are written to, beside the results"
    )
    pinput: int | str | None = reference("PINPUT", to="PINPUT", help="the inputs u")
    poutput: int | str | None = reference("POUTPUT", to="POUTPUT", help="the outputs y")
