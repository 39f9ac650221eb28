"""Decks of every registered statement, argument, function and command, most of them without errors.

The other kinds change files that are there, and no deck of the project has them all.  Here a deck
begins with ``STOCK``, which has something to refer to of every kind, and goes on with statements
that are drawn: their ids exist, their numbers are small, their vectors as long as they should be,
and each of that is now and then not so.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from functools import cache
from random import Random

import adamslite.elements
import adamslite.functions  # noqa: F401  both register what is drawn
from adamslite.language.function import FUNCTIONS, Function, Parameter
from adamslite.language.statement import STATEMENTS, Argument, Statement

STOCK = """something to refer to
UNITS/SYSTEM=MKS
PART/1, GROUND
MARKER/1, PART=1
MARKER/2, PART=1, QP=1,0,0, REULER=90D,0,0
MARKER/3, PART=1, FLOATING
PART/2, MASS=1, CM=4, IP=1,2,3, QG=1,0,0
MARKER/4, PART=2
MARKER/5, PART=2, QP=0.1,0,0
PART/3, MASS=2, CM=6, IP=1,2,3, QG=0,2,0, REULER=30D,20D,10D
MARKER/6, PART=3
MARKER/7, PART=3, FLOATING
PART/4, MASS=2, CM=8, IP=1,2,3, QG=0,0,3
MARKER/8, PART=4
POINT_MASS/5, MASS=1, CM=9, QG=3,3,3
MARKER/9, POINT_MASS=5
JOINT/1, REVOLUTE, I=4, J=2
JOINT/2, TRANSLATIONAL, I=8, J=1
GRAPHICS/1, BOX, CORNER=4, X=1, Y=1, Z=1
GRAPHICS/2, ELLIPSOID, CM=6, XSCALE=1, YSCALE=1, ZSCALE=1
GRAPHICS/3, PLANE, RM=1, XMIN=-1, XMAX=1, YMIN=-1, YMAX=1
GRAPHICS/4, CYLINDER, CM=8, LENGTH=1, RADIUS=0.1
VARIABLE/1, FUNCTION=TIME
VARIABLE/2, IC=1, FUNCTION=DX(4,1)
DIFF/1, IC=1, FUNCTION=-DIF(1)
ARRAY/1, IC, NUMBERS=0,1
ARRAY/2, U, VARIABLES=1,2
ARRAY/3, X, SIZE=2
ARRAY/4, Y, SIZE=2
ARRAY/5, X, SIZE=1
ARRAY/6, U, VARIABLES=1
ARRAY/7, Y, SIZE=1
MATRIX/1, FULL=RORDER, ROWS=2, COLUMNS=2, VALUES=-1,0,0,-1
MATRIX/2, FULL=CORDER, ROWS=6, COLUMNS=6, VALUES=1,0,0,0,0,0, 0,1,0,0,0,0, 0,0,1,0,0,0
, 0,0,0,1,0,0, 0,0,0,0,1,0, 0,0,0,0,0,1
MATRIX/3, FULL=RORDER, ROWS=5, COLUMNS=3, VALUES=0,0,0, 1,0,0, 2,1,0, 3,1,1, 4,0,1
SPLINE/1, X=0,1,2,3,4, Y=0,1,0,1,0
SPLINE/2, X=0,1,2,3, Y=0, 0,1,2,3, Y=1, 1,2,3,5, LINEAR_EXTRAPOLATE
MATRIX/4, FULL=RORDER, ROWS=7, COLUMNS=3, VALUES=1,0,0, 0.5,0.9,0, -0.5,0.9,0, -1,0,0
, -0.5,-0.9,0, 0.5,-0.9,0, 1,0,0
CURVE/1, OPEN, CURVE_POINTS, MATRIX=3
CURVE/2, CLOSED, CURVE_POINTS, MATRIX=4
STRING/1, STRING=a text
PINPUT/1, VARIABLES=1,2
POUTPUT/1, VARIABLES=2
SENSOR/1, FUNCTION=TIME, VALUE=0.005, GE, EVALUATE=DX(4,1)
"""
COMMANDS = """INTEGRATOR/GSTIFF, ERROR=1E-3
SIMULATE/DYNAMIC, END=0.01, STEPS=2
"""
#: Ids that the stock has of a statement.
STOCKED = {
    "PART": "1234", "MARKER": "124568", "POINT_MASS": "5", "JOINT": "12", "GRAPHICS": "1234",
    "VARIABLE": "12", "DIFF": "1", "ARRAY": "1234", "MATRIX": "1234", "SPLINE": "12", "CURVE": "12",
    "STRING": "1", "PINPUT": "1", "POUTPUT": "1", "SENSOR": "1",
}  # fmt: skip
#: Markers on two bodies.
PAIRS = (("4", "2"), ("6", "1"), ("8", "1"), ("5", "6"), ("6", "4"), ("8", "6"), ("9", "6"))
#: Markers that arguments of these names take.
FLOATING = ("3", "7")
#: Statements without errors: {i} and {j} are markers of two bodies, {n} is a number, {p} one above
#: zero, {e} an expression, {t} one of TIME.
FORMS = {
    "ARRAY": ("IC, NUMBERS={n},{n}", "U, VARIABLES=1,2", "X, SIZE=2"),
    "BEAM": (
        "I={i}, J={j}, LENGTH={p}, IXX={p}, IYY={p}, IZZ={p}, AREA={p}, EMODULUS={p}, GMODULUS={p}"
        ", CRATIO={p}, FORMULATION=STRING",
        "I={i}, J={j}, LENGTH={p}, IXX={p}, IYY={p}, IZZ={p}, AREA={p}, EMODULUS={p}, GMODULUS={p}"
        ", ASY={p}, ASZ={p}",
    ),
    "BUSHING": ("I={i}, J={j}, K={p},{p},{p}, C={p},{p},{p}, KT={p},{p},{p}, CT={p},{p},{p}",),
    "CONTACT": (
        "IGEOM=2, JGEOM=3, IMPACT, STIFFNESS={p}, EXPONENT=1.5, DAMPING={p}, DMAX={p}",
        "IGEOM=2, JGEOM=1, POISSON, PENALTY={p}, RESTITUTION_COEFFICIENT=0.5",
        "IGEOM=2, JGEOM=3, IMPACT, STIFFNESS={p}, EXPONENT=2.2, DAMPING={p}, DMAX={p}"
        ", COULOMB_FRICTION=ON, MU_STATIC=0.3, MU_DYNAMIC=0.1, STICTION_TRANSITION_VELOCITY=0.1"
        ", FRICTION_TRANSITION_VELOCITY=1",
    ),
    "COUPLER": ("JOINTS=1,2, TYPE=R:T, SCALES=1,{n}", "JOINTS=1,2, TYPE=R:T, SCALES={p},{p}"),
    "CURVE": (
        "OPEN, CURVE_POINTS, MATRIX=3, ORDER=4",
        "CLOSED, CURVE_POINTS, MATRIX=4",
        "OPEN, CONTROL_POINTS, MATRIX=3, ORDER=3",
    ),
    "CVCV": ("ICURVE=2, JCURVE=2, IRM=6, JRM=1", "ICURVE=2, JCURVE=2, IRM=6, JRM=4"),
    "DIFF": ("IC={n}, FUNCTION={e}", "IC={n}, IMPLICIT, FUNCTION=DIF1({id})-({e})"),
    "FIELD": (
        "I={i}, J={j}, KMATRIX=1,0,0,0,0,0,0,1,0,0,0,0,0,0,1,0,0,0,0,0,0,1,0,0,0,0,0,0,1,0"
        ",0,0,0,0,0,1, CRATIO={p}, LENGTH={n},{n},{n},0,0,0",
        "I={i}, J={j}, FX={e} \\ FY={e} \\ FZ=0 \\ TX={e} \\ TY=0 \\ TZ=0",
    ),
    "FRICTION": (
        "JOINT=1, MU_STATIC=0.3, MU_DYNAMIC=0.2, STICTION_TRANSITION_VELOCITY={p}, PIN_RADIUS={p}"
        ", FRICTION_ARM={p}, BENDING_REACTION_ARM={p}",
        "JOINT=2, MU_STATIC=0.3, MU_DYNAMIC=0.2, INITIAL_OVERLAP={p}, REACTION_ARM={p}"
        ", OVERLAP_DELTA=CONSTANT",
    ),
    "GCON": ("FUNCTION=DX({i},{j})-({n})", "FUNCTION=DX(6,1)*DY(6,1)-{n}"),
    "GEAR": ("JOINTS=1,2, CV=1",),
    "GFORCE": ("I={i}, JFLOAT=3, RM={j}, FX={e} \\ FY={e} \\ FZ={e} \\ TX={e} \\ TY=0 \\ TZ=0",),
    "JOINT": (
        "SPHERICAL, I={i}, J={j}", "HOOKE, I={i}, J={j}", "CYLINDRICAL, I={i}, J={j}",
        "FIXED, I={i}, J={j}", "PLANAR, I={i}, J={j}", "SCREW, PITCH={p}, I={i}, J={j}",
        "RACKPIN, PD={p}, I={i}, J={j}", "CONVEL, I={i}, J={j}", "UNIVERSAL, I={i}, J={j}",
    ),
    "JPRIM": (
        "INLINE, I={i}, J={j}", "INPLANE, I={i}, J={j}", "ORIENTATION, I={i}, J={j}",
        "PARALLEL_AXES, I={i}, J={j}", "PERPENDICULAR, I={i}, J={j}", "ATPOINT, I={i}, J={j}",
    ),
    "LSE": ("X=3, U=2, A=1, B=1", "X=3, U=2, Y=4, IC=1, A=1, B=1, C=1, D=1, STATIC_HOLD"),
    "MATRIX": (
        "FULL=RORDER, ROWS=2, COLUMNS=2, VALUES={n},{n},{n},{n}",
        "SPARSE, ROWS=3, COLUMNS=3, VALUES=1,1,{n},2,3,{n}",
    ),
    "MOTION": (
        "JOINT=1, ROTATION, FUNCTION={t}", "JOINT=2, TRANSLATION, VELOCITY, FUNCTION={t}",
        "I={i}, J={j}, X, FUNCTION={t}", "I={i}, J={j}, B3, ACCELERATION, FUNCTION={t}",
    ),
    "NFORCE": ("IMARKERS=6, J=4, KMATRIX=2, CRATIO={p}", "IMARKERS=6, J=8, KMATRIX=2, CMATRIX=2"),
    "PTCV": ("I=6, JFLOAT=3, CURVE={c}, RM=1", "I=9, JFLOAT=3, CURVE={c}, RM=1"),
    "REQUEST": ("F2={e} \\ F3={e}", "FORCE, I={i}, J={j}, RM={j}", "ACCELERATION, I={i}, J={j}"),
    "SENSOR": (
        "FUNCTION={e} \\ VALUE={n}, GE, ERROR={p}, HALT",
        "FUNCTION={t} \\ VALUE=0.003, EQ, ERROR=1E-4, STEPSIZE={p}, RESTART",
        "FUNCTION={e} \\ VALUE={n}, LE, RETURN, EVALUATE={e}",
    ),
    "SFORCE": (
        "TRANSLATIONAL, I={i}, J={j}, FUNCTION={e}", "ROTATIONAL, I={i}, J={j}, FUNCTION={e}",
        "TRANSLATIONAL, ACTIONONLY, I={i}, J={j}, FUNCTION={e}",
    ),
    "SPLINE": ("X=0,1,2,3,4, Y={n},{n},{n},{n},{n}",),
    "SPRINGDAMPER": (
        "TRANSLATIONAL, I={i}, J={j}, K={p}, C={p}, LENGTH={p}",
        "ROTATIONAL, I={i}, J={j}, KT={p}, CT={p}",
    ),
    "TFSISO": ("X={x}, U={u}, Y={y}, NUMERATOR=1, DENOMINATOR=1,{p}",),
    "VARIABLE": ("FUNCTION={e}", "IC={n}, FUNCTION={e}"),
    "VFORCE": ("I={i}, JFLOAT=3, RM={j}, FX={e} \\ FY={e} \\ FZ={e}",),
    "VTORQUE": ("I={i}, JFLOAT=3, RM={j}, TX={e} \\ TY={e} \\ TZ={e}",),
}  # fmt: skip
COMMAND_FORMS = (
    "SIMULATE/STATIC",
    "SIMULATE/STATIC, END=0.01, STEPS=2",
    "SIMULATE/KINEMATIC, END=0.02, STEPS=1",
    "SIMULATE/INITIAL_CONDITIONS",
    "SIMULATE/DYNAMIC, DURATION=0.01, STEPS=2",
    "LINEAR/EIGENSOL",
    "LINEAR/STATEMAT, FILE=matrices, PINPUT=1, POUTPUT=1",
    "LINEAR/MKB, FILE=mkb",
    "SAVE/SYSTEM, FILE=kept",
    "RELOAD/SYSTEM, FILE=kept",
    "DEACTIVATE/JOINT, ID=1",
    "ACTIVATE/JOINT, ID=1",
    "INFO/DISPLACEMENT, I=4, J=1",
    "INFO/FORCE, I=4, J=2",
    "EQUILIBRIUM/METHOD=DYNAMIC",
    "PART/2, MASS=3",
    "VARIABLE/1, FUNCTION={e}",
    "MARKER/5, QP={n},{n},{n}",
    "JOINT/1, SPHERICAL",
    "SPLINE/1, Y={n},{n},{n},{n},{n}",
    "SAVE/STATES, BUFFER=a",
    "RELOAD/STATES, BUFFER=a",
    "FILE/OUTPUT_PREFIX=other",
    "INTEGRATOR/HHT",
    "INTEGRATOR/WSTIFF, SI2, ERROR={p}",
    "INTEGRATOR/ABAM",
    "KINEMATICS/MAXIT=5",
)
NUMBERS = ("0", "1", "2", "0.5", "0.1", "1E-3", "10", "100", "30D", "-1", "1E4")
ODD_NUMBERS = ("1E300", "-1E300", "1E-300", "1E400", "9" * 30, "-0", "1E5D", "7", "-2", "1E-9")
WORDS = ("a title", "x", '"quoted, text"', "kept", "a b", "USER(1,2)", "é", "A::b")
#: How often something is as it should not be.
ODD = 0.02
NEW = 50
"""The first id of what is drawn."""
DEPTH = 3
VECTORS = ("DXYZ", "VXYZ", "ACCXYZ", "WXYZ", "WDTXYZ", "FXYZ", "TXYZ")
#: Functions that few arguments take: vectors, routines of the user, what is known at outputs only.
APART = ("UVX", "UVY", "UVZ", "UV", "TRANS", "USER", "HSIZE", "ORDER", "NJAC", "NRHS")

Found = dict[str, list[str]]
"""Ids by the statement."""


@cache
def _classes(*places: str) -> tuple[type[Statement], ...]:
    """What may be drawn for a deck or for commands."""
    return tuple(each for each in STATEMENTS.values() if each.place in places and not each.ends)


def deck(random: Random) -> str:
    """A deck."""
    lines = [each for each in STOCK.splitlines() if random.random() > ODD / 4]
    known = {keyword: list(ids) for keyword, ids in STOCKED.items()}
    for number in range(random.randint(1, 5)):
        any_of = [STATEMENTS[each] for each in FORMS] if random.random() < 0.7 else ()
        cls = random.choice(any_of or _classes("deck", "both"))
        lines.append(_statement(random, cls, str(NEW + number), known))
        known.setdefault(cls.keyword, []).append(str(NEW + number))
    return "\n".join([*lines, "END", ""])


def commands(random: Random) -> str:
    """Commands for any of these decks."""
    lines = COMMANDS.splitlines()
    known = {keyword: list(ids) for keyword, ids in STOCKED.items()}
    for _ in range(random.randint(1, 4)):
        at = random.randrange(len(lines) + 1)
        lines.insert(at, _command(random, known))
    return "\n".join([*lines, random.choice(["", "STOP"]), ""])


def _command(random: Random, known: Found) -> str:
    """A command of a form without errors, or with any arguments."""
    form = random.random()
    if form < 0.7:
        return _filled(random, random.choice(COMMAND_FORMS), "1", known)
    cls = random.choice(_classes(*(("command", "both") if form < 0.9 else ("deck",))))
    return _any_statement(random, cls, random.choice(known.get(cls.keyword, ["1"])), known)


def _statement(random: Random, cls: type[Statement], key: str, known: Found) -> str:
    """A statement of a form without errors, or of any arguments."""
    forms = FORMS.get(cls.keyword, ())
    if forms and random.random() < 0.8:
        return f"{cls.keyword}/{key}, {_filled(random, random.choice(forms), key, known)}"
    return _any_statement(random, cls, key, known)


def _filled(random: Random, form: str, key: str, known: Found) -> str:
    """A form with what is missing in it."""
    i, j = random.choice(PAIRS)
    slots: dict[str, Callable[[], str]] = {
        "i": lambda: i, "j": lambda: j, "id": lambda: key,
        "n": lambda: _number(random), "p": lambda: _number(random).lstrip("-").replace("0", "2"),
        "e": lambda: expression(random, known), "t": lambda: expression(random, {}, of_time=True),
        "c": lambda: random.choice("12"), "x": lambda: "5", "u": lambda: "6", "y": lambda: "7",
    }  # fmt: skip
    return re.sub(r"\{(\w+)\}", lambda found: slots[found[1]](), form)


def _any_statement(random: Random, cls: type[Statement], key: str, known: Found) -> str:
    """A statement with the arguments that it must have, and some others."""
    given = [
        _argument(random, each, known)
        for each in cls.arguments.values()
        if random.random() < (1 - ODD if each.required else 0.3)
    ]
    if random.random() < 0.3:
        random.shuffle(given)
    form = "/" if cls.singleton else f"/{key}"
    joined = ", ".join(given)
    return f"{cls.keyword}{form}{',' if given and not cls.singleton else ''} {joined}"


def _argument(random: Random, argument: Argument, known: Found) -> str:
    if argument.kind == "flag" or argument.bare:
        return random.choice([*argument.options] if argument.bare else [*argument.keys])
    value = _value(random, argument, known)
    closed = " \\" if argument.kind in ("expression", "text") else ""
    return f"{random.choice(argument.keys)}={value}{closed}"


def _value(random: Random, argument: Argument, known: Found) -> str:
    """The value, or values, of an argument."""
    kind = argument.kind
    if kind == "expression":
        return expression(random, known)
    if kind == "reference":
        ids = FLOATING if "FLOAT" in argument.key else known.get(argument.to, ())
        return _id(random, ids)
    if kind in ("references", "ids"):
        ids = known.get(argument.to, [*"12"])
        separator = ":" if random.random() < ODD else ","
        return separator.join(_id(random, ids) for _ in range(random.choice([1, 2, 2, 3])))
    if kind in ("choice", "words"):
        words = [random.choice([*argument.options]) for _ in range(random.choice([1, 2, 3]))]
        return words[0] if kind == "choice" else ":".join(words)
    if kind in ("text", "texts"):
        return random.choice(WORDS)
    if kind == "integer":
        return _number(random) if random.random() < 5 * ODD else str(random.randint(0, 6))
    least, most = argument.sizes if kind in ("vector", "vectors") else (1, 1)
    size = random.randint(least, min(most, least + 6))
    if random.random() < ODD:
        size = random.randint(1, 20)
    return ",".join(_number(random) for _ in range(size))


def _number(random: Random) -> str:
    return random.choice(ODD_NUMBERS if random.random() < ODD else NUMBERS)


def _id(random: Random, ids: list[str] | tuple[str, ...]) -> str:
    return random.choice(ids) if ids and random.random() > ODD else random.choice(["0", "99", "x"])


# ---- expressions ---------------------------------------------------------------------------------


@cache
def _calls(keywords: frozenset[str], of_time: bool) -> tuple[Function, ...]:
    """Functions whose arguments can be named; those of TIME alone need none."""
    found = []
    for each in FUNCTIONS.values():
        named = {p.statement for p in each.parameters if p.statement and p.kind != "past"}
        vector = each.name in VECTORS
        if not (vector or (named if of_time else named - keywords)) and each.name not in APART:
            found.append(each)
    return tuple(found)


def expression(random: Random, known: Found, depth: int = DEPTH, *, of_time: bool = False) -> str:
    """An expression of any functions."""
    form = random.random()
    if depth == 0 or form < 0.2:
        return random.choice(["TIME", "PI", _number(random), _number(random)])
    if form < 0.4:
        sign = random.choice(["+", "-", "*", "/", "**", "*"])
        one, other = (expression(random, known, depth - 1, of_time=of_time) for _ in range(2))
        return f"({one}){sign}({other})"
    calls = _calls(frozenset(known), of_time)
    if random.random() < ODD:
        calls = tuple(FUNCTIONS.values())
    return _call(random, random.choice(calls), known, depth, of_time)


def _call(random: Random, function: Function, known: Found, depth: int, of_time: bool) -> str:
    """A call with arguments of the kinds that the function takes."""
    values: list[str] = []
    for parameter in function.parameters:
        if parameter.default is not None and random.random() < 0.5:
            break
        least, most = parameter.counts or (1, 1)
        many = random.randint(least, min(most or least + 3, least + 3))
        values += [_actual(random, parameter, known, depth, of_time) for _ in range(many)]
    if values and random.random() < ODD:
        values.pop()
    if function.colon and len(values) > 1:
        return f"{function.name}({values[0]}: {', '.join(values[1:])})"
    return f"{function.name}({', '.join(values)})"


def _actual(random: Random, parameter: Parameter, known: Found, depth: int, of_time: bool) -> str:
    if parameter.kind == "constant":
        return str(random.choice(parameter.allowed or (1, 2)))
    if parameter.kind == "exponent":
        return random.choice(["1", "1.5", "2", "2.2", "3"])
    if parameter.kind == "vector":
        vector = FUNCTIONS[random.choice(VECTORS)]
        return _call(random, vector, known, max(depth - 1, 0), of_time)
    if parameter.statement and parameter.kind != "past" and random.random() > ODD:
        return _id(random, known.get(parameter.statement, ()))
    return expression(random, known, max(depth - 1, 0), of_time=of_time)
