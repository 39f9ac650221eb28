"""LINEAR: small motions about the present state, at rest or moving.

Equation::

    EIGENSOL   s x = A x
    STATEMAT   dx/dt = A x + B u,   y = C x + D u      u of PINPUT, y of POUTPUT
    MKB        M y" + B y' + K y = F u                 where all states are motions

x holds the small motions that the constraints allow, their speeds, and the states of DIFF, LSE,
TFSISO and GSE, as an observer sees them: on the ground, or on the body of RM, whose axes turn with
it.  A position is a vector from the observer, a change of attitude a rotation vector, both along
the observer's axes; the body of the observer (b) moves relative to the ground::

    xi = E^T (dx - dx_b - phi_b x r),    sigma = E^T (phi - phi_b)        r = x - x_b

Where the state is steady for the observer (at rest, turning with the observer, or turning about an
axis of symmetry) the eigenvalues s are the exponents of small motions, including gyroscopic,
centrifugal and Coriolis terms.  Otherwise they hold at this time only; a note reports that, and
names an RM for which the state is steady if there is one.  Where it is steady for two observers,
one of which turns by W relative to the other, s for one may be s + i W for the other.

NODAMPING leaves out all terms that depend on speeds, also gyroscopic ones.
"""

from __future__ import annotations

from adamslite.language.statement import (
    Statement,
    choice,
    flag,
    reference,
    statement,
    text,
    texts,
    vector,
)


def _modes(key: str, what: str, short: str = "") -> tuple[str, ...]:
    keys = (key, short) if short else (key,)
    return texts(*keys, inert=True, help=f"first and last mode whose {what} ADAMS prints")


def _range(given: tuple[float, ...]) -> tuple[int, int] | None:
    return (round(given[0]), round(given[-1])) if given else None


@statement("LINEAR", singleton=True, repeatable=True, place="command")
class Linear(Statement):
    """Eigenvalues and mode shapes, or the matrices of the linearised model.

    EIGENSOL writes NAME.modes.csv, and with COORDS the magnitudes and phases of mode shapes to
    NAME.shapes.csv, the largest of a mode 1 at phase 0, with KINETIC the shares of bodies in the
    kinetic energy to NAME.kinetic.csv; STATEMAT writes its FILE or NAME.states.json, MKB its FILE
    or NAME.mkb.json.
    """

    kind: str = choice(
        options=("EIGENSOL", "STATEMAT", "MKB", "NASTRAN"), required=True,
        supported=("EIGENSOL", "STATEMAT", "MKB"), help="eigenvalues, or which matrices",
    )  # fmt: skip
    nodamping: bool = flag("NODAMPING", help="leave out what depends on velocities")
    rm: int | str | None = reference(
        "RM", to="MARKER", help="marker of the body of the observer, whose axes are used"
    )
    file: str | None = text(
        "FILE", help="plain name of the file the matrices are written to, beside the results"
    )
    pinput: int | str | None = reference("PINPUT", to="PINPUT", help="the inputs u")
    poutput: int | str | None = reference("POUTPUT", to="POUTPUT", help="the outputs y")
    pstate: int | str | None = reference(
        "PSTATE", to="PSTATE", help="the states for ADAMS to use; without effect in EIGENSOL"
    )
    original: bool = flag("ORIGINAL", inert=True, help="the coordinates of the FORTRAN solver")
    novector: bool = flag("NOVECTOR", inert=True, help="no table of mode shapes")
    format: str | None = choice(
        "FORMAT", options=("MATRIXX", "MATLAB"),
        help="MATLAB: plain tables in files FILEa to FILEd; one file with everything unless given",
    )  # fmt: skip
    coords: tuple[float, ...] = vector(
        "COORDS", size=1, most=2, unit="1", default=(),
        help="first and last mode whose shape is written",
    )  # fmt: skip
    energy: tuple[str, ...] = _modes("ENERGY", "energies")
    kinetic: tuple[float, ...] = vector(
        "KINETIC", "KENERGY", size=1, most=2, unit="1", default=(),
        help="first and last mode of which the share of each body in the energy is written",
    )  # fmt: skip
    strain: tuple[str, ...] = _modes("STRAIN", "strain energies", "SENERGY")
    dissipation: tuple[str, ...] = _modes("DISSIPATION", "dissipated energies", "DENERGY")

    @property
    def shapes(self) -> tuple[int, int] | None:
        """First and last mode whose shape is written."""
        return _range(self.coords)

    @property
    def energies(self) -> tuple[int, int] | None:
        """The same of kinetic energies."""
        return _range(self.kinetic)

    @property
    def parts(self) -> tuple[str, ...]:
        """What is added to the name of its file for each file that it writes."""
        if self.kind != "STATEMAT" or self.format != "MATLAB":
            return ("",)
        given, seen = self.pinput is not None, self.poutput is not None
        return ("a", *("b" * given), *("c" * seen), *("d" * (given and seen)))
