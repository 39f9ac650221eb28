"""Statements without influence on the motion: they are read and kept; a note names those, or their
words, that are passed over.

Equation: none.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from functools import cache
from typing import ClassVar, NamedTuple

from adamslite.language.abbreviations import match
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
    acting: ClassVar[tuple[str, ...]] = ()
    """Words that decide about files; without the first of them the others are passed over too."""

    written: str = ""

    @property
    def words(self) -> dict[str, str]:
        """The arguments by their full names, with their values as written."""
        table, found = _full_names(self.known), {}
        for word, value in ARGUMENT.findall(COMMENT.sub("", self.written)):
            meant = match(word.upper(), table)
            found[meant if isinstance(meant, str) else word.upper()] = value.strip()
        return found

    @property
    def passed_over(self) -> tuple[str, ...]:
        """What of it has no effect at all: words, or the statement."""
        if not self.acting:
            return (self.keyword,)
        words = self.words
        if self.acting[0] not in words:
            return (self.keyword,)
        return tuple(f"{self.keyword} {word}" for word in words if word not in self.acting)


@cache
def _full_names(known: tuple[tuple[str, str], ...]) -> dict[str, str]:
    """The full names of arguments, by themselves."""
    return {name: name for listed, _ in known for name in listed.split(", ")}


ARGUMENT = re.compile(r"(?:^|,)\s*([A-Za-z]\w*)\s*(?:=([^,\n]*))?")
COMMENT = re.compile(r"!.*")


class Entry(NamedTuple):
    """What a statement is, its arguments (in each line names and what they mean), its place.

    ``acting``: words that decide about files, and ``doc``, what they do.
    """

    what: str
    arguments: str
    has_id: bool = False
    place: str = "both"
    body: bool = False
    acting: tuple[str, ...] = ()
    doc: str = ""


RESULTS_WORDS = (
    "XRF", "FORMATTED", "DECIMALPLACES", "COMMENT", "NODISPLACEMENTS", "NOVELOCITIES",
    "NOACCELERATIONS", "NOAPPLIEDFORCES", "NOREACTIONFORCES", "NODATASTRUCTURES",
    "NOSYSTEMELEMENTS", "NOLINEAR", "NOFLOATINGMARKERS", "NOREQUESTS", "NOTIRES", "NOCONTACTS",
)  # fmt: skip

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
        "files of REQUESTs",
        """
        REQSAVE                             the file .req of REQUESTs
        GRSAVE, GR521SAV, ICSAVE            files of graphics and initial conditions
        DACSAVE, RPCSAVE, MATSAVE           files of other programs
        CHART, DPLOT                        charts
        NOPRINT, NOSEPARATOR                what is left out of tables
        FIXED, OSFORMAT, TELETYPE           form of tables
        YPR                                 angles as yaw, pitch and roll
        DSCALE, VSCALE, ASCALE, FSCALE      factors of tables
        DZERO, VZERO, AZERO, FZERO          what is printed as zero
        """,
        acting=("REQSAVE",),
        doc="`solve` writes the file `.req` of `REQSAVE` beside the results; other words are "
        "passed over.",
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
        XRF                             XML
        FORMATTED                       text; with XRF it is XML
        DECIMALPLACES                   digits after the point, all of them from 17 on (the default)
        COMMENT                         a remark in the file
        NODISPLACEMENTS, NOVELOCITIES, NOACCELERATIONS  components of parts that are left out
        NOAPPLIEDFORCES                 leaves SFORCE, GFORCE, BUSHING and other forces out
        NOREACTIONFORCES                leaves JOINT, JPRIM, MOTION and other constraints out
        NOSYSTEMELEMENTS                leaves VARIABLE and DIFF out
        NOREQUESTS, NOCONTACTS          leave REQUEST and CONTACT out
        NODATASTRUCTURES, NOLINEAR, NOFLOATINGMARKERS, NOTIRES  of what is not written in any case
        """,
        acting=RESULTS_WORDS,
        doc="`solve` writes the file `.res` of `XRF` beside the results; the text and binary forms "
        "of ADAMS, without `XRF`, are passed over.",
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
        "__doc__": entry.doc or f"Passed over{condition}; any argument is accepted.",
        "acting": entry.acting,
        "heading": f"{keyword}: {entry.what}",
        "known": _meanings(entry.arguments),
    }
    made = type(keyword.title().replace("_", ""), (InertStatement,), content)
    declare = statement(
        keyword, singleton=not entry.has_id, repeatable=not entry.has_id,
        place="deck" if entry.has_id else entry.place, body=entry.body, ignored=True, inert=True,
        data=True,
    )  # fmt: skip
    globals()[made.__name__] = declare(made)  # where a copy of a statement looks for its class


for _keyword, _entry in TABLE.items():
    _register(_keyword, _entry)
