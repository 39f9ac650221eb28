"""Messages about linear systems: LSE, TFSISO and the ARRAYs and MATRIXes that they name."""

from __future__ import annotations

from adamslite.language.diagnostics import NOTE
from adamslite.language.messages.entry import Message

_PARTS = (
    "VARIABLE/1, FUNCTION=TIME\nVARIABLE/2, FUNCTION=1\nARRAY/1, U, VARIABLES=1\nARRAY/2, X\n"
    "ARRAY/3, Y\nARRAY/4, U, VARIABLES=1,2\nARRAY/5, IC, NUMBERS=1,2\nARRAY/6, Y\n"
    "MATRIX/1, ROWS=2, COLUMNS=2, VALUES=0,1,-4,-1\nMATRIX/2, ROWS=2, COLUMNS=1, VALUES=0,1\n"
    "MATRIX/3, ROWS=1, COLUMNS=2, VALUES=1,0\nMATRIX/4, ROWS=1, COLUMNS=1, VALUES=2\n"
    "MATRIX/5, ROWS=2, COLUMNS=2, VALUES=0,1,0,-1\n"
)
_LSE = _PARTS + "LSE/1, X=2, A=1"
_FILTER = _PARTS + "TFSISO/1, X=2, U=1, Y=3"
_GSE = "ARRAY/1, X\nARRAY/2, Y\nARRAY/3, X\nARRAY/4, IC, NUMBERS=1\nGSE/1, NS=1, X=1"
_STATICS = "\nSIMULATE/STATICS"

_STRUCTURE = (
    "MATRIX/1, SPARSE, ROWS=6, COLUMNS=6, VALUES=1,1,5\n"
    "MATRIX/2, SPARSE, ROWS=6, COLUMNS=1, VALUES=1,1,5\n"
    "NFORCE/1, IMARKERS=2, J=1"
)
SYSTEMS: dict[str, Message] = {
    "brings-too-much": Message(
        "{label} makes too many states, outputs or points of contact: a deck has room for {most}",
        "they are NS, NO and ND of a GSE, rows of an LSE, IGEOM times JGEOM of a CONTACT",
        (
            "ARRAY/1, X\nARRAY/2, Y\nMATRIX/1, ROWS=1, COLUMNS=1, VALUES=-1\n"
            "MATRIX/2, SPARSE, ROWS=1000000, COLUMNS=1, VALUES=1,1,1\nLSE/1, X=1, Y=2, A=1, C=2",
        ),
    ),
    "array-kind": Message(
        "{word} of {label} must be an ARRAY {needed}, and {array} is an ARRAY {kind}",
        "X are states, U inputs, Y outputs, IC numbers",
        (
            _PARTS + "LSE/1, X=3, A=1",
            _LSE + ", U=3, B=2",
            _LSE + ", Y=5, C=3",
            _LSE + ", IC=1",
            _FILTER.replace("Y=3", "Y=2") + ", NUM=1, DEN=1,1",
        ),
    ),
    "array-owners": Message(
        "{array} belongs to {first} and to {label}",
        "the values of an ARRAY X or Y are those of one LSE or TFSISO: write another ARRAY",
        (
            _LSE + "\nLSE/2, X=2, A=1",
            _FILTER + ", NUM=1, DEN=1,1\nARRAY/7, X\nTFSISO/2, X=7, U=1, Y=3, NUM=1, DEN=1,1",
        ),
    ),
    "system-part": Message(
        "{label} has {word} without {other}",
        "B and D take U, C and D make Y",
        (
            _LSE + ", B=2",
            _LSE + ", C=3",
            _LSE + ", U=1, B=2, D=4",
            _LSE + ", Y=3, D=4",
            _LSE + ", U=1",
            _LSE + ", Y=3",
        ),
    ),
    "system-matrix": Message(
        "{word} of {label} is {matrix}, {size}, and must be {needed}",
        "A (n, n), B (n, m), C (p, n), D (p, m) for n states, m inputs and p outputs",
        (
            _PARTS + "LSE/1, X=2, A=2",
            _LSE + ", U=4, B=2",
            _LSE + ", U=1, B=4",
            _LSE + ", Y=3, C=4",
            _LSE + ", U=4, Y=3, C=3, D=4",
            _LSE + ", U=1, Y=3, C=3, D=2",
        ),
    ),
    "system-array": Message(
        "{array} has {count} {what}, and {label} needs {needed}",
        "SIZE may be left out",
        (
            _PARTS + "ARRAY/7, X, SIZE=3\nLSE/1, X=7, A=1",
            _PARTS + "ARRAY/7, Y, SIZE=2\nLSE/1, X=2, A=1, C=3, Y=7",
            _PARTS + "ARRAY/7, IC, NUMBERS=1,2,3\nLSE/1, X=2, A=1, IC=7",
            _FILTER + ", IC=5, NUM=1, DEN=1,1",
            _FILTER.replace("U=1", "U=4") + ", NUM=1, DEN=1,1",
        ),
    ),
    "system-value": Message(
        "{label} takes value number {number} of {array}, which has {count}",
        "an ARRAY X or Y has the values of the LSE or TFSISO that names it",
        (
            "ARRAY/1, X, SIZE=2\nVARIABLE/1, FUNCTION=ARYVAL(1,2)",
            "ARRAY/1, Y\nVARIABLE/1, FUNCTION=ARYVAL(1,1)",
            _PARTS + "ARRAY/7, X\nLSE/1, X=7, A=1\nVARIABLE/3, FUNCTION=ARYVAL(7,3)",
        ),
    ),
    "no-routine": Message(
        "FUNCTION of {label} must be USER(...)",
        "of equations that are expressions each is a DIFF",
        ("ARRAY/1, X\nGSE/1, NS=1, X=1, FUNCTION=TIME",),
    ),
    "discrete-states": Message(
        "the discrete states of {label} can be read, but not computed",
        "bind numbers to its routine; then they stay as ICD has them",
        (_GSE + ", ND=1, XD=3, FUNCTION=USER(1)",),
        user=("GSESUB=user_functions:constant",),
    ),
    "no-leading-coefficient": Message(
        "the last number of DENOMINATOR of {label} is zero",
        "it belongs to the highest power: coefficients ascend, a0, a1, ..., an; leave a zero out",
        (_FILTER + ", NUM=1, DEN=1,0", _FILTER + ", NUM=1, DEN=0"),
    ),
    "no-states": Message(
        "DENOMINATOR of {label} is a number",
        "a gain has no states: write a VARIABLE, FUNCTION=k*VARVAL(id)",
        (_FILTER + ", NUM=3, DEN=2",),
    ),
    "improper-fraction": Message(
        "NUMERATOR of {label} has degree {above}, and DENOMINATOR only {below}",
        "it would differentiate its input; give a pole more, as in b1 p/(1 + T p) with a short T",
        (_FILTER + ", NUM=0,1,0.5, DEN=1,1",),
    ),
    "no-rest": Message(
        "statics cannot find the states of {label}: equations of A x + B u = 0 are dependent",
        "STATIC_HOLD keeps the states in statics",
        (_PARTS + "LSE/1, X=2, A=5" + _STATICS, _FILTER + ", NUM=0,1, DEN=0,1,1" + _STATICS),
        commands=("SIMULATE/STATICS",),
        deck=_PARTS + "LSE/1, X=2, A=5\n",
    ),
    "rest-by-input": Message(
        "statics find the states of {label} only if they bring the input about at which "
        "A x + B u = 0: A is singular, as that of an integrator",
        "STATIC_HOLD keeps the states in statics",
        (
            _PARTS + "LSE/1, X=2, U=1, A=5, B=2" + _STATICS,
            _FILTER + ", NUM=1, DEN=0,1" + _STATICS,
        ),
        severity=NOTE,
    ),
    "nforce-matrix": Message(
        "{word} of {label} is {matrix}, {size}, and must be {needed}",
        "six rows for each of IMARKERS; KMATRIX and CMATRIX as many columns, LENGTH and FORCE one",
        (_STRUCTURE + ", KMATRIX=2", _STRUCTURE + ", FORCE=1"),
    ),
    "marker-twice": Message(
        "{label} has MARKER/{key} twice",
        "IMARKERS and J are all different",
        (_STRUCTURE.replace("=2,", "=2,2,"), _STRUCTURE.replace("=2,", "=2,1,")),
    ),
    "nforce-marker": Message(
        "MARKER/{key} is none of {nforce}",
        "it has {listed}",
        (_STRUCTURE + "\nVARIABLE/1, FUNCTION=NFORCE(1,3,1)",),
    ),
}
