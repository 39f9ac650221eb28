"""Names of the ADAMS/Solver language that cannot be run yet.

They exist, so a deck that uses them is told "not supported yet" and not "unknown".  A name that is
registered elsewhere is supported, whether or not it still stands here.
"""

STATEMENTS = frozenset(
    """ARRAY BEAM BUSHING CONTACT CVCV DEBUG FIELD FLEX_BODY FRICTION
    GFORCE GSE IC LSE LSSMATRIX MREQUEST NFORCE PFORCE
    PREFERENCES SENSOR SPLINE STRING SYSVAR TFSISO UCON VTORQUE""".split()
)

COMMANDS = frozenset(
    "CONTROL ENVIRONMENT HELP INFO MENU RELOAD SAVE SHOW TIME".split()
)

FUNCTIONS = frozenset(
    """ACCXYZ AKISPL ARYVAL BEAM BUSH CONTACT CUBSPL CURVE CVCV DXYZ FIELD FRICTION GCON
    GFORCE INCANG INTERP INVPSD NFORCE PINVAL POUVAL SENVAL USER
    UV VTORQ VXYZ WDTXYZ WXYZ""".split()
)
