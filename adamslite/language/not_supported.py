"""Names of the ADAMS/Solver language that are not supported yet.

They exist, so they are reported as "not supported yet" and not as "unknown".  A name that is
registered elsewhere is supported, whether or not it still stands here.
"""

STATEMENTS = frozenset(
    """CONTACT CVCV
    GSE IC LSE LSSMATRIX MREQUEST NFORCE PFORCE
    SYSVAR TFSISO UCON""".split()
)

COMMANDS = frozenset("CONTROL HELP INFO MENU RELOAD SAVE SHOW TIME".split())

FUNCTIONS = frozenset(
    """AO CONTACT CURVE CVCV DELAY HSIZE INVPSD NFORCE NJAC NRHS ORDER TRANS
    USER""".split()
)

_TABULATE = "write points of the curve into a MATRIX: CURVE/id, MATRIX=id, CURVE_POINTS"
INSTEAD = {
    "ARYVAL of states and outputs": "an ARRAY X or Y gets its values from an LSE, GSE or TFSISO",
    "CURVE FUNCTION": _TABULATE,
    "CURVE MINPAR": _TABULATE,
    "CURVE MAXPAR": _TABULATE,
    "DELAY": "for a delay of TIME alone, write the expression with TIME-tau for TIME, in a STEP or "
    "IF that holds the start; a lag is a DIFF: FUNCTION=(VARVAL(id)-DIF(this))/tau",
    "INVPSD": "its random phases come from a generator that is not published: write the sum of "
    "sines a*SIN(2*PI*f*TIME+phase), or a SPLINE of the signal",
    "CVCV": "curves that roll on each other cannot be run; PTCV holds a point on one curve",
    "BEAM NONLINEAR": "a beam that bends far is a row of LINEAR ones with parts between them",
}
"""What to write instead, by statement, statement and argument, or statement and choice."""
