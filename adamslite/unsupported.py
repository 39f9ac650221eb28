"""Names of the ADAMS/Solver language that cannot be run yet.

They exist, so a deck that uses them is told "not supported yet" and not "unknown".  A name that is
registered elsewhere is supported, whether or not it still stands here.
"""

STATEMENTS = frozenset(
    """ARRAY CONTACT CVCV DEBUG FLEX_BODY
    GSE IC LSE LSSMATRIX MREQUEST NFORCE PFORCE
    PREFERENCES SENSOR SPLINE STRING SYSVAR TFSISO UCON""".split()
)

COMMANDS = frozenset("CONTROL ENVIRONMENT HELP INFO MENU RELOAD SAVE SHOW TIME".split())

FUNCTIONS = frozenset(
    """ACCXYZ AKISPL ARYVAL CONTACT CUBSPL CURVE CVCV DXYZ
    INCANG INTERP INVPSD NFORCE PINVAL POUVAL SENVAL USER
    UV VXYZ WDTXYZ WXYZ""".split()
)
