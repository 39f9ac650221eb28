"""RESULTS: the result file of ADAMS.

Equation: none.
"""

from __future__ import annotations

from adamslite.language.statement import Statement, flag, integer, statement, text


@statement("RESULTS", singleton=True)
class ResultsFile(Statement):
    """Form and content of the .res file."""

    formatted: bool = flag("FORMATTED", help="text instead of binary")
    xrf: bool = flag("XRF", help="XML")
    decimalplaces: int | None = integer("DECIMALPLACES", help="digits in XML")
    novelocities: bool = flag("NOVELOCITIES", help="without velocities")
    noaccelerations: bool = flag("NOACCELERATIONS", help="without accelerations")
    noappliedforces: bool = flag("NOAPPLIEDFORCES", help="without applied forces")
    noreactionforces: bool = flag("NOREACTIONFORCES", help="without reactions")
    nodatastructures: bool = flag("NODATASTRUCTURES", help="without data elements")
    nosystemelements: bool = flag("NOSYSTEMELEMENTS", help="without system elements")
    nolinear: bool = flag("NOLINEAR", help="without linear results")
    nofloatingmarkers: bool = flag("NOFLOATINGMARKERS", help="without floating markers")
    norequests: bool = flag("NOREQUESTS", help="without requests")
    nocontacts: bool = flag("NOCONTACTS", help="without contacts")
    comment: str | None = text("COMMENT", help="a remark")
