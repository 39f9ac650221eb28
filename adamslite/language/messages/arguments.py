"""Messages about the arguments of a statement and their values."""

from __future__ import annotations

from adamslite.language.diagnostics import WARNING
from adamslite.language.messages.entry import Message

ARGUMENTS: dict[str, Message] = {
    "unknown-argument": Message(
        "{keyword} has no argument {word}",
        "its arguments are {known}",
        ("MARKER/4, PART=1, QQ=1,2,3", "PART/4, MAS5=1, CM=4, IP=1,1,1\nMARKER/4, PART=4",
         "SFORCE/1, I=1, J=2, FUNCION=1", "JOINT/1, REVOLVE, I=1, J=2", "MARKER/4, PART=1, XYZW"),
    ),
    "argument-without-value": Message(
        "{word} needs a value",
        "write {word}=: {value}",
        ("MATRIX/1, FULL, ROWS=1, COLUMNS=1, VALUES=1", "MARKER/4, PART=1, QP"),
    ),
    "ambiguous-argument": Message(
        "{word} may mean {choices}", "write more letters",
        ("PART/4, V=1, MASS=1, CM=4, IP=1,1,1\nMARKER/4, PART=4",),
    ),
    "planned-argument": Message(
        "not supported yet: argument {word} of {keyword}{times}",
        "the argument exists in ADAMS; this program cannot run it",
        ("MATRIX/1, NAME=a, FULL=RORDER, ROWS=1, COLUMNS=1, VALUES=1\n"
         "MATRIX/2, NAME=a, FULL=RORDER, ROWS=1, COLUMNS=1, VALUES=1",),
    ),
    "duplicate-argument": Message(
        "{word} is given twice",
        "",
        (
            "MARKER/4, PART=1, QP=1,2,3, QP=1,2,3",
            "MARKER/4, USEXP, PART=1, USEXP, ZP=0,0,1, XP=1,0,0",
            "SFORCE/1, TRANSLATIONAL, ROTATIONAL, I=1, J=2, FUNCTION=1",
            "VFORCE/1, I=2, J_PART=1, FXYZ=DXYZ(2)\\FX=1",
        ),
    ),
    "missing-argument": Message(
        "{label} needs {word}",
        "",
        ("VARIABLE/1", "SFORCE/1, I=1, FUNCTION=1", "JOINT/1, I=1, J=2", "SIMULATE/END=1",
         "CURVE/1"),
    ),
    "flag-with-value": Message(
        "{word} is a flag and takes no value",
        "write just {word}",
        ("MARKER/4, PART=1, USEXP=1", "DIFF/1, IMPLICIT=1, FUNCTION=1"),
    ),
    "unexpected-value": Message(
        "{text} belongs to no argument",
        "values follow the = sign of their argument",
        ("MARKER/4, 5, PART=1", "VARIABLE/1, IC=1,2, FUNCTION=1"),
    ),
    "value-count": Message(
        "{word} takes {expected} and has {count}",
        "values are separated by commas",
        ("MARKER/4, PART=1, QP=1,2", "PART/4, MASS=1, CM=4, IP=1,2,3,4,5,6,7\nMARKER/4, PART=4",
         "SPLINE/1, X=0,1,2, Y=0,1,4"),
    ),
    "not-a-number": Message(
        "{text} is not a number",
        "{word} takes numbers, or arithmetic with numbers",
        ("MARKER/4, PART=1, QP=1,2 3,4", "VARIABLE/1, IC=abc, FUNCTION=1", "DIFF/1, IC=1/0, FU=1"),
    ),
    "number-too-large": Message(
        "{word} is too large for a number", "", ("VARIABLE/1, IC=1E999, FUNCTION=1E999",)
    ),
    "degrees-of-no-angle": Message(
        "{text} is {value:.4g}: D turns degrees into radians, and {word} has the unit {unit}",
        "leave D out; an exponent has digits after the D",
        ("ACCGRAV/JGRAV=-9.81D",),
        severity=WARNING,
    ),
    "exponent-or-degrees": Message(
        "{text} is read as one number, {value:g}",
        "write {power} for a power of ten; for degrees, put a blank behind the D",
        ("VARIABLE/1, FUNCTION=90D+2*TIME", "VARIABLE/1, FUNCTION=SIN(5.0d-1*TIME)"),
        severity=WARNING,
    ),
    "not-an-integer": Message(
        "{word} takes a whole number", "", ("SIMULATE/DYNAMICS, END=1, STEPS=1.5",)
    ),
    "not-a-reference": Message(
        "{text} is not the id or name of a {kind}",
        "an id is a number, a name begins with a letter",
        ("MARKER/4, PART=1.5", "SFORCE/1, I=1*2, J=2, FUNCTION=1"),
    ),
    "unknown-choice": Message(
        "{word} cannot be {text}",
        "it is one of {known}",
        ("UNITS/SYSTEM=SI", "UNITS/SYSTEM=1",
         "PART/4, MASS=1, CM=4, IP=1,1,1, EXACT=X:Q\nMARKER/4, PART=4"),
    ),
    "planned-choice": Message(
        "not supported yet: {keyword} of the kind {word}{times}",
        "supported are {known}",
        ("BEAM/1, I=2, J=1, FORMULATION=NONLINEAR, LENGTH=1, AREA=1, IXX=1, IYY=1, IZZ=1, EMOD=1"
         ", GMOD=1",),
    ),
    "discontinued-choice": Message(
        "ADAMS has discontinued {word}; {instead} runs in its place", "write {instead}",
        ("INTEGRATOR/HASTIFF",), severity=WARNING,
    ),
    "expression-not-closed": Message(
        "the expression before {word} does not end with a backslash",
        "write a backslash before the comma; ADAMS requires it between an expression and {word}",
        ("SFORCE/1, ROTATIONAL, FUNCTION=1, I=1, J=2",),
        severity=WARNING,
    ),
    "missing-reference": Message(
        "there is no {kind}/{key}",
        "",
        ("MARKER/4, PART=7", "SFORCE/1, I=1, J=9, FUNCTION=1", "VARIABLE/1, FUNCTION=DX(9)"),
    ),
    "ambiguous-name": Message(
        "the name {word} belongs to {labels}",
        "names may repeat; then write the id",
        ("! adams_view_name='cm'\nMARKER/4, PART=1\n! adams_view_name='cm'\nMARKER/5, PART=1\n"
         "VARIABLE/1, FUNCTION=DX(cm)",
         "! adams_view_name='a'\nVARIABLE/1, FUNCTION=1\n! adams_view_name='A'\n"
         "VARIABLE/2, FUNCTION=1\nVARIABLE/3, FUNCTION=a"),
    ),
}  # fmt: skip
