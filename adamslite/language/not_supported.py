"""Names of the ADAMS/Solver language that are not supported yet.

They exist, so they are reported as "not supported yet" and not as "unknown".  A name that is
registered elsewhere is supported, whether or not it still stands here.
"""

STATEMENTS = frozenset("""LSSMATRIX PFORCE SYSVAR""".split())

COMMANDS = frozenset("CONTROL".split())

FUNCTIONS = frozenset("""AO INVPSD""".split())

_MATRICES = "LINEAR/STATEMAT writes A, B, C and D of the same linear model"
_ROUTINE = "libraries of the user cannot be loaded: write FUNCTION as an expression"
_CONTACT = "routines of the user cannot be called: write IMPACT or POISSON, and COULOMB_FRICTION"
INSTEAD = {
    "CONTACT FRICTION_FUNCTION": _CONTACT,
    "CONTACT NORMAL_FUNCTION": _CONTACT,
    "GSE IMPLICIT": "write each equation as a DIFF, IMPLICIT",
    "GSE STATICS_ONLY": "write STATIC_HOLD on the other elements, or delete it",
    "LSSMATRIX": "the matrices come from another program: write them as MATRIX and LSE",
    "PFORCE": "its law is not published: write an SFORCE, a VFORCE or a FIELD",
    "SYSVAR": "its meaning is not published: write a VARIABLE",
    "CONTROL": "it calls a subroutine, which gives commands: write these into the command file",
    "AO": "its meaning is not published: write AX, AY, AZ or ORIENT",
    "ARRAY ROUTINE": _ROUTINE,
    "BEAM NONLINEAR": "a beam that bends far is a row of STRING ones with parts between them",
    "FILE COMMAND": "name the command file on the command line: `adamslite solve DECK FILE.acf`",
    "INVPSD": "its random phases come from a generator that is not published: write the sum of "
    "sines a*SIN(2*PI*f*TIME+phase), or a SPLINE of the signal",
    "LINEAR NASTRAN": _MATRICES,
    "MATRIX NAME": "a table .csv holds one matrix: name the file, MATRIX/id, FILE=name.csv",
    "SPLINE ROUTINE": "write X and Y, or FILE= with a table .csv",
}
"""What to write instead and why, by statement, function, statement and argument, or statement and
choice."""
