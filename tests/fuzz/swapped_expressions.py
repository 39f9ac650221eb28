"""Decks whose expressions are functions of each other, of constants and of TIME, in every place
that takes one.
"""

from __future__ import annotations

from functools import cache
from random import Random

from adamslite.language.function import FUNCTIONS

HEAD = """functions of each other
UNITS/SYSTEM=MKS
PART/1, GROUND
MARKER/1, PART=1
MARKER/5, PART=1, FLOATING
PART/2, MASS=1, CM=2, IP=1,2,3, QG=0.5,0.2,0.1, VX=1
MARKER/2, PART=2
MARKER/3, PART=2, QP=0.1,0,0
SPLINE/9, X=0,1,2,3, Y=0,1,0,2
ARRAY/9, IC, NUMBERS=1,2
"""
#: Statements with a place for an expression each.
PLACES = (
    "VARIABLE/{n}, FUNCTION={e}",
    "DIFF/{n}, IC=1, FUNCTION={e}",
    "DIFF/{n}, IC=1, IMPLICIT, FUNCTION={e}",
    "SFORCE/{n}, TRANSLATION, I=2, J=1, FUNCTION={e}",
    "SFORCE/{n}, ROTATION, ACTIONONLY, I=2, J=1, FUNCTION={e}",
    "VFORCE/{n}, I=2, J_PART=1, FX={e}\\, FY={e}\\, FZ=0",
    "VTORQUE/{n}, I=2, J_PART=1, TX={e}\\, TY=0\\, TZ={e}",
    "GCON/{n}, FUNCTION={e}",
    "MOTION/{n}, I=2, J=1, X, FUNCTION={e}",
    "MOTION/{n}, I=2, J=1, VELOCITY, Y, FUNCTION={e}",
    "SENSOR/{n}, FUNCTION={e}\\, VALUE=1, GE, PRINT",
    "REQUEST/{n}, F2={e}\\F3={e}",
    "VARIABLE/{n}, FUNCTION=VARVAL(1)*({e})",
)
VALUES = ("0", "1", "-1", "2", "0.5", "1E-3", "1E30", "TIME", "TIME", "TIME-0.5", "PI")
TABLES = "AKISPL(TIME,0,9)", "CUBSPL(DX(2,1),0,9)", "CUBSPL(1,0,9,1)", "ARYVAL(9,1)"
MEASURES = ("DM(2,1)", "DX(2,1)", "DZ(3,2)", "VR(2,1)", "AZ(2,1)", "WZ(2,1)", "VARVAL(1)", *TABLES)
FEW_ARGUMENTS = 12
#: Of vectors, and what is the whole of a FUNCTION.
NOT_INSIDE = ("MAG", "USER", "UV")


def expression(random: Random, depth: int = 3) -> str:
    """An expression so deep."""
    form = random.random()
    if depth == 0 or form < 0.2:
        return random.choice(VALUES if random.random() < 0.75 else MEASURES)
    if form < 0.4:
        a, b = (expression(random, depth - 1) for _ in "ab")
        return f"({a}){random.choice(('+', '-', '*', '/', '**'))}({b})"
    name = random.choice(_values())
    if name == "IF":
        a, b, c, d = (expression(random, depth - 1) for _ in "abcd")
        return f"IF({a}:{b},{c},{d})"
    plain = random.random() < 0.5
    count = random.randint(*_counts(name))
    drawn = (random.choice(VALUES) if plain else expression(random, depth - 1) for _ in "x" * count)
    return f"{name}({','.join(drawn)})"


def _counts(name: str) -> tuple[int, int]:
    """Least and most arguments of a function."""
    function = FUNCTIONS[name]
    least = function.minimum
    most = function.maximum
    return least, max(least, min(most if most is not None else least + 3, FEW_ARGUMENTS))


@cache
def _values() -> list[str]:
    """Functions whose arguments are all expressions."""
    values = [
        name
        for name, each in FUNCTIONS.items()
        if each.parameters
        and name not in NOT_INSIDE
        and {each.parameter(n).statement for n in range(max(1, each.minimum))} == {None}
    ]
    return [*sorted(values), "IF", "IF"]


def deck(random: Random) -> str:
    """Some statements with such expressions."""
    lines = [f"VARIABLE/1, FUNCTION={expression(random, 1)}"]
    for number in range(2, 2 + random.randint(1, 3)):
        place = random.choice(PLACES)
        while "{e}" in place:
            place = place.replace("{e}", expression(random), 1)
        lines.append(place.format(n=number))
    wrapped = "\n".join(_wrapped(line) for line in lines)
    return f"{HEAD}{wrapped}\nSIMULATE/DYNAMIC, END=1, STEPS=3\nEND\n"


def _wrapped(line: str) -> str:
    """Broken after commas."""
    found, row = [], ""
    for word in line.split(","):
        if len(row) + len(word) > 70:
            found.append(row)
            row = ""
        row += word + ","
    return "\n, ".join([*found, row.removesuffix(",")])
