"""Messages about tables of numbers: SPLINE and the functions that use it."""

from __future__ import annotations

from adamslite.language.diagnostics import NOTE
from adamslite.language.messages.entry import Message

_CURVE = "SPLINE/1, X=0,1,2,3, Y=0,1,4,9\nVARIABLE/1, FUNCTION="
_FAMILY = "SPLINE/1, X=0,1,2,3, Y=0,0,1,4,9, Y=1,0,2,8,18\nVARIABLE/1, FUNCTION="

TABLES: dict[str, Message] = {
    "not-ascending": Message(
        "{word} of {label} must increase: {low} is followed by {high}",
        "",
        (
            "SPLINE/1, X=0,1,1,3, Y=0,1,4,9",
            "SPLINE/1, X=3,2,1,0, Y=0,1,4,9",
            "SPLINE/1, X=0,1,2,3, Y=1,0,1,4,9, Y=1,0,2,8,18",
        ),
    ),
    "spline-length": Message(
        "a list Y of {label} has {count} values and needs {expected}",
        "one for each X; each of several lists begins with its z, before the values",
        (
            "SPLINE/1, X=0,1,2,3, Y=0,1,4,9,16",
            "SPLINE/1, X=0,1,2,3, Y=0,1,4,9, Y=0,1,4,9",
        ),
    ),
    "spline-curve": Message(
        "{word} has a z, and {spline} is a single curve",
        "write 0 for z, or give the SPLINE several lists Y=z, y1, y2, ...",
        (_CURVE + "AKISPL(TIME,1,1)", _CURVE + "CUBSPL(TIME,TIME,1)"),
    ),
    "spline-family": Message(
        "{word} takes a single curve, and {spline} is a family of curves",
        "AKISPL and CUBSPL take z",
        (_FAMILY + "INTERP(TIME,1,1)",),
    ),
    "family-derivative": Message(
        "{word} has no derivatives of {spline}, which is a family of curves",
        "leave the order out; derivatives are those of a single curve",
        (_FAMILY + "AKISPL(TIME,0.5,1,1)", _FAMILY + "CUBSPL(TIME,0,1,2)"),
    ),
    "curve-uneven": Message(
        "the points of {curve} are not equally far apart, and alpha of CURVE runs along them",
        "ADAMS does not publish how it spreads alpha; give points at equal distances to be sure",
        (
            "MATRIX/1, ROWS=3, COLUMNS=3, VALUES=0,0,0, 1,0,0, 4,0,0\nCURVE/1, MATRIX=1\n"
            "VARIABLE/1, FUNCTION=CURVE(TIME,0,1,1)",
        ),
        severity=NOTE,
    ),
    "spline-sources": Message(
        "{label} has both X, Y and FILE",
        "give its points, or the file that has them",
        ("SPLINE/1, X=0,1,2,3, Y=0,1,4,9, FILE=road.csv",),
    ),
    "data-file": Message(
        "{label} cannot use {file}: {reason}",
        "a table .csv in the folder of the deck or below; that of a SPLINE has a column of x, then "
        "the channels",
        (
            "SPLINE/1, FILE=no-such-table.csv",
            "SPLINE/1, FILE=../road.csv",
            "SPLINE/1, FILE=/road.csv",
            "SPLINE/1, FILE=road.rsp, CHANNEL=2",
            "MATRIX/1, FILE=no-such-table.csv",
        ),
    ),
    "array-size": Message(
        "{label} has SIZE={size} and {count} {word}",
        "leave SIZE out, or make it their number",
        (
            "ARRAY/1, IC, SIZE=3, NUMBERS=1,2",
            "VARIABLE/1, FUNCTION=1\nARRAY/1, U, SIZE=2, VARIABLES=1",
        ),
    ),
    "no-such-value": Message(
        "{label} has no value number {number}: it has {count}",
        "values are counted from 1",
        (
            "ARRAY/1, IC, NUMBERS=1,2\nVARIABLE/1, FUNCTION=ARYVAL(1,3)",
            "ARRAY/1, IC, NUMBERS=1,2\nVARIABLE/1, FUNCTION=ARYVAL(1,0)",
            "ARRAY/1, IC, NUMBERS=1,2\nVARIABLE/1, FUNCTION=ARYVAL(1,1.5)",
            "PINPUT/1, VARIABLES=2\nVARIABLE/2, FUNCTION=1\nVARIABLE/1, FUNCTION=PINVAL(1,2)",
            "POUTPUT/1, VARIABLES=2\nVARIABLE/2, FUNCTION=1\nVARIABLE/1, FUNCTION=POUVAL(1,0)",
            "ARRAY/1, X, SIZE=2\nVARIABLE/1, FUNCTION=ARYVAL(1,3)",
        ),
    ),
    "array-fixed": Message(
        "{word} of {label} cannot change between analyses",
        "NUMBERS can; expressions take VARIABLEs of a list when the deck is read",
        commands=("ARRAY/1, VARIABLES=2", "PINPUT/1, VARIABLES=2", "POUTPUT/1, VARIABLES=2"),
        deck="VARIABLE/1, FUNCTION=1\nVARIABLE/2, FUNCTION=2\nARRAY/1, U, VARIABLES=1\n"
        "PINPUT/1, VARIABLES=1\nPOUTPUT/1, VARIABLES=1\n",
    ),
    "value-lost": Message(
        "{label} uses {word}, which a command has removed",
        "give NUMBERS as many values as before",
        commands=("ARRAY/1, NUMBERS=1",),
        deck="ARRAY/1, IC, NUMBERS=1,2\nVARIABLE/1, FUNCTION=ARYVAL(1,2)\n",
    ),
}
