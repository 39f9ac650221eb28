"""OUTPUT: selection of the output files of ADAMS.

Equation: none; every result is always written.
"""

from __future__ import annotations

from adamslite.language.statement import Statement, flag, statement


@statement("OUTPUT", singleton=True)
class Output(Statement):
    """Choice of output files."""

    reqsave: bool = flag("REQSAVE", help="write a .req file")
    grsave: bool = flag("GRSAVE", help="write a .gra file")
    noprint: bool = flag("NOPRINT", help="no tables")
    noseparator: bool = flag("NOSEPARATOR", help="no blocks per analysis")
    dacsave: bool = flag("DACSAVE", help="write DAC files")
    rpcsave: bool = flag("RPCSAVE", help="write RPC files")
    matsave: bool = flag("MATSAVE", help="write matrix files")
    ypr: bool = flag("YPR", help="angles as yaw, pitch, roll")
    fixed: bool = flag("FIXED", help="fixed-point tables")
    teletype: bool = flag("TELETYPE", help="narrow tables")
    osformat: bool = flag("OSFORMAT", help="old format")
    dplot: bool = flag("DPLOT", help="write plot data")
