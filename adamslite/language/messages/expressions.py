"""Messages about function expressions."""

from __future__ import annotations

from adamslite.language.diagnostics import NOTE
from adamslite.language.messages.entry import Message


def _variables(*functions: str) -> tuple[str, ...]:
    return tuple(f"VARIABLE/1, FUNCTION={function}" for function in functions)


EXPRESSIONS: dict[str, Message] = {
    "missing-operator": Message(
        "an operator is missing between {word} and {other}",
        "an expression ends with a backslash when another argument follows",
        _variables("2 TIME", "(1)(2)", "1, 2", "SIN(1)COS(1)"),
    ),
    "missing-operand": Message(
        "{word} lacks a value on one side",
        "",
        _variables("1+", "*2", "MAX(1+, 2)", "2*/3"),
    ),
    "empty-argument": Message(
        "an argument between the commas is missing", "", _variables("MAX(1,,2)", "MAX(1,)")
    ),
    "empty-brackets": Message("these brackets are empty", "", _variables("1+()")),
    "stray-comma": Message(
        "{word} does not belong here",
        "commas and colons separate the arguments of functions only",
        _variables("(1:2)", "1:2"),
    ),
    "expression-too-large": Message(
        "{label} has more than {most} operations when the VARIABLEs in it are written out",
        "a SPLINE in place of long sums; what is solved for (DIFF, MOTION) is not written out",
    ),
    "deck-too-large": Message(
        "with {label} the deck has more than {most} operations when VARIABLEs are written out",
        "chains of VARIABLEs are written out in each that follows: shorter ones, or a DIFF between",
    ),
    "expression-too-long": Message(
        "the expression has {count} words, numbers and signs, and {most} are the most",
        "put parts of it into VARIABLEs of their own; numbers of a table belong in a SPLINE",
    ),
    "too-deep": Message(
        "the expression is nested more than {limit} deep",
        "put inner parts into a VARIABLE of their own",
        _variables("SIN(" * 120 + "1" + ")" * 120),
    ),
    "unknown-name": Message(
        "there is no VARIABLE named {word}",
        "a name in an expression stands for the VARIABLE of that name",
        _variables("EA/2", "TIM", "SIN"),
    ),
    "unknown-function": Message(
        "there is no function {word}",
        "",
        _variables("SIM(1)", "WHATEVER(1,2)", "d(2)"),
    ),
    "planned-function": Message(
        "not supported yet: function {word}{times}",
        "the function exists in ADAMS; this program cannot run it",
        _variables("INVPSD(TIME,1)+INVPSD(TIME,2)"),
    ),
    "only-an-output": Message(
        "{label} cannot use {word}(), which is known at output times only",
        "write it into a request: REQUEST/id, F2={word}()",
        _variables("HSIZE()", "2*ORDER()", "NJAC()", "NRHS()"),
    ),
    "assumed-meaning": Message(
        "ADAMS does not publish what {word} means",
        "`adamslite help {word}` says what it does here; DX(i,j,k), DY and DZ do not leave it open",
        _variables("UVX(2)*TRANS(DXYZ(2,1),2)"),
        severity=NOTE,
    ),
    "argument-count": Message(
        "{word} takes {limits} and has {count}",
        "it is written {usage}",
        _variables("DX()", "DX(1,1,1,1)", "STEP(TIME,0,0,1)", "IF(1: 2, 3)"),
    ),
    "wrong-separator": Message(
        "a colon and a comma are mixed up",
        "it is written {usage}",
        _variables("IF(1, 2, 3, 4)", "MAX(1: 2)"),
    ),
    "not-an-id": Message(
        "{word} takes the id or name of a {kind} here",
        "an id is written, as a whole number of 18 digits at most or a name, and not computed",
        _variables("DX(1+1)", "DX(1.5)", "DX(-1)", "VARVAL(2*3)"),
    ),
    "not-constant": Message(
        "{word} takes a fixed number here", "", _variables("ORIENT(TIME, 1, 1)")
    ),
    "vector-here": Message(
        "a number belongs here, and this is a vector",
        "take a component of it (DX, UVX(i)*v), its size MAG(v), or the product of two vectors",
        _variables("DXYZ(1)", "2*VXYZ(1)", "SIN(DXYZ(1))", "IF(UVX(1): 1, 2, 3)"),
    ),
    "number-here": Message(
        "a vector belongs here, and this is a number",
        "vectors are DXYZ, VXYZ, ACCXYZ, WXYZ, WDTXYZ, FXYZ, TXYZ, UVX, UVY, UVZ, UV and what is "
        "made of them; v*w is a number",
        _variables("MAG(DX(1))", "UVX(1)*UV(3)")
        + ("VFORCE/1, I=2, J_PART=1, FXYZ=DXYZ(2)*UVX(2)",),
    ),
    "vector-operation": Message(
        "{word} does not join these: one is a vector",
        "vectors are added to vectors; they are multiplied with vectors and numbers, and divided "
        "by numbers",
        _variables("MAG(DXYZ(1)+1)", "DXYZ(1)/UVX(1)", "MAG(1/UVX(1))", "DXYZ(1)**2"),
    ),
    "function-rule": Message(
        "{sentence}", "", _variables("STEP(TIME, 1, 0, 1, 1)", "ORIENT(99, 1, 1)")
    ),
}
