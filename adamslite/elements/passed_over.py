"""Statements without influence on the motion: they are read, kept and passed over with a note.

Equation: none.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar, NamedTuple

from adamslite.language.statement import Statement, statement


@dataclass(init=False, repr=False, eq=False)
class InertStatement(Statement):
    """A statement of which only the text is kept; any argument is accepted.

    Parameters
    ----------
    written : str
        The arguments as written.
    """

    heading: ClassVar[str] = ""
    known: ClassVar[tuple[tuple[str, str], ...]] = ()
    """Arguments of ADAMS and what they mean."""

    written: str = ""


class Entry(NamedTuple):
    """What a statement is, its arguments (in each line names and what they mean), its place."""

    what: str
    arguments: str
    has_id: bool = False
    place: str = "both"
    body: bool = False


TABLE = {
    "DEBUG": Entry(
        "what ADAMS prints about its solution",
        """
        EPRINT            every step
        DUMP, RHSDUMP     equations and residuals
        JMDUMP            Jacobians
        REQDUMP           requests
        TOPOLOGY, DOF     how parts are connected, degrees of freedom
        EIGEN             eigenvalues
        VERBOSE           longer messages
        """,
    ),
    "ENVIRONMENT": Entry(
        "variables of the operating system",
        """
        NAME              the variable
        VALUE             its value
        """,
        place="command",
    ),
    "FE_PART": Entry(
        "a beam of finite elements with large deflections",
        """
        SECTION, MATERIAL  its section and material
        NODES              its nodes
        """,
        has_id=True,
        body=True,
    ),
    "FLEX_BODY": Entry(
        "a flexible body, by its modes",
        """
        QG, REULER        origin and axes
        MTX_FILE, MNF_FILE  the file with its modes
        CRATIO            damping of the modes
        VX, VY, VZ        velocity at the start
        WX, WY, WZ        angular velocity at the start
        """,
        has_id=True,
        body=True,
    ),
    "HELP": Entry(
        "prints help of ADAMS; `adamslite help NAME` prints a page of this program",
        "",
        place="command",
    ),
    "IC": Entry(
        "how ADAMS finds initial conditions; this program finds them to round-off",
        """
        ERROR, VERROR, AERROR   allowed corrections
        MAXIT, AMAXIT           most iterations
        TLIMIT, ALIMIT          largest translation and rotation of an iteration
        PATTERN, APATTERN       iterations that renew the Jacobian
        DEFAULT                 resets all
        """,
    ),
    "LIST": Entry(
        "a word of commands, as in PART/2, LIST: prints what a statement holds",
        "",
        place="command",
    ),
    "LSOLVER": Entry(
        "the linear algebra of ADAMS",
        """
        AUTO, CALAHAN, HARWELL, UMF  the program
        STABILITY         how pivots are chosen
        """,
    ),
    "MATERIAL": Entry(
        "properties of a material",
        """
        NAME              its name
        YOUNGS_MODULUS    modulus of elasticity
        POISSONS_RATIO    transverse contraction
        DENSITY           mass per volume
        """,
        has_id=True,
    ),
    "MENU": Entry("prints the commands of ADAMS", "", place="command"),
    "OUTPUT": Entry(
        "the output files of ADAMS; this program writes all results",
        """
        REQSAVE, GRSAVE, GR521SAV, ICSAVE   files of requests, graphics and initial conditions
        DACSAVE, RPCSAVE, MATSAVE           files of other programs
        CHART, DPLOT                        charts
        NOPRINT, NOSEPARATOR                what is left out of tables
        FIXED, OSFORMAT, TELETYPE           form of tables
        YPR                                 angles as yaw, pitch and roll
        DSCALE, VSCALE, ASCALE, FSCALE      factors of tables
        DZERO, VZERO, AZERO, FZERO          what is printed as zero
        """,
    ),
    "PREFERENCES": Entry(
        "preferences of the user",
        """
        SOLVER            C++ or FORTRAN
        NTHREADS          number of processors
        CONTACT_FACETING_TOLERANCE, CONTACT_GEOMETRY_LIBRARY  how shapes are approximated
        STATUS_MESSAGE    messages on progress
        """,
    ),
    "PSTATE": Entry(
        "states for ADAMS to use in LINEAR",
        """
        VARIABLES         as many as there are degrees of freedom
        """,
        has_id=True,
    ),
    "RESULTS": Entry(
        "the .res file of ADAMS",
        """
        FORMATTED, XRF, DECIMALPLACES   text, XML and its digits
        COMMENT                         a remark
        NODISPLACEMENTS, NOVELOCITIES, NOACCELERATIONS, NOAPPLIEDFORCES  are left out
        NOREACTIONFORCES, NODATASTRUCTURES, NOSYSTEMELEMENTS, NOLINEAR   are left out
        NOFLOATINGMARKERS, NOREQUESTS, NOTIRES, NOCONTACTS               are left out
        """,
    ),
    "SECTION": Entry(
        "the cross section of an FE_PART",
        """
        AREA              its area
        IXX, IYY, IZZ     its moments
        """,
        has_id=True,
    ),
    "SHOW": Entry("prints how the run stands", "", place="command"),
    "TIME": Entry("prints the time of the model", "", place="command"),
}


def _meanings(lines: str) -> tuple[tuple[str, str], ...]:
    """Arguments that share a meaning, joined by commas, and the meaning."""
    parts = (line.split("  ", 1) for line in map(str.strip, lines.splitlines()) if line)
    return tuple((names, meaning.strip()) for names, meaning in parts)


def _register(keyword: str, entry: Entry) -> None:
    condition = " as long as nothing refers to its markers; rejected otherwise" * entry.body
    content: dict[str, object] = {
        "__module__": __name__,
        "__doc__": f"Passed over{condition}; any argument is accepted.",
        "heading": f"{keyword}: {entry.what}",
        "known": _meanings(entry.arguments),
    }
    made = type(keyword.title().replace("_", ""), (InertStatement,), content)
    declare = statement(
        keyword, singleton=not entry.has_id, repeatable=not entry.has_id,
        place="deck" if entry.has_id else entry.place, body=entry.body, ignored=True, inert=True,
        data=True,
    )  # fmt: skip
    declare(made)


for _keyword, _entry in TABLE.items():
    _register(_keyword, _entry)
